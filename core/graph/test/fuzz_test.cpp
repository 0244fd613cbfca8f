// SPDX-License-Identifier: BSD-3-Clause
// Altered mission files: each is resolved or refused with a sentence, never more.
#include <doctest/doctest.h>

#include <cstdint>

#include "core/graph/test/shelf.hpp"

namespace fuzz_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// Small generator of its own, so that the test does not depend on anything else (Marsaglia's xorshift64).
struct Dice {
  std::uint64_t state = 88172645463325252ull;
  std::size_t below(std::size_t n) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return static_cast<std::size_t>(state % n);
  }
};

void mutate(std::string& text, Dice& dice) {
  static const std::string bits[] = {
      "{",  "}",    "[",         "]",    ":",     ",",   "\n", "\t", " ",       "'",    "\"",
      "#",  "&a",   "*a",        "?",    "-",     "!",   "|",  ">",  "%",       "@",    "\xff",
      "\0", "null", "nav.state", ".nan", "1e999", "any", "0",  "-1", "vehicle", "next", "<<: "};
  const std::size_t at = dice.below(text.size());
  switch (dice.below(5)) {
    case 0: text[at] = static_cast<char>(dice.below(256)); break;
    case 1: text.insert(at, bits[dice.below(std::size(bits))]); break;
    case 2: text.erase(at, 1 + dice.below(8)); break;
    case 3: {  // a word is replaced by another word of the file
      const std::size_t from = dice.below(text.size()), size = 1 + dice.below(12);
      text.replace(at, size, text.substr(from, size));
      break;
    }
    default: {  // a line goes somewhere else
      const std::size_t begin = text.rfind('\n', at) + 1, end = text.find('\n', at);
      const std::string line = text.substr(begin, end == std::string::npos ? end : end - begin + 1);
      text.erase(begin, line.size());
      text.insert(dice.below(text.size() + 1), line);
    }
  }
}

}  // namespace

TEST_CASE("500 altered missions are resolved or refused with a sentence") {
  Mission mission;
  Dice dice;
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    mission.text = hourglass;
    for (std::size_t n = 1 + dice.below(4); n > 0; --n) mutate(mission.text, dice);
    const std::string faults = mission.faults();  // anything but Error ends the test
    refused += faults.empty() ? 0 : 1;
    if (!faults.empty()) CHECK(faults.find(".yaml") != std::string::npos);
  }
  CHECK(refused > 250);
  CHECK(refused < 500);
}

TEST_CASE("200 altered airframe and plan files are taken or refused with a sentence") {
  Mission mission;
  Dice dice;
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    std::string airframe = anaconda, plan = hourglass_plan;
    mutate(airframe, dice);
    mutate(plan, dice);
    mission.folder.write("anaconda.yaml", airframe);
    mission.folder.write("plans/hourglass.yaml", plan);
    refused += mission.faults().empty() ? 0 : 1;
  }
  CHECK(refused > 50);
}

}  // namespace fuzz_test
