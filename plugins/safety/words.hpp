// SPDX-License-Identifier: BSD-3-Clause
// One line for each cause that comes or goes: what is wrong, what the aircraft does, what the pilot should
// do.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>

#include "fulmar/flight/control/alarms.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "fulmar/plugin.hpp"
#include "gate.hpp"

namespace fulmar::safety {

class Reports {
 public:
  using Queue = OutQueue<Notice, 12>;
  using Line = std::array<char, 97>;
  struct Facts {
    double battery_ratio = 1, wind_mps = 0, ground_wind_mps = 0, roll_rad = 0, pitch_rad = 0;
    double room_m = 0;                              ///< to the nearest side of the fence, now
    double below_ceiling_m = 0, above_floor_m = 0;  ///< now
    bool tail_wind = false;                         ///< found in a take-off run
    bool aloft = false;                             ///< off the ground, for however short a time
    bool by_side = false;                           ///< it is a side that the turn back comes too near to
    bool landing = false, drift_ends_wait = false, kept_fence = false;
  };

  void step(const SafetyState& now, const Facts& facts, const Tick& tick, double dt, Queue& out) {
    now_ = &now;
    tick_ = &tick;
    out_ = &out;
    said_ = false;
    lands_ = facts.landing;
    faults(facts);
    place(facts);
    changes(facts);
    before_take_off(facts, dt);
    reported_ = now;
  }

 private:
  static constexpr std::array<const char*, 7> does{
      "goes on",           "levels the wings",  "glides down", "descends in a circle, motor off",
      "circles and waits", "returns and lands", "returns home"};

  const char* answer() const {
    if (lands_ && now_->answer == SafetyAnswer::none) return "finishes the landing";
    return does[static_cast<std::size_t>(now_->answer)];
  }

  void push(const char* text, Severity severity, Cause cause = Cause::none) {
    Notice notice;
    notice.text = text;
    notice.severity = severity;
    notice.cause = cause;
    out_->push(notice, tick_->now_ns);
    said_ = true;
  }
  static Line line(const char* text) { return joined({text}); }
  template <class First, class... A>
  static Line line(const char* format, First first, A... a) {
    Line text{};
    std::snprintf(text.data(), text.size(), format, first, a...);
    return text;
  }

  /// Parts one after the other, as far as there is room.
  static Line joined(std::initializer_list<const char*> parts) {
    Line text{};
    std::size_t used = 0;
    for (const char* part : parts)
      for (; *part != 0 && used + 1 < text.size(); ++part) text[used++] = *part;
    return text;
  }

  void say(bool SafetyState::*flag, const Line& wrong, const char* right, const char* pilot) {
    const bool raised = now_->*flag;
    if (raised == reported_.*flag) return;
    const Cause cause = alarm(flag).cause;
    const char* const what = raised ? wrong.data() : right;
    if (!now_->airborne) return push(what, raised ? Severity::warning : Severity::info, cause);
    if (raised)
      return push(joined({what, ": ", answer(), ". Pilot: ", pilot}).data(), Severity::warning, cause);
    const bool free = now_->answer == SafetyAnswer::none;
    push(joined({what, free ? ": " : ": still ", answer()}).data(), Severity::info, cause);
  }
  /// The text of an alarm, and a figure.
  void say(bool SafetyState::*flag, const char* right, const char* pilot, const Line& figure = {}) {
    say(flag, joined({alarm(flag).words, figure.data()}), right, pilot);
  }

  void faults(const Facts& f) {
    using S = SafetyState;
    constexpr double deg = std::numbers::pi / 180;
    const int charge = static_cast<int>(std::lround(100 * std::clamp(f.battery_ratio, 0.0, 1.0)));
    const int thrust = static_cast<int>(std::lround(100 * std::clamp(now_->thrust_ratio, 0.0, 1.0)));
    say(&S::engine_failed, "the motor gives thrust", "land ahead");
    if (!now_->engine_failed)
      say(&S::engine_weak, "the motor has its thrust", "no go-around", line(", %d %% of its thrust", thrust));
    say(&S::battery_empty, "battery not empty", "land now", line(", %d %%", charge));
    say(&S::attitude_excessive,
        joined({alarm(&S::attitude_excessive).words, line(", roll %.0f", std::abs(f.roll_rad) / deg).data(),
                line(", pitch %.0f deg", std::abs(f.pitch_rad) / deg).data()}),
        "attitude in limits", "take over");
    say(&S::estimator_failed, "estimate valid", "take over");
    say(&S::gnss_lost, "position back", "take over by sight");
    say(&S::battery_low, "battery not low", "clear the runway", line(", %d %%", charge));
    say(&S::pitot_lost, "airspeed measured again", "fly fast");
    say(&S::wind_excessive, "wind below the limit", "keep the field clear", line(", %.0f m/s", f.wind_mps));
    say(&S::radio_lost, "radio back", "check the transmitter");
    say(&S::link_lost, "vehicle status back", "check the link");
    if (now_->drifting != reported_.drifting)
      push(now_->drifting
               ? line("wind %.0f m/s exceeds the top airspeed: nose into wind, drifts. Pilot: land",
                      f.wind_mps)
                     .data()
               : "wind below the top airspeed: holds its ground",
           now_->drifting ? Severity::warning : Severity::info, Cause::drifting);
  }

