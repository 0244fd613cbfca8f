// SPDX-License-Identifier: BSD-3-Clause
// Common parts of the three components: begin and end of a signal, its abort, and the reports.
#pragma once
#include <array>
#include <string_view>

#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "messages.hpp"
#include "waveform.hpp"

namespace fulmar::signal {

struct BoundParams {
  Param roll_bound{0.785, "rad", 0.05, 3.15,
                   "limit of the roll angle, either way; beyond it the signal is aborted"};
  Param pitch_bound{0.5, "rad", 0.05, 1.6,
                    "limit of the pitch angle, either way; beyond it the signal is aborted"};
  Param height_bound{20, "m", 0.5, 10000,
                     "limit of the height change since the request; beyond it the signal is aborted"};
  Param stall_airspeed{0, "m/s", 0, 300,
                       "stall airspeed with wings level; abort below 1.1 times this; 0: minimum airspeed of "
                       "the airframe over 1.2"};
  Record<Airframe> airframe{"airframe with the limits and throws of every signal", required};
};

/// Outputs common to all components, in addition to the signal of each channel.
struct Reported {
  Probe active_ratio;   // 1: from the request, its delay included, until the end
  Probe aborted_ratio;  // 1: after an abort, until the next request
  OutQueue<Notice, 4> notices;
};

struct SignalInputs {
  In<VehicleState> state;
  // if connected, the signal is aborted while commands do not move the aircraft
  Optional<VehicleStatus> status;
};

/// Reason that forbids a signal now; "" for none. `begun_m`: the height at the request.
inline std::string_view trouble(const SignalInputs& in, const BoundParams& p, double begun_m) {
  const VehicleState& s = *in.state;
  const FlightLimits& limits = p.airframe->limits;
  const double stall = p.stall_airspeed > 0 ? p.stall_airspeed.value : limits.airspeed_min_mps / 1.2;
  if (in.status && !in.status->in_control) return signal_messages::aborted_by_pilot.c_str();
  if (in.state.stale() || !s.attitude_valid || !s.height_valid || !s.airspeed_valid)
    return signal_messages::aborted_by_estimate.c_str();
  // The negated comparisons also catch NaN.
  if (!(std::abs(s.roll_rad) <= p.roll_bound)) return signal_messages::aborted_by_roll.c_str();
  if (!(std::abs(s.pitch_rad) <= p.pitch_bound)) return signal_messages::aborted_by_pitch.c_str();
  if (!(std::abs(s.height_m - begun_m) <= p.height_bound)) return signal_messages::aborted_by_height.c_str();
  if (!(s.airspeed_mps >= 1.1 * stall)) return signal_messages::aborted_by_airspeed_low.c_str();
  if (!(s.airspeed_mps <= limits.airspeed_max_mps)) return signal_messages::aborted_by_airspeed_high.c_str();
  return "";
}

/// The sum within the limits. A value outside of them is passed on unchanged. Without a signal the result has
/// the same bits.
inline double added(double value, double by, double low, double high) {
  if (by == 0) return value;
  return std::clamp(value + by, std::min(low, value), std::max(high, value));
}

/// Generates one signal after the other, each on one of N channels.
template <std::size_t N>
class Excitation {
 public:
  /// A request. A change of any field fades out the present signal and begins a new one.
  struct Request {
    Shape shape = Shape::none;
    std::size_t channel = 0;
    // SI units, as the parameters
    double size = 0, delay = 0, duration = 0, frequency = 0, frequency_end = 0;
    std::int64_t every = 1, run = 0;
    bool operator==(const Request&) const = default;
  };

  /// Takes over the role. After another component the signal of the phase begins at its start. While the
  /// pilot flies, a signal ends and none begins.
  void take_over(bool other_active) {
    if (other_active) {
      request_ = {};
      aborted_ = false;
    }
    if (!other_active && running_) abort(signal_messages::aborted_by_pilot.c_str());
    running_ = false;
    last_ = left_ = {};
  }

  /// Computes the value for each channel. `extra`: a further reason of the component to abort.
  Status step(const Tick& tick, const SignalInputs& in, const SignalParams& p, const BoundParams& bounds,
              std::size_t channel, double size, std::string_view extra, Reported& reported) {
    const Request now{p.shape,     channel,         size,    p.delay, p.duration,
                      p.frequency, p.frequency_end, p.every, p.run};
    began_ = now != request_;
    if (began_) begin(now, p, tick, in.state->height_m);
    if (running_) {
      std::string_view why = trouble(in, bounds, begun_m_);
      if (why.empty()) why = extra;
      if (!why.empty()) abort(why);
    }
    fade(tick.dt_s());
    last_ = left_;
    const double t = 1e-9 * static_cast<double>(tick.now_ns - begun_ns_) - request_.delay;
    if (running_) last_[request_.channel] += request_.size * wave_.at(t);
    running_ = running_ && t < wave_.end_s();
    if (!unreported_.empty()) reported.notices.push({Text<96>(unreported_), Severity::warning}, tick.now_ns);
    unreported_ = {};
    reported.active_ratio = running_ ? 1.0 : 0.0;
    reported.aborted_ratio = aborted_ ? 1.0 : 0.0;
    return aborted_ ? Status::degraded : Status::ok;
  }
  double operator[](std::size_t channel) const { return last_[channel]; }
  /// True when the last step had a new request.
  bool began() const { return began_; }

 private:
  static constexpr double let_go_s = 0.2;  // fade-out time of an ended signal

  void begin(const Request& now, const SignalParams& p, const Tick& tick, double height_m) {
    let_go();
    request_ = now;
    wave_ = Waveform(p);
    begun_ns_ = tick.now_ns;
    begun_m_ = height_m;
    running_ = now.shape != Shape::none;
    aborted_ = false;
  }
  void abort(std::string_view why) {
    let_go();
    running_ = false;
    aborted_ = true;
    unreported_ = why;
  }
  void let_go() {
    left_ = last_;
    from_[request_.channel] = last_[request_.channel];
  }
  void fade(double dt_s) {
    for (std::size_t i = 0; i < N; ++i) {
      const double by = std::abs(from_[i]) * dt_s / let_go_s;
      left_[i] -= std::clamp(left_[i], -by, by);
      // Below rounding the rest is set to 0: from here on the command keeps its bits.
      if (std::abs(left_[i]) < 1e-9 * std::abs(from_[i])) left_[i] = 0;
    }
  }

  Request request_;
  Waveform wave_;
  std::int64_t begun_ns_ = 0;
  double begun_m_ = 0;
  bool running_ = false, aborted_ = false, began_ = false;
  std::string_view unreported_;  // reason of an abort, until it is reported
  // last added; rest of former signals now, and at the begin of their fade-out
  std::array<double, N> last_{}, left_{}, from_{};
};

}  // namespace fulmar::signal
