// SPDX-License-Identifier: BSD-3-Clause
// Times of the report of a fault and of its end.
#pragma once

namespace fulmar::safety {

/// State of one fault from its begin over its report to its end. An intermittent fault is reported once per
/// `pause_s`.
class Reported {
 public:
  enum class News { none, raised, cleared };

  News step(bool bad, bool good, double raise_s, double clear_s, double pause_s, double now_s, double dt) {
    held_s_ = (raised_ ? good : bad) ? held_s_ + dt : 0;
    if (held_s_ <= 0 || held_s_ < (raised_ ? clear_s : raise_s)) return News::none;
    held_s_ = 0;
    raised_ = !raised_;
    if (!raised_) return said_ ? News::cleared : News::none;
    began_s_ = now_s - raise_s;
    said_ = !any_ || now_s - said_s_ >= pause_s;
    if (!said_) return News::none;
    any_ = true;
    said_s_ = now_s;
    return News::raised;
  }
  double since_s(double now_s) const { return now_s - began_s_; }

 private:
  double held_s_ = 0, began_s_ = 0, said_s_ = 0;
  bool raised_ = false, said_ = false, any_ = false;
};

}  // namespace fulmar::safety
