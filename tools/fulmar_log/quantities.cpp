// SPDX-License-Identifier: BSD-3-Clause
// See quantities.hpp.
#include "tools/fulmar_log/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fulmar/flight/math/angles.hpp"
#include "tools/fulmar_log/pairing.hpp"

namespace fulmar::states {
namespace {

using S = const VehicleState&;
constexpr double degrees = 180 / std::numbers::pi;

bool attitude(S s) { return s.attitude_valid; }
bool velocity(S s) { return s.velocity_valid; }
bool position(S s) { return s.position_valid; }
bool height(S s) { return s.height_valid; }
bool airspeed(S s) { return s.airspeed_valid; }
bool wind(S s) { return s.wind_valid; }

/// Standard deviation of the small rotation about a level axis; `rad` is its direction, from north.
double level_std(S s, double rad) {
  return std::hypot(std::cos(rad) * s.attitude_std_rad.north, std::sin(rad) * s.attitude_std_rad.east);
}
// Effect of a small rotation phi about the NED axes on the angles of the 3-2-1 sequence, to first order:
// d roll = (cos psi phi_n + sin psi phi_e) / cos theta, d pitch = -sin psi phi_n + cos psi phi_e,
// d yaw = phi_d + sin theta d roll. From B&M (3.3), with the rate in the axes of the ground.
// The correlation of the errors about two axes is neglected.
double roll_std(S s) { return level_std(s, s.yaw_rad) / std::max(std::cos(s.pitch_rad), 1e-6); }
double pitch_std(S s) { return level_std(s, s.yaw_rad + std::numbers::pi / 2); }
double yaw_std(S s) { return std::hypot(s.attitude_std_rad.down, std::sin(s.pitch_rad) * roll_std(s)); }

template <class... Values>
bool finite(Values... values) {
  return (std::isfinite(values) && ...);
}
bool finite(const Vec3<Ned>& v) { return finite(v.north, v.east, v.down); }
bool finite(const Vec3<Body>& v) { return finite(v.x, v.y, v.z); }

template <class Frame>
Vec3<Frame> mix(const Vec3<Frame>& a, const Vec3<Frame>& b, double t) {
  return a + t * (b - a);
}
double mix(double a, double b, double t) { return a + t * (b - a); }
double turn(double a, double b, double t) { return wrap_pi(a + t * angle_difference(b, a)); }

/// Interpolates between two attitudes that are close to each other.
Quat mix(const Quat& a, const Quat& b, double t) {
  const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -1 : 1;
  Quat q{mix(a.w, sign * b.w, t), mix(a.x, sign * b.x, t), mix(a.y, sign * b.y, t), mix(a.z, sign * b.z, t)};
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

}  // namespace

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all{
      {"roll_deg", "roll", "deg", degrees, true, [](S s) { return s.roll_rad; }, roll_std, attitude},
      {"pitch_deg", "pitch", "deg", degrees, true, [](S s) { return s.pitch_rad; }, pitch_std, attitude},
      {"yaw_deg", "yaw", "deg", degrees, true, [](S s) { return s.yaw_rad; }, yaw_std, attitude},
      {"velocity_north_mps", "velocity north", "m/s", 1, false, [](S s) { return s.velocity_mps.north; },
       [](S s) { return s.velocity_std_mps.north; }, velocity},
      {"velocity_east_mps", "velocity east", "m/s", 1, false, [](S s) { return s.velocity_mps.east; },
       [](S s) { return s.velocity_std_mps.east; }, velocity},
      {"velocity_down_mps", "velocity down", "m/s", 1, false, [](S s) { return s.velocity_mps.down; },
       [](S s) { return s.velocity_std_mps.down; }, velocity},
      {"position_north_m", "position north", "m", 1, false, [](S s) { return s.position_m.north; },
       [](S s) { return s.position_std_m.north; }, position},
      {"position_east_m", "position east", "m", 1, false, [](S s) { return s.position_m.east; },
       [](S s) { return s.position_std_m.east; }, position},
      {"height_m", "height", "m", 1, false, [](S s) { return s.height_m; },
       [](S s) { return s.position_std_m.down; }, height},
      {"airspeed_mps", "airspeed", "m/s", 1, false, [](S s) { return s.airspeed_mps; },
       [](S s) { return s.airspeed_std_mps; }, airspeed},
      {"wind_north_mps", "wind north", "m/s", 1, false, [](S s) { return s.wind_mps.north; },
       [](S s) { return s.wind_std_mps.north; }, wind},
      {"wind_east_mps", "wind east", "m/s", 1, false, [](S s) { return s.wind_mps.east; },
       [](S s) { return s.wind_std_mps.east; }, wind},
      {"gyro_bias_x_degps", "gyro bias x", "deg/s", degrees, false, [](S s) { return s.gyro_bias_radps.x; },
       nullptr, attitude},
      {"gyro_bias_y_degps", "gyro bias y", "deg/s", degrees, false, [](S s) { return s.gyro_bias_radps.y; },
       nullptr, attitude},
      {"gyro_bias_z_degps", "gyro bias z", "deg/s", degrees, false, [](S s) { return s.gyro_bias_radps.z; },
       nullptr, attitude},
      {"accel_bias_x_mps2", "accel bias x", "m/s2", 1, false, [](S s) { return s.accel_bias_mps2.x; },
       nullptr, attitude},
      {"accel_bias_y_mps2", "accel bias y", "m/s2", 1, false, [](S s) { return s.accel_bias_mps2.y; },
       nullptr, attitude},
      {"accel_bias_z_mps2", "accel bias z", "m/s2", 1, false, [](S s) { return s.accel_bias_mps2.z; },
       nullptr, attitude}};
  return all;
}

double Quantity::difference(const VehicleState& of, const VehicleState& from) const {
  return scale * (angle ? angle_difference(value(of), value(from)) : value(of) - value(from));
}
bool Quantity::is_valid(const VehicleState& state) const {
  return valid(state) && std::isfinite(value(state));
}
bool Quantity::has_claim(const VehicleState& state) const {
  if (!std) return false;
  const double claimed = std(state);
  return claimed >= 0 && claimed < 0.1 * unknown_std;
}

bool drop_not_finite(VehicleState& s) {
  const VehicleState before = s;
  const Quat& q = s.attitude;
  s.attitude_valid = s.attitude_valid && finite(s.roll_rad, s.pitch_rad, s.yaw_rad, q.w, q.x, q.y, q.z) &&
                     finite(s.gyro_bias_radps) && finite(s.accel_bias_mps2);
  s.velocity_valid = s.velocity_valid && finite(s.velocity_mps);
  s.position_valid = s.position_valid && finite(s.position_m.north, s.position_m.east);
  s.height_valid = s.height_valid && finite(s.height_m, s.position_m.down);
  s.airspeed_valid = s.airspeed_valid && finite(s.airspeed_mps);
  s.wind_valid = s.wind_valid && finite(s.wind_mps.north, s.wind_mps.east);
  s.origin_valid =
      s.origin_valid && finite(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
  return s.attitude_valid == before.attitude_valid && s.velocity_valid == before.velocity_valid &&
         s.position_valid == before.position_valid && s.height_valid == before.height_valid &&
         s.airspeed_valid == before.airspeed_valid && s.wind_valid == before.wind_valid &&
         s.origin_valid == before.origin_valid;
}

VehicleState between(const VehicleState& a, const VehicleState& b, double t) {
  VehicleState s = a;  // fields that are not compared stay unchanged
  s.position_m = mix(a.position_m, b.position_m, t);
  s.velocity_mps = mix(a.velocity_mps, b.velocity_mps, t);
  s.attitude = mix(a.attitude, b.attitude, t);
  s.roll_rad = turn(a.roll_rad, b.roll_rad, t);
  s.pitch_rad = mix(a.pitch_rad, b.pitch_rad, t);
  s.yaw_rad = turn(a.yaw_rad, b.yaw_rad, t);
  s.height_m = mix(a.height_m, b.height_m, t);
  s.airspeed_mps = mix(a.airspeed_mps, b.airspeed_mps, t);
  s.wind_mps = mix(a.wind_mps, b.wind_mps, t);
  s.gyro_bias_radps = mix(a.gyro_bias_radps, b.gyro_bias_radps, t);
  s.accel_bias_mps2 = mix(a.accel_bias_mps2, b.accel_bias_mps2, t);
  s.position_std_m = mix(a.position_std_m, b.position_std_m, t);
  s.velocity_std_mps = mix(a.velocity_std_mps, b.velocity_std_mps, t);
  s.attitude_std_rad = mix(a.attitude_std_rad, b.attitude_std_rad, t);
  s.wind_std_mps = mix(a.wind_std_mps, b.wind_std_mps, t);
  s.airspeed_std_mps = mix(a.airspeed_std_mps, b.airspeed_std_mps, t);
  s.origin_valid = a.origin_valid && b.origin_valid;
  s.attitude_valid = a.attitude_valid && b.attitude_valid;
  s.velocity_valid = a.velocity_valid && b.velocity_valid;
  s.position_valid = a.position_valid && b.position_valid;
  s.height_valid = a.height_valid && b.height_valid;
  s.airspeed_valid = a.airspeed_valid && b.airspeed_valid;
  s.wind_valid = a.wind_valid && b.wind_valid;
  return s;
}

const LocalFrame& CommonFrame::frame_of(const VehicleState& base) {
  const double lat = base.origin_latitude_deg, lon = base.origin_longitude_deg, alt = base.origin_altitude_m;
  if (!known_ || lat != lat_deg_ || lon != lon_deg_ || alt != alt_m_) frame_ = LocalFrame(lat, lon, alt);
  lat_deg_ = lat;
  lon_deg_ = lon;
  alt_m_ = alt;
  known_ = true;
  return frame_;
}

VehicleState CommonFrame::seen_from(const VehicleState& state, const VehicleState& base) {
  const bool same = state.origin_latitude_deg == base.origin_latitude_deg &&
                    state.origin_longitude_deg == base.origin_longitude_deg &&
                    state.origin_altitude_m == base.origin_altitude_m;
  if (same || !state.origin_valid || !base.origin_valid) return state;
  const Eigen::Vector3d away =
      frame_of(base).to_ned(state.origin_latitude_deg, state.origin_longitude_deg, state.origin_altitude_m);
  VehicleState moved = state;
  moved.position_m = state.position_m + Vec3<Ned>{away.x(), away.y(), away.z()};
  moved.height_m -= away.z();
  return moved;
}

VehicleState CommonFrame::seen_from(const Gnss& fix, const VehicleState& base) {
  VehicleState s;
  const bool solved = fix.fix != FixType::none && fix.fix != FixType::dead_reckoning &&
                      fix.fix != FixType::time_only && base.origin_valid &&
                      finite(fix.latitude_deg, fix.longitude_deg, fix.altitude_m);
  if (!solved) return s;
  const Eigen::Vector3d p = frame_of(base).to_ned(fix.latitude_deg, fix.longitude_deg, fix.altitude_m);
  s.position_m = {p.x(), p.y(), p.z()};
  s.height_m = -p.z();
  s.velocity_mps = fix.velocity_mps;
  s.position_std_m = {fix.horizontal_std_m, fix.horizontal_std_m, fix.vertical_std_m};
  s.velocity_std_mps = {fix.speed_std_mps, fix.speed_std_mps, fix.speed_std_mps};
  s.position_valid = true;
  s.height_valid = fix.fix != FixType::fix_2d;
  s.velocity_valid = finite(fix.velocity_mps);
  return s;
}

}  // namespace fulmar::states
