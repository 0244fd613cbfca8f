// SPDX-License-Identifier: BSD-3-Clause
// The floating-point mode of the calling thread. A library linked with -ffast-math switches denormals off
// when it is loaded; the host restores the mode around every load, and the probing child refuses such a
// library.
#pragma once
#include <cfenv>
#include <limits>

namespace fulmar::core {

/// Saves the mode and restores it at the end of the scope, the control word of SSE or NEON included.
class FloatModeGuard {
 public:
  FloatModeGuard() { std::fegetenv(&saved_); }
  ~FloatModeGuard() { std::fesetenv(&saved_); }
  FloatModeGuard(const FloatModeGuard&) = delete;
  FloatModeGuard& operator=(const FloatModeGuard&) = delete;

 private:
  std::fenv_t saved_{};
};

/// What arithmetic does, found by doing it: portable where control words are not.
struct FloatMode {
  bool denormal_operands, denormal_results, extended;
  int rounding, traps;  // traps: which exceptions raise a signal
  friend bool operator==(const FloatMode&, const FloatMode&) = default;

  static FloatMode now() {
    volatile double smallest = std::numeric_limits<double>::denorm_min(),
                    normal = std::numeric_limits<double>::min(), half = 0.5;
    volatile long double one = 1, little = std::numeric_limits<long double>::epsilon();
    const volatile double doubled = smallest * (4 * half), halved = normal * half;
    const volatile long double sum = one + little;
    return {doubled > 0, halved > 0, sum > one, std::fegetround(), fegetexcept()};
  }
};

}  // namespace fulmar::core
