// SPDX-License-Identifier: BSD-3-Clause
// The inner loops, tuned in flight: excites one axis after another, chooses gains for given margins, excites
// again, and keeps them when the margins measured then hold. README.md, "Autotune".
#pragma once
#include <fulmar/msg/autotune_report.hpp>
#include <fulmar/msg/vehicle_status.hpp>
#include <string_view>

#include "gain_search.hpp"
#include "inner.hpp"
#include "rate_fit.hpp"

namespace fulmar::slc {

struct Autotune {
  static constexpr const char* doc =
      "control_slc/Inner that finds its gains in flight, measures their margins, and goes back if they do "
      "not "
      "hold.";
  struct Inputs {
    Inner::Inputs law;
    Optional<VehicleStatus> status;  // wired: ends while commands do not move the aircraft
  };
  struct Outputs {
    Inner::Outputs law;
    AutotuneReport report;
    OutQueue<Notice, 4> findings;
  };
  struct Params {
    Inner::Params law;
    Flag tune{false, "false to true begins; false again ends it, and leaves the gains that were kept"};
    Param wanted_gain_margin{8, "dB", 3, 20, "that gains are chosen for"};
    Param wanted_phase_margin{0.96, "rad", 0.3, 1.5, "that gains are chosen for"};
    Param wanted_delay_margin{0.08, "s", 0, 1, "that gains are chosen for"};
    Param least_gain_margin{6, "dB", 1, 20, "measured in the second excitation: less goes back"};
    Param least_phase_margin{0.7854, "rad", 0.1, 1.5, "measured in the second excitation: less goes back"};
    Param roll_size{0.1, "rad", 0.005, 0.35, "peak of the excitation of the aileron"};
    Param pitch_size{0.15, "rad", 0.005, 0.35, "peak of the excitation of the elevator"};
    Param yaw_size{0.15, "rad", 0.005, 0.35, "peak of the excitation of the rudder"};
    Param noise_limit{0.15, "ratio", 0.02, 1, "largest standard error of 1 + L, relative, that is believed"};
    Param roll_bound{0.785, "rad", 0.05, 1.5, "beyond this roll, either way, it ends"};
    Param pitch_bound{0.44, "rad", 0.05, 1.5, "beyond this pitch, either way, it ends"};
    Param height_bound{20, "m", 1, 1000, "so far from the height at which it began it ends"};
    Param time_limit{90, "s", 20, 600, "of the whole"};
  };

  void configure(const Params& p) {
    law_ = p.law;
    for (std::size_t i = 0; i < axes; ++i)
      given_[i] = old_[i] = kept_[i] = used_[i] = goal_[i] = gains_of(p.law, i);
    inner_.configure(law_);
    stage_ = Stage::idle;
    asked_ = false;
  }

  void retune(const Params& p) {
    law_ = p.law;
    for (std::size_t i = 0; i < axes; ++i) {
      const AxisGains now = gains_of(p.law, i);
      if (now != given_[i]) set_by_somebody(i, now);
      use(i, used_[i]);
    }
    if (running()) law_.quieten.value = false;
    inner_.retune(law_);
  }

