// SPDX-License-Identifier: BSD-3-Clause
// Rotation of turbulent air over the wing, which gusts along the axes (dryden.hpp) leave out. Source:
// MIL-F-8785C 3.7.5 with the spectra of 3.7.1.2, in the low-altitude form
//   Phi_p = sigma_w^2/(V L_w) 0.8 (pi L_w/(4 b))^(1/3) / (1 + (4 b w/(pi V))^2)
//   q_g = -(s/V)/(1 + 4 b s/(pi V)) w_g,   r_g = (s/V)/(1 + 3 b s/(pi V)) v_g
// with the span b, the airspeed V, Laplace variable s. Rolling gusts have noise of their own.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/flight/earth/dryden.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/random.hpp"

namespace fulmar {

/// Angular velocity of turbulent air about the body axes, rad/s, for one wing span.
class DrydenRotation {
 public:
  /// `span_m`: wing span, above 0.
  DrydenRotation(double span_m, std::uint64_t seed) : b_(span_m), random_(seed) { p_ = random_.normal(); }

  /// Angular velocity of the air, rad/s, body axes, after another `dt` at airspeed `Va`. `gust_b`, m/s, is
  /// the gust of `Dryden` with these scales at the same time.
  Eigen::Vector3d advance(double dt, double Va, const Eigen::Vector3d& gust_b, const DrydenScales& scales) {
    const double V = std::max(Va, 5.0);  // as in Dryden: air also passes an aircraft at rest
    const double pole = std::numbers::pi * V / (4 * b_), pole_r = std::numbers::pi * V / (3 * b_);
    const double decay = std::exp(-pole * dt);
    p_ = decay * p_ + std::sqrt(1 - decay * decay) * random_.normal();
    // (s/V) / (1 + s/a) = (a/V) s/(s + a): a wash-out
    return {deviation_p(scales, b_) * p_, -pole / V * w_.step(gust_b.z(), pole, dt),
            pole_r / V * v_.step(gust_b.y(), pole_r, dt)};
  }

  /// Standard deviation of the rolling gusts, rad/s: root of the integral of Phi_p over all frequencies above
  /// 0.
  static double deviation_p(const DrydenScales& scales, double span_m) {
    constexpr double pi = std::numbers::pi;
    const double L = scales.length.z(), b = span_m;
    return scales.sigma.z() * std::sqrt(0.8 * pi * pi / (8 * b * L) * std::cbrt(pi * L / (4 * b)));
  }

 private:
  double b_;
  Random random_;
  double p_ = 0;  ///< unit standard deviation
  WashOut v_, w_;
};

}  // namespace fulmar
