// SPDX-License-Identifier: BSD-3-Clause
// Limits of a landing: wind, length of the flare, bounce, length of the roll.
#include <limits>

#include "landing_kit.hpp"

namespace landing_limits_test {

using namespace fulmar;
using namespace landing_kit;

TEST_CASE(
    "a tail wind that the runway is too short for keeps it on the circle, with the figure, or is flown with "
    "a "
    "warning") {
  for (const bool warn : {false, true}) {
    CAPTURE(warn);
    Strip strip(260);
    strip.bench.params.wind.wind.value = warn ? path::WindAnswer::warn : path::WindAnswer::refuse;
    REQUIRE(strip.bench.configure() == Status::ok);
    strip.bench.activate();
    strip.s.wind_valid = true;
    strip.s.wind_mps.east = 2;  // from behind, to the east
    // V = 12, 14 m/s over ground: 50 + (3.5 / tan 0.07 / 12 + 2) 14 + 14^2 / 1.6 = 258.7
    CHECK(strip.at(450, 0, strip.slope(450)).needed_m == doctest::Approx(258.7).epsilon(0.002));
    CHECK(strip.bench.out.progress.stage == LandingStage::approach);
    CHECK(strip.bench.out.progress.reason == LandingReason::none);
    strip.bench.activate();
    strip.s.wind_mps.east = 4;
    strip.at(450, 0, strip.slope(450));
    CHECK(strip.bench.out.progress.stage == (warn ? LandingStage::approach : LandingStage::join));
    CHECK(strip.bench.out.progress.reason == LandingReason::runway_short);
    CHECK(strip.bench.out.progress.head_wind_mps == doctest::Approx(-4));
    CHECK(strip.bench.out.notices.count == 1);
    CHECK(strip.bench.out.notices.items[0].severity == Severity::warning);
    if (warn) continue;
    strip.at(450, 0, strip.slope(450), 20);
    CHECK(strip.bench.out.notices.count == 0);  // repeated after half a minute
    strip.s.wind_mps.east = 2;                  // the wind drops, for longer than a lull
    strip.at(600, 0, strip.slope(450), 1);
    CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::join);
    strip.at(600, 0, strip.slope(450), 30);
    CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::approach);
    CHECK(strip.bench.out.progress.reason == LandingReason::none);
  }
}

TEST_CASE("an approach that the wind refuses is flown after wind_wait, or at once with little charge") {
  for (const double wait_s : {60.0, 180.0}) {
    Strip strip;
    strip.bench.params.wind.wind_wait.value = wait_s;
    REQUIRE(strip.bench.configure() == Status::ok);
    strip.bench.activate();
    strip.s.wind_valid = true;
    strip.s.wind_mps.north = 9;
    const double away = strip.slope(450);
    CHECK(strip.at(450, 0, away).stage == LandingStage::join);
    strip.at(900, 0, away, wait_s - 2);
    CHECK(strip.at(450, 0, away).stage == LandingStage::join);
    CHECK(strip.bench.out.progress.reason == LandingReason::crosswind);
    strip.at(900, 0, away, 3);
    CHECK(strip.at(450, 0, away).stage == LandingStage::approach);
    CHECK(strip.bench.out.progress.reason == LandingReason::crosswind);
    REQUIRE(strip.bench.out.notices.count == 1);
    CHECK(strip.bench.out.notices.items[0].severity == Severity::warning);
    // The next flight of the same object waits again.
    strip.bench.activate();
    CHECK(strip.at(450, 0, away).stage == LandingStage::join);
    VehicleStatus status;
    status.battery_frac = std::numeric_limits<double>::quiet_NaN();  // not measured
    strip.bench.set(strip.bench.in.status, status);
    CHECK(strip.at(450, 0, away).stage == LandingStage::join);
    status.battery_frac = 0.19;
    strip.bench.set(strip.bench.in.status, status);
    CHECK(strip.at(450, 0, away).stage == LandingStage::approach);
  }
}

TEST_CASE("a crosswind beyond the limit is refused from either side") {
  for (const double from : {1.0, -1.0}) {
    Strip strip;
    strip.bench.activate();
    strip.s.wind_valid = true;
    strip.s.wind_mps.north = -from * 7.2;  // 0.55 of 1.1 12 m/s is 7.26
    CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::approach);
    CHECK(strip.bench.out.progress.cross_wind_mps == doctest::Approx(from * 7.2));  // from the left, north
    strip.bench.activate();
    strip.s.wind_mps.north = -from * 7.3;
    CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::join);
    CHECK(strip.bench.out.progress.reason == LandingReason::crosswind);
  }
}

TEST_CASE("a flare that lasts too long sinks faster, goes around once, and the next one begins lower") {
  Strip strip;
  GroundState aloft;
  aloft.contact = Contact::air;
  strip.bench.set(strip.bench.in.ground, aloft);
  strip.approach();
  strip.at(45, 0, 3.4);
  // dh/dt = -(0.4 + (0.98 - 0.4) h / 3.5) lasts 3.5 ln(2.45) / 0.58 = 5.4 s; 1.3 times that are 7.0 s.
  strip.at(0, 0, -1, 6.5);
  CHECK(strip.bench.out.command.climb_rate_mps == doctest::Approx(-0.4));
  strip.at(0, 0, -2, 2.5);
  CHECK(strip.bench.out.command.climb_rate_mps == doctest::Approx(-0.4 - 0.15 * 2).epsilon(0.05));
  strip.at(0, 0, -3, 4);
  CHECK(strip.bench.out.command.climb_rate_mps == doctest::Approx(-0.7).epsilon(0.03));
  REQUIRE(strip.bench.out.progress.stage == LandingStage::flare);
  // 350 m of runway behind the aim, 14^2 / 1.6 = 122.5 m to stop
  CHECK(strip.at(-227, 0, -4).stage == LandingStage::flare);
  CHECK(strip.at(-229, 0, -4).stage == LandingStage::go_around);
  CHECK(strip.bench.out.progress.reason == LandingReason::flare_long);
  CHECK(strip.at(-300, 0, strip.slope(450)).stage == LandingStage::join);
  CHECK(strip.at(450, 0, strip.slope(450) - 4).stage == LandingStage::approach);
  CHECK(strip.at(300, 0, strip.slope(300) - 4).height_m == doctest::Approx(strip.slope(300)));
  strip.at(45, 0, 3.4 - 4);
  CHECK(strip.at(-229, 0, -6, 6).stage == LandingStage::flare);  // no second time
}

TEST_CASE("a bounce within four seconds is a flare again; a later lift-off is not") {
  for (const double after_s : {1.0, 5.0}) {
    Strip strip;
    strip.approach();
    strip.at(40, 0, 3);
    GroundState ground;
    ground.contact = Contact::ground;
    strip.bench.set(strip.bench.in.ground, ground);
    REQUIRE(strip.at(20, 0, 0, after_s).stage == LandingStage::roll_out);
    ground.contact = Contact::air;
    strip.bench.set(strip.bench.in.ground, ground);
    CHECK(strip.at(10, 0, 1).stage == (after_s < 4 ? LandingStage::flare : LandingStage::roll_out));
  }
}

TEST_CASE("a roll that does not end is reported after its time") {
  Strip strip;
  strip.approach();
  strip.at(40, 0, 3);
  GroundState ground;
  ground.contact = Contact::ground;
  strip.bench.set(strip.bench.in.ground, ground);
  CHECK(strip.at(-100, 0, 0, 59.9).stage == LandingStage::roll_out);
  CHECK(strip.at(-100, 0, 0, 0.2).stage == LandingStage::stopped);
}

}  // namespace landing_limits_test
