// SPDX-License-Identifier: BSD-3-Clause
// Messages as text and as tables.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

/// A number with six digits, a text unchanged, a list or struct in one line: {north: 1.5, east: 2, down:
/// -70}.
std::string short_text(const nlohmann::ordered_json& value);

/// One field per line: "  roll_deg: 12.5".
std::string message_lines(const nlohmann::ordered_json& message);

/// Columns of a message of this type: every number by its path, a list or struct list as one column of JSON.
/// Names are the displayed ones.
std::vector<std::string> columns(const Type& type, const std::string& prefix);
/// The cells of a message from shown_json, in the order of columns(). Missing numbers are empty.
std::vector<std::string> cells(const Type& type, const nlohmann::ordered_json& message);

/// As a cell of CSV (RFC 4180).
std::string csv_cell(const nlohmann::ordered_json& value);

}  // namespace fulmar::core
