// SPDX-License-Identifier: BSD-3-Clause
// Randomly altered texts, for tests of input from outside.
#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>

namespace fulmar::core::test {

/// Small random generator, independent of the standard library (Marsaglia's xorshift64).
struct Dice {
  std::uint64_t state = 88172645463325252ull;
  std::size_t below(std::size_t n) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<std::size_t>(state % n);
  }
};

inline void mutate(std::string& text, Dice& dice) {
  static const std::string bits[] = {
      "{",  "}",    "[",         "]",    ":",     ",",   "\n", "\t", " ",       "'",    "\"",
      "#",  "&a",   "*a",        "?",    "-",     "!",   "|",  ">",  "%",       "@",    "\xff",
      "\0", "null", "nav.state", ".nan", "1e999", "any", "0",  "-1", "vehicle", "next", "<<: "};
  const std::size_t at = dice.below(text.size());
  switch (dice.below(5)) {
    case 0: text[at] = static_cast<char>(dice.below(256)); break;
    case 1: text.insert(at, bits[dice.below(std::size(bits))]); break;
    case 2: text.erase(at, 1 + dice.below(8)); break;
    case 3: {  // replace a word by another word of the file
      const std::size_t from = dice.below(text.size()), size = 1 + dice.below(12);
      text.replace(at, size, text.substr(from, size));
      break;
    }
    default: {  // move a line
      const std::size_t begin = text.rfind('\n', at) + 1, end = text.find('\n', at);
      const std::string line = text.substr(begin, end == std::string::npos ? end : end - begin + 1);
      text.erase(begin, line.size());
      text.insert(dice.below(text.size() + 1), line);
    }
  }
}

/// Repeats a piece of the text many times, or adds an anchor of a long text with many aliases.
inline void swell(std::string& text, Dice& dice) {
  const std::size_t at = dice.below(text.size()), size = 1 + dice.below(40);
  std::string many;
  if (dice.below(3) == 0) {
    many = "\nanchored: &x \"" + std::string(1 + dice.below(200'000), 'x') + "\"\naliases: [";
    for (std::size_t i = dice.below(200'000); i > 0; --i) many += "*x, ";
    text += many + "]\n";
    return;
  }
  for (std::size_t i = dice.below(50'000); i > 0; --i) many += text.substr(at, size);
  text.insert(at, many);
}

}  // namespace fulmar::core::test
