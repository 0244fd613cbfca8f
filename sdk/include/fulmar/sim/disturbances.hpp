// SPDX-License-Identifier: BSD-3-Clause
// Motion of the air in addition to the steady wind: Dryden turbulence, a discrete gust, thermals.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "fulmar/flight/earth/dryden.hpp"
#include "fulmar/flight/earth/dryden_height.hpp"
#include "fulmar/flight/earth/dryden_rotation.hpp"
#include "fulmar/flight/model/rigid_body.hpp"
#include "fulmar/sim/gust.hpp"
#include "fulmar/sim/updraft.hpp"
#include "fulmar/sim/weather.hpp"

namespace fulmar::sim {

/// Sum of turbulence, gust and thermals. Velocities in m/s, body axes unless a suffix says NED.
class Disturbances {
 public:
  Disturbances(const Weather& w, std::uint64_t seed)
      : dryden_(fixed_scales(w), seed),
        rotation_(std::max(w.gust_span_m, 0.1), mix_seed(seed, rotation_stream)),
        updrafts_(w.thermals),
        turbulence_(w.turbulence),
        wind_20ft_mps_(w.wind_20ft_mps),
        gust_airspeed_mps_(w.gust_airspeed_mps),
        rotates_(w.turbulence != Turbulence::none && w.gust_span_m > 0),
        by_height_(w.turbulence != Turbulence::none && w.turbulence_height == TurbulenceHeight::actual) {}

  /// True if it depends on the place of the aircraft.
  bool of_place() const { return by_height_ || gust_.active() || updrafts_.any(); }
  void fire(const GustSpec& gust) { gust_.fire(gust); }

  /// Velocity of the air in body axes, after another `dt` at airspeed `Va`, if the place has no effect.
  Eigen::Vector3d advance(double dt, double Va) { return dryden_.advance(dt, passing(Va)); }

  /// True if the air also rotates.
  bool rotates() const { return rotates_; }
  /// Angular velocity of the air in body axes, rad/s, after the `advance` with the same `dt` and `Va`.
  [[gnu::noinline]] Eigen::Vector3d rotation(double dt, double Va) {
    return rotation_.advance(dt, passing(Va), dryden_.gust(), dryden_.scales());
  }

  /// The same if the place has an effect: at `x` relative to the ground below, `height_m` above it.
  [[gnu::noinline]] Eigen::Vector3d advance_at(double dt, double Va, const RigidBody& x, double height_m,
                                               const Eigen::Vector3d& steady_wind_n) {
    if (by_height_) follow(height_m);
    Eigen::Vector3d v_b = dryden_.advance(dt, passing(Va)) + gust_.advance(dt, Va);
    if (!updrafts_.any()) return v_b;
    updrafts_.drift(dt, steady_wind_n);
    return v_b - updrafts_.at(x.p_n) * (x.q_nb.conjugate() * Eigen::Vector3d::UnitZ());
  }

 private:
  static constexpr std::uint64_t rotation_stream =
      0x726f7461746573;  ///< separate seed: gusts along the axes stay unchanged

  static DrydenScales fixed_scales(const Weather& w) {
    return w.fixed_height_m > 0 ? dryden_scales_at(w.turbulence, w.fixed_height_m, w.wind_20ft_mps)
                                : dryden_scales(w.turbulence);
  }
  double passing(double Va) const { return gust_airspeed_mps_ > 0 ? gust_airspeed_mps_ : Va; }

  /// Lengths and standard deviations follow the height in steps of 1 %, because the discretisation of the
  /// filters costs more than their step.
  void follow(double height_m) {
    constexpr double lowest_m = mil8785c::lowest_ft * mil8785c::foot;
    const double h = std::max(height_m, lowest_m);
    if (std::abs(h - height_m_) <= 0.01 * height_m_) return;
    height_m_ = h;
    dryden_.set_scales(dryden_scales_at(turbulence_, h, wind_20ft_mps_));
  }

  Dryden dryden_;
  DrydenRotation rotation_;
  Gust gust_;
  Updrafts updrafts_;
  Turbulence turbulence_;
  double wind_20ft_mps_, gust_airspeed_mps_, height_m_ = 0;
  bool rotates_, by_height_;
};

}  // namespace fulmar::sim
