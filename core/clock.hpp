// SPDX-License-Identifier: BSD-3-Clause
// The monotonic clock. No result of a flight depends on it: it serves for pace, measurement and time limits.
#pragma once
#include <time.h>

#include <cstdint>

namespace fulmar::core {

inline std::int64_t monotonic_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

}  // namespace fulmar::core
