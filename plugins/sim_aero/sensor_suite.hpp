// SPDX-License-Identifier: BSD-3-Clause
// A set of sensors as one YAML file says it, configs/sensors/: what data sheets state, and what nobody's data
// sheet does. What is left out is 0, and a sensor without errors. README.md tells what each key does.
#pragma once
#include <array>
#include <limits>
#include <string_view>

#include "fulmar/message.hpp"
#include "fulmar/msg/gnss.hpp"

namespace fulmar::sim {

/// When a sensor speaks.
struct Timing {
  double rate_hz = 100;         ///< a loop that is slower reads it once per tick
  double latency_s = 0;         ///< from the time that the sample is stamped with to its arrival
  double jitter_s = 0;          ///< samples are early or late by up to this
  double dropouts_frac = 0;     ///< share of the samples that get lost
  double dropout_length_s = 0;  ///< mean length of a gap; 0: each sample is lost for itself
};

/// Where a sensor is and how askew it sits.
struct Mount {
  Vec3<Body> position_m;                            ///< from the centre of gravity
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;  ///< from the body's axes to the sensor's, 3-2-1
};

struct GyroErrors {
  double noise_per_root_hz_radps = 0;  ///< one-sided density
  double noise_radps = 0;              ///< deviation of each sample, whatever the rate; beside the density
  double bias_range_radps = 0;         ///< at turn-on, drawn evenly from +-this
  double bias_std_radps = 0;           ///< at turn-on, normal
  double instability_radps = 0;        ///< lowest point of the Allan deviation
  double instability_time_s = 30;      ///< averaging time of that point
  double walk_radps = 0;               ///< deviation of the rate random walk after one second
  double drift_radps = 0;              ///< stationary deviation of a Gauss-Markov process
  double drift_time_s = 1;             ///< its time constant
  bool drift_from_zero = false;        ///< else it begins with its stationary deviation
  Vec3<Body> warm_up_radps;            ///< an offset that fades
  double warm_up_time_s = 1;
  double scale_range_ratio = 0;    ///< error of the scale, drawn evenly from +-this
  double cross_axis_ratio = 0;     ///< of each axis into each other one, drawn evenly from +-this
  double g_sensitivity_radps = 0;  ///< per 9.80665 m/s2 along the same axis, drawn evenly from +-this
  double vibration_radps = 0;      ///< amplitude at vibration_speed
  double bandwidth_hz = 0;         ///< -3 dB of a first-order low-pass; 0: none
  double range_radps = 0;          ///< larger values are cut; 0: none
  double step_radps = 0;           ///< of the digits; 0: none
};

struct AccelErrors {
  double noise_per_root_hz_mps2 = 0;
  double noise_mps2 = 0;
  double bias_range_mps2 = 0;
  double bias_std_mps2 = 0;
  double instability_mps2 = 0;
  double instability_time_s = 30;
  double walk_mps2 = 0;
  double drift_mps2 = 0;
  double drift_time_s = 1;
  bool drift_from_zero = false;
  double scale_range_ratio = 0;
  double cross_axis_ratio = 0;
  double vibration_mps2 = 0;
  double bandwidth_hz = 0;
  double range_mps2 = 0;
  double step_mps2 = 0;
};

struct ImuErrors {
  Timing timing{400};
  Mount mount;
  GyroErrors gyro;
  AccelErrors accel;
  double vibration_speed_radps = 0;   ///< of the motor, where the vibrations have their amplitude; 0: none
  double vibration_second_ratio = 0;  ///< what the second harmonic has of the first
};

struct MagErrors {
  Timing timing{50};
  Mount mount;  ///< its position counts nothing
  double noise_tesla = 0;
  double bias_range_tesla = 0;
  double drift_tesla = 0;
  double drift_time_s = 1;
  bool drift_from_zero = false;
  Vec3<Body> hard_iron_tesla;
  std::array<double, 9> soft_iron_ratio{};  ///< beyond the identity, row by row
  double scale_range_ratio = 0;
  double cross_axis_ratio = 0;
  Vec3<Body> current_tesla;  ///< per ampere of the motor
  double range_tesla = 0;
  double step_tesla = 0;
};

/// A barometer or a pitot tube with its pressure gauge.
struct PressureErrors {
  Timing timing{100};
  Vec3<Body> position_m;  ///< of the tube, from the centre of gravity; of a barometer it counts nothing
  double noise_pa = 0;
  double bias_range_pa = 0;
  double walk_pa = 0;
  double drift_pa = 0;
  double drift_time_s = 1;
  bool drift_from_zero = false;
  double scale_range_ratio = 0;  ///< of a pitot tube
  double static_port_ratio = 0;  ///< the static port feels its pressure and this share of the dynamic one
  double alpha_ratio = 0;        ///< of a pitot tube: its pressure grows by this share per radian of alpha
  double beta_ratio = 0;         ///< and of |beta|
  double range_pa = 0;
  double step_pa = 0;
};

struct PositionErrors {
  double noise_m = 0;
  double drift_m = 0;
  double drift_time_s = 1;
  bool drift_from_zero = false;
};

struct VelocityErrors {
  double noise_mps = 0;
  double drift_mps = 0;
  double drift_time_s = 1;
  bool drift_from_zero = false;
};

struct GnssErrors {
  Timing timing{10};
  Vec3<Body> position_m;  ///< of the antenna, from the centre of gravity
  PositionErrors horizontal, vertical;
  VelocityErrors speed, climb;
  double start_up_s = 0;           ///< after power-on there is no fix before
  double horizontal_std_m = 0.01;  ///< what the receiver claims
  double vertical_std_m = 0.01;    ///< what it claims
  double speed_std_mps = 0.01;     ///< what it claims
  FixType fix = FixType::fix_3d;
};

/// A parameter `Record<SensorSuite>`.
struct SensorSuite {
  Text<64> name;
  ImuErrors imu;
  MagErrors mag;
  PressureErrors baro, pitot;
  GnssErrors gnss;
  bool calibrated = false;        ///< what a calibration on the ground takes off is off
  bool single_precision = false;  ///< of all but the receiver, as a flight controller sends
  double temperature_kelvin = 300.15;
};

}  // namespace fulmar::sim

