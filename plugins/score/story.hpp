// SPDX-License-Identifier: BSD-3-Clause
// What happened, in words: the crash, and what safety answered before.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <utility>

#include "fulmar/flight/control/alarms.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "score_messages.hpp"

namespace fulmar::score {

inline const char* answer_words(SafetyAnswer answer) {
  switch (answer) {
    case SafetyAnswer::none: break;
    case SafetyAnswer::level: return "wings level";
    case SafetyAnswer::glide: return "glide";
    case SafetyAnswer::descend: return "descent without motor";
    case SafetyAnswer::wait: return "circle and wait";
    case SafetyAnswer::land: return "return and land";
    case SafetyAnswer::home: return "return home";
  }
  return "go on";
}

/// A line that grows until its room is full.
template <std::size_t N>
class Line {
 public:
  [[gnu::format(printf, 2, 3)]] void add(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int n = std::vsnprintf(bytes_.data() + size_, N - size_, format, arguments);
    va_end(arguments);
    size_ = std::min(N - 1, size_ + static_cast<std::size_t>(std::max(n, 0)));
  }
  bool empty() const { return size_ == 0; }
  std::size_t left() const { return N - 1 - size_; }
  const char* c_str() const { return bytes_.data(); }
  std::string_view view() const { return {bytes_.data(), size_}; }

 private:
  std::array<char, N> bytes_{};
  std::size_t size_ = 0;
};

/// All that is wrong: "no thrust from the motor and battery low".
inline Line<128> alarm_words(const SafetyState& s) {
  Line<128> line;
  for (const NamedAlarm& a : alarms)
    if (is_raised(a, s)) line.add("%s%s", line.empty() ? "" : " and ", a.words);
  return line;
}

class Story {
 public:
  /// Whether it has left the ground, as far as that is observed. True: there is something new to say.
  bool lift(bool observed, bool flies) {
    const bool before = std::exchange(grounded_, observed && (grounded_ || !begun_) && !flies);
    begun_ = true;
    return before != grounded_;
  }

  /// Whether there is something new to say.
  bool answer(const SafetyState& s, bool flies, double now_s) {
    const SafetyAnswer before = std::exchange(answer_, s.answer);
    if (s.answer == before || s.answer == SafetyAnswer::none || !flies) return false;
    if (answers_.left() < 60) return false;
    const Line<128> why = alarm_words(s);
    answers_.add("%s%s at %.1f s", answers_.empty() ? "" : ", ", answer_words(s.answer), now_s);
    if (!why.empty()) answers_.add(" (%s)", why.c_str());
    return true;
  }

  Verdict verdict() const {
    Verdict v;
    v.text = grounded_ ? "never left the ground" : answers_.view();
    return v;
  }

  Verdict verdict(const Crash& c) const {
    constexpr double degrees = 180 / std::numbers::pi;
    Line<320> line;
    line.add(
        "%s touched at %.2f s, sink %.1f m/s, bank %.0f deg, %.1f m/s over ground, %.0f m %s and %.0f m %s",
        c.part.view().empty() ? "an unknown part" : c.part.bytes.data(), c.at_s, c.sink_mps,
        degrees * c.roll_rad, c.ground_speed_mps, std::abs(c.north_m), c.north_m < 0 ? "south" : "north",
        std::abs(c.east_m), c.east_m < 0 ? "west" : "east");
    if (!answers_.empty()) line.add("; before: %s", answers_.c_str());
    Verdict v;
    v.word = "crashed";
    v.text = line.view();
    return v;
  }

 private:
  Line<200> answers_;
  SafetyAnswer answer_ = SafetyAnswer::none;
  bool begun_ = false, grounded_ = false;
};

inline Crash crash_of(const ContactTruth& c) {
  return {c.part,     c.touched_s,        c.position_m.north, c.position_m.east,
          c.sink_mps, c.ground_speed_mps, c.roll_rad,         c.pitch_rad};
}

}  // namespace fulmar::score
