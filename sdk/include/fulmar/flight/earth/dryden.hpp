// SPDX-License-Identifier: BSD-3-Clause
// Dryden turbulence in body axes. Source: MIL-F-8785C / MIL-HDBK-1797; forming filters and figures of Beard &
// McLain (4.24) and table 4.1. The discretisation is exact: the output is a sample of the continuous process
// for any step and any varying airspeed.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/random.hpp"

namespace fulmar {

/// Levels of MIL-F-8785C.
enum class Turbulence : std::uint8_t { none, light, moderate, severe };

/// Scale lengths, m, and standard deviations, m/s, along body x, y, z.
struct DrydenScales {
  Eigen::Vector3d length{200, 200, 50};
  Eigen::Vector3d sigma{0, 0, 0};
};

/// Scales at 50 m: Beard & McLain, table 4.1, low altitude. Severe is three times light, as the wind at 20 ft
/// that defines them (15, 30, 45 knots).
inline DrydenScales dryden_scales(Turbulence turbulence) {
  const double k = turbulence == Turbulence::light      ? 1
                   : turbulence == Turbulence::moderate ? 2
                   : turbulence == Turbulence::severe   ? 3
                                                        : 0;
  return {{200, 200, 50}, k * Eigen::Vector3d(1.06, 1.06, 0.7)};
}

/// Gust velocity along the body axes, m/s. Equal seeds and steps give equal gusts.
class Dryden {
 public:
  Dryden(const DrydenScales& scales, std::uint64_t seed) : scales_(scales), random_(seed) {
    // Covariance of the state at any airspeed: [1/2 1/4; 1/4 1/4], for u only the first element.
    u_ = std::sqrt(0.5) * random_.normal();
    for (auto* s : {&v_, &w_}) {
      (*s)(0) = std::sqrt(0.5) * random_.normal();
      (*s)(1) = 0.5 * (*s)(0) + std::sqrt(0.125) * random_.normal();
    }
  }

  /// Sets new lengths and standard deviations. The state has no unit: gusts scale with the standard
  /// deviations, without a step.
  void set_scales(const DrydenScales& scales) {
    scales_ = scales;
    dt_ = 0;
  }

  const DrydenScales& scales() const { return scales_; }

  /// Gust velocity, body axes, after another `dt` at airspeed `Va`.
  Eigen::Vector3d advance(double dt, double Va) {
    if (scales_.sigma.isZero(0)) return Eigen::Vector3d::Zero();
    const double speed = std::max(Va, slowest);
    if (dt != dt_ || std::abs(speed - speed_) > 0.01 * speed_) discretise(dt, speed);
    u_ = lon_.decay * u_ + lon_.q11 * random_.normal();
    step(lat_, v_);
    step(ver_, w_);
    return gust();
  }

  Eigen::Vector3d gust() const {
    // (s + z)/(s + b)^2 = 1/(s + b) + (z - b)/(s + b)^2 with z = b / sqrt(3)
    const double k = 1 / std::numbers::sqrt3 - 1;
    return {scales_.sigma.x() * std::numbers::sqrt2 * u_,
            scales_.sigma.y() * std::numbers::sqrt3 * (v_(0) + k * v_(1)),
            scales_.sigma.z() * std::numbers::sqrt3 * (w_(0) + k * w_(1))};
  }

 private:
  static constexpr double slowest = 5;  ///< m/s: air also passes an aircraft at rest

  struct Step {
    double decay = 0, coupling = 0;    ///< x1 <- decay x1; x2 <- decay x2 + coupling x1
    double q11 = 0, q21 = 0, q22 = 0;  ///< root of the noise covariance
  };

  static Step exact(double b_dt) {
    Step s;
    s.decay = std::exp(-b_dt);
    s.coupling = s.decay * b_dt;
    // The state is stationary with covariance P, so the noise has P - F P F^T.
    const double Q11 = -0.5 * std::expm1(-2 * b_dt);
    const double Q21 = 0.25 - s.decay * (0.5 * s.coupling + 0.25 * s.decay);
    const double Q22 =
        0.25 - (0.5 * s.coupling * s.coupling + 0.5 * s.coupling * s.decay + 0.25 * s.decay * s.decay);
    s.q11 = std::sqrt(Q11);
    s.q21 = Q21 / s.q11;
    s.q22 = std::sqrt(std::max(0.0, Q22 - s.q21 * s.q21));
    return s;
  }

  void discretise(double dt, double speed) {
    dt_ = dt;
    speed_ = speed;
    lon_ = exact(speed / scales_.length.x() * dt);
    lat_ = exact(speed / scales_.length.y() * dt);
    ver_ = exact(speed / scales_.length.z() * dt);
  }

  void step(const Step& s, Eigen::Vector2d& x) {
    const double n1 = random_.normal(), n2 = random_.normal();
    x(1) = s.decay * x(1) + s.coupling * x(0) + s.q21 * n1 + s.q22 * n2;
    x(0) = s.decay * x(0) + s.q11 * n1;
  }

  DrydenScales scales_;
  Random random_;
  double dt_ = 0, speed_ = 0;
  Step lon_, lat_, ver_;
  double u_ = 0;
  Eigen::Vector2d v_ = Eigen::Vector2d::Zero(), w_ = Eigen::Vector2d::Zero();
};

}  // namespace fulmar
