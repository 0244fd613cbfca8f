// SPDX-License-Identifier: BSD-3-Clause
// Behaviour of the inner loops while the attitude is unknown.
#pragma once
#include <fulmar/flight/control/turn_trim.hpp>
#include <fulmar/msg/attitude_command.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <fulmar/plugin.hpp>

namespace fulmar::slc {

/// Detects the loss and the return of the attitude. After a loss the attitude counts again only once the
/// command answers to it, so that no surface steps.
class AttitudeLoss {
 public:
  void begin() { blind_ = false; }
  bool blind() const { return blind_; }
  /// True when the law begins to use the attitude again.
  bool look(const In<VehicleState>& state, const In<AttitudeCommand>& attitude) {
    if (!state->attitude_valid) {
      blind_ = true;
      known_ns_ = 0;
      return false;
    }
    if (!blind_) return false;
    if (known_ns_ == 0) known_ns_ = state.valid_at_ns();
    if (attitude.valid_at_ns() < known_ns_) return false;
    blind_ = false;
    return true;
  }

 private:
  bool blind_ = false;
  std::int64_t known_ns_ = 0;  ///< time of the first state after a loss of attitude
};

/// State that replaces an unknown attitude: the aircraft is assumed to follow its command. Feed-forward, trim
/// and the integrals remain; they level the aircraft as the command goes to level.
inline VehicleState as_commanded(const VehicleState& last, const AttitudeCommand& command, double Va) {
  VehicleState state = last;
  const TurnRates turn = turn_rates(command.roll_rad, command.pitch_rad, Va);
  state.roll_rad = command.roll_rad;
  state.pitch_rad = command.pitch_rad;
  state.rate_radps = {0, turn.q_radps, turn.r_radps};
  state.beta_rad = 0;
  return state;
}

}  // namespace fulmar::slc
