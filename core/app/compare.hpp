// SPDX-License-Identifier: BSD-3-Clause
// Two flights side by side.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fulmar::core {

/// A table of the figures that both results have and that differ: before, after, change. Results as
/// result_json makes them.
std::string comparison(const nlohmann::json& before, const nlohmann::json& after);

}  // namespace fulmar::core
