// SPDX-License-Identifier: BSD-3-Clause
// The airspeed while no tube says it: when the model of airspeed_model.hpp learns, when it is believed, and how
// it comes into the filter.
#pragma once
#include <array>

#include "fulmar/flight/airspeed_model.hpp"
#include "fulmar/flight/navigator_updates.hpp"
#include "fulmar/msg/actuators.hpp"

namespace fulmar::navigation {

class ModelledAirspeed {
 public:
  /// After the sensors' samples, with each inertial one. `commanded`: to this aircraft, and not stale.
  void step(Navigator& navigator, const Actuators& commands, bool commanded, double dt_s, const Params& p) {
    if (!navigator.airborne() || !commanded || !(dt_s < coasted_s) || !navigator.aligned() || navigator.settling()) {
      time_s_ = 0;
      sum_ = {};
      in_use_ = false;
      lag_ = commands.throttle_frac;
      if (!navigator.airborne()) contradicted_ = false;
      return;
    }
    const ErrorStateEkf& f = navigator.filter();
    lag_ += (commands.throttle_frac - lag_) * std::min(dt_s / lag_s, 1.0);
    sum_.f_x_mps2 += dt_s * f.specific_force_b().x();
    sum_.f_z_mps2 += dt_s * f.specific_force_b().z();
    sum_.throttle_frac += dt_s * lag_;
    sum_.Va_mps += dt_s * airspeed(f);
    time_s_ += dt_s;
    if (time_s_ < AirspeedModel::block_s - 1e-4) return;
    AirspeedModel::Block b{sum_.f_x_mps2 / time_s_, sum_.f_z_mps2 / time_s_, sum_.throttle_frac / time_s_,
                           sum_.Va_mps / time_s_};
    block(navigator, b, p);
    sum_ = {};
    time_s_ = 0;
  }
  /// The published airspeed rests on it.
  bool in_use() const { return in_use_; }
  const AirspeedModel& model() const { return model_; }

 private:
  static constexpr double lag_s = 0.1;    ///< of an electric motor with its propeller
  static constexpr double tube_s = 0.5;   ///< without an accepted sample: the tube is lost
  static constexpr double doubt_s = 8;    ///< what the tube said last before it failed is not learnt
  static constexpr std::size_t waiting = static_cast<std::size_t>(doubt_s / AirspeedModel::block_s);

  static double airspeed(const ErrorStateEkf& f) {
    return std::max(ekf::air_velocity(f.state()).norm() + f.state().gust_mps, 0.0);
  }

  void block(Navigator& n, AirspeedModel::Block b, const Params& p) {
    const double up = -n.filter().state().p_n.z();
    const double density = standard_air(n.origin().alt_m + up).density_kgm3;
    const double root = std::sqrt(density / 1.225);
    b.Va_mps *= root;
    model_.wander(AirspeedModel::block_s);
    const Aid& tube = n.health().pitot;
    const double silent = n.time_s() - tube.accepted_s;
    if (silent < tube_s) {
      in_use_ = false;
      contradicted_ = false;
      if (tube.contradicts) count_ = 0;
      if (count_ == waiting) model_.learn(late_[next_]);
      late_[next_] = b;
      next_ = (next_ + 1) % waiting;
      count_ = std::min(count_ + 1, waiting);
      return;
    }
    count_ = 0;
    use(n, b, root, p);
  }

  void use(Navigator& n, const AirspeedModel::Block& b, double root, const Params& p) {
    const AirspeedModel::Said said = model_.airspeed(b);
    if (std::getenv("AIR_DEBUG") && n.time_s() - said_s_ > 5) {
      said_s_ = n.time_s();
      std::fprintf(stderr, "t %.1f known %d slope %.3f +- %.3f Va %.2f/%.2f noise %.2f model %.2f res %.3f alone %.1f fz %.2f fx %.2f thr %.2f theta", n.time_s(), said.known,
                   model_.slope_per_s(b), model_.slope_std(b), said.Va_mps, b.Va_mps, said.noise_std_mps, said.model_std_mps, model_.std_mps2(), model_.alone(), b.f_z_mps2, b.f_x_mps2, b.throttle_frac);
      for (int i = 0; i < 7; ++i) std::fprintf(stderr, " %.2f+-%.2f", model_.parameters()(i), std::sqrt(model_.covariance()(i, i)));
      std::fprintf(stderr, "\n");
    }
    in_use_ = said.known && !contradicted_;
    if (!in_use_) return;
    ErrorStateEkf& f = n.filter();
    // The block's mean against the airspeed now: by its change since.
    ekf::Scalar z = ekf::true_airspeed(f.state(), 0);
    z.innovation = (said.Va_mps - b.Va_mps) / root;
    const double P = f.expected_std(z, 0), bias = said.model_std_mps / root,
                 noise = said.noise_std_mps / root;
    if (!(P > bias)) return;
    const double variance = std::max(noise * noise, bias * bias * P * P / (P * P - bias * bias));
    if (std::getenv("AIR_CONSIDER"))
      f.fuse_considering_attitude(z, variance, p.air_gate);
    else
      n.fuse(z, variance, p.air_gate, aid_);
  }

  AirspeedModel model_;
  AirspeedModel::Block sum_{};
  std::array<AirspeedModel::Block, waiting> late_{};
  std::size_t next_ = 0, count_ = 0;
  double time_s_ = 0, lag_ = 0;
  bool in_use_ = false, contradicted_ = false;
  Aid aid_;
  double said_s_ = -1e9;
};

}  // namespace fulmar::navigation
