// SPDX-License-Identifier: BSD-3-Clause
// A set of sensors in one YAML file, configs/sensors/: values of data sheets, and further errors that data
// sheets do not give. A key that is left out is 0. README.md explains each key.
#pragma once
#include <array>
#include <limits>
#include <string_view>

#include "fulmar/message.hpp"
#include "fulmar/msg/gnss.hpp"

namespace fulmar::sim {

/// Timing of the samples of a sensor.
struct Timing {
  double rate_hz = 100;         ///< rate of the samples; a slower loop reads one per tick
  double latency_s = 0;         ///< delay from the time stamp of a sample to its arrival
  double jitter_s = 0;          ///< largest error of the sampling time, either way
  double dropouts_frac = 0;     ///< share of lost samples
  double dropout_length_s = 0;  ///< mean length of a gap; 0: independent losses
};

/// Position and misalignment of a sensor.
struct Mount {
  Vec3<Body> position_m;                            ///< position from the centre of gravity
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;  ///< rotation from the body axes to the sensor axes,
                                                    ///< 3-2-1
};

struct GyroErrors {
  double noise_per_root_hz_radps = 0;  ///< noise density, one-sided
  double noise_radps = 0;              ///< standard deviation of the noise of a sample at any rate, in
                                       ///< addition to the density
  double bias_range_radps = 0;         ///< largest bias at turn-on, uniform distribution, either way
  double bias_std_radps = 0;           ///< standard deviation of the bias at turn-on, normal distribution
  double instability_radps = 0;        ///< bias instability: minimum of the Allan deviation
  double instability_time_s = 30;      ///< averaging time of that minimum
  double walk_radps = 0;               ///< standard deviation of the rate random walk after one second
  double drift_radps = 0;              ///< stationary standard deviation of a Gauss-Markov drift
  double drift_time_s = 1;             ///< time constant of the drift
  bool drift_from_zero = false;        ///< initial value of the drift: true for 0, false for its stationary
                                       ///< distribution
  Vec3<Body> warm_up_radps;            ///< offset at turn-on that decays
  double warm_up_time_s = 1;           ///< time constant of the warm-up
  double scale_range_ratio = 0;        ///< largest scale error, uniform distribution, either way
  double cross_axis_ratio = 0;         ///< largest coupling of each axis into another one, uniform
                                       ///< distribution, either way
  double g_sensitivity_radps = 0;      ///< largest error per 9.80665 m/s2 along the same axis, uniform
                                       ///< distribution, either way
  double vibration_radps = 0;          ///< amplitude of the vibration at vibration_speed
  double bandwidth_hz = 0;             ///< bandwidth of a first-order low-pass, -3 dB; 0: none
  double range_radps = 0;              ///< measurement range, either way; 0: none
  double step_radps = 0;               ///< resolution; 0: none
};

struct AccelErrors {
  double noise_per_root_hz_mps2 = 0;  ///< noise density, one-sided
  double noise_mps2 = 0;              ///< standard deviation of the noise of a sample
  double bias_range_mps2 = 0;         ///< largest bias at turn-on, uniform distribution, either way
  double bias_std_mps2 = 0;           ///< standard deviation of the bias at turn-on, normal distribution
  double instability_mps2 = 0;        ///< bias instability: minimum of the Allan deviation
  double instability_time_s = 30;     ///< averaging time of that minimum
  double walk_mps2 = 0;               ///< standard deviation of the random walk after one second
  double drift_mps2 = 0;              ///< stationary standard deviation of a Gauss-Markov drift
  double drift_time_s = 1;            ///< time constant of the drift
  bool drift_from_zero = false;       ///< initial value of the drift: true for 0
  double scale_range_ratio = 0;       ///< largest scale error, uniform distribution, either way
  double cross_axis_ratio = 0;        ///< largest coupling of each axis into another one, either way
  double vibration_mps2 = 0;          ///< amplitude of the vibration at vibration_speed
  double bandwidth_hz = 0;            ///< bandwidth of a first-order low-pass, -3 dB; 0: none
  double range_mps2 = 0;              ///< measurement range, either way; 0: none
  double step_mps2 = 0;               ///< resolution; 0: none
};

struct ImuErrors {
  Timing timing{400};
  Mount mount;
  GyroErrors gyro;
  AccelErrors accel;
  double vibration_speed_radps = 0;   ///< motor speed at the full amplitude of the vibrations; 0: none
  double vibration_second_ratio = 0;  ///< ratio of the second harmonic to the first
};

struct MagErrors {
  Timing timing{50};
  Mount mount;                              ///< misalignment; its position is not used
  double noise_tesla = 0;                   ///< standard deviation of the noise of a sample
  double bias_range_tesla = 0;              ///< largest bias at turn-on, uniform distribution, either way
  double drift_tesla = 0;                   ///< stationary standard deviation of a Gauss-Markov drift
  double drift_time_s = 1;                  ///< time constant of the drift
  bool drift_from_zero = false;             ///< initial value of the drift: true for 0
  Vec3<Body> hard_iron_tesla;               ///< field of magnetised parts
  std::array<double, 9> soft_iron_ratio{};  ///< soft iron matrix minus the identity, row by row
  double scale_range_ratio = 0;             ///< largest scale error, uniform distribution, either way
  double cross_axis_ratio = 0;              ///< largest coupling of each axis into another one, either way
  Vec3<Body> current_tesla;                 ///< field per ampere of the motor
  double range_tesla = 0;                   ///< measurement range, either way; 0: none
  double step_tesla = 0;                    ///< resolution; 0: none
};

/// A barometer or a pitot with its pressure sensor.
struct PressureErrors {
  Timing timing{100};
  Vec3<Body> position_m;         ///< position of the pitot from the centre of gravity; not used for a
                                 ///< barometer
  double noise_pa = 0;           ///< standard deviation of the noise of a sample
  double bias_range_pa = 0;      ///< largest bias at turn-on, uniform distribution, either way
  double walk_pa = 0;            ///< standard deviation of the random walk after one second
  double drift_pa = 0;           ///< stationary standard deviation of a Gauss-Markov drift
  double drift_time_s = 1;       ///< time constant of the drift
  bool drift_from_zero = false;  ///< initial value of the drift: true for 0
  double scale_range_ratio = 0;  ///< largest scale error of a pitot, uniform distribution, either way
  double static_port_ratio = 0;  ///< error of the static port, as a share of the dynamic pressure
  double alpha_ratio = 0;        ///< relative growth of the pressure of a pitot per radian of alpha
  double beta_ratio = 0;         ///< relative growth of the pressure of a pitot per radian of |beta|
  double range_pa = 0;           ///< measurement range; 0: none
  double step_pa = 0;            ///< resolution; 0: none
};

struct PositionErrors {
  double noise_m = 0;            ///< standard deviation of the noise of a fix, each axis
  double drift_m = 0;            ///< stationary standard deviation of a Gauss-Markov drift
  double drift_time_s = 1;       ///< time constant of the drift
  bool drift_from_zero = false;  ///< initial value of the drift: true for 0
};

struct VelocityErrors {
  double noise_mps = 0;          ///< standard deviation of the noise of a fix, each axis
  double drift_mps = 0;          ///< stationary standard deviation of a Gauss-Markov drift
  double drift_time_s = 1;       ///< time constant of the drift
  bool drift_from_zero = false;  ///< initial value of the drift: true for 0
};

struct GnssErrors {
  Timing timing{10};
  Vec3<Body> position_m;                ///< position of the antenna from the centre of gravity
  PositionErrors horizontal, vertical;  ///< errors of the position
  VelocityErrors speed, climb;          ///< errors of the velocity
  double start_up_s = 0;                ///< time from power-on to the first fix
  double horizontal_std_m = 0.01;       ///< reported standard deviation of the horizontal position
  double vertical_std_m = 0.01;         ///< reported standard deviation of the altitude
  double speed_std_mps = 0.01;          ///< reported standard deviation of the velocity
  FixType fix = FixType::fix_3d;        ///< reported type of the fix
};

/// A parameter `Record<SensorSuite>`.
struct SensorSuite {
  Text<64> name;
  ImuErrors imu;
  MagErrors mag;
  PressureErrors baro, pitot;
  GnssErrors gnss;
  bool calibrated = false;             ///< removal of the biases that a calibration on the ground finds
  bool single_precision = false;       ///< single precision of all sensors except the receiver, as from a
                                       ///< flight controller
  double temperature_kelvin = 300.15;  ///< temperature of the sensors
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

/// Standard deviations, densities and ranges are at least 0; times are above 0.
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
