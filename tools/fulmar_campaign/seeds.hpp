// SPDX-License-Identifier: BSD-3-Clause
// Many flights of one mission: their seeds, and statistics of their figures.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fulmar::core {

/// "1..20", "3,5,8..10". Throws Error.
std::vector<std::uint64_t> parse_seeds(const std::string& text);

/// Statistics of the figures of those results (of result_json): "mean", "deviation" (of the sample; null for
/// one flight), "least", "most", each with the figures in their places, and "flown", the number of flights.
nlohmann::json spread(const std::vector<nlohmann::json>& results);
/// Table for a terminal. `results` as above.
std::string spread_table(const std::vector<nlohmann::json>& results);

}  // namespace fulmar::core
