// SPDX-License-Identifier: BSD-3-Clause
// Names taken from a compiler's signature of a function, at compile time.
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace fulmar::detail {

constexpr bool word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The last identifier in a signature, before the closing characters of the compiler.
constexpr std::string_view last_word(std::string_view s) {
  while (!s.empty() && !word(s.back())) s.remove_suffix(1);
  std::size_t b = s.size();
  while (b > 0 && word(s[b - 1])) --b;
  return s.substr(b);
}

/// Texts taken from a signature, each with a final NUL, in sequence.
template <std::size_t count, std::size_t room>
struct Words {
  std::array<char, room> bytes{};
  std::array<std::size_t, count> begin{};
};
/// Position of each of `count` words in a signature, and the total length with their NULs.
template <std::size_t count>
struct Found {
  std::array<std::string_view, count> words{};
  std::size_t room = 0;
};
template <std::size_t count, std::size_t room>
consteval Words<count, room> cut_out(const Found<count>& found) {
  Words<count, room> out;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    out.begin[i] = at;
    for (const char c : found.words[i]) out.bytes[at++] = c;
    out.bytes[at++] = '\0';
  }
  return out;
}

}  // namespace fulmar::detail
