// SPDX-License-Identifier: BSD-3-Clause
// wired: state vehicle.truth nav.state
// says: range MyLawRange[]
// rate: 20 Hz
// A simulated range finder that points down along the body axis, over flat ground at the height of the
// origin. It measures the connected state, with noise and bias from the seed of the component.
#pragma once
#include <algorithm>
#include <cmath>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>
#include <fulmar/random.hpp>

using namespace fulmar;

/// Measurement. A field name ends in its unit. A flag marks a missing value; 0 is a measurement.
struct MyLawRange {
  double range_m = 0;  ///< distance to the ground along the body's down axis
  double range_std_m = unknown_std;
  bool valid = false;  ///< false: ground not in range
};

struct MyLaw {
  static constexpr const char* doc = "A range finder with noise.";
  struct Inputs {
    In<VehicleState> state;  // truth in a simulation
  };
  struct Outputs {
    OutQueue<MyLawRange, 4> range;  // a queue: no reader misses a sample; each has its time of validity
  };
  struct Params {
    Param noise_std{0.05, "m", 0, 10, "standard deviation of a measurement"};
    Param bias_std{0.02, "m", 0, 10, "standard deviation of the constant error, drawn once", setup};
    Param range_max{120, "m", 1, 10000, "largest range with a measurement"};
  };

  explicit MyLaw(std::uint64_t seed) : seed_(seed), noise_(seed) {}

  void configure(const Params& p) {
    noise_ = Random(mix_seed(seed_, 0));
    bias_m_ = p.bias_std * Random(mix_seed(seed_, 1)).normal();
  }

  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
    if (!in.state.fresh()) return Status::ok;  // nothing new to measure
    // Replace this by your own measurement.
    const double down = std::cos(in.state->roll_rad) * std::cos(in.state->pitch_rad);
    const double distance = in.state->height_m / std::max(down, 1e-3);
    MyLawRange seen;
    seen.valid = down > 0.1 && distance >= 0 && distance < p.range_max;
    const double noise =
        p.noise_std * noise_.normal();  // drawn even if unused: later random numbers stay the same
    if (seen.valid) {
      seen.range_m = std::max(distance + bias_m_ + noise, 0.0);
      seen.range_std_m = std::hypot(p.noise_std, p.bias_std);
    }
    out.range.push(seen, in.state.valid_at_ns());
    return Status::ok;
  }

 private:
  std::uint64_t seed_;
  Random noise_;
  double bias_m_ = 0;
};
