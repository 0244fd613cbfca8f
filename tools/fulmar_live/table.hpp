// SPDX-License-Identifier: BSD-3-Clause
// Columns of text.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

/// Rows as lines, columns as wide as their widest text and two blanks apart; `indent` before each line.
std::string table_text(const std::vector<std::vector<std::string>>& rows, const std::string& indent = "");

/// Characters, not bytes, of UTF-8.
std::size_t width_of(const std::string& text);

}  // namespace fulmar::core
