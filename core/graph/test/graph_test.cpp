// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <iostream>

#include "core/graph/test/shelf.hpp"

using namespace fulmar::core;
using namespace fulmar::core::test;

TEST_CASE("the hourglass mission resolves") {
  Mission mission;
  CHECK(mission.faults() == "");
  std::cout << print_graph(mission.load(), "text");
}
