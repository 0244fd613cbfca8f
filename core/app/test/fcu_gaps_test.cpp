// SPDX-License-Identifier: BSD-3-Clause
// The shipped autopilot through a flight controller's port whose link falls silent in a turn, in virtual
// time. bench_link_gaps flies the whole of it.
#include <doctest/doctest.h>

#include "core/app/test/virtual_controller.hpp"

using namespace fulmar::core;
using namespace fulmar::core::through_controller;
namespace fs = std::filesystem;

namespace fcu_gaps_test {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-fcu-gaps-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

FlightOptions unlogged() {
  FlightOptions o;
  o.log = false;
  return o;
}

TEST_CASE("a link gap in a turn: no command without a valid attitude, and hardly any height lost") {
  const Folder folder;
  const AfterGap a = fly({1, true, 70, 1}, folder.path, unlogged());
  CHECK_FALSE(a.crashed);
  CHECK(a.blind == 0);
  CHECK(a.sticks < 0.01);
  CHECK(a.lost_m < 15);
  CHECK(a.back_s >= 0);
  CHECK(a.back_s < 1);
  CHECK(a.told_blind);
  CHECK(a.told_known);
}

}  // namespace fcu_gaps_test
