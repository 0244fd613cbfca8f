// SPDX-License-Identifier: BSD-3-Clause
// A control surface with its servo, and the faults of both.
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/sim/fault.hpp"
#include "fulmar/sim/servo.hpp"

namespace fulmar::sim {

/// One surface with servo and fault. Angles in rad, time in s.
class Drive {
 public:
  explicit Drive(const Surface& s) : servo_(s) {}

  void advance(double command, double dt) {
    if (kind_ == FaultKind::none) return servo_.advance(command, dt);
    fail(command, dt);
  }
  double angle() const { return kind_ == FaultKind::lost ? 0 : servo_.angle(); }
  void set(double angle) { servo_.set(angle); }

  void suffer(const Fault& fault) {
    kind_ = fault.kind;
    speed_ = 1 + fault.growth * (fault.share - 1);
  }
  bool free() const { return kind_ == FaultKind::free; }
  void trail_at(double angle) { trailing_ = angle; }

 private:
  /// A separate function, so that a surface without a fault has no additional cost.
  [[gnu::noinline]] void fail(double command, double dt) {
    switch (kind_) {
      case FaultKind::stuck: return;
      case FaultKind::hardover_positive: return servo_.advance(servo_.max(), dt);
      case FaultKind::hardover_negative: return servo_.advance(servo_.min(), dt);
      case FaultKind::slow: return servo_.advance(command, speed_ * dt);  // slows down time
      case FaultKind::free: return servo_.advance(trailing_, dt);
      default: servo_.advance(command, dt);
    }
  }

  Servo servo_;
  FaultKind kind_ = FaultKind::none;
  double speed_ = 1, trailing_ = 0;
};

/// Free floating surfaces, rad: zero hinge moment, Ch_alpha alpha + Ch_delta delta = 0, so each trails its
/// local flow by Ch_alpha / Ch_delta of its angle (Etkin & Reid, Dynamics of Flight, 3rd edition, 2.5, 2.6:
/// the free elevator). 0.5, a plain flap without balance, is an assumption. Assumption: tail and fin have the
/// flow of the centre of gravity; the ailerons, which are linked, react to rolling alone.
inline Deflections trailing(const Eigen::Vector3d& v_r, const Eigen::Vector3d& omega_b, double span_m) {
  constexpr double Ch_ratio = 0.5;
  constexpr double aileron_place = 0.35;  ///< of the span, from the middle
  const AirData air(v_r);
  if (air.Va < 1) return {};
  return {Ch_ratio * aileron_place * span_m * omega_b.x() / air.Va, -Ch_ratio * air.alpha,
          Ch_ratio * air.beta};
}

}  // namespace fulmar::sim
