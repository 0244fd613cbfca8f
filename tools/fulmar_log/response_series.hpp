// SPDX-License-Identifier: BSD-3-Clause
// Fields of a log as series: "nav.state.roll_rad", or a probe, "attitude_signal.roll_excitation_rad".
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "tools/fulmar_log/response.hpp"

namespace fulmar::response {

/// Flight time.
struct Window {
  std::optional<double> from_s, to_s;
  std::string phase;  // "": none; its first occurrence within from_s and to_s
};

struct Signal {
  std::string name, unit;    // displayed: "nav.state.roll_deg", "deg"; "" without a unit
  Series series;             // by time of validity; angles in degrees, and without jumps of a turn
  std::size_t left_out = 0;  // samples that are not finite, or not later than the one before
};

/// Input and output. Throws core::Error for a field that is not in the log.
std::array<Signal, 2> read_signals(const std::filesystem::path& log, const std::array<std::string, 2>& fields,
                                   const Window& window);

/// Share of the time from `from_s` to `to_s` in which a servo was saturated or at its rate limit, by the
/// components that report it (`limited_ratio`); the largest of several. Empty without a report.
std::optional<double> limited_share(const std::filesystem::path& log, double from_s, double to_s);

}  // namespace fulmar::response
