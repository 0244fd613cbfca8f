// SPDX-License-Identifier: BSD-3-Clause
// Converts a file of sensors to the simulator's parameters: densities become standard deviations of samples.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fulmar/eigen.hpp"
#include "presets.hpp"

namespace fulmar::sim {

inline Eigen::Matrix3d body_to_sensor(const Mount& m) {
  return (Eigen::AngleAxisd(m.yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(m.pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(m.roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix()
      .transpose();
}

/// Standard deviation of samples at `hz` of white noise with a one-sided density, from 0 to half of `hz`.
inline double sampled(double per_root_hz, double noise, double hz) {
  return per_root_hz > 0 ? std::hypot(per_root_hz * std::sqrt(0.5 * hz), noise) : noise;
}

inline void set_gyro(const ImuErrors& imu, double hz, SensorSpec& s) {
  const GyroErrors& g = imu.gyro;
  const double white = sampled(g.noise_per_root_hz_radps, g.noise_radps, hz);
  const Eigen::Vector3d warm_up = eigen(g.warm_up_radps);
  for (std::size_t i = 0; i < 3; ++i)
    s.gyro[i] = {white,
                 g.bias_range_radps,
                 g.walk_radps,
                 g.drift_radps,
                 g.drift_time_s,
                 !g.drift_from_zero,
                 warm_up[static_cast<Eigen::Index>(i)],
                 g.warm_up_time_s};
  SheetSpec& sheet = s.gyro_sheet;
  sheet.bias_std = g.bias_std_radps;
  sheet.instability = g.instability_radps;
  sheet.instability_time_s = g.instability_time_s;
  sheet.noise_after_1s = white / std::sqrt(hz);
  sheet.walk = g.walk_radps;
  sheet.scale = g.scale_range_ratio;
  sheet.cross_axis = g.cross_axis_ratio;
  sheet.mount = body_to_sensor(imu.mount);
  sheet.bandwidth_hz = g.bandwidth_hz;
  sheet.range = g.range_radps;
  sheet.step = g.step_radps;
  s.gyro_per_g = g.g_sensitivity_radps;
  s.gyro_vibration = g.vibration_radps;
}

inline void set_accel(const ImuErrors& imu, double hz, SensorSpec& s) {
  const AccelErrors& a = imu.accel;
  const double white = sampled(a.noise_per_root_hz_mps2, a.noise_mps2, hz);
  for (NoiseSpec& axis : s.accel)
    axis = {white, a.bias_range_mps2, a.walk_mps2, a.drift_mps2, a.drift_time_s, !a.drift_from_zero};
  SheetSpec& sheet = s.accel_sheet;
  sheet.bias_std = a.bias_std_mps2;
  sheet.instability = a.instability_mps2;
  sheet.instability_time_s = a.instability_time_s;
  sheet.noise_after_1s = white / std::sqrt(hz);
  sheet.walk = a.walk_mps2;
  sheet.scale = a.scale_range_ratio;
  sheet.cross_axis = a.cross_axis_ratio;
  sheet.mount = body_to_sensor(imu.mount);
  sheet.bandwidth_hz = a.bandwidth_hz;
  sheet.range = a.range_mps2;
  sheet.step = a.step_mps2;
  s.accel_vibration = a.vibration_mps2;
}

inline void set_mag(const MagErrors& m, SensorSpec& s) {
  for (NoiseSpec& axis : s.mag)
    axis = {m.noise_tesla, m.bias_range_tesla, 0, m.drift_tesla, m.drift_time_s, !m.drift_from_zero};
  SheetSpec& sheet = s.mag_sheet;
  sheet.mount = body_to_sensor(m.mount);
  sheet.offset = eigen(m.hard_iron_tesla);
  for (int i = 0; i < 9; ++i) sheet.soft_iron(i / 3, i % 3) += m.soft_iron_ratio[static_cast<std::size_t>(i)];
  sheet.scale = m.scale_range_ratio;
  sheet.cross_axis = m.cross_axis_ratio;
  sheet.range = m.range_tesla;
  sheet.step = m.step_tesla;
  s.mag_per_amp = eigen(m.current_tesla);
}

inline NoiseSpec pressure_noise(const PressureErrors& p) {
  return {p.noise_pa, p.bias_range_pa, p.walk_pa, p.drift_pa, p.drift_time_s, !p.drift_from_zero};
}

inline void set_gnss(const GnssErrors& g, SensorSpec& s) {
  const auto position = [](const PositionErrors& e) {
    return NoiseSpec{e.noise_m, 0, 0, e.drift_m, e.drift_time_s, !e.drift_from_zero};
  };
  const auto velocity = [](const VelocityErrors& e) {
    return NoiseSpec{e.noise_mps, 0, 0, e.drift_mps, e.drift_time_s, !e.drift_from_zero};
  };
  s.gnss_position = {position(g.horizontal), position(g.horizontal), position(g.vertical)};
  s.gnss_velocity = {velocity(g.speed), velocity(g.speed), velocity(g.climb)};
  s.gnss_latency_s = g.timing.latency_s;
  s.horizontal_std_m = g.horizontal_std_m;
  s.vertical_std_m = g.vertical_std_m;
  s.speed_std_mps = g.speed_std_mps;
  s.antenna_at = eigen(g.position_m);
  s.gnss_start_up_s = g.start_up_s;
  s.fix = g.fix;
}

/// `tick_hz`: rate of the loop. Of a faster sensor one sample per tick is used.
inline SensorSpec spec_of(const SensorSuite& suite, double tick_hz) {
  SensorSpec s;
  s.imu_hz = suite.imu.timing.rate_hz;
  s.gnss_hz = suite.gnss.timing.rate_hz;
  s.mag_hz = suite.mag.timing.rate_hz;
  s.baro_hz = suite.baro.timing.rate_hz;
  s.pitot_hz = suite.pitot.timing.rate_hz;
  const double imu_hz = std::min(s.imu_hz, tick_hz);
  set_gyro(suite.imu, imu_hz, s);
  set_accel(suite.imu, imu_hz, s);
  s.imu_at = eigen(suite.imu.mount.position_m);
  s.vibration_speed = suite.imu.vibration_speed_radps;
  s.vibration_second = suite.imu.vibration_second_ratio;
  set_mag(suite.mag, s);
  s.baro = pressure_noise(suite.baro);
  s.baro_sheet.range = suite.baro.range_pa;
  s.baro_sheet.step = suite.baro.step_pa;
  s.baro_static_port = suite.baro.static_port_ratio;
  s.pitot = pressure_noise(suite.pitot);
  s.pitot_scale = suite.pitot.scale_range_ratio;
  s.pitot_sheet.range = suite.pitot.range_pa;
  s.pitot_sheet.step = suite.pitot.step_pa;
  s.pitot_static_port = suite.pitot.static_port_ratio;
  s.pitot_alpha = suite.pitot.alpha_ratio;
  s.pitot_beta = suite.pitot.beta_ratio;
  s.pitot_at = eigen(suite.pitot.position_m);
  set_gnss(suite.gnss, s);
  s.calibrated = suite.calibrated;
  s.single_precision = suite.single_precision;
  s.temperature_kelvin = suite.temperature_kelvin;
  s.imu_timing = suite.imu.timing;
  s.gnss_timing = suite.gnss.timing;
  s.mag_timing = suite.mag.timing;
  s.baro_timing = suite.baro.timing;
  s.pitot_timing = suite.pitot.timing;
  return s;
}

/// Sets rates and receiver latency of a built-in set.
inline SensorSpec with_timing(SensorSpec s) {
  s.imu_timing.rate_hz = s.imu_hz;
  s.gnss_timing.rate_hz = s.gnss_hz;
  s.gnss_timing.latency_s = s.gnss_latency_s;
  s.mag_timing.rate_hz = s.mag_hz;
  s.baro_timing.rate_hz = s.baro_hz;
  s.pitot_timing.rate_hz = s.pitot_hz;
  return s;
}

}  // namespace fulmar::sim
