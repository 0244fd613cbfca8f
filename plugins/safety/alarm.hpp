// SPDX-License-Identifier: BSD-3-Clause
// A flag with delays.
#pragma once

namespace fulmar::safety {

/// A flag that rises when `bad` has held for `raise_s` and falls when `good` has held for `clear_s`. In
/// between it stays.
class Alarm {
 public:
  bool step(bool bad, bool good, double raise_s, double clear_s, double dt_s) {
    held_s_ = (raised_ ? good : bad) ? held_s_ + dt_s : 0;
    if (held_s_ > 0 && held_s_ >= (raised_ ? clear_s : raise_s)) {
      raised_ = !raised_;
      held_s_ = 0;
    }
    return raised_;
  }
  bool step(bool bad, double raise_s, double clear_s, double dt_s) {
    return step(bad, !bad, raise_s, clear_s, dt_s);
  }
  bool raised() const { return raised_; }
  void reset() { *this = {}; }

 private:
  double held_s_ = 0;
  bool raised_ = false;
};

}  // namespace fulmar::safety
