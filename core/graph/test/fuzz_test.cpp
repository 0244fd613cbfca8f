// SPDX-License-Identifier: BSD-3-Clause
// Altered mission files: each is resolved or refused with a sentence, never more.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>

#include "core/graph/test/shelf.hpp"
#include "core/test/limits.hpp"

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

/// A piece of the text a great many times, or an anchor of a long text with a great many aliases.
void swell(std::string& text, Dice& dice) {
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

TEST_CASE("each altered or swollen mission, airframe and plan takes less than a gigabyte and five seconds") {
  Dice dice;
  for (int i = 0; i < mutants(); ++i) {
    std::string texts[] = {hourglass, anaconda, hourglass_plan};
    std::string& altered = texts[i % 3];
    for (std::size_t n = dice.below(3); n > 0; --n) mutate(altered, dice);
    if (i % 2 == 0) swell(altered, dice);
    CAPTURE(i);
    CHECK(within_limits([&] {
      Mission mission;
      mission.text = texts[0];
      mission.folder.write("anaconda.yaml", texts[1]);
      mission.folder.write("plans/hourglass.yaml", texts[2]);
      mission.faults();
    }));
  }
}

}  // namespace fuzz_test
