// SPDX-License-Identifier: BSD-3-Clause
// Makes foreign text safe for a terminal.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace fulmar::core {

/// Whether a control character begins there: one of ASCII, or an 8-bit one in UTF-8. A line break and a tab
/// do not count.
constexpr bool is_control(std::string_view text, std::size_t at) {
  const auto c = static_cast<unsigned char>(text[at]);
  if (c == 0xc2 && at + 1 < text.size()) return static_cast<unsigned char>(text[at + 1]) < 0xa0;
  return (c < ' ' && c != '\n' && c != '\t') || c == 0x7f;
}

/// Foreign text without control characters.
inline std::string for_terminal(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_control(text, i)) continue;
    if (static_cast<unsigned char>(text[i]) == 0xc2) text.erase(i, 1);
    text[i] = '?';
  }
  return text;
}

}  // namespace fulmar::core
