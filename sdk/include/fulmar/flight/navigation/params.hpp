// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the estimator. Noises are physical: densities per sqrt(Hz), standard deviations of one sample
// in the sensor's unit.
#pragma once
#include "fulmar/msg/origin.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::navigation {

/// Group of parameters of a component that holds the estimator.
struct Params {
  Record<Origin> origin{"origin of the local frame; without it the first good fixes decide"};
  Param start_height{0, "m", -1000, 1000,
                     "above the origin, of the place where it stands when it is switched on"};
  Param start_height_std{0.3, "m", 0.01, 1000, "how well that is known; 1000: not at all"};

  // inertial unit
  Param gyro_noise{5e-4, "rad/s/sqrt(Hz)", 1e-6, 0.1,
                   "white noise of the gyros, vibration included, before their samples tell it"};
  Param gyro_scale_error{1.2e-3, "1/sqrt(Hz)", 0, 0.1,
                         "grows gyro_noise with a turn rate that lasts: scale and alignment errors"};
  Param gyro_bias_walk{2.4e-5, "rad/s/sqrt(s)", 0, 0.01, "how fast the gyro bias wanders"};
  Param gyro_bias_std{0.15, "rad/s", 1e-4, 1, "gyro bias before it is learnt"};
  Param accel_noise{0.02, "m/s2/sqrt(Hz)", 1e-5, 5,
                    "white noise of the accelerometers, vibration included, before their samples tell it"};
  Param accel_scale_error{1e-2, "1/sqrt(Hz)", 0, 0.1, "grows accel_noise with a load beyond 1 g that lasts"};
  Param accel_bias_walk{5e-4, "m/s2/sqrt(s)", 0, 0.1, "how fast the accelerometer bias wanders"};
  Param accel_bias_std{0.35, "m/s2", 1e-3, 3, "accelerometer bias before it is learnt"};
  Param gravity{9.80665, "m/s2", 9.7, 9.9, "local gravity"};
  Param max_coast{
      0.3, "s", 0.03, 2,
      "a gap of the inertial unit is bridged up to this; after a longer one the attitude is found anew"};
  Param max_bridge{
      2.1, "s", 0, 10,
      "a gap up to this is bridged by the turn that the flight controller's own attitude has made"};
  Param gap_rate_std{0.5, "rad/s", 0.01, 5, "turn rate that nobody saw in a gap"};
  Param gap_accel_std{5, "m/s2", 0.1, 50, "acceleration that nobody saw in a gap"};

  // satellite navigation; the receiver's own accuracies count when it reports them
  Param gnss_delay{0, "s", 0, 0.5,
                   "added to the age of a fix, for receivers whose stamp is the time of arrival"};
  Param gnss_delay_std{0.05, "s", 0, 0.3, "how well that is known; the rest is learnt in turns"};
  Param gnss_horizontal_std{2, "m", 0.01, 50, "when the receiver reports none"};
  Param gnss_vertical_std{4, "m", 0.01, 50, "when the receiver reports none"};
  Param gnss_height_time{
      60, "s", 0, 1000,
      "correlation time of the receiver's height error: a fix counts for less the more of them come in it"};
  Param gnss_height_doubt{
      5, "m", 0.5, 100,
      "a height that contradicts by so much for seconds is believed by degrees; below, it hardly counts"};
  Param gnss_climb_time{
      2, "s", 0, 100,
      "the same for the error of its vertical velocity, which would else be integrated to a height"};
  Param gnss_climb_doubt{
      1, "m/s", 0.1, 100,
      "a climb that contradicts by so much over a second is believed; below, it counts by gnss_climb_time"};
  Param gnss_position_time{150, "s", 1, 1e4,
                           "correlation time of the receiver's horizontal error: as large as its deviation, "
                           "and in no mean of fixes"};
  Param gnss_speed_time{0.28, "s", 0, 100,
                        "the same for what of its horizontal velocity error does not change from fix to fix"};
  Param gnss_speed_std{0.29, "m/s", 0.005, 10, "when the receiver reports none"};
  Param gnss_position_floor{0.1, "m", 0, 10, "no position is trusted more than this"};
  Param gnss_speed_floor{0.015, "m/s", 0, 10, "no velocity is trusted more than this"};
  Param gnss_gate{5, "", 2, 20, "innovations beyond this many deviations are refused"};
  Param gnss_reset_after{9, "s", 1, 60, "fixes refused for so long are believed after all"};
  Param gnss_timeout{5, "s", 0.5, 60, "position counts as invalid after so long without an accepted fix"};
  Count origin_fixes{10, 1, 1000, "good fixes on the ground that are averaged to the origin", setup};

