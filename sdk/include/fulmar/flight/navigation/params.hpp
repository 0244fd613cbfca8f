// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the estimator. Noises are physical: densities per sqrt(Hz), standard deviations of one sample
// in the sensor's unit.
#pragma once
#include "fulmar/msg/origin.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::navigation {

/// Group of parameters of a component that holds the estimator.
struct Params {
  Record<Origin> origin{"origin of the local frame; without it the mean of the first good fixes"};
  Param start_height{0, "m", -1000, 1000, "height of the start position above the origin"};
  Param start_height_std{0.3, "m", 0.01, 1000, "standard deviation of the start height; 1000: unknown"};

  // inertial unit
  Param gyro_noise{5e-4, "rad/s/sqrt(Hz)", 1e-6, 0.1,
                   "white noise of the gyros with vibration, before its estimate from samples"};
  Param gyro_scale_error{1.2e-3, "1/sqrt(Hz)", 0, 0.1,
                         "growth of gyro_noise with a sustained turn rate: scale and alignment errors"};
  Param gyro_bias_walk{2.4e-5, "rad/s/sqrt(s)", 0, 0.01, "random walk of the gyro bias"};
  Param gyro_bias_std{0.15, "rad/s", 1e-4, 1, "initial standard deviation of the gyro bias"};
  Param accel_noise{0.02, "m/s2/sqrt(Hz)", 1e-5, 5,
                    "white noise of the accelerometers with vibration, before its estimate from samples"};
  Param accel_scale_error{1e-2, "1/sqrt(Hz)", 0, 0.1,
                          "growth of accel_noise with a sustained load beyond 1 g"};
  Param accel_bias_walk{5e-4, "m/s2/sqrt(s)", 0, 0.1, "random walk of the accelerometer bias"};
  Param accel_bias_std{0.35, "m/s2", 1e-3, 3, "initial standard deviation of the accelerometer bias"};
  Param gravity{9.80665, "m/s2", 9.7, 9.9, "local gravity"};
  Param max_coast{0.3, "s", 0.03, 2,
                  "largest gap of the inertial unit that is bridged; a longer one restarts the attitude"};
  Param max_bridge{2.1, "s", 0, 10,
                   "largest gap that is bridged by the attitude change of the flight controller"};
  Param gap_rate_std{0.5, "rad/s", 0.01, 5, "standard deviation of the unmeasured turn rate in a gap"};
  Param gap_accel_std{5, "m/s2", 0.1, 50, "standard deviation of the unmeasured acceleration in a gap"};

  // satellite navigation; the receiver's own accuracies count when it reports them
  Param gnss_delay{0, "s", 0, 0.5,
                   "addition to the age of a fix, for receivers with the time of arrival as stamp"};
  Param gnss_delay_std{0.05, "s", 0, 0.3,
                       "standard deviation of gnss_delay; the error is estimated in turns"};
  Param gnss_horizontal_std{2, "m", 0.01, 50,
                            "standard deviation of the horizontal position, if the receiver reports none"};
  Param gnss_vertical_std{4, "m", 0.01, 50, "standard deviation of the height, if the receiver reports none"};
  Param gnss_height_time{
      60, "s", 0, 1000, "correlation time of the receiver's height error: it reduces the weight of each fix"};
  Param gnss_height_doubt{
      5, "m", 0.5, 100,
      "height innovation, sustained for seconds, that is gradually accepted; low weight below"};
  Param gnss_climb_time{2, "s", 0, 100, "correlation time of the receiver's vertical velocity error"};
  Param gnss_climb_doubt{
      1, "m/s", 0.1, 100,
      "climb rate innovation, sustained for a second, that is accepted; below it gnss_climb_time holds"};
  Param gnss_position_time{150, "s", 1, 1e4, "correlation time of the receiver's horizontal position error"};
  Param gnss_speed_time{0.28, "s", 0, 100,
                        "correlation time of the slow part of the receiver's horizontal velocity error"};
  Param gnss_speed_std{0.29, "m/s", 0.005, 10,
                       "standard deviation of the velocity, if the receiver reports none"};
  Param gnss_position_floor{0.1, "m", 0, 10, "minimum standard deviation of a position"};
  Param gnss_speed_floor{0.015, "m/s", 0, 10, "minimum standard deviation of a velocity"};
  Param gnss_gate{5, "", 2, 20, "gate of the innovation in standard deviations"};
  Param gnss_reset_after{9, "s", 1, 60, "duration of rejected fixes after which they are accepted"};
  Param gnss_timeout{5, "s", 0.5, 60, "time without an accepted fix before the position counts as invalid"};
  Count origin_fixes{10, 1, 1000, "number of good fixes on the ground in the mean for the origin", setup};

