// SPDX-License-Identifier: BSD-3-Clause
// Airspeed without a pitot: thrust and drag (fulmar/flight/navigation/airspeed_model.hpp), learnt while the
// pitot works. The error of the model is the state `model`, constant while the pitot is lost.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bench/second_filter/sensors.hpp"
#include "fulmar/flight/navigation/airspeed_model.hpp"

namespace fulmar::second_filter {

class Thrust {
 public:
  /// Call with each inertial sample, after the samples of other sensors. `commanded`: the motor gets this
  /// throttle.
  void step(Navigator& navigator, double throttle_frac, bool commanded, double dt_s, const Params& p) {
    const bool flies = navigator.airborne() && navigator.aligned() && !navigator.settling();
    if (!flies || !commanded || !(dt_s < Navigator::coasted_s)) {
      begin(throttle_frac);
      return;
    }
    const Filter& f = navigator.filter();
    lag_ += (throttle_frac - lag_) * std::min(dt_s / lag_s, 1.0);
    sum_.f_x_mps2 += dt_s * f.specific_force_b().x();
    sum_.f_z_mps2 += dt_s * f.specific_force_b().z();
    sum_.throttle_frac += dt_s * lag_;
    sum_.Va_mps += dt_s * f.state().through_air_n().norm();
    time_s_ += dt_s;
    if (time_s_ < AirspeedModel::block_s - 1e-4) return;
    const AirspeedModel::Block mean{sum_.f_x_mps2 / time_s_, sum_.f_z_mps2 / time_s_,
                                    sum_.throttle_frac / time_s_, sum_.Va_mps / time_s_};
    sum_ = {};
    time_s_ = 0;
    block(navigator, mean, p);
  }
  /// True when the model supplies the airspeed.
  bool in_use() const { return in_use_; }

 private:
  static constexpr double lag_s = 0.1;   ///< of an electric motor with its propeller
  static constexpr double lost_s = 0.5;  ///< without an accepted sample the pitot is lost
  static constexpr double doubt_s = 8;   ///< samples of this time before a detected fault are not learnt
  static constexpr double refused_std = 4, off_std = 1.3,
                          off_s = 2;            ///< innovation, and its mean over seconds
  static constexpr double wrong_mps = 1.5;      ///< by which a wrong model may have moved the wind, each axis
  static constexpr double model_std_mps = 0.3;  ///< beside the standard deviation of its parameters
  static constexpr std::size_t waiting = static_cast<std::size_t>(doubt_s / AirspeedModel::block_s);

  void begin(double throttle_frac) {
    sum_ = {};
    time_s_ = 0;
    lag_ = throttle_frac;
    in_use_ = false;
  }
  void block(Navigator& n, AirspeedModel::Block b, const Params& p) {
    Filter& f = n.filter();
    const double root = std::sqrt(n.air().density_kgm3 / isa::sea_level_density);
    b.Va_mps *= root;
    model_.wander(AirspeedModel::block_s);
    const Aid& tube = n.health().pitot;
    if (n.time_s() - tube.accepted_s < lost_s && !tube.faulty(n.time_s())) {
      in_use_ = ended_ = refused_ = false;
      if (count_ == waiting) model_.learn(late_[next_]);
      late_[next_] = b;
      next_ = (next_ + 1) % waiting;
      count_ = std::min(count_ + 1, waiting);
      return;
    }
    count_ = 0;
    const AirspeedModel::Said said = model_.airspeed(b);
    if (said.known && !in_use_ && !ended_) {
      f.correct(model, -f(model));
      f.forget(model, 1, std::hypot(model_std_mps, said.model_std_mps / root));
    }
    if (said.known && !in_use_) off_ = 0;
    in_use_ = said.known && !ended_;
    if (!in_use_) return;
    const double noise = said.noise_std_mps / root;
    const Scalar z = modelled_airspeed(f, (said.Va_mps - b.Va_mps) / root);
    if (contradicts(z.innovation / f.expected_std(z, noise * noise))) {
      f.inflate(wind, 2, wrong_mps);
      in_use_ = false;
      ended_ = true;
    } else if (!refused_) {
      n.fuse(z, noise * noise, p, n.health().model);
    }
  }

  /// A motor that stops looks like a sudden gain of airspeed, a fading one like a small one again and again.
  bool contradicts(double ratio) {
    off_ += (ratio - off_) * AirspeedModel::block_s / off_s;
    const bool again = std::exchange(refused_, std::abs(ratio) > refused_std);
    return (refused_ && again) || std::abs(off_) > off_std;
  }

  AirspeedModel model_;
  AirspeedModel::Block sum_{};  ///< over `time_s_` so far
  std::array<AirspeedModel::Block, waiting> late_{};
  std::size_t next_ = 0, count_ = 0;  ///< of `late_`: the next, and how many in a row
  double time_s_ = 0, lag_ = 0;
  double off_ = 0;
  bool in_use_ = false, refused_ = false;
  bool ended_ = false;  ///< contradicted since the pitot was lost
};

}  // namespace fulmar::second_filter