  // air data
  Param baro_noise{4, "Pa", 0.1, 100, "of one sample"};
  Param static_port_std{0.05, "", 0, 1,
                        "share of the dynamic pressure that the static port may see, before it is learnt"};
  Param static_port_walk{0.003, "1/sqrt(s)", 0, 0.1, "how fast that share changes: flaps, throttle, load"};
  Param baro_load_error{
      0.1, "", 0, 1,
      "noise of the barometer as a share of the dynamic pressure, for each g of load beyond 1"};
  Param baro_walk{0.06, "m/sqrt(s)", 0, 5, "how fast the weather and the sensor shift the pressure height"};
  Param pitot_noise{2, "Pa", 0.1, 100, "of one sample"};
  Param pitot_speed_std{0.1, "m/s", 0, 5, "of one sample, beside the pressure noise"};
  Param pitot_scale{1, "", 0.8, 1.2, "true over measured airspeed"};
  Param pitot_scale_std{0.012, "", 0, 0.2, "how well that is known: counts in the deviations, is not learnt"};
  Param air_gate{5, "", 2, 20, "gate of baro, pitot and sideslip, in deviations"};
  Param wind_walk{0.01, "m/s/sqrt(s)", 0, 5, "how fast the wind wanders"};
  Param wind_shear{0.002, "1/sqrt(s)", 0, 5, "grows wind_walk with the climb rate"};
  Param wind_std{5, "m/s", 0.1, 30, "wind before it is learnt"};
  Param gust_std{1.5, "m/s", 0, 10, "gusts along the flight: first-order Gauss-Markov"};
  Param gust_time{3, "s", 0.1, 60, "their correlation time"};
  Param wind_gust_std{1, "m/s", 0, 10,
                      "horizontal gusts of the published wind before they are learnt: first-order "
                      "Gauss-Markov, north and east"};
  Param wind_gust_time{12, "s", 2, 60, "their correlation time, before it is learnt, and at most"};
  Param wind_side_ratio{0.8, "", 0.01, 20,
                        "side component of the air velocity, at 10 Hz, as a share of these gusts, for the "
                        "published wind"};
  Param sideslip_speed_std{2.0, "m/s", 0.05, 20,
                           "side component of the air velocity, at 10 Hz; its gusts are correlated, so "
                           "attitude does not follow it"};
  Param sideslip_ratio{0.1, "rad", 0, 1, "grows with the airspeed: sideslip of uncoordinated flight"};
  Param min_airspeed{8, "m/s", 2, 12, "below this neither pitot nor sideslip is used: rolling, not flying"};

  // magnetometer
  Param mag_noise{0.03, "", 1e-4, 0.5, "at 10 Hz, as a share of the field"};
  Param mag_deviation{0.06, "rad", 0, 1, "slow error of the magnetic heading after calibration"};
  Param mag_deviation_time{190, "s", 1, 1e5, "its correlation time"};
  Param mag_gate{5, "", 2, 20, "gate of the heading, in deviations"};

  Param rate_filter{0, "Hz", 0, 200, "cut-off of the published body rate; 0 publishes it as it is"};
};

}  // namespace fulmar::navigation
