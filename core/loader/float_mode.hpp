// SPDX-License-Identifier: BSD-3-Clause
// Floating-point mode of the calling thread. A library linked with -ffast-math switches denormals off when it
// is loaded. The host restores the mode around every load, and the probing child rejects such a library.
#pragma once
#include <cfenv>
#include <cstdint>
#include <limits>

namespace fulmar::core {

/// Saves the mode and restores it at the end of the scope, including the control word of SSE or NEON.
class FloatModeGuard {
 public:
  FloatModeGuard() { std::fegetenv(&saved_); }
  ~FloatModeGuard() { std::fesetenv(&saved_); }
  FloatModeGuard(const FloatModeGuard&) = delete;
  FloatModeGuard& operator=(const FloatModeGuard&) = delete;

 private:
  std::fenv_t saved_{};
};

/// Whether the calling thread has the initial mode of a thread: rounds to nearest, keeps denormals, traps
/// nothing. Takes one or two instructions, for use in flight.
#if defined(__x86_64__)
inline bool plain_arithmetic() noexcept {
  constexpr unsigned control = 0xffc0, initial = 0x1f80;  // MXCSR; System V ABI for AMD64, 3.2.3
  // control word of long double, section 8.1.5 in Intel's architecture manual: precision, rounding, traps
  constexpr unsigned x87_control = 0x0f3f, x87_initial = 0x033f;
  std::uint16_t x87 = 0;
  asm volatile("fnstcw %0" : "=m"(x87));
  return (__builtin_ia32_stmxcsr() & control) == initial && (x87 & x87_control) == x87_initial;
}
#elif defined(__aarch64__)
inline bool plain_arithmetic() noexcept {
  std::uint64_t mode = 0;
  asm volatile("mrs %0, fpcr" : "=r"(mode));
  return mode == 0;
}
#else
inline bool plain_arithmetic() noexcept { return true; }
#endif
inline void make_arithmetic_plain() noexcept {
  std::fesetenv(FE_DFL_ENV);
#if defined(__x86_64__)
  __builtin_ia32_ldmxcsr(0x1f80);  // the sanitizer assumes nothing about the register
#elif defined(__aarch64__)
  asm volatile("msr fpcr, %0" ::"r"(std::uint64_t{0}));
#endif
}

/// Measures the behaviour of arithmetic: portable to machines without these control words.
struct FloatMode {
  bool denormal_operands, denormal_results, extended;
  int rounding, traps;  // traps: exceptions that raise a signal
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
