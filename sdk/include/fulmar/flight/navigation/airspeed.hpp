// SPDX-License-Identifier: BSD-3-Clause
// Airspeed without a pitot: when the model of airspeed_model.hpp learns, when it is accepted, and how the
// filter uses it. While the pitot is used, the filter does not depend on the model.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fulmar/flight/navigation/airspeed_model.hpp"
#include "fulmar/flight/navigation/navigator_updates.hpp"

namespace fulmar::navigation {

/// Fuses the modelled airspeed into the filter while the pitot is lost, and ends when it contradicts.
class ModelledAirspeed {
 public:
  /// Call with each inertial sample, after the samples of other sensors. `commanded`: the motor gets this
  /// throttle.
  void step(Navigator& navigator, double throttle_frac, bool commanded, double dt_s, const Params& p) {
    const bool flies = navigator.airborne() && navigator.aligned() && !navigator.settling();
    if (!flies || !commanded || !(dt_s < coasted_s)) {
      begin(throttle_frac);
      if (!navigator.airborne()) contradicted_ = false;
      return;
    }
    const ErrorStateEkf& f = navigator.filter();
    lag_ += (throttle_frac - lag_) * std::min(dt_s / lag_s, 1.0);
    sum_.f_x_mps2 += dt_s * f.specific_force_b().x();
    sum_.f_z_mps2 += dt_s * f.specific_force_b().z();
    sum_.throttle_frac += dt_s * lag_;
    sum_.Va_mps += dt_s * (ekf::air_velocity(f.state()).norm() + f.state().gust_mps);
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
  /// Standard deviation to add to that of the filter. The change that the model has made against inertia and
  /// wind is due to gusts or to a wrong motor model, which cannot be separated. The part beyond usual gusts
  /// may all be wrong.
  double doubt_mps(const Navigator& n, const Params& p) const {
    return used(n) ? std::max(std::abs(moved_mps(n)) - usual_gust * n.gusts().std_mps(p), 0.0) : 0;
  }

 private:
  static constexpr double lag_s = 0.1;      ///< of an electric motor with its propeller
  static constexpr double tube_s = 0.5;     ///< without an accepted sample the pitot is lost
  static constexpr double doubt_s = 8;      ///< samples of this time before a detected fault are not learnt
  static constexpr double usual_std = 1.5;  ///< beyond it counts for less
  // In bench_airspeed none of the next three ended a flight whose motor follows its command.
  static constexpr double refused_std = 4;           ///< beyond it is not used, twice in a row: never again
  static constexpr double off_std = 1.3, off_s = 2;  ///< the same of the mean over seconds
  /// The same for the mean change of the airspeed, in gust standard deviations: at most 3.3 in flights whose
  /// motor follows its command.
  static constexpr double moved_most = 3.6, mean_s = 4, calm_mps = 0.5, moved_s = 10;
  static constexpr double usual_gust =
      0.5;  ///< in gust standard deviations: change that does not count as an error
  static constexpr double wrong_mps = 1.5;  ///< by which a wrong model may have moved the wind, each axis
  static constexpr std::size_t waiting = static_cast<std::size_t>(doubt_s / AirspeedModel::block_s);

  void begin(double throttle_frac) {
    sum_ = {};
    time_s_ = 0;
    lag_ = throttle_frac;
    in_use_ = false;
  }

  void block(Navigator& n, AirspeedModel::Block b, const Params& p) {
    const double altitude_m = n.origin().alt_m - n.filter().state().p_n.z();
    const double root = std::sqrt(standard_air(altitude_m).density_kgm3 / isa_density_kgm3);
    b.Va_mps = root * std::max(b.Va_mps, 0.0);
    model_.wander(AirspeedModel::block_s);
    const Aid& tube = n.health().pitot;
    if (n.time_s() - tube.accepted_s < tube_s) {
      in_use_ = contradicted_ = refused_ = false;
      if (tube.contradicts) count_ = 0;
      if (count_ == waiting) model_.learn(late_[next_]);
      late_[next_] = b;
      next_ = (next_ + 1) % waiting;
      count_ = std::min(count_ + 1, waiting);
      return;
    }
    count_ = 0;
    const AirspeedModel::Said said = model_.airspeed(b);
    in_use_ = said.known && !contradicted_;
    moved_ -= moved_ * AirspeedModel::block_s / moved_s;
    if (in_use_) use(n, b, said, root, p);
  }

  /// Its error is slow, so repeated updates add no information: they reduce the standard deviation of the
  /// airspeed to that of the model and no further. Attitude and biases are not corrected.
  void use(Navigator& n, const AirspeedModel::Block& b, const AirspeedModel::Said& said, double root,
           const Params& p) {
    ErrorStateEkf& f = n.filter();
    ekf::Scalar z = ekf::true_airspeed(f.state(), 0);
    z.innovation = (said.Va_mps - b.Va_mps) / root;  // means over the block: changes within it are kept
    const double noise = said.noise_std_mps / root, lasting = said.model_std_mps / root;
    const double ratio = ratio_of(n, z, std::hypot(noise, lasting), p);
    if (!agrees(n, ratio, p)) return;
    const double known = f.expected_std(z, 0);
    if (!(known > lasting)) return;
    const double to_lasting = lasting * lasting * known * known / (known * known - lasting * lasting);
    const double doubt = std::max(std::abs(ratio) / usual_std, 1.0);
    const double before = ekf::air_velocity(f.state()).norm();
    f.fuse_considering_attitude(z, doubt * doubt * std::max(noise * noise, to_lasting), never_refused);
    moved_ += ekf::air_velocity(f.state()).norm() - before;
  }

  /// Innovation in standard deviations: of the model, of the airspeed without gusts, and of the change of
  /// gusts since the last use.
  double ratio_of(const Navigator& n, ekf::Scalar z, double std, const Params& p) const {
    const double since_s = std::clamp(n.time_s() - used_s_, AirspeedModel::block_s, 1.0);
    const double gust = n.gusts().std_mps(p) * std::sqrt(-2 * std::expm1(-since_s / n.gusts().time_s(p)));
    z.H(ekf::gust) = 0;
    return z.innovation / std::hypot(std, gust, n.filter().expected_std(z, 0));
  }
  /// True when it was used since the pitot was lost.
  bool used(const Navigator& n) const { return used_s_ > n.health().pitot.accepted_s; }
  double moved_mps(const Navigator& n) const { return moved_ + n.filter().state().gust_mps; }
  /// A motor that stops or loses a propeller looks like a sudden gain of speed beyond gusts; a fading motor
  /// like a repeated small one. One rejected block is allowed. Two in a row, the mean of seconds, or the
  /// total change end the model until the pitot returns.
  bool agrees(Navigator& n, double ratio, const Params& p) {
    if (!used(n)) off_ = moved_ = mean_moved_ = 0;
    off_ += (ratio - off_) * AirspeedModel::block_s / off_s;
    mean_moved_ += (moved_mps(n) - mean_moved_) * AirspeedModel::block_s / mean_s;
    const bool agrees = std::abs(ratio) < refused_std, again = std::exchange(refused_, !agrees);
    const bool sudden = !agrees && again,
               slowly = std::abs(off_) > off_std ||
                        std::abs(mean_moved_) > moved_most * std::hypot(calm_mps, n.gusts().std_mps(p));
    if (!sudden && !slowly) {
      if (agrees) used_s_ = n.time_s();
      return agrees;
    }
    contradicted_ = true;
    in_use_ = false;
    if (used(n)) n.filter().inflate(ekf::wind, 2, wrong_mps);
    return false;
  }

  static constexpr double isa_density_kgm3 = 1.225, never_refused = 1e9;

  AirspeedModel model_;
  AirspeedModel::Block sum_{};  ///< over `time_s_` so far
  std::array<AirspeedModel::Block, waiting> late_{};
  std::size_t next_ = 0, count_ = 0;  ///< of `late_`: the next, and how many in a row
  double time_s_ = 0, lag_ = 0, used_s_ = never, off_ = 0, moved_ = 0, mean_moved_ = 0;
  bool in_use_ = false, refused_ = false;
  bool contradicted_ = false;  ///< the force has changed as no gust changes it: the motor is not as commanded
};

}  // namespace fulmar::navigation
