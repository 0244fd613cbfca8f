// SPDX-License-Identifier: BSD-3-Clause
// Shipped missions through the software flight controller, which has no contact switch: landings at wrong
// heights, lost fixes, failed sensors, experiments. bench_hardware flies twenty seeds of each.
#include <doctest/doctest.h>
#include <unistd.h>

#include "bench/hardware/flight.hpp"
#include "core/app/test/unlogged.hpp"

namespace hardware_landing_test {

using namespace fulmar::hardware_bench;

namespace {

Landing flown(const std::string& mission, const std::string& name, std::uint64_t seed,
              bool replayed = false) {
  const fulmar::core::test::OwnStore folder;
  const std::vector<Case> all = all_cases();
  const auto c = std::find_if(all.begin(), all.end(),
                              [&](const Case& each) { return each.mission == mission && each.name == name; });
  REQUIRE(c != all.end());
  const Landing l = fly(*c, seed, folder.path, replayed);
  CAPTURE(l.flown());
  CAPTURE(l.reason);
  CHECK(verdict(*c, l) == "");
  return l;
}

}  // namespace

TEST_CASE(
    "a runway 4 m lower than given, or 6 m higher: it touches in the approach or late, and is recognised") {
  flown("return_home", "runway given -4 m off", 14);
  flown("runway_to_runway", "runway given 6 m off", 3);
}

TEST_CASE("after a landing a lost fix does not open the throttle, and nothing takes off") {
  flown("safe", "no fix for 20 s, 5 s after the landing", 4);
}

TEST_CASE("a fix that is lost for 3 s in the take-off run does not end the take-off") {
  const Landing l = flown("return_home", "no fix for 3 s in the take-off run", 2);
  CHECK_FALSE(l.has("wait"));
}

TEST_CASE("a pilot's flight with closed throttle does not make the motor count as dead") {
  flown("safe", "the pilot flies for 5 s with closed throttle", 3);
}

TEST_CASE("an inertial unit that is stuck calls the pilot, and a silent barometer is named") {
  flown("runway_to_runway", "inertial unit stuck for 3 s", 5);
  flown("runway_to_runway", "barometer silent", 6);
}

TEST_CASE("the autotune finishes through a controller, the pilot lands, and the log replays") {
  flown("autotune", "tunes, the pilot lands", 3, true);
}

TEST_CASE("all signals are injected through a controller, and the pilot lands") {
  flown("excitation", "all four signals, the pilot lands", 5);
}

TEST_CASE("each level of the sticks is flown through a controller, and the pilot lands") {
  flown("manual", "each level of the sticks, the pilot lands", 5);
}

TEST_CASE("the verdict of a flight names the first thing that was not as asked") {
  Case c;
  c.never = {"glide"};
  c.phases = {"takeoff", "cruise"};
  c.reported = {"barometer"};
  Landing l;
  l.landed = true;
  l.takeoff_m = 30;
  l.recognised_s = 0.1;
  l.last_event_s = 50;
  l.phases = {"hold", "takeoff", "cruise"};
  l.said = {{40, "barometer silent"}};
  CHECK(verdict(c, l) == "no line with \"barometer\"");
  l.said = {{70, "barometer silent"}};
  CHECK(verdict(c, l) == "no line with \"barometer\"");
  l.said = {{51, "barometer silent"}};
  CHECK(verdict(c, l) == "");
  l.recognised_s = -0.7;
  CHECK(verdict(c, l) == "touch-down recognised late");
  l.replayed_equal = false;
  CHECK(verdict(c, l) == "its log replays otherwise");
  l.phases = {"hold", "cruise", "takeoff"};
  CHECK(verdict(c, l) == "left out a phase");
  l.phases.push_back("glide");
  CHECK(verdict(c, l) == "flew glide");
  l.throttle_after = 0.1;
  CHECK(verdict(c, l) == "motor on after the landing");  // asserts the whole sentence on purpose
  l.again = true;
  CHECK(verdict(c, l) == "took off again by itself");  // asserts the whole sentence on purpose
  l.crashed = true;
  CHECK(verdict(c, l) == "crashed");
}

}  // namespace hardware_landing_test
