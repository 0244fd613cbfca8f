// SPDX-License-Identifier: BSD-3-Clause
// Many flights of one mission: which seeds, and what their figures are on the whole.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fulmar::core {

/// "1..20", "3,5,8..10". Throws Error.
std::vector<std::uint64_t> parse_seeds(const std::string& text);

/// Of the figures of those results (as result_json makes them) that are flown: "mean", "deviation" (of the
/// sample; null for one flight), "least", "most", each with the figures in their places, and "flown", how
/// many.
nlohmann::json spread(const std::vector<nlohmann::json>& results);
/// For people. `results` as above.
std::string spread_table(const std::vector<nlohmann::json>& results);

}  // namespace fulmar::core
