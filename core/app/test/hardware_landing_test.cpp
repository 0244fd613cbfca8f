// SPDX-License-Identifier: BSD-3-Clause
// Shipped missions through the software flight controller, which has no contact switch: landings at wrong
// heights, and what a lost fix does on the ground. bench_hardware flies twenty seeds of each.
#include <doctest/doctest.h>
#include <unistd.h>

#include "bench/hardware/flight.hpp"

namespace hardware_landing_test {

using namespace fulmar::hardware_bench;

namespace {

Landing flown(const Case& c, std::uint64_t seed) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("fulmar-hardware-landing-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const Landing l = fly(c, seed, folder);
  std::filesystem::remove_all(folder);
  CAPTURE(l.phases);
  CAPTURE(l.reason);
  CHECK(l.landed);
  CHECK_FALSE(l.crashed);
  CHECK_FALSE(l.again);
  CHECK(l.throttle_after == 0);
  CHECK(l.recognised_s < 0.6);
  CHECK(l.takeoff_m > 20);
  return l;
}

}  // namespace

TEST_CASE(
    "a runway 4 m lower than given, or 6 m higher: it touches in the approach or late, and is recognised") {
  Case low;
  low.height_off_m = -4;
  flown(low, 14);
  Case high;
  high.height_off_m = 6;
  flown(high, 3);
}

TEST_CASE("after a landing a lost fix does not open the throttle, and nothing takes off") {
  Case shaded;
  shaded.no_fix_landed_s = 5;
  flown(shaded, 4);
}

TEST_CASE("a fix that is lost for 3 s in the take-off run does not end the take-off") {
  Case gap;
  gap.no_fix_ground_s = 6;
  const Landing l = flown(gap, 2);
  CHECK(l.phases.find("takeoff wait") == std::string::npos);
}

}  // namespace hardware_landing_test
