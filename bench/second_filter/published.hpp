// SPDX-License-Identifier: BSD-3-Clause
// Standard deviations, flags and probes that the component (estimator.hpp) publishes beside the estimate.
#pragma once
#include "bench/second_filter/estimator.hpp"

namespace fulmar::second_filter {

/// Each published standard deviation is that of the filter.
inline void Ekf::fill_deviations(const Params& p) {
  const Filter& f = navigator_.filter();
  const Health& h = navigator_.health();
  VehicleState& s = state_;
  const double now = navigator_.time_s();
  deviations_s_ = f.time_s();
  const auto three = [&](int i) { return Vec3<Ned>{f.std(i), f.std(i + 1), f.std(i + 2)}; };
  s.attitude_std_rad = three(theta);
  s.velocity_std_mps = three(vel);
  s.position_std_m = three(pos);
  const auto air = [&](int i) {
    Scalar z;
    z.H(wind + i) = z.H(gust + i) = 1;
    return f.expected_std(z, 0);
  };
  s.wind_std_mps = {air(0), air(1), unknown_std};
  const bool pitot = now - h.pitot.accepted_s < pitot_lost_s,
             tube = !navigator_.airborne() && navigator_.pitot_mps() > 0;
  Scalar speed;
  const Vector3d ahead = f.state().through_air_n().normalized();
  speed.H.segment<3>(vel) = ahead.transpose();
  speed.H.segment<2>(wind) = speed.H.segment<2>(gust) = -ahead.head<2>().transpose();
  s.airspeed_std_mps = navigator_.airborne() ? f.expected_std(speed, 0) : tube ? tube_std_mps : unknown_std;
  const auto origin = navigator_.origin();
  s.origin_latitude_deg = origin.lat_deg;
  s.origin_longitude_deg = origin.lon_deg;
  s.origin_altitude_m = origin.alt_m;
  const Seen& seen = navigator_.seen();
  s.origin_valid = seen.origin;
  const bool known = !navigator_.settling();
  s.attitude_valid = known && seen.yaw &&
                     std::max(s.attitude_std_rad.north, s.attitude_std_rad.east) < tilt_valid_rad &&
                     s.attitude_std_rad.down < yaw_valid_rad;
  s.velocity_valid = known && std::max({s.velocity_std_mps.north, s.velocity_std_mps.east,
                                        s.velocity_std_mps.down}) < speed_valid_mps;
  s.position_valid = known && seen.position && now - h.horizontal.accepted_s < p.gnss_timeout &&
                     std::max(s.position_std_m.north, s.position_std_m.east) < position_valid_m;
  s.height_valid = known && seen.height && s.position_std_m.down < height_valid_m;
  s.wind_valid = known && std::max(s.wind_std_mps.north, s.wind_std_mps.east) < speed_valid_mps;
  s.airspeed_from_model = known && navigator_.airborne() && !pitot && thrust_.in_use();
  s.airspeed_valid = known && (navigator_.airborne() ? pitot || s.airspeed_std_mps < speed_valid_mps : tube);
}

inline void Ekf::publish_check(Outputs& out) {
  const Filter& f = navigator_.filter();
  const Health& h = navigator_.health();
  checked_s_ = h.horizontal.accepted_s;
  FilterCheck c;
  const Covariance& P = f.covariance();
  std::array<double, 9> over_std;
  for (int i = 0; i < 9; ++i) over_std[static_cast<std::size_t>(i)] = 1 / f.std(i);
  std::size_t k = 0;
  for (std::size_t i = 1; i < 9; ++i)
    for (std::size_t j = 0; j < i; ++j)
      c.correlation_ratio[k++] =  // theta, vel, pos
          to_single(P(static_cast<int>(j), static_cast<int>(i)) * over_std[i] * over_std[j]);
  c.position_innovation_ratio = from_eigen<Ned>(h.position_innovation);
  c.velocity_innovation_ratio = from_eigen<Ned>(h.velocity_innovation);
  c.mean_wind_mps = {f(wind), f(wind + 1), 0};
  c.mean_wind_std_mps = {f.std(wind), f.std(wind + 1), unknown_std};
  out.check.publish(c, imu_ns_);
}

inline void Ekf::probes(Outputs& out) const {
  const Health& h = navigator_.health();
  const Nominal& x = navigator_.filter().state();
  out.horizontal_ratio = std::abs(h.horizontal.ratio);
  out.height_ratio = std::abs(h.height.ratio);
  out.velocity_ratio = std::abs(h.velocity.ratio);
  out.baro_ratio = h.baro.ratio;
  out.pitot_ratio = h.pitot.ratio;
  out.sideslip_ratio = h.sideslip.ratio;
  out.heading_ratio = h.heading.ratio;
  out.refused_ratio = h.refused;
  const Vector2d gust_n = x.at<2>(gust);
  out.gust_north_mps = gust_n.x();
  out.gust_east_mps = gust_n.y();
  out.gust_mps = -gust_n.dot(x.through_air_n().head<2>().normalized());
  out.baro_bias_m = x.x(baro_bias);
  out.static_port_ratio = x.x(port);
  out.heading_deviation_rad = x.x(mount);
  out.gnss_delay_s = x.x(delay);
}

}  // namespace fulmar::second_filter
