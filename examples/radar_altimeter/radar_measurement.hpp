// SPDX-License-Identifier: BSD-3-Clause
// Measurement model of a radar range, and its checks. Sources: Sola, Quaternion kinematics for the
// error-state Kalman filter (2017), section 7; Groves, Principles of GNSS, Inertial and Multisensor
// Integrated Navigation Systems (2013), chapters 6 (radar altimeter) and 17 (gates).
#pragma once
#include <cmath>
#include <fulmar/flight/navigation/estimator.hpp>

#include "radar_altimeter.hpp"

using Eigen::Vector3d;
using navigation::Navigator;

struct RadarMeasurement {
  struct Params {
    Flag use_radar{true, "use of the radar; false: same estimate as the shipped estimator"};
    Param radar_gate{5, "ratio", 2, 20, "gate of the innovation in standard deviations"};
    Param max_age{0.3, "s", 0.02, 0.5, "largest age of a range that is used"};
    Count stuck_after{10, 2, 1000, "number of equal ranges in a row that counts as a stuck sensor"};
    Param reopen_after{5, "s", 0.5, 60,
                       "duration of rejected ranges after which height and barometer are down-weighted"};
    Param doubt{3, "m", 0.1, 100, "standard deviation that is then added to height and barometer bias"};
  };

  /// Range r = h / c along r_z, the body's z axis in NED, with c = r_z.down = cos phi cos theta. Height, its
  /// row and the tilt are those at the time of the measurement: the height from ekf::position, the tilt by
  /// the present body rate. A rotation theta of the estimate changes r by r/c (e_down x r_z) . theta.
  static ekf::Scalar slant_range(const ErrorStateEkf& f, double time_s, double measured_m) {
    const ErrorStateEkf::Past past = f.at(time_s);
    const Vector3d r_z = f.R_nb() * (exp_map(-past.age_s * f.rate_b()) * Vector3d::UnitZ());
    const double c = r_z.z(), r = -past.p_n.z() / c;
    ekf::Scalar z = ekf::position(f, past, 2, 0);
    z.innovation = measured_m - r;
    z.H *= -1 / c;
    const Eigen::RowVector3d by_tilt = r / c * Vector3d::UnitZ().cross(r_z);
    z.H.segment<3>(ekf::theta) += by_tilt;
    z.H.segment<3>(ekf::gyro_bias) += past.age_s * by_tilt * f.R_nb();
    return z;
  }

  /// Drops ranges without an echo, ranges that are not finite, late ranges, and repeated ones.
  void fuse(Navigator& navigator, const RadarRange& seen, double time_s, const Params& p) {
    const ErrorStateEkf& f = navigator.filter();
    const double age_s = f.time_s() - time_s, c = f.R_nb()(2, 2);
    aid.arrivals.sampled({seen.range_m}, f.time_s());
    const bool stuck = aid.arrivals.repeated() >= p.stuck_after;
    const bool whole = seen.valid && seen.range_m >= 0 && seen.range_m < 1e4 && seen.range_std_m < 100;
    const bool timely = age_s > -0.01 && age_s < p.max_age && f.at(time_s).known;
    if (!p.use_radar || stuck || !whole || !timely || c < 0.3) return;
    // The past tilt is uncertain by a few milliradians, which changes the slant range.
    const double slant_std = 0.004 * seen.range_m * std::tan(std::acos(std::min(c, 1.0)));
    const double std = std::hypot(seen.range_std_m, slant_std, 0.02);
    if (navigator.refused_for_s(aid) >= p.reopen_after)
      navigator.doubt({ekf::pos + 2, ekf::baro}, p.doubt, aid);
    navigator.fuse(slant_range(f, time_s, seen.range_m), std * std, p.radar_gate, aid);
  }

  navigation::Aid aid;
};