  Status activate(const Tick& tick, const Inputs& in, const Params&, const Applied<Outputs>& last) {
    if (running()) end("somebody else has flown");
    for (std::size_t i = 0; i < axes; ++i) {
      use(i, goal_[i]);
      left_s_[i] = 0;  // no surface is bound to these
    }
    strength_ = 0;
    return inner_.activate(tick, in.law, law_, last.part(last->law));
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    const double dt = std::clamp(tick.dt_s(), 0.0, 0.1);
    if (p.tune && !asked_) begin(in, p);
    if (!p.tune && asked_ && running()) end("it was switched off");
    asked_ = p.tune;
    if (running()) {
      time_s_ += dt;
      stage_s_ += dt;
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
    for (std::size_t i = 0; i < axes; ++i) change_over(i, dt);
    const Status status = inner_.step(tick, in.law, law_, out.law);
    excite(in, p, dt, out.law);
    tell(tick, out);
    return status;
  }

 private:
  enum : std::size_t { roll, pitch, yaw, axes };
  static constexpr std::array<const char*, axes> names{"roll", "pitch", "yaw"};
  static constexpr double settle_s = 1, fade_s = 1, change_s = 0.5;
  static constexpr double excite_s = settle_s + fade_s + Lines::record_s, search_s = 1.6;

  using Stage = AutotuneStage;
  using Verdict = AutotuneVerdict;
  using Reason = AutotuneReason;
  /// Of `LoopRecord::answer`: without an answer it is 1 +- 0.3, with one 3.5 and more in moderate turbulence.
  static constexpr double min_answer = 2.5;

  static AxisGains gains_of(const Inner::Params& p, std::size_t axis) {
    if (axis == roll) return {p.roll_kp, p.roll_ki, p.roll_kd};
    if (axis == pitch) return {p.pitch_kp, p.pitch_ki, p.pitch_kd};
    return {0, 0, p.yaw_kd};
  }
  void use(std::size_t axis, const AxisGains& g) {
    used_[axis] = g;
    if (axis == roll) {
      law_.roll_kp.value = g.kp;
      law_.roll_ki.value = g.ki;
      law_.roll_kd.value = g.kd;
    }
    if (axis == pitch) {
      law_.pitch_kp.value = g.kp;
      law_.pitch_ki.value = g.ki;
      law_.pitch_kd.value = g.kd;
    }
    if (axis == yaw) law_.yaw_kd.value = g.kd;
  }
  static AxisGains times(const AxisGains& g, double by) { return {g.kp * by, g.ki * by, g.kd * by}; }

  /// Gains move within change_s: no surface steps.
  void change_to(std::size_t axis, const AxisGains& g) {
    goal_[axis] = g;
    left_s_[axis] = change_s;
  }
  void change_over(std::size_t axis, double dt) {
    if (left_s_[axis] <= 0) return;
    const double part = std::min(1.0, dt / left_s_[axis]);
    left_s_[axis] = part < 1 ? left_s_[axis] - dt : 0;
    const AxisGains &to = goal_[axis], &now = used_[axis];
    use(axis, part < 1 ? AxisGains{now.kp + part * (to.kp - now.kp), now.ki + part * (to.ki - now.ki),
                                   now.kd + part * (to.kd - now.kd)}
                       : to);
  }

  bool running() const {
    return stage_ == Stage::exciting || stage_ == Stage::searching || stage_ == Stage::verifying;
  }
  const Surface& surface(std::size_t axis) const {
    const Airframe& a = *law_.airframe;
    return axis == roll ? a.aileron : axis == pitch ? a.elevator : a.rudder;
  }

  void begin(const Inputs& in, const Params& p) {
    // What quietening has left of the gains is what they are; from here on excitation is no oscillation.
    for (std::size_t i = 0; i < axes; ++i) {
      kept_[i] = old_[i] = goal_[i] = times(used_[i], inner_.gain_left(static_cast<Inner::Axis>(i)));
      use(i, kept_[i]);
    }
    law_.quieten.value = false;
    inner_.retune(law_);
    begun_m_ = in.law.state->height_m;
    time_s_ = 0;
    verdict_ = {};
    reason_ = {};
    before_ = {};
    after_ = {};
    noise_ = {};
    next_axis(roll, p);
  }
  /// They count, whatever was measured with others.
  void set_by_somebody(std::size_t axis, const AxisGains& now) {
    given_[axis] = kept_[axis] = used_[axis] = goal_[axis] = now;
    if (running()) end("gains were set");
    verdict_[axis] = Verdict::open;
    reason_[axis] = Reason::none;
    before_[axis].reset();
    after_[axis].reset();
  }
  void begin_axis(std::size_t axis) {
    axis_ = axis;
    larger_ = 1;
    first_ = true;
    go_to(Stage::exciting);
  }
  void next_axis(std::size_t first, const Params& p) {
    for (std::size_t next = first; next < axes; ++next) {
      const Reason why = in_the_way(next, p);
      if (why == Reason::none) return begin_axis(next);
      verdict_[next] = Verdict::left_out;
      reason_[next] = why;
      say(Severity::info, "%s: not tuned: %s", names[next], words(why));
    }
    go_to(Stage::finished);
  }
  Reason in_the_way(std::size_t axis, const Params& p) const {
    if (surface(axis).limit_rad <= 0 || (axis == yaw && law_.airframe->aero.yaw.rudder_ratio == 0))
      return Reason::no_surface;
    // Found are multiples of what there is; an attitude loop without kp is none.
    if ((axis == yaw ? used_[axis].kd : used_[axis].kp) <= 0) return Reason::gain_is_zero;
    return time_for(2 * excite_s + search_s, p) ? Reason::none : Reason::no_time;
  }
  static const char* words(Reason why) {
    switch (why) {
      case Reason::margins_do_not_hold: return "the margins do not hold";
      case Reason::no_gains_found: return "no gains have the margins";
      case Reason::surface_at_limit: return "the surface was at its limit";
      case Reason::turbulence: return "turbulence hides the answer to the excitation";
      case Reason::no_answer: return "the surface does not act as it should";
      case Reason::no_surface: return "the aircraft has no such surface";
      case Reason::gain_is_zero: return "its gain is 0, and multiples of it are all that is tried";
      case Reason::no_time: return "time_limit leaves no time";
      default: return "";
    }
  }
  void go_to(Stage stage) {
    stage_ = stage;
    stage_s_ = 0;
    fitting_ = false;
    lines_.begin();
  }
  bool time_for(double seconds, const Params& p) const { return time_s_ + seconds < p.time_limit; }

  /// Ends it all: the axis under test goes back, those that were verified stay.
  void end(std::string_view why) {
    revert(Reason::ended, why);
    go_to(Stage::aborted);
  }
  void go_back() { change_to(axis_, kept_[axis_]); }
  void revert(Reason reason, std::string_view why) {
    go_back();
    verdict_[axis_] = Verdict::reverted;
    reason_[axis_] = reason;
    say(Severity::warning, "%s: old gains: %.*s", names[axis_], static_cast<int>(why.size()), why.data());
  }

  /// As they stand in a file.
  void tell_gains(const AxisGains& g, const Margins& m) {
    constexpr double degree = std::numbers::pi / 180;
    const double phase_deg = std::min(m.phase_rad / degree, 180.0);
    const char* const name = names[axis_];
    if (g.damper())
      say(Severity::info, "%s_kd: %.3g  # kept: %.1f dB, %.0f deg measured", name, g.kd, m.min_gain_db(),
          phase_deg);
    else
      say(Severity::info, "%s_kp: %.3g, %s_ki: %.3g, %s_kd: %.3g  # kept: %.1f dB, %.0f deg measured", name,
          g.kp, name, g.ki, name, g.kd, m.min_gain_db(), phase_deg);
  }

  template <class... Values>
  void say(Severity severity, const char* format, Values... values) {
    if (said_ >= notices_.size()) return;
    Notice& n = notices_[said_++];
    n.severity = severity;
    std::snprintf(n.text.bytes.data(), n.text.bytes.size(), format, values...);
  }

  std::string_view trouble(const Inputs& in, const Params& p) const {
    const VehicleState& s = *in.law.state;
    const FlightLimits& limits = p.law.airframe->limits;
    if (in.status && !in.status->in_control) return "commands do not move the aircraft";
    if (in.law.state.stale() || !s.attitude_valid || !s.height_valid || !s.airspeed_valid)
      return "attitude, height or airspeed is not known";
    // Each the other way round: what is no number is out of its bound.
    if (!(std::abs(s.roll_rad) <= p.roll_bound)) return "roll is beyond roll_bound";
    if (!(std::abs(s.pitch_rad) <= p.pitch_bound)) return "pitch is beyond pitch_bound";
    if (!(std::abs(s.height_m - begun_m_) <= p.height_bound)) return "height has moved by height_bound";
    if (!(s.airspeed_mps >= 1.1 * limits.airspeed_min_mps / 1.2)) return "airspeed is near the stall";
    if (!(s.airspeed_mps <= limits.airspeed_max_mps)) return "airspeed is above the maximum";
    if (!(time_s_ <= p.time_limit)) return "time_limit is over";
    return "";
  }

  void go_on(const Params& p) {
    if (stage_ == Stage::searching) {
      for (int i = 0; i < 4; ++i)
        if (search_.step()) return found(p);
    } else if (fitting_ && fit_.step()) {
      judge(fit_.record(), p);
    }
  }

  /// A record is complete: is it to be believed, and do the margins hold?
  void judge(const LoopRecord& r, const Params& p) {
    const Margins m = margins_of(r.loop);
    noise_[axis_] = noise_of(r);
    const bool verifying = stage_ == Stage::verifying;
    if (r.limited > 0.02) {
      if (verifying || !time_for(2 * excite_s + search_s, p)) return done_with(Reason::surface_at_limit, p);
      change_to(axis_, times(used_[axis_], 0.5));  // too much gain to measure by
      return go_to(Stage::exciting);
    }
    if (!(noise_[axis_] <= p.noise_limit)) {
      if (larger_ > 2 || !time_for((verifying ? 1 : 2) * excite_s + search_s, p))
        return done_with(Reason::turbulence, p);
      // The error falls as the excitation grows.
      larger_ = noise_[axis_] > 1.5 * p.noise_limit ? 2.25 : 1.5 * larger_;
      return go_to(stage_);
    }
    if (!answers(r)) return done_with(Reason::no_answer, p);
    (first_ ? before_ : after_)[axis_] = m;
    first_ = false;
    // A standard error more than is asked for: of 1 + L, which is near 1 where margins are read.
    const MarginsWanted least{p.least_gain_margin + 20 * std::log10(1 + noise_[axis_]),
                              p.least_phase_margin + noise_[axis_]};
    if (verifying && least.kept(m)) {
      kept_[axis_] = used_[axis_];
      verdict_[axis_] = Verdict::kept;
      tell_gains(kept_[axis_], m);
      return next_axis(axis_ + 1, p);
    }
    if (verifying && !time_for(excite_s + search_s, p)) return done_with(Reason::margins_do_not_hold, p);
    search_.begin(r, used_[axis_], {p.wanted_gain_margin, p.wanted_phase_margin, p.wanted_delay_margin});
    go_to(Stage::searching);
  }
  void done_with(Reason why, const Params& p) {
    revert(why, words(why));
    next_axis(axis_ + 1, p);
  }
  void found(const Params& p) {
    if (search_.found()) {
      change_to(axis_, search_.best());
      return go_to(Stage::verifying);
    }
    // A record near noise_limit may leave none: once more, from the gains of before.
    if (larger_ > 2 || !time_for(2 * excite_s + search_s, p)) return done_with(Reason::no_gains_found, p);
    larger_ *= 1.5;
    first_ = true;
    go_back();
    go_to(Stage::exciting);
  }
  /// The rate follows the surface, and not the turbulence alone.
  static bool answers(const LoopRecord& r) {
    Complex sum = 0;
    for (std::size_t i = 2; i < 8; ++i) sum += r.rate[i];
    return sum.real() > 0 && r.answer > min_answer;
  }

  void excite(const Inputs& in, const Params& p, double dt, Inner::Outputs& out) {
    const bool wanted =
        (stage_ == Stage::exciting || stage_ == Stage::verifying) && stage_s_ >= settle_s && !fitting_;
    if (strength_ == 0) {
      excited_ = axis_;
      phase_s_ = 0;  // what is left of one stays on its surface
    }
    strength_ = std::clamp(strength_ + (wanted ? dt / fade_s : -5 * dt), 0.0, 1.0);
    if (strength_ == 0) return;
    phase_s_ += dt;
    const double size = excited_ == roll ? p.roll_size : excited_ == pitch ? p.pitch_size : p.yaw_size;
    const Surface& s = surface(excited_);
    // Positive in the record turns to the right or up.
    const double sign = excited_ == roll ? 1 : -1;
    double& deflection = excited_ == roll    ? out.actuators.aileron_rad
                         : excited_ == pitch ? out.actuators.elevator_rad
                                             : out.actuators.rudder_rad;
    const double feedback = deflection;
    const double asked =
        feedback + sign * std::min(size * larger_, 0.5 * s.limit_rad) * strength_ * lines_.at(phase_s_);
    deflection = std::clamp(asked, -s.limit_rad, s.limit_rad);
    const double recorded_s = stage_s_ - settle_s - fade_s;
    if (!wanted || recorded_s < -0.5 * dt) return;
    const VehicleState& x = *in.law.state;
    const double angle = excited_ == roll ? x.roll_rad : excited_ == pitch ? x.pitch_rad : 0;
    const double rate = excited_ == roll    ? x.rate_radps.x
                        : excited_ == pitch ? x.rate_radps.y
                                            : x.rate_radps.z;
    if (recorded_s < Lines::record_s - 0.5 * dt) {
      const bool limited = asked != deflection || std::abs(feedback) >= s.limit_rad;
      return lines_.add(sign * feedback, sign * deflection, angle, rate, out.surface_scale_ratio.value,
                        limited, dt);
    }
    lines_.close(sign * feedback, sign * deflection, angle, rate);
    fit_.begin(lines_.record(), used_[axis_], axis_ == roll && law_.roll_from_sideslip != 0);
    fitting_ = true;
  }

  void tell(const Tick& tick, Outputs& out) {
    AutotuneReport& r = out.report;
    r.stage = stage_;
    r.done = stage_ == Stage::finished || stage_ == Stage::aborted;
    r.axis = running() ? static_cast<AutotuneAxis>(axis_ + 1) : AutotuneAxis::none;
    r.roll = verdict_[roll];
    r.pitch = verdict_[pitch];
    r.yaw = verdict_[yaw];
    r.roll_reason = reason_[roll];
    r.pitch_reason = reason_[pitch];
    r.yaw_reason = reason_[yaw];
    r.time_s = time_s_;
    for (std::size_t i = 0; i < axes; ++i) {
      r.before_kp_ratio[i] = old_[i].kp;
      r.before_ki_ratio[i] = old_[i].ki;
      r.before_kd_ratio[i] = old_[i].kd;
      r.kp_ratio[i] = used_[i].kp;
      r.ki_ratio[i] = used_[i].ki;
      r.kd_ratio[i] = used_[i].kd;
      tell_margins(before_[i], r.before_gain_margin_ratio[i], r.before_phase_margin_rad[i]);
      tell_margins(after_[i], r.gain_margin_ratio[i], r.phase_margin_rad[i]);
      r.crossover_radps[i] = after_[i] ? after_[i]->crossover_radps : 0;
      r.noise_ratio[i] = std::isfinite(noise_[i]) ? std::min(noise_[i], 1e9) : 1e9;
    }
    for (std::size_t i = 0; i < said_; ++i) out.findings.push(notices_[i], tick.now_ns);
    said_ = 0;
  }
  static void tell_margins(const std::optional<Margins>& m, double& gain_ratio, double& phase_rad) {
    gain_ratio = m ? std::min(std::pow(10, m->min_gain_db() / 20), 1e9) : 0;
    phase_rad = m ? std::min(m->phase_rad, std::numbers::pi) : 0;
  }

  Inner inner_;
  Inner::Params law_;  ///< with the gains in use
  std::array<AxisGains, axes> given_{}, old_{}, kept_{}, used_{}, goal_{};
  std::array<double, axes> left_s_{};  ///< of a change of gains
  LoopLines lines_;
  RateFit fit_;
  bool fitting_ = false;  ///< a record is complete, and not yet judged
  GainSearch search_;
  Stage stage_ = Stage::idle;
  std::size_t axis_ = roll, excited_ = roll;
  std::array<Verdict, axes> verdict_{};
  std::array<Reason, axes> reason_{};
  std::array<std::optional<Margins>, axes> before_{}, after_{};
  std::array<double, axes> noise_{};
  std::array<Notice, 4> notices_{};
  std::size_t said_ = 0;
  double time_s_ = 0, stage_s_ = 0, phase_s_ = 0, begun_m_ = 0;
  double strength_ = 0, larger_ = 1;  ///< of the excitation
  bool asked_ = false, first_ = true;
};

}  // namespace fulmar::slc
