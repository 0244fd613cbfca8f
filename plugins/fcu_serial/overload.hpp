// SPDX-License-Identifier: BSD-3-Clause
// Detects a computer that is too slow for its laws: inertial samples are too old when the loop takes them. A
// single pause is reported elsewhere; this is a permanent overload.
#pragma once
#include <cstdint>

#include "words.hpp"

namespace fulmar::fcu {

class Overload {
 public:
  void sample(bool too_old) {
    ++samples_;
    if (too_old) ++too_old_;
  }
  /// Reports in the second such second, then every ten, and at the end.
  void report(std::int64_t now_ns, Notices& out) {
    if (now_ns - since_ns_ < second_ns) return;
    const std::int64_t percent = samples_ > 0 ? 100 * too_old_ / samples_ : 0;
    since_ns_ = now_ns;
    samples_ = too_old_ = 0;
    const bool slow = percent >= worth_saying_percent;
    seconds_ = slow ? seconds_ + 1 : 0;
    if (reported_ && !slow) {
      out.add(fulmar::Severity::warning, fcu_serial_messages::computer_fast_again);
      reported_ = false;
    }
    if (seconds_ % 10 != 2) return;
    reported_ = true;
    out.add(fulmar::Severity::critical, fcu_serial_messages::computer_slow, percent);
  }

 private:
  static constexpr std::int64_t second_ns = 1'000'000'000;
  static constexpr std::int64_t worth_saying_percent = 10;
  std::int64_t since_ns_ = 0, samples_ = 0, too_old_ = 0;
  std::int64_t seconds_ = 0;  ///< number of such seconds in a row
  bool reported_ = false;
};

}  // namespace fulmar::fcu