  // air data
  Param baro_noise{4, "Pa", 0.1, 100, "standard deviation of a sample"};
  Param static_port_std{
      0.05, "", 0, 1,
      "initial standard deviation of the static port error, as a share of the dynamic pressure"};
  Param static_port_walk{0.003, "1/sqrt(s)", 0, 0.1,
                         "random walk of the static port error: flaps, throttle, load"};
  Param baro_load_error{0.1, "", 0, 1,
                        "noise of the barometer per g of load beyond 1, as a share of the dynamic pressure"};
  Param baro_walk{0.06, "m/sqrt(s)", 0, 5, "random walk of the pressure height by weather and sensor"};
  Param pitot_noise{2, "Pa", 0.1, 100, "standard deviation of a pressure sample"};
  Param pitot_speed_std{0.1, "m/s", 0, 5,
                        "standard deviation of an airspeed sample, in addition to the pressure noise"};
  Param pitot_scale{1, "", 0.8, 1.2, "ratio of true to measured airspeed"};
  Param pitot_scale_std{
      0.012, "", 0, 0.2,
      "standard deviation of pitot_scale: part of the reported standard deviation, not estimated"};
  Param air_gate{5, "", 2, 20, "gate of baro, pitot and sideslip in standard deviations"};
  Param wind_walk{0.01, "m/s/sqrt(s)", 0, 5, "random walk of the wind"};
  Param wind_shear{0.002, "1/sqrt(s)", 0, 5, "growth of wind_walk with the climb rate"};
  Param wind_std{5, "m/s", 0.1, 30, "initial standard deviation of the wind"};
  Param gust_std{1.5, "m/s", 0, 10,
                 "standard deviation of gusts along the flight path: first-order Gauss-Markov"};
  Param gust_time{3, "s", 0.1, 60, "correlation time of the gusts along the flight path"};
  Param wind_gust_std{1, "m/s", 0, 10,
                      "initial standard deviation of the horizontal gusts of the published wind: first-order "
                      "Gauss-Markov, north and east"};
  Param wind_gust_time{12, "s", 2, 60,
                       "correlation time of these gusts: initial value and upper limit of the estimate"};
  Param wind_side_ratio{
      0.8, "", 0.01, 20,
      "ratio of the side component of the air velocity, at 10 Hz, to these gusts, for the published wind"};
  Param sideslip_speed_std{
      2.0, "m/s", 0.05, 20,
      "standard deviation of the side component of the air velocity, at 10 Hz, for the attitude"};
  Param sideslip_ratio{0.1, "rad", 0, 1, "standard deviation of the sideslip angle in uncoordinated flight"};
  Param min_airspeed{8, "m/s", 2, 12, "minimum airspeed at which pitot and sideslip are used"};

  // magnetometer
  Param mag_noise{0.03, "", 1e-4, 0.5, "standard deviation at 10 Hz, as a share of the field"};
  Param mag_deviation{0.06, "rad", 0, 1,
                      "standard deviation of the slow error of the magnetic heading after calibration"};
  Param mag_deviation_time{190, "s", 1, 1e5, "correlation time of the slow error of the magnetic heading"};
  Param mag_gate{5, "", 2, 20, "gate of the heading in standard deviations"};

  Param rate_filter{0, "Hz", 0, 200, "cut-off frequency of the published body rate; 0: unfiltered"};
};

}  // namespace fulmar::navigation
