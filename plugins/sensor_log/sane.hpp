// SPDX-License-Identifier: BSD-3-Clause
// Plausible values of a sensor, for any file.
#pragma once
#include <cmath>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>

namespace fulmar::sensor_log {

inline bool finite(const Vec3<Body>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool sane(const Imu& imu) { return finite(imu.rate_radps) && finite(imu.specific_force_mps2); }
inline bool sane(const Mag& mag) { return finite(mag.field_tesla); }
/// Pressure of air is above 0: the estimator computes its logarithm.
inline bool sane(const Baro& baro) { return baro.pressure_pa > 100 && baro.pressure_pa < 2e5; }
inline bool sane(const Pitot& pitot) {
  return std::isfinite(pitot.pressure_pa) && std::isfinite(pitot.indicated_airspeed_mps);
}
inline bool sane(const Gnss& g) {
  const Vec3<Ned>& v = g.velocity_mps;
  return std::abs(g.latitude_deg) <= 90 && std::abs(g.longitude_deg) <= 360 && std::abs(g.altitude_m) < 1e6 &&
         std::isfinite(v.north) && std::isfinite(v.east) && std::isfinite(v.down) &&
         std::isfinite(g.horizontal_std_m) && std::isfinite(g.vertical_std_m) &&
         std::isfinite(g.speed_std_mps);
}

}  // namespace fulmar::sensor_log
