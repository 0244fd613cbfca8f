// SPDX-License-Identifier: BSD-3-Clause
// Conversion of the controller's messages to the shared ones. No value when an input is not finite or not
// plausible: a broken sensor is then silent. Units and scaling: ROSflight sends SI, temperatures in kelvin,
// the field in tesla, indicated airspeed for 1.225 kg/m3.
#pragma once
#include <cmath>
#include <optional>

#include "fulmar/frames.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/pitot.hpp"
#include "link/messages.hpp"
#include "reports.hpp"

namespace fulmar::fcu {

inline constexpr double standard_kelvin = 288.15;

/// Finite, and within +-limit.
template <class... T>
bool within(double limit, T... values) {
  return (... && (std::isfinite(values) && std::abs(static_cast<double>(values)) <= limit));
}

/// An invalid temperature does not invalidate the sample.
inline double kelvin(float value) {
  return within(500, value) && value > 150 ? static_cast<double>(value) : standard_kelvin;
}

inline std::optional<Imu> to_imu(const SmallImu& m) {
  if (!within(400, m.xacc, m.yacc, m.zacc) || !within(100, m.xgyro, m.ygyro, m.zgyro)) return {};
  return Imu{{m.xacc, m.yacc, m.zacc}, {m.xgyro, m.ygyro, m.zgyro}, kelvin(m.temperature)};
}

/// The Earth's field is 25 to 65 uT. More than 1 mT is a magnet, and 0 a missing magnetometer.
inline std::optional<Mag> to_mag(const SmallMag& m) {
  if (!within(1e-3, m.xmag, m.ymag, m.zmag) || (m.xmag == 0 && m.ymag == 0 && m.zmag == 0)) return {};
  return Mag{{m.xmag, m.ymag, m.zmag}};
}

inline std::optional<Baro> to_baro(const SmallBaro& m) {
  if (!within(1.2e5, m.pressure) || m.pressure < 1e4f) return {};
  return Baro{m.pressure, kelvin(m.temperature)};
}

inline std::optional<Pitot> to_pitot(const DiffPressure& m) {
  if (!within(2e4, m.diff_pressure) || !within(200, m.velocity)) return {};
  return Pitot{m.diff_pressure, m.velocity, kelvin(m.temperature)};
}

inline double deviation(float claimed) {
  return within(1e6, claimed) && claimed > 0 ? static_cast<double>(claimed) : unknown_std;
}

inline std::optional<Gnss> to_gnss(const RosflightGnss& m) {
  if (!within(90, m.lat) || !within(180, m.lon) || !within(1e5, m.height) ||
      !within(1e3, m.vel_n, m.vel_e, m.vel_d))
    return {};
  constexpr std::int64_t last_s = 4102444800;  // 2100-01-01
  Gnss g;
  g.latitude_deg = m.lat;
  g.longitude_deg = m.lon;
  g.altitude_m = m.height;
  g.velocity_mps = {m.vel_n, m.vel_e, m.vel_d};
  g.horizontal_std_m = deviation(m.h_acc);
  g.vertical_std_m = deviation(m.v_acc);
  g.speed_std_mps = deviation(m.s_acc);
  // A receiver without a date reports 1970 or its own epoch.
  if (m.seconds > 1000000000 && m.seconds < last_s && std::abs(std::int64_t{m.nanos}) <= 1000000000)
    g.utc_ns = m.seconds * 1000000000 + m.nanos;
  g.fix = m.fix_type <= static_cast<std::uint8_t>(FixType::rtk_fixed) ? static_cast<FixType>(m.fix_type)
                                                                      : FixType::none;
  g.satellites = m.num_sat;
  return g;
}

inline std::optional<Range> to_range(const SmallRange& m) {
  if (!within(1e4, m.range, m.min_range, m.max_range)) return {};
  return Range{m.range, m.min_range, m.max_range, m.range >= m.min_range && m.range <= m.max_range};
}

inline std::optional<ControllerAttitude> to_attitude(const AttitudeQuaternion& m) {
  if (!within(1.1, m.q1, m.q2, m.q3, m.q4) || !within(100, m.rollspeed, m.pitchspeed, m.yawspeed)) return {};
  const double w = m.q1, x = m.q2, y = m.q3, z = m.q4, norm = std::sqrt(w * w + x * x + y * y + z * z);
  if (norm < 0.9) return {};
  ControllerAttitude a;
  a.attitude = {w / norm, x / norm, y / norm, z / norm};
  a.rate_radps = {m.rollspeed, m.pitchspeed, m.yawspeed};
  const Quat& q = a.attitude;
  a.roll_rad = std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y));
  a.pitch_rad = std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0));
  a.yaw_rad = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
  return a;
}

inline std::optional<ControllerOutputs> to_outputs(const RosflightOutputRaw& m) {
  ControllerOutputs o;
  for (std::size_t i = 0; i < o.values_ratio.size(); ++i) {
    if (!within(1e6, m.values[i])) return {};
    o.values_ratio[i] = m.values[i];
  }
  return o;
}

}  // namespace fulmar::fcu
