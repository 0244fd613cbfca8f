// SPDX-License-Identifier: BSD-3-Clause
// Tuning of the inner loops in flight: excites one axis after another, chooses gains for given margins, and
// excites again. Gains are kept when the margins then measured are sufficient. README.md, "Autotune".
#pragma once
#include <fulmar/msg/autotune_report.hpp>
#include <fulmar/msg/vehicle_status.hpp>
#include <string_view>

#include "axis_result.hpp"
#include "excitation.hpp"
#include "findings.hpp"
#include "gain_search.hpp"
#include "inner.hpp"
#include "messages.hpp"
#include "rate_fit.hpp"
#include "tuned_gains.hpp"

namespace fulmar::slc {

struct Autotune {
  static constexpr const char* doc =
      "control_slc/Inner with an autotune in flight: finds gains, measures their margins, and restores the "
      "old gains if a margin is too small.";
  struct Inputs {
    Inner::Inputs law;
    Optional<VehicleStatus> status;  // if connected, tuning ends while commands do not move the aircraft
  };
  struct Outputs {
    Inner::Outputs law;
    AutotuneReport report;
    OutQueue<Notice, 4> findings;
  };
  struct Params {
    Inner::Params law;
    Flag tune{false, "switch of the autotune: true starts it, false ends it and keeps the accepted gains"};
    Param wanted_gain_margin{8, "dB", 3, 20, "gain margin of the design"};
    Param wanted_phase_margin{0.96, "rad", 0.3, 1.5, "phase margin of the design"};
    Param wanted_delay_margin{0.08, "s", 0, 1, "delay margin of the design"};
    Param least_gain_margin{6, "dB", 1, 20, "minimum measured gain margin; below it the old gains return"};
    Param least_phase_margin{0.7854, "rad", 0.1, 1.5,
                             "minimum measured phase margin; below it the old gains return"};
    Param roll_size{0.1, "rad", 0.005, 0.35, "peak of the excitation of the aileron"};
    Param pitch_size{0.15, "rad", 0.005, 0.35, "peak of the excitation of the elevator"};
    Param yaw_size{0.15, "rad", 0.005, 0.35, "peak of the excitation of the rudder"};
    Param noise_limit{0.15, "ratio", 0.02, 1, "largest relative standard error of 1 + L that is accepted"};
    Param roll_bound{0.785, "rad", 0.05, 1.5,
                     "limit of the roll angle, either way; beyond it the autotune ends"};
    Param pitch_bound{0.44, "rad", 0.05, 1.5,
                      "limit of the pitch angle, either way; beyond it the autotune ends"};
    Param height_bound{20, "m", 1, 1000,
                       "limit of the height change since the start; beyond it the autotune ends"};
    Param time_limit{90, "s", 20, 600, "largest duration of the autotune"};
  };

  void configure(const Params& p) {
    law_ = p.law;
    gains_.configure(law_);
    inner_.configure(law_);
    stage_ = Stage::idle;
    asked_ = false;
  }

  void retune(const Params& p) {
    law_ = p.law;
    for (std::size_t i = 0; i < axes; ++i) {
      if (gains_.give(i, TunedGains::gains_of(p.law, i))) set_from_outside(i);
      gains_.put_into(law_, i);
    }
    if (running()) law_.quieten.value = false;
    inner_.retune(law_);
  }

  Status activate(const Tick& tick, const Inputs& in, const Params&, const Applied<Outputs>& last) {
    if (running()) end(control_slc_messages::other_component_active.c_str());
    for (std::size_t i = 0; i < axes; ++i) {
      gains_.finish_change(i);
      gains_.put_into(law_, i);
    }
    excitation_.stop();
    return inner_.activate(tick, in.law, law_, last.part(last->law));
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    if (p.tune && !asked_) begin(in, p);
    if (!p.tune && asked_ && running()) end(control_slc_messages::tune_switched_off.c_str());
    asked_ = p.tune;
    if (running()) {
      time_s_ += dt;
      excitation_.advance(dt);
      const std::string_view why = trouble(in, p);
      if (!why.empty())
        end(why);
      else
        go_on(p);
    }
    if (!running() && law_.quieten.value != p.law.quieten.value) {
      law_.quieten.value = p.law.quieten.value;
      inner_.retune(law_);
    }
    for (std::size_t i = 0; i < axes; ++i)
      if (gains_.change_over(i, dt)) gains_.put_into(law_, i);
    const Status status = inner_.step(tick, in.law, law_, out.law);
    excite(in, p, dt, out.law);
    report(tick, out);
    return status;
  }

