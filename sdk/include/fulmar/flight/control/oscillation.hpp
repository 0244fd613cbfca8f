// SPDX-License-Identifier: BSD-3-Clause
// A loop with too much gain oscillates at the frequency where it has no phase margin, with a constant
// amplitude. The swings of its output show the limit cycle: Åström & Hägglund, Advanced PID Control (2006),
// section 7.3. A lower gain ends it.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/math/filters.hpp"

namespace fulmar {

/// Counts swings: half waves of a signal beyond a threshold, none much smaller than the one before, each as
/// long as a half wave of 8 to 63 rad/s. Gusts and manoeuvres make two or three in a row. The part from the
/// command is no oscillation of the loop: while it swings half as far, no swing counts.
class Swings {
 public:
  /// Number of swings in a row that are an oscillation.
  static constexpr int many = 5;

  /// True after `many` swings; then the count restarts. `caused`: part of `signal` from the command, through
  /// gains and feed-forward.
  bool step(double signal, double caused, double threshold, double dt_s) {
    const double y = fast_.step(signal, wash_out_radps, dt_s),
                 c = std::abs(commanded_.step(caused, wash_out_radps, dt_s));
    time_s_ += dt_s;
    if ((y > 0) != positive_) {
      count();
      positive_ = y > 0;
      before_ = peak_;
      time_s_ = peak_ = caused_ = 0;
    }
    peak_ = std::max(peak_, std::abs(y));
    caused_ = std::max(caused_, c);
    large_ = peak_ > threshold && peak_ > 0.7 * before_ && caused_ < 0.5 * peak_;
    if (count_ < many) return false;
    count_ = 0;
    return true;
  }
  void reset() { *this = {}; }

 private:
  static constexpr double wash_out_radps = 6, shortest_s = 0.05, max_s = 0.4;

  void count() { count_ = large_ && time_s_ >= shortest_s && time_s_ <= max_s ? count_ + 1 : 0; }

  WashOut fast_, commanded_;
  double time_s_ = 0, peak_ = 0, before_ = 0, caused_ = 0;
  int count_ = 0;
  bool positive_ = false, large_ = false;
};

/// Factor on the gains of a loop: multiplied by `share` at each oscillation, at least `least`, until
/// `restore()`.
class Quietening {
 public:
  static constexpr double share = 0.4, least = 0.1;

  /// True if the gains were reduced in this step. Arguments as in Swings.
  bool step(double signal, double caused, double threshold, double dt_s) {
    if (!swings_.step(signal, caused, threshold, dt_s) || gain_ <= least) return false;
    gain_ = std::max(share * gain_, least);
    return true;
  }
  /// Clears the count after a switch or on the ground. The gain stays.
  void begin() { swings_.reset(); }
  void restore() { *this = {}; }
  double gain() const { return gain_; }

 private:
  Swings swings_;
  double gain_ = 1;
};

}  // namespace fulmar
