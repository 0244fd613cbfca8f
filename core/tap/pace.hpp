// SPDX-License-Identifier: BSD-3-Clause
// Pace of a simulation: orders for its clock.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace fulmar::core {

/// Not a command of the flight: it changes only the pace, and the log does not record it.
struct PaceOrder {
  enum class What : std::uint8_t { pause, resume, step, speed, restart };
  What what = What::pause;
  std::uint64_t ticks = 0;              // of `step`: ticks until the next pause
  double speed = 0;                     // of `speed`: times real time; 0: as fast as the machine allows
  std::optional<std::uint64_t> seed{};  // of `restart`: seed of the next flight; none: that of this one
};

/// "real", "max", or a multiple of real time; empty for anything else.
std::optional<double> speed_of(const std::string& text);
/// For users: "real", "max", "10".
std::string speed_text(double speed);

/// These throw Error with the valid values.
PaceOrder step_order(const std::string& ticks);
PaceOrder speed_order(const std::string& speed);
/// "": the seed of the flight that ends.
PaceOrder restart_order(const std::string& seed);

}  // namespace fulmar::core