  /// Distances without a sign.
  static Line side(double room_m) {
    return line(room_m < 0 ? "outside the fence by %.0f m" : "%.0f m to the fence", std::abs(room_m));
  }
  static Line ceiling(double below_m) {
    return line(below_m < 0 ? "above the ceiling by %.0f m" : "%.0f m to the ceiling", std::abs(below_m));
  }
  static Line floor(double above_m) {
    return line(above_m < 0 ? "below the floor by %.0f m" : "%.0f m to the floor", std::abs(above_m));
  }
  static Line where(const Facts& f) {
    if (f.by_side) return side(f.room_m);
    return f.below_ceiling_m < f.above_floor_m ? ceiling(f.below_ceiling_m) : floor(f.above_floor_m);
  }

  void place(const Facts& f) {
    const char* const right = f.kept_fence ? "inside the fence, the return goes on" : "inside the fence";
    say(&SafetyState::fence, where(f), right, "keep inside");
  }

  /// Answers that change with time alone.
  void changes(const Facts& f) {
    if (said_ || !now_->airborne || !reported_.airborne || now_->answer == reported_.answer) return;
    if (now_->answer == SafetyAnswer::descend)
      push(joined({f.drift_ends_wait ? "near the fence after " : "no position for ",
                   line("%.0f s", now_->waiting_s).data(), f.drift_ends_wait ? " without position: " : ": ",
                   answer(), ". Pilot: take over"})
               .data(),
           Severity::warning);
    else if (now_->answer == SafetyAnswer::land)
      push(line("returning for %.0f s: lands. Pilot: clear the runway", now_->returning_s).data(),
           Severity::warning);
  }

  /// The list of what is missing, when it has been the same for a while; once before a flight that is enough.
  void before_take_off(const Facts& f, double dt) {
    constexpr double settled_s = 2, apart_s = 5;
    flew_ = flew_ || now_->airborne;
    since_s_ += dt;
    if (flew_ || f.aloft) return;
    const std::uint32_t bits = mask(now_->not_ready);
    same_s_ = bits == bits_ ? same_s_ + dt : 0;
    bits_ = bits;
    if (same_s_ < settled_s || since_s_ < apart_s || bits == listed_) return;
    if (bits != 0)
      push(joined({"not ready: ", missing(f).data()}).data(), Severity::warning);
    else
      push("ready for take-off", Severity::info);
    listed_ = bits;
    since_s_ = 0;
  }

  static std::uint32_t mask(const NotReady& n) {
    std::uint32_t bits = 0;
    for (const bool b :
         {n.motor, n.fence, n.height, n.wind, n.pitot, n.battery, n.radio, n.position, n.estimator})
      bits = 2 * bits + (b ? 1U : 0U);
    return bits;
  }

  Line missing(const Facts& f) const {
    const NotReady& n = now_->not_ready;
    Line list{};
    const auto add = [&list](bool is, const Line& what) {
      if (is) list = joined({list.data(), list[0] != 0 ? ", " : "", what.data()});
    };
    add(n.motor, line("no thrust from the motor"));
    add(n.fence, side(f.room_m));
    add(n.height, ceiling(f.below_ceiling_m));
    add(n.wind, f.tail_wind ? line("tail wind in the run") : line("wind %.0f m/s", f.ground_wind_mps));
    add(n.pitot, line("pitot"));
    add(n.battery, line("battery"));
    add(n.radio, line("radio"));
    add(n.position, line("position"));
    add(n.estimator, line("estimate"));
    return list;
  }

  const SafetyState* now_ = nullptr;
  const Tick* tick_ = nullptr;
  Queue* out_ = nullptr;
  SafetyState reported_;
  std::uint32_t bits_ = 0, listed_ = 0;
  double same_s_ = 0, since_s_ = 1e9;
  bool said_ = false, flew_ = false, lands_ = false;
};

}  // namespace fulmar::safety
