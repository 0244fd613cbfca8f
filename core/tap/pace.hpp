// SPDX-License-Identifier: BSD-3-Clause
// How fast a simulation flies: what can be asked of its clock.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace fulmar::core {

/// Not a command of the flight: its time stands still or runs faster, and its log does not tell.
struct PaceOrder {
  enum class What : std::uint8_t { pause, resume, step, speed, restart };
  What what = What::pause;
  std::uint64_t ticks = 0;              // of `step`: so many, then it is paused again
  double speed = 0;                     // of `speed`: times real time; 0: as fast as the machine allows
  std::optional<std::uint64_t> seed{};  // of `restart`: of the next flight; none: that of this one
};

/// "real", "max", or a multiple of real time; empty for anything else.
std::optional<double> speed_of(const std::string& text);
/// For people: "real", "max", "10".
std::string speed_text(double speed);

/// Throw Error with what would be right.
PaceOrder step_order(const std::string& ticks);
PaceOrder speed_order(const std::string& speed);
/// "": the seed of the flight that ends.
PaceOrder restart_order(const std::string& seed);

}  // namespace fulmar::core
