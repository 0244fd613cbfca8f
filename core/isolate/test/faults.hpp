// SPDX-License-Identifier: BSD-3-Clause
// Faults of a laboratory component: its parameter, which the tests set by number.
#pragma once
#include <cstdint>

namespace isolate_lab {

enum Fault : std::uint8_t {
  none,
  segfault,
  aborts,
  exits,
  hangs,
  overflow,
  throws,
  not_a_number,
  leaks,
  killed,
  divides,
  prints,
  allocates,
  fails,
  terminates,
  forks,
  clones,
  clone_crashes
};

}  // namespace isolate_lab
