// SPDX-License-Identifier: BSD-3-Clause
// Text of a crash, and of the answer of safety before it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>

#include "fulmar/flight/control/alarms.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/msg/safety_state.hpp"
#include "messages.hpp"
#include "score_messages.hpp"

namespace fulmar::score {

inline const MessageText<0>& answer_text(SafetyAnswer answer) {
  switch (answer) {
    case SafetyAnswer::none: break;
    case SafetyAnswer::level: return score_messages::wings_level;
    case SafetyAnswer::glide: return score_messages::glide;
    case SafetyAnswer::descend: return score_messages::descent;
    case SafetyAnswer::wait: return score_messages::wait;
    case SafetyAnswer::land: return score_messages::land;
    case SafetyAnswer::home: return score_messages::home;
  }
  return score_messages::go_on;
}

/// A text that grows up to its capacity.
template <std::size_t N>
class Line {
 public:
  void add(std::string_view words) {
    const std::size_t n = std::min(words.size(), left());
    std::copy_n(words.begin(), n, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += n;
  }
  template <std::size_t M, class... Values>
  void add(const MessageText<M>& text, const Values&... values) {
    const std::size_t n = text.write(bytes_.data() + size_, N - size_, values...);
    size_ = std::min(N - 1, size_ + n);
  }
  bool empty() const { return size_ == 0; }
  std::size_t left() const { return N - 1 - size_; }
  std::string_view view() const { return {bytes_.data(), size_}; }

 private:
  std::array<char, N> bytes_{};
  std::size_t size_ = 0;
};

/// All active alarms: "no thrust from the motor and battery low".
inline Line<128> alarm_words(const SafetyState& s) {
  Line<128> line;
  for (const NamedAlarm& a : alarms)
    if (is_raised(a, s)) {
      if (!line.empty()) line.add(" and ");
      line.add(*a.message);
    }
  return line;
}

class Story {
 public:
  /// Updates the observed lift-off. Returns true when there is a new text.
  bool lift(bool observed, bool flies) {
    const bool before = std::exchange(grounded_, observed && (grounded_ || !begun_) && !flies);
    begun_ = true;
    return before != grounded_;
  }

  /// Returns true when there is a new text.
  bool answer(const SafetyState& s, bool flies, double now_s) {
    const SafetyAnswer before = std::exchange(answer_, s.answer);
    if (s.answer == before || s.answer == SafetyAnswer::none || !flies) return false;
    if (answers_.left() < 60) return false;
    const Line<128> why = alarm_words(s);
    const char* const answer = answer_text(s.answer).c_str();
    if (!answers_.empty()) answers_.add(", ");
    if (why.empty())
      answers_.add(score_messages::answered, answer, Fixed{now_s, 1});
    else
      answers_.add(score_messages::answered_because, answer, Fixed{now_s, 1}, why.view());
    return true;
  }

  Verdict verdict() const {
    Verdict v;
    v.text = grounded_ ? score_messages::never_airborne.c_str() : answers_.view();
    return v;
  }

  Verdict verdict(const Crash& c) const {
    constexpr double degrees = 180 / std::numbers::pi;
    Line<320> crash, line;
    crash.add(score_messages::crashed,
              c.part.view().empty() ? std::string_view(score_messages::part_unknown.c_str()) : c.part.view(),
              Fixed{c.at_s, 2}, Fixed{c.sink_mps, 1}, Fixed{degrees * c.roll_rad, 0},
              Fixed{c.ground_speed_mps, 1}, Fixed{std::abs(c.north_m), 0}, c.north_m < 0 ? "south" : "north",
              Fixed{std::abs(c.east_m), 0}, c.east_m < 0 ? "west" : "east");
    if (answers_.empty())
      line = crash;
    else
      line.add(score_messages::crashed_after, crash.view(), answers_.view());
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
