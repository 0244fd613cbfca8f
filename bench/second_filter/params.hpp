// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the estimator. Noises are physical: densities per sqrt(Hz), standard deviations of one sample
// in the sensor's unit. Each sensor adapts its own noise to its innovations, so that one set serves
// different aircraft and days.
#pragma once
#include "fulmar/msg/origin.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::second_filter {

/// Group of parameters of a component that holds the estimator.
struct Params {
  Record<Origin> origin{"origin of the local frame; without it the mean of the first good fixes"};
  Param start_height{0, "m", -1000, 1000, "height of the start position above the origin"};
  Param start_height_std{0.3, "m", 0.01, 1000, "standard deviation of the start height; 1000: unknown"};

  // inertial unit
  Param gyro_noise{5e-4, "rad/s/sqrt(Hz)", 1e-6, 0.1,
                   "white noise of the gyros with vibration, before its estimate from samples"};
  Param gyro_scale_error{1e-3, "1/sqrt(Hz)", 0, 1,
                         "growth of gyro_noise with a sustained turn rate: scale and alignment errors"};
  Param gyro_bias_walk{1.5e-5, "rad/s/sqrt(s)", 0, 0.01, "random walk of the gyro bias"};
  Param gyro_bias_std{0.15, "rad/s", 1e-4, 1, "initial standard deviation of the gyro bias"};
  Param accel_noise{0.02, "m/s2/sqrt(Hz)", 1e-5, 5,
                    "white noise of the accelerometers with vibration, before its estimate from samples"};
  Param accel_scale_error{1e-2, "1/sqrt(Hz)", 0, 1, "growth of accel_noise with a sustained load beyond 1 g"};
  Param accel_bias_walk{2e-4, "m/s2/sqrt(s)", 0, 0.1, "random walk of the accelerometer bias"};
  Param accel_bias_std{0.35, "m/s2", 1e-3, 3, "initial standard deviation of the accelerometer bias"};
  Param gravity{9.80665, "m/s2", 9.7, 9.9, "local gravity"};
  Param max_coast{0.3, "s", 0.03, 2,
                  "largest gap of the inertial unit that is bridged; a longer one restarts the attitude"};
  Param max_bridge{2.1, "s", 0, 10,
                   "largest gap that is bridged by the attitude change of the flight controller"};
  Param gap_rate_std{0.5, "rad/s", 0.01, 5, "standard deviation of the unmeasured turn rate in a gap"};
  Param gap_accel_std{5, "m/s2", 0.1, 50, "standard deviation of the unmeasured acceleration in a gap"};

  // satellite navigation; accuracies that the receiver reports replace the first three
  Param gnss_horizontal_std{2, "m", 0.01, 50, "standard deviation of the horizontal position"};
  Param gnss_vertical_std{2.5, "m", 0.01, 50, "standard deviation of the height"};
  Param gnss_speed_std{0.29, "m/s", 0.005, 10, "standard deviation of the velocity"};
  Param gnss_position_least{1, "m", 0, 10, "least standard deviation of the slow error of a position"};
  Param gnss_position_time{100, "s", 1, 1e4, "correlation time of the slow error of a position"};
  Param gnss_speed_least{0.02, "m/s", 0, 10, "least standard deviation of the slow error of a velocity"};
  Param gnss_speed_time{1.5, "s", 0.1, 100, "correlation time of the slow error of a velocity"};
  Param gnss_white{0.3, "", 0.01, 1,
                   "white part of the error of a fix, as a share of its standard deviation"};
  Param gnss_delay{0, "s", 0, 0.5,
                   "addition to the age of a fix, for receivers with the time of arrival as stamp"};
  Param gnss_delay_std{0.05, "s", 0, 0.3,
                       "standard deviation of gnss_delay; the error is estimated in turns"};
  Param gnss_timeout{5, "s", 0.5, 60, "time without an accepted fix before the position counts as invalid"};
  Count origin_fixes{10, 1, 1000, "number of good fixes on the ground in the mean for the origin", setup};

  // air data
  Param baro_noise{4, "Pa", 0.1, 100, "standard deviation of a sample"};
  Param baro_walk{0.15, "m/sqrt(s)", 0, 5, "random walk of the pressure height by weather and sensor"};
  Param static_port_std{
      0.1, "", 0, 1,
      "initial standard deviation of the static port error, as a share of the dynamic pressure"};
  Param static_port_walk{0.012, "1/sqrt(s)", 0, 0.1,
                         "random walk of the static port error: flaps, throttle, load"};
  Param baro_load_error{0.1, "", 0, 1,
                        "noise of the barometer per g of load beyond 1, as a share of the dynamic pressure"};
  Param pitot_noise{1, "Pa", 0.1, 100, "standard deviation of a pressure sample"};
  Param pitot_speed_std{0.05, "m/s", 0, 5,
                        "standard deviation of an airspeed sample, in addition to the pressure noise"};
  Param pitot_scale{1, "", 0.8, 1.2, "ratio of true to measured airspeed"};
  Param pitot_scale_std{0.012, "", 0, 0.2, "standard deviation of pitot_scale"};
  Param wind_std{5, "m/s", 0.1, 30, "initial standard deviation of the wind"};
  Param wind_walk{0.03, "m/s/sqrt(s)", 0, 5, "random walk of the mean wind"};
  Param wind_shear{0.002, "1/sqrt(s)", 0, 5, "growth of wind_walk with the climb rate"};
  Param gust_std{1, "m/s", 0, 10, "standard deviation of the turbulence, before its estimate from the pitot"};
  Param gust_time{6, "s", 0.1, 60, "correlation time of the turbulence"};
  Param sideslip_ratio{0.35, "", 0, 5, "ratio of the side component of the air velocity to the turbulence"};
  Param sideslip_gust{0.7, "", 0, 1,
                      "share of a change of the side wind that becomes sideslip, before the aircraft turns"};
  Param sideslip_time{1, "s", 0.05, 60, "correlation time of the sideslip"};
  Param sideslip_noise{2, "m/s", 0.01, 20, "white part of the side component of the air velocity, at 10 Hz"};
  Param min_airspeed{8, "m/s", 2, 12, "minimum airspeed at which pitot and sideslip are used"};

  // magnetometer
  Param mag_noise{0.01, "", 1e-4, 0.5, "standard deviation at 10 Hz, as a share of the field"};
  Param mag_scale_std{0.05, "", 0, 1, "standard deviation of the scale of the magnetometer"};
  Param mag_mount_std{0.02, "rad", 0, 1,
                      "standard deviation of the turn of the magnetometer about the body z axis"};
  Param hard_iron_std{0.03, "", 0, 1, "standard deviation of the hard iron, as a share of the field"};
  Param hard_iron_walk{3e-4, "1/sqrt(s)", 0, 0.1, "random walk of the hard iron"};

  Param gate{5, "", 2, 20, "largest accepted innovation in standard deviations"};
  Param rate_filter{0, "Hz", 0, 200, "cut-off frequency of the published body rate; 0: unfiltered"};
};

}  // namespace fulmar::second_filter
