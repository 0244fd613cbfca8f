// SPDX-License-Identifier: BSD-3-Clause
// A periodic schedule without drift: due times are whole nanoseconds, and the next one is a period after the
// last due time, however late that was served. After a gap the schedule begins again instead of catching up.
#pragma once
#include <cstdint>
#include <limits>

namespace fulmar::core {

class Due {
 public:
  bool is(std::int64_t now_ns) const noexcept { return now_ns >= next_ns_; }
  /// Due now, independent of the schedule.
  void call(std::int64_t now_ns) noexcept { next_ns_ = now_ns; }
  /// Starts the schedule here, if it has not begun.
  void begin(std::int64_t now_ns) noexcept {
    if (next_ns_ == never) next_ns_ = now_ns;
  }
  void done(std::int64_t now_ns, std::int64_t period_ns) noexcept {
    const bool late = next_ns_ == never || next_ns_ + period_ns <= now_ns;
    next_ns_ = (late ? now_ns : next_ns_) + period_ns;
  }
  /// Whether it is due; a true result counts as served. A period below 0 is never due.
  bool take(std::int64_t now_ns, std::int64_t period_ns) noexcept {
    if (period_ns < 0 || !is(now_ns)) return false;
    done(now_ns, period_ns);
    return true;
  }

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::min();
  std::int64_t next_ns_ = never;
};

}  // namespace fulmar::core
