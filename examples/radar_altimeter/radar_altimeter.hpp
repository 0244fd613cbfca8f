// SPDX-License-Identifier: BSD-3-Clause
// A simulated radar altimeter with a narrow beam, fixed to the aircraft. Over flat ground at the height of
// the origin it measures the slant range r = h / (cos phi cos theta) along the body's z axis. The divisor is
// the last element of the rotation from body to NED: Beard & McLain, Small Unmanned Aircraft (2012), chapter
// 2.
#pragma once
#include <cmath>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <fulmar/random.hpp>

using namespace fulmar;

/// Slant range to the ground along the body's z axis.
struct RadarRange {
  double range_m = 0;
  double range_std_m = unknown_std;
  bool valid = false;  ///< false: no echo, `range_m` is not valid
};

struct RadarAltimeter {
  static constexpr const char* doc =
      "Slant range to flat ground along the body's z axis, with a delay of one step.";
  struct Inputs {
    In<VehicleState> truth;
  };
  struct Outputs {
    OutQueue<RadarRange, 4> range;
  };
  struct Params {
    Param noise_std{0.25, "m", 0, 10, "standard deviation of a measurement"};
    Param max_range{120, "m", 1, 5000, "largest range with an echo"};
    Param max_tilt{0.6, "rad", 0.05, 1.4, "largest tilt of the beam with an echo"};
    Param dropout{0.02, "ratio", 0, 1, "share of measurements without an echo, at random"};
  };

  explicit RadarAltimeter(std::uint64_t seed) : random_(seed) {}

  RadarRange measure(const VehicleState& truth, const Params& p) {
    const double noise_m = p.noise_std * random_.normal();  // drawn also if unused: the later ones stay equal
    const bool lost = random_.uniform() < p.dropout;
    const double c = std::cos(truth.roll_rad) * std::cos(truth.pitch_rad);
    const double r = truth.height_m / c;
    if (lost || c < std::cos(p.max_tilt) || r < 0 || r > p.max_range) return {};
    return {std::max(r + noise_m, 0.0), p.noise_std, true};
  }

  /// The radar has a delay of one period; the range has the time of its measurement.
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (!in.truth.fresh()) return Status::ok;
    if (measured_) out.range.push(last_, last_ns_);
    last_ = measure(*in.truth, p);
    last_ns_ = in.truth.valid_at_ns();
    measured_ = true;
    return Status::ok;
  }

 private:
  Random random_;
  RadarRange last_;
  std::int64_t last_ns_ = 0;
  bool measured_ = false;
};