 private:
  using enum TunedAxis::Index;
  static constexpr double excite_s = Excitation::whole_s, search_s = 1.6;

  using Stage = AutotuneStage;
  using Verdict = AutotuneVerdict;
  using Reason = AutotuneReason;
  /// Threshold of `LoopRecord::answer`: 1 +- 0.3 without a response, 3.5 and more with one in moderate
  /// turbulence.
  static constexpr double min_answer = 2.5;

  bool running() const {
    return stage_ == Stage::exciting || stage_ == Stage::searching || stage_ == Stage::verifying;
  }
  void begin(const Inputs& in, const Params& p) {
    // The reduced gains of quietening are the initial gains. During excitation the oscillation detector is
    // off.
    for (std::size_t i = 0; i < axes; ++i) {
      gains_.begin(i, inner_.gain_left(static_cast<Inner::Axis>(i)));
      gains_.put_into(law_, i);
    }
    law_.quieten.value = false;
    inner_.retune(law_);
    begun_m_ = in.law.state->height_m;
    time_s_ = 0;
    results_ = {};
    next_axis(roll, p);
  }
  /// Gains that are set from outside replace those of a measurement.
  void set_from_outside(std::size_t axis) {
    if (running()) end(control_slc_messages::gains_set.c_str());
    results_[axis].forget();
  }
  void begin_axis(std::size_t axis) {
    axis_ = axis;
    excitation_.begin_axis();
    first_ = true;
    go_to(Stage::exciting);
  }
  void next_axis(std::size_t first, const Params& p) {
    for (std::size_t next = first; next < axes; ++next) {
      const Reason why = in_the_way(next, p);
      if (why == Reason::none) return begin_axis(next);
      results_[next].decide(Verdict::left_out, why);
      findings_.left_out(next, why);
    }
    go_to(Stage::finished);
  }
  Reason in_the_way(std::size_t axis, const Params& p) const {
    if (surface_of(*law_.airframe, axis).limit_rad <= 0 ||
        (axis == yaw && law_.airframe->aero.yaw.rudder_ratio == 0))
      return Reason::no_surface;
    // The search returns multiples of the present gains, so an attitude loop without kp cannot be tuned.
    const AxisGains& used = gains_.used(axis);
    if ((axis == yaw ? used.kd : used.kp) <= 0) return Reason::gain_is_zero;
    return time_for(2 * excite_s + search_s, p) ? Reason::none : Reason::no_time;
  }
  void go_to(Stage stage) {
    stage_ = stage;
    excitation_.begin();
  }
  bool time_for(double seconds, const Params& p) const { return time_s_ + seconds < p.time_limit; }

  /// Ends the tuning: the axis under test gets its old gains back, verified axes keep their new ones.
  void end(std::string_view why) {
    revert(Reason::ended, why);
    go_to(Stage::aborted);
  }
  void revert(Reason reason, std::string_view why) {
    gains_.go_back(axis_);
    results_[axis_].decide(Verdict::reverted, reason);
    findings_.reverted(axis_, why);
  }

  std::string_view trouble(const Inputs& in, const Params& p) const {
    const VehicleState& s = *in.law.state;
    const FlightLimits& limits = p.law.airframe->limits;
    if (in.status && !in.status->in_control) return control_slc_messages::commands_ignored.c_str();
    if (in.law.state.stale() || !s.attitude_valid || !s.height_valid || !s.airspeed_valid)
      return control_slc_messages::estimate_unknown.c_str();
    // The negated comparisons also catch NaN.
    if (!(std::abs(s.roll_rad) <= p.roll_bound)) return control_slc_messages::roll_beyond_bound.c_str();
    if (!(std::abs(s.pitch_rad) <= p.pitch_bound)) return control_slc_messages::pitch_beyond_bound.c_str();
    if (!(std::abs(s.height_m - begun_m_) <= p.height_bound))
      return control_slc_messages::height_moved.c_str();
    if (!(s.airspeed_mps >= 1.1 * limits.airspeed_min_mps / 1.2))
      return control_slc_messages::airspeed_low.c_str();
    if (!(s.airspeed_mps <= limits.airspeed_max_mps)) return control_slc_messages::airspeed_high.c_str();
    if (!(time_s_ <= p.time_limit)) return control_slc_messages::time_limit_over.c_str();
    return "";
  }

  void go_on(const Params& p) {
    if (stage_ == Stage::searching) {
      for (int i = 0; i < 4; ++i)
        if (search_.step()) return found(p);
    } else if (excitation_.complete() && fit_.step()) {
      judge(fit_.record(), p);
    }
  }

