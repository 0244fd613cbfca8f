// SPDX-License-Identifier: BSD-3-Clause
// Response to a client of a flight: the first request shows the lines that would change, the second one
// writes exactly those.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_save/param_file.hpp"

namespace fulmar::core {

/// The parameters of a view that a file can hold; of one component, unless it is "".
std::vector<SavedParam> saved_params(const nlohmann::json& view, const std::string& component);
std::vector<std::string> flown_plugins(const nlohmann::json& view);

/// {component, mark, set, file, mission, components: as in a view} -> {accepted, reason, lines, mark}, as in
/// links/live/saving.hpp. A fault becomes a reason.
nlohmann::json save_answer(const nlohmann::json& request);

}  // namespace fulmar::core
