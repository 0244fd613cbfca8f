// SPDX-License-Identifier: BSD-3-Clause
// The excitation of one surface: settling time, fade-in, record, fade-out.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "loop_lines.hpp"
#include "tuned_gains.hpp"

namespace fulmar::slc {

inline const Surface& surface_of(const Airframe& a, std::size_t axis) {
  return axis == TunedAxis::roll ? a.aileron : axis == TunedAxis::pitch ? a.elevator : a.rudder;
}

/// Adds a multisine to the deflection of the law and records the response.
class Excitation {
  using enum TunedAxis::Index;

 public:
  static constexpr double settle_s = 1, fade_s = 1;
  static constexpr double whole_s = settle_s + fade_s + Lines::record_s;

  /// Begins an axis with the size that the parameters give.
  void begin_axis() { larger_ = 1; }
  /// Enlarges the excitation, which reduces the error of a record.
  void enlarge(bool much) { larger_ = much ? 2.25 : 1.5 * larger_; }
  bool at_largest() const { return larger_ > 2; }

  /// Begins a new record.
  void begin() {
    stage_s_ = 0;
    complete_ = false;
    lines_.begin();
  }
  void advance(double dt) { stage_s_ += dt; }
  /// Stops without a fade, after another law was active.
  void stop() { strength_ = 0; }
  bool complete() const { return complete_; }
  LoopRecord record() const { return lines_.record(); }

  /// `on`: the stage excites `axis`. `sizes`: rad, of each surface. Returns true when the record is complete.
  bool step(std::size_t axis, bool on, const VehicleState& x, const Airframe& airframe,
            const std::array<double, axes>& sizes, double dt, Inner::Outputs& out) {
    const bool wanted = on && stage_s_ >= settle_s && !complete_;
    if (strength_ == 0) {
      excited_ = axis;
      phase_s_ = 0;  // the remainder of an excitation stays on its surface
    }
    strength_ = std::clamp(strength_ + (wanted ? dt / fade_s : -5 * dt), 0.0, 1.0);
    if (strength_ == 0) return false;
    phase_s_ += dt;
    const Surface& s = surface_of(airframe, excited_);
    // Sign convention of the record: positive turns to the right or up.
    const double sign = excited_ == roll ? 1 : -1;
    double& deflection = deflection_of(out.actuators);
    const double feedback = deflection;
    const double asked = feedback + sign * std::min(sizes[excited_] * larger_, 0.5 * s.limit_rad) *
                                        strength_ * lines_.at(phase_s_);
    deflection = std::clamp(asked, -s.limit_rad, s.limit_rad);
    const bool limited = asked != deflection || std::abs(feedback) >= s.limit_rad;
    return wanted && take(sign * feedback, sign * deflection, limited, x, out.surface_scale_ratio.value, dt);
  }

 private:
  double& deflection_of(Actuators& u) const {
    return excited_ == roll ? u.aileron_rad : excited_ == pitch ? u.elevator_rad : u.rudder_rad;
  }

  /// Returns true when the record is complete.
  bool take(double feedback, double total, bool limited, const VehicleState& x, double scale, double dt) {
    const double recorded_s = stage_s_ - settle_s - fade_s;
    if (recorded_s < -0.5 * dt) return false;
    const double angle = excited_ == roll ? x.roll_rad : excited_ == pitch ? x.pitch_rad : 0;
    const double rate = excited_ == roll    ? x.rate_radps.x
                        : excited_ == pitch ? x.rate_radps.y
                                            : x.rate_radps.z;
    complete_ = recorded_s >= Lines::record_s - 0.5 * dt;
    if (complete_)
      lines_.close(feedback, total, angle, rate);
    else
      lines_.add(feedback, total, angle, rate, scale, limited, dt);
    return complete_;
  }

  LoopLines lines_;
  std::size_t excited_ = roll;
  double stage_s_ = 0, phase_s_ = 0;
  double strength_ = 0, larger_ = 1;
  bool complete_ = false;  ///< a record waits for its judgement
};

}  // namespace fulmar::slc
