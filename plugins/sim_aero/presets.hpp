// SPDX-License-Identifier: BSD-3-Clause
// Three sets of sensors: without errors; as in the ROSflight simulator; and from data sheets and typical
// receivers.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "noise.hpp"
#include "sensor_suite.hpp"
#include "sheet.hpp"

namespace fulmar::sim {

enum class SensorSet : std::uint8_t { perfect, rosflight, ublox };

struct SensorSpec {
  double imu_hz = 400, gnss_hz = 10, mag_hz = 50, baro_hz = 50, pitot_hz = 100;
  std::array<NoiseSpec, 3> gyro{}, accel{};  ///< rad/s, m/s2
  std::array<NoiseSpec, 3> mag{};            ///< T
  NoiseSpec baro{}, pitot{};                 ///< Pa
  double pitot_scale = 0;                    ///< scale error of the pressure, drawn from [-this, this]
  std::array<NoiseSpec, 3> gnss_position{}, gnss_velocity{};  ///< NED; m, m/s
  double gnss_latency_s = 0;
  double horizontal_std_m = 0.01, vertical_std_m = 0.01, speed_std_mps = 0.01;  ///< reported by the receiver
  double temperature_kelvin = 300.15;                                           ///< of the sensors
  bool single_precision = false;  ///< for all sensors but the receiver, as sent by a flight controller
  // Not used by the built-in sets: all off.
  SheetSpec gyro_sheet{}, accel_sheet{}, mag_sheet{}, baro_sheet{}, pitot_sheet{};
  bool calibrated = false;
  Eigen::Vector3d imu_at = Eigen::Vector3d::Zero(), pitot_at = Eigen::Vector3d::Zero(),
                  antenna_at = Eigen::Vector3d::Zero();  ///< m from the centre of gravity
  double gyro_per_g = 0;                                 ///< rad/s
  double gyro_vibration = 0, accel_vibration = 0, vibration_speed = 0, vibration_second = 0;
  Eigen::Vector3d mag_per_amp = Eigen::Vector3d::Zero();
  double baro_static_port = 0, pitot_static_port = 0, pitot_alpha = 0, pitot_beta = 0;
  double gnss_start_up_s = 0;
  FixType fix = FixType::fix_3d;
  Timing imu_timing{400}, gnss_timing{10}, mag_timing{50}, baro_timing{50}, pitot_timing{100};
};

/// rosflight_sim's `standalone_sensors` with the defaults of its code. Its random walks are per sample. Here
/// they are rates at its sample rate, which gives the same process at that rate. The README lists the
/// differences.
inline SensorSpec rosflight_sensors() {
  SensorSpec s;
  s.baro_hz = 100;
  s.single_precision = true;
  const double T_imu = 1.0 / 400, T_mag = 1.0 / 50, T_gnss = 1.0 / 10;
  // x <- exp(-T/tau) x + step n has this stationary deviation
  const auto stationary = [](double step, double T, double tau) {
    return step / std::sqrt(-std::expm1(-2 * T / tau));
  };
  const std::array<double, 3> warm_up{0.003, -0.002, 0.001};
  for (std::size_t i = 0; i < 3; ++i) {
    s.gyro[i] = {0.00226,  0.25,  0,          stationary(0.033 * T_imu, T_imu, 1.0 / 20),
                 1.0 / 20, false, warm_up[i], 400};
    s.accel[i] = {0.2, 0.6, 0.00001 / std::sqrt(T_imu)};
    s.mag[i] = {0, 0, 0, stationary(3e-6 * T_mag, T_mag, 1.0 / 7), 1.0 / 7, false};
    s.gnss_position[i] = {0, 0, 0, stationary((i < 2 ? 0.21 : 0.4) * T_gnss, T_gnss, 1100), 1100, false};
    s.gnss_velocity[i] = {0.01};
  }
  s.baro = {4, 500, 0.1 * std::sqrt(100)};
  s.pitot = {1.15, 0.15, 0.001 * std::sqrt(100)};
  s.horizontal_std_m = 0.21;
  s.vertical_std_m = 0.4;
  s.speed_std_mps = 0.01;
  return s;
}

/// A MEMS inertial unit of the ICM-20602 class: 4 mdeg/s and 100 ug per root Hz, 200 Hz bandwidth, after a
/// calibration on the ground. A u-blox M8 class receiver (2.5 m CEP, 0.05 m/s), an MS5611 class barometer,
/// and a pitot in the pressure field of the wing.
inline SensorSpec ublox_sensors() {
  SensorSpec s;
  s.mag_hz = 100;
  s.single_precision = true;
  constexpr double degree = 0.017453292519943295;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool horizontal = i < 2;
    s.gyro[i] = {0.004 * degree * std::sqrt(200.0), 0.5 * degree, 0, 0.003 * degree, 300};
    s.accel[i] = {100e-6 * 9.80665 * std::sqrt(200.0), 0.1, 0, 0.002, 300};
    s.mag[i] = {0.3e-6, 1.5e-6};
    s.gnss_position[i] = {0.3, 0, 0, horizontal ? 1.5 : 3.0, 150};
    s.gnss_velocity[i] = {0.03, 0, 0, horizontal ? 0.1 : 0.2, 2};
  }
  s.baro = {2.5, 150, 0, 12, 600};
  s.pitot = {1, 2, 0, 0.5, 300};
  s.pitot_scale = 0.04;
  s.gnss_latency_s = 0.15;
  s.horizontal_std_m = 1.5;
  s.vertical_std_m = 3;
  s.speed_std_mps = 0.15;
  return s;
}

inline SensorSpec sensor_spec(SensorSet set) {
  if (set == SensorSet::rosflight) return rosflight_sensors();
  if (set == SensorSet::ublox) return ublox_sensors();
  return {};
}

}  // namespace fulmar::sim