  /// A record is complete: checks its quality and the margins.
  void judge(const LoopRecord& r, const Params& p) {
    const Margins m = margins_of(r.loop);
    AxisResult& result = results_[axis_];
    result.noise = noise_of(r);
    const bool verifying = stage_ == Stage::verifying;
    if (r.limited > 0.02) {
      if (verifying || !time_for(2 * excite_s + search_s, p)) return done_with(Reason::surface_at_limit, p);
      gains_.change_to(axis_, TunedGains::times(gains_.used(axis_), 0.5));  // gain too high to measure with
      return go_to(Stage::exciting);
    }
    if (!(result.noise <= p.noise_limit)) {
      if (excitation_.at_largest() || !time_for((verifying ? 1 : 2) * excite_s + search_s, p))
        return done_with(Reason::turbulence, p);
      excitation_.enlarge(result.noise > 1.5 * p.noise_limit);
      return go_to(stage_);
    }
    if (!answers(r)) return done_with(Reason::no_answer, p);
    (first_ ? result.before : result.after) = m;
    first_ = false;
    // The required margins include one standard error of 1 + L, which is near 1 where margins are read.
    const MarginsWanted least{p.least_gain_margin + 20 * std::log10(1 + result.noise),
                              p.least_phase_margin + result.noise};
    if (verifying && least.kept(m)) {
      gains_.keep(axis_);
      result.verdict = Verdict::kept;
      findings_.kept(axis_, gains_.used(axis_), m);
      return next_axis(axis_ + 1, p);
    }
    if (verifying && !time_for(excite_s + search_s, p)) return done_with(Reason::margins_do_not_hold, p);
    search_.begin(r, gains_.used(axis_),
                  {p.wanted_gain_margin, p.wanted_phase_margin, p.wanted_delay_margin});
    go_to(Stage::searching);
  }
  void done_with(Reason why, const Params& p) {
    revert(why, words(why));
    next_axis(axis_ + 1, p);
  }
  void found(const Params& p) {
    if (search_.found()) {
      gains_.change_to(axis_, search_.best());
      return go_to(Stage::verifying);
    }
    // A record near noise_limit may leave no candidate: the search starts once more, from the old gains.
    if (excitation_.at_largest() || !time_for(2 * excite_s + search_s, p))
      return done_with(Reason::no_gains_found, p);
    excitation_.enlarge(false);
    first_ = true;
    gains_.go_back(axis_);
    go_to(Stage::exciting);
  }
  /// True when the rate responds to the surface and not to the turbulence alone.
  static bool answers(const LoopRecord& r) {
    Complex sum = 0;
    for (std::size_t i = 2; i < 8; ++i) sum += r.rate[i];
    return sum.real() > 0 && r.answer > min_answer;
  }

  void excite(const Inputs& in, const Params& p, double dt, Inner::Outputs& out) {
    const bool on = stage_ == Stage::exciting || stage_ == Stage::verifying;
    if (excitation_.step(axis_, on, *in.law.state, *law_.airframe, {p.roll_size, p.pitch_size, p.yaw_size},
                         dt, out))
      fit_.begin(excitation_.record(), gains_.used(axis_), axis_ == roll && law_.roll_from_sideslip != 0);
  }

  void report(const Tick& tick, Outputs& out) {
    AutotuneReport& r = out.report;
    r.stage = stage_;
    r.done = stage_ == Stage::finished || stage_ == Stage::aborted;
    r.axis = running() ? static_cast<AutotuneAxis>(axis_ + 1) : AutotuneAxis::none;
    r.roll = results_[roll].verdict;
    r.pitch = results_[pitch].verdict;
    r.yaw = results_[yaw].verdict;
    r.roll_reason = results_[roll].reason;
    r.pitch_reason = results_[pitch].reason;
    r.yaw_reason = results_[yaw].reason;
    r.time_s = time_s_;
    for (std::size_t i = 0; i < axes; ++i) {
      gains_.put_into(r, i);
      results_[i].put_into(r, i);
    }
    findings_.publish(tick, out.findings);
  }

  Inner inner_;
  Inner::Params law_;  ///< with the gains in use
  TunedGains gains_;
  Excitation excitation_;
  RateFit fit_;
  GainSearch search_;
  std::array<AxisResult, axes> results_{};
  Findings findings_;
  Stage stage_ = Stage::idle;
  std::size_t axis_ = roll;
  double time_s_ = 0, begun_m_ = 0;  ///< since the beginning; height at the beginning
  bool asked_ = false;
  bool first_ = true;  ///< the next record measures the old gains
};

}  // namespace fulmar::slc
