// SPDX-License-Identifier: BSD-3-Clause
// Altered mission files: each is resolved or rejected with a sentence.
#include <doctest/doctest.h>

#include "core/graph/test/shelf.hpp"
#include "core/test/altered.hpp"
#include "core/test/limits.hpp"

namespace fuzz_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("500 altered missions are resolved or rejected with a sentence") {
  Mission mission;
  Dice dice;
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    mission.text = hourglass;
    for (std::size_t n = 1 + dice.below(4); n > 0; --n) mutate(mission.text, dice);
    const std::string faults = mission.faults();  // any exception but Error ends the test
    refused += faults.empty() ? 0 : 1;
    if (!faults.empty()) CHECK(faults.find(".yaml") != std::string::npos);
  }
  CHECK(refused > 250);
  CHECK(refused < 500);
}

TEST_CASE("200 altered airframe and plan files are accepted or rejected with a sentence") {
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

TEST_CASE("each altered or swollen mission, airframe and plan takes less than a gigabyte and five seconds") {
  Dice dice;
  for (int i = 0; i < costly_mutants(); ++i) {
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