namespace fulmar {

namespace sim {
inline constexpr double any = std::numeric_limits<double>::infinity();
}  // namespace sim

template <>
inline constexpr std::array<FieldRange, 5> field_ranges<sim::Timing>{{{"rate_hz", 0.01, 1e5},
                                                                      {"latency_s", 0, 10},
                                                                      {"jitter_s", 0, 10},
                                                                      {"dropouts_frac", 0, 0.99},
                                                                      {"dropout_length_s", 0, 3600}}};

/// Deviations, densities and ranges are not below 0; times are more than that.
template <>
inline constexpr std::array<FieldRange, 17> field_ranges<sim::GyroErrors>{
    {{"noise_per_root_hz_radps", 0, sim::any},
     {"noise_radps", 0, sim::any},
     {"bias_range_radps", 0, sim::any},
     {"bias_std_radps", 0, sim::any},
     {"instability_radps", 0, sim::any},
     {"instability_time_s", 1e-6, sim::any},
     {"walk_radps", 0, sim::any},
     {"drift_radps", 0, sim::any},
     {"drift_time_s", 1e-6, sim::any},
     {"warm_up_time_s", 1e-6, sim::any},
     {"scale_range_ratio", 0, 0.9},
     {"cross_axis_ratio", 0, 0.9},
     {"g_sensitivity_radps", 0, sim::any},
     {"vibration_radps", 0, sim::any},
     {"bandwidth_hz", 0, sim::any},
     {"range_radps", 0, sim::any},
     {"step_radps", 0, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 15> field_ranges<sim::AccelErrors>{
    {{"noise_per_root_hz_mps2", 0, sim::any},
     {"noise_mps2", 0, sim::any},
     {"bias_range_mps2", 0, sim::any},
     {"bias_std_mps2", 0, sim::any},
     {"instability_mps2", 0, sim::any},
     {"instability_time_s", 1e-6, sim::any},
     {"walk_mps2", 0, sim::any},
     {"drift_mps2", 0, sim::any},
     {"drift_time_s", 1e-6, sim::any},
     {"scale_range_ratio", 0, 0.9},
     {"cross_axis_ratio", 0, 0.9},
     {"vibration_mps2", 0, sim::any},
     {"bandwidth_hz", 0, sim::any},
     {"range_mps2", 0, sim::any},
     {"step_mps2", 0, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 8> field_ranges<sim::MagErrors>{{{"noise_tesla", 0, sim::any},
                                                                         {"bias_range_tesla", 0, sim::any},
                                                                         {"drift_tesla", 0, sim::any},
                                                                         {"drift_time_s", 1e-6, sim::any},
                                                                         {"scale_range_ratio", 0, 0.9},
                                                                         {"cross_axis_ratio", 0, 0.9},
                                                                         {"range_tesla", 0, sim::any},
                                                                         {"step_tesla", 0, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 8> field_ranges<sim::PressureErrors>{
    {{"noise_pa", 0, sim::any},
     {"bias_range_pa", 0, sim::any},
     {"walk_pa", 0, sim::any},
     {"drift_pa", 0, sim::any},
     {"drift_time_s", 1e-6, sim::any},
     {"scale_range_ratio", 0, 0.9},
     {"range_pa", 0, sim::any},
     {"step_pa", 0, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<sim::PositionErrors>{
    {{"noise_m", 0, sim::any}, {"drift_m", 0, sim::any}, {"drift_time_s", 1e-6, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 3> field_ranges<sim::VelocityErrors>{
    {{"noise_mps", 0, sim::any}, {"drift_mps", 0, sim::any}, {"drift_time_s", 1e-6, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 4> field_ranges<sim::GnssErrors>{{{"start_up_s", 0, sim::any},
                                                                          {"horizontal_std_m", 0, sim::any},
                                                                          {"vertical_std_m", 0, sim::any},
                                                                          {"speed_std_mps", 0, sim::any}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<sim::ImuErrors>{
    {{"vibration_speed_radps", 0, sim::any}, {"vibration_second_ratio", 0, sim::any}}};

}  // namespace fulmar
