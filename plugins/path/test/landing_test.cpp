// SPDX-License-Identifier: BSD-3-Clause
// The stages of a landing: turn onto the final approach, slope, sink in the flare, go-around, and conditions
// of a touch-down. In flight: core/app/test/landing_test.cpp.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/testing.hpp>
#include <numbers>
#include <vector>

#include "landing_kit.hpp"

namespace landing_test {

using namespace fulmar;
using namespace landing_kit;
using path::Landing;

namespace {

/// In the flare with the nose off: the wings stay level and no slip is asked for.
void check_no_slip(Strip& strip) {
  strip.bench.configure();
  strip.s.yaw_rad = 98 * deg;
  strip.approach();
  strip.at(45, 0, 3.4, 1);
  CHECK(strip.bench.out.sideslip.sideslip_rad == 0);
  CHECK(std::abs(strip.bench.out.command.roll_feedforward_rad) < 1e-12);
}

}  // namespace

TEST_CASE("the circle touches the centre line where the final approach begins; onto it at its height alone") {
  Strip strip;
  strip.bench.activate();
  CHECK(strip.at(450, 0, strip.slope(450) + 20).stage == LandingStage::join);
  CHECK(strip.bench.out.command.height_m == doctest::Approx(20 + strip.slope(450)));
  CHECK(strip.bench.out.command.course_rad == doctest::Approx(90 * deg));  // on the circle, at the tangent
  CHECK(strip.bench.out.command.roll_feedforward_rad < -0.2);              // flown to the left
  strip.s.course_rad = -90 * deg;
  CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::join);
  strip.s.course_rad = 90 * deg;
  CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::approach);
}

TEST_CASE(
    "on the approach height and sink are those of the slope, and both sides lead back to the centre line") {
  Strip strip;
  strip.approach();
  for (const double along : {400.0, 200.0}) {
    strip.at(along, 0, strip.slope(along));
    CHECK(strip.bench.out.command.height_m == doctest::Approx(20 + strip.slope(along)));
    CHECK(strip.bench.out.command.climb_rate_mps == doctest::Approx(-14 * std::tan(0.07)));
    CHECK(strip.bench.out.command.airspeed_mps == doctest::Approx(1.1 * 12));
  }
  CHECK(strip.at(300, 5, strip.slope(300)).cross_m == doctest::Approx(5));
  CHECK(strip.bench.out.command.course_rad < 89 * deg);
  strip.at(300, -5, strip.slope(300));
  CHECK(strip.bench.out.command.course_rad > 91 * deg);
}

TEST_CASE("the flare sinks more slowly the lower it is, down to the sink of the touch-down") {
  Strip strip;
  strip.approach();
  strip.s.climb_rate_mps = -0.5;
  CHECK(strip.at(45, 0, 3.4).stage == LandingStage::flare);
  const double first = strip.bench.out.command.climb_rate_mps;
  strip.at(30, 0, 1.75);
  const double middle = strip.bench.out.command.climb_rate_mps;
  strip.at(20, 0, -1);
  CHECK(first == doctest::Approx(-14 * std::tan(0.07)).epsilon(0.05));
  CHECK(middle == doctest::Approx(-0.5 * (14 * std::tan(0.07) + 0.4)).epsilon(0.02));
  CHECK(strip.bench.out.command.climb_rate_mps == doctest::Approx(-0.4));
  // The height goes on down where the aircraft floats: by the sink, no more than 1.5 m below it.
  strip.at(10, 0, 1, 1);
  CHECK(strip.bench.out.command.height_m - strip.s.height_m < -0.4);
  strip.at(10, 0, 1, 20);
  CHECK(strip.bench.out.command.height_m - strip.s.height_m == doctest::Approx(-1.5));
}

TEST_CASE("off the centre line, off the slope or without a position it goes around, and joins again") {
  for (const int what : {0, 1, 2, 3, 4}) {
    CAPTURE(what);
    Strip strip;
    strip.approach();
    if (what == 2) strip.s.position_valid = false;
    if (what == 4) {
      strip.bench.params.go_around.value = true;
      strip.bench.retune();
    }
    const LandingProgress& p = strip.at(230, what == 0 ? 9 : 0, strip.slope(230) + (what == 1 ? 6.5 : 0));
    if (what == 3) {
      CHECK(p.stage == LandingStage::approach);
      continue;
    }
    CHECK(p.stage == LandingStage::go_around);
    CHECK(p.go_arounds == 1);
    CHECK(strip.bench.out.command.height_m == doctest::Approx(20 + strip.slope(450)));
    CHECK(strip.bench.out.command.airspeed_mps == 17);
    strip.bench.params.go_around.value = false;
    strip.bench.retune();
    strip.s.position_valid = true;
    CHECK(strip.at(-300, 0, strip.slope(450)).stage == LandingStage::join);
  }
}

TEST_CASE("far out it may be off, and below the decision height it lands") {
  Strip strip;
  strip.approach();
  CHECK(strip.at(400, 12, strip.slope(400)).stage == LandingStage::approach);
  CHECK(strip.at(150, 12, 11).stage == LandingStage::approach);
}

TEST_CASE("a touch-down is what the vehicle says, or two seconds without sinking when asked to be lower") {
  Strip strip;
  strip.approach();
  strip.at(40, 0, 3);
  strip.s.climb_rate_mps = -0.5;
  CHECK(strip.at(20, 0, 0.5, 6).stage == LandingStage::flare);  // it sinks
  strip.s.climb_rate_mps = 0;
  CHECK(strip.at(20, 0, 0.5, 1.9).stage == LandingStage::flare);
  CHECK(strip.at(20, 0, 0.5, 0.2).stage == LandingStage::roll_out);
  CHECK(strip.at(0, 0, 0, 2).stage == LandingStage::roll_out);
  strip.s.ground_speed_mps = 0.3;
  CHECK(strip.at(-60, 0, 0).stage == LandingStage::stopped);

  // A gust that holds it up for three seconds, before the flare has asked to be lower: still in the air.
  Strip held;
  held.approach();
  held.at(40, 0, 3);
  held.s.climb_rate_mps = 0;
  CHECK(held.at(20, 0, 1.5, 3).stage == LandingStage::flare);
  held.s.climb_rate_mps = -0.5;
  CHECK(held.at(20, 0, 1.5, 0.1).stage == LandingStage::flare);
  held.s.climb_rate_mps = 0;
  CHECK(held.at(20, 0, 1.5, 1.5).stage == LandingStage::flare);  // counted again

  Strip reported;
  reported.approach();
  reported.at(40, 0, 3);
  GroundState ground;
  ground.contact = Contact::ground;
  reported.bench.set(reported.bench.in.ground, ground);
  reported.s.climb_rate_mps = -0.5;
  CHECK(reported.at(20, 0, 2.5).stage == LandingStage::roll_out);  // for any height
}

TEST_CASE("the ground above the flare's height is a touch-down, at the circle's height it is none") {
  GroundState ground;
  ground.contact = Contact::ground;
  Strip strip;
  strip.approach();
  strip.bench.set(strip.bench.in.ground, ground);
  CHECK(strip.at(400, 0, strip.slope(400)).stage == LandingStage::approach);  // 28 m: a contact that is stuck
  CHECK(strip.at(60, 0, 4.2).stage == LandingStage::roll_out);
}

TEST_CASE("what is rolled back by the wind has stopped") {
  Strip strip;
  strip.approach();
  GroundState ground;
  ground.contact = Contact::ground;
  strip.at(40, 0, 3);
  strip.bench.set(strip.bench.in.ground, ground);
  strip.s.ground_speed_mps = 3;
  CHECK(strip.at(0, 0, 0, 2).stage == LandingStage::roll_out);
  strip.s.course_rad = -90 * deg;
  CHECK(strip.at(0, 0, 0).stage == LandingStage::stopped);
}

TEST_CASE(
    "approach and flare are faster by half of a head wind, up to cruise, and not slower by a tail wind") {
  const struct {
    double from_east_mps;
    bool known;
    double approach, flare;
  } winds[] = {{4, true, 13.2 + 2, 12 + 2}, {20, true, 17, 17}, {-6, true, 13.2, 12}, {4, false, 13.2, 12}};
  for (const auto& w : winds) {
    CAPTURE(w.from_east_mps);
    Strip strip;  // to the east
    strip.s.wind_mps.east = -w.from_east_mps;
    strip.s.wind_mps.north = 5;
    strip.s.wind_valid = w.known;
    strip.approach();
    strip.at(300, 0, strip.slope(300));
    CHECK(strip.bench.out.command.airspeed_mps == doctest::Approx(w.approach));
    strip.at(40, 0, 3);
    CHECK(strip.bench.out.command.airspeed_mps == doctest::Approx(w.flare));
  }
}

TEST_CASE("in the flare the nose is turned to the runway, with the bank that the side force takes") {
  for (const double side : {1.0, -1.0}) {
    CAPTURE(side);
    Strip strip;
    strip.bench.params.decrab.value = 0.1;
    Airframe& a = strip.bench.params.airframe.value;
    a.mass_kg = 4.5;
    a.wing.area_m2 = 0.52;
    a.aero.side.beta_ratio = -0.98;
    a.aero.side.rudder_ratio = 0.19;
    a.aero.yaw.beta_ratio = 0.13;
    a.aero.yaw.rudder_ratio = -0.065;
    strip.bench.configure();
    strip.s.yaw_rad = (90 + side * 8) * deg;  // into a wind from that side
    strip.approach();
    CHECK(strip.bench.out.sideslip.sideslip_rad == 0);
    strip.at(45, 0, 3.4, 0.255);
    // 8 deg in a second: a quarter of them after a quarter of it.
    CHECK(strip.bench.out.sideslip.sideslip_rad == doctest::Approx(side * 0.26 * 8 * deg).epsilon(0.03));
    strip.at(40, 0, 3, 2);
    CHECK(strip.bench.out.sideslip.sideslip_rad == doctest::Approx(side * 0.1));
    // 0.5 1.2227 kg/m3 (20 + 3 m) 14^2 0.52 m2 (0.98 - 0.19 * 2) 0.1 / (4.5 kg g) = 0.0847: into the wind
    CHECK(strip.bench.out.command.roll_feedforward_rad == doctest::Approx(side * 0.0848).epsilon(0.01));
    strip.s.climb_rate_mps = -0.5;  // no touch-down
    strip.at(40, -side * 1, 3);     // blown off by 1 m: half of it is left; to windward it stays
    CHECK(strip.bench.out.sideslip.sideslip_rad == doctest::Approx(side * 0.05));
    strip.at(40, side * 1, 3, 2);
    CHECK(strip.bench.out.sideslip.sideslip_rad == doctest::Approx(side * 0.1));
    strip.s.yaw_rad = 90 * deg;  // it is turned: the slip stays
    strip.at(40, 0, 3, 1);
    CHECK(strip.bench.out.sideslip.sideslip_rad == doctest::Approx(side * 0.1));
    strip.s.attitude_valid = false;
    strip.at(40, 0, 3);
    CHECK(strip.bench.out.sideslip.sideslip_rad == 0);
  }
  for (const bool by_power : {false, true}) {  // a rudder without a throw, or without an effect
    Strip none;
    none.bench.params.decrab.value = 0.1;
    Airframe& a = none.bench.params.airframe.value;
    a.aero.yaw.beta_ratio = 0.13;
    a.aero.yaw.rudder_ratio = by_power ? 0 : -0.065;
    if (!by_power) a.rudder.limit_rad = 0;
    check_no_slip(none);
  }
  Strip none;
  none.bench.params.decrab.value = 0;
  check_no_slip(none);
}

TEST_CASE("while it rolls the rudder leads back to the centre line, from either side and with the nose off") {
  for (const double side : {1.0, -1.0}) {
    Strip strip;
    strip.bench.params.decrab.value = 0.15;
    strip.bench.params.airframe.value.aero.yaw.rudder_ratio = -0.065;
    strip.bench.configure();
    strip.approach();
    strip.at(45, 0, 3);
    GroundState ground;
    ground.contact = Contact::ground;
    strip.bench.set(strip.bench.in.ground, ground);
    REQUIRE(strip.at(0, side * 1, 0).stage == LandingStage::roll_out);
    const auto slip = [&](double right_m, double nose_rad) {
      strip.s.yaw_rad = 90 * deg + nose_rad;
      strip.at(-5, right_m, 0);
      return strip.bench.out.sideslip.sideslip_rad;
    };
    // Positive is nose left: from the right, back to it.
    CHECK(slip(side * 1, 0) == doctest::Approx(side * 4 / 15));
    CHECK(std::abs(slip(side * 1, -side * 1.0 / 15)) < 1e-9);  // it points there
    CHECK(slip(0, side * 0.05) == doctest::Approx(side * 4 * 0.05));
    CHECK(slip(side * 20, -side * 0.15) == doctest::Approx(side * 4 * 0.05));  // no more than 0.2 rad across
    CHECK(slip(side * 20, side * 0.3) == doctest::Approx(side * 0.35));
    strip.bench.params.decrab.value = 0;
    strip.bench.retune();  // without connections
    CHECK(slip(side * 20, side * 0.3) == 0);
  }
}

TEST_CASE("a fence that the pattern leaves, or comes too near to, is refused with where and by how much") {
  // Runway to the east from (100, -200), 400 m; approach from (100, -600); circle to the left of 70 m: its
  // centre is (170, -600).
  using Corners = std::vector<safety::FencePoint>;
  const auto box = [](double north, double south, double west, double east) {
    return Corners{{north, west}, {north, east}, {south, east}, {south, west}};
  };
  const auto refused = [](const Corners& corners, double ceiling = 1e9, bool right = false) {
    Strip strip;
    safety::Fence& fence = strip.bench.params.fence.value;
    for (const safety::FencePoint& corner : corners) fence.corners.push_back(corner);
    fence.ceiling_m = ceiling;
    strip.bench.params.fence.is_given = true;
    if (right) strip.bench.params.pattern.circle.value = Turn::right;
    return strip.bench.configure() == Status::failed ? std::string(strip.bench.error()) : std::string();
  };
  const auto begins = [](const std::string& text, const char* with) { return text.find(with) == 0; };
  const auto near = [](const std::string& part) {
    return "fence.corners: path.landing_near_fence(path." + part + ", ";
  };
  const std::string circle = near("landing_circle");
  CHECK(refused(box(256, 84, -686, 216)) == "");
  CHECK(begins(refused(box(254, 84, -686, 216)), (circle + "240, -600, 14, 15)").c_str()));
  CHECK(begins(refused(box(230, 84, -686, 216)),
               "fence.corners: path.landing_outside_fence(path.landing_circle, 240, -600, 10)"));
  CHECK(begins(refused(box(256, 84, -684, 216)), circle.c_str()));
  CHECK(begins(refused(box(256, 86, -686, 216)), circle.c_str()));
  CHECK(begins(refused(box(256, 84, -686, 216), 1e9, true), circle.c_str()));  // to the other side
  CHECK(begins(refused(box(256, 84, -686, 214)), (near("runway") + "100, 200, ").c_str()));
  CHECK(begins(refused({{256, -686}, {256, 216}, {84, 216}, {84, -350}, {95, -360}, {84, -370}, {84, -686}}),
               (near("final_approach") + "100, -3").c_str()));
  // tan(0.07) (400 + 50) m + 20 m = 51.6 m
  CHECK(refused(box(256, 84, -686, 216), 67) == "");
  CHECK(refused(box(256, 84, -686, 216), 66) == "fence.ceiling_m: path.landing_above_ceiling(52, 66, 15)");
}

TEST_CASE("a runway that is too short is refused with what it takes") {
  Strip strip(200);
  CHECK(strip.bench.configure() == Status::failed);
  CHECK(std::string(strip.bench.error()) == "runway.length: path.runway_too_short(200, 214)");
  CHECK(Strip(215).bench.configure() == Status::ok);
}

TEST_CASE("a glide slope that sinks more than the aircraft may is refused with what it takes") {
  Strip strip;
  FlightLimits& limits = strip.bench.params.airframe.value.limits;
  limits.airspeed_min_mps = 12.9;
  limits.airspeed_cruise_mps = 16.75;
  limits.sink_rate_max_mps = 0.67;
  CHECK(strip.bench.configure() == Status::failed);
  // 1.1 12.9 sin 0.07 = 0.9925; asin(0.67 / 14.19) = 0.04723
  CHECK(std::string(strip.bench.error()) ==
        "glide_slope: path.glide_slope_steep(0.070, 14.19, 0.992, 0.670, 0.047)");
  strip.bench.params.pattern.glide_slope.value = 0.047;
  CHECK(strip.bench.configure() == Status::ok);
  strip.bench.params.pattern.glide_slope.value = 0.07;
  limits.sink_rate_max_mps = 0.993;
  CHECK(strip.bench.configure() == Status::ok);
  limits.airspeed_cruise_mps = 13.5;
  limits.sink_rate_max_mps = 0.945;  // no faster than cruise
  CHECK(strip.bench.configure() == Status::ok);
}

TEST_CASE("a geodetic runway is the local one, by the mission's origin or the state's") {
  Strip local;
  local.approach();
  const LandingProgress at = local.at(300, 5, 25);
  for (const bool given : {true, false}) {
    CAPTURE(given);
    Strip strip;
    Runway& r = strip.bench.params.runway.value;
    // 100 m north, 200 m west, 20 m up of 40 N, 111 W, 1387 m: a degree is 111 034 m and 85 393 m there
    // (Bowring's series of the meridian and the parallel on WGS-84), and (1 + h / a) times that at height h.
    r = {.heading_rad = 90 * deg, .length_m = 400};
    r.lat_deg = 40 + 100 / (111034.6 * (1 + 1407 / 6.36e6));
    r.lon_deg = -111 - 200 / (85393.9 * (1 + 1407 / 6.387e6));
    r.alt_msl_m = 1407;
    if (given) {
      strip.bench.params.origin.value = {40, -111, 1387, true};
      strip.bench.params.origin.is_given = true;
    }
    REQUIRE(strip.bench.configure() == Status::ok);
    if (!given) {
      CHECK(strip.at(450, 0, strip.slope(450)).stage == LandingStage::join);  // unknown position
      CHECK(strip.bench.step(0.01) == Status::degraded);
      CHECK(strip.bench.out.command.course_rad == strip.s.course_rad);
      CHECK(strip.bench.out.command.height_m == strip.s.height_m);
      strip.s.origin_latitude_deg = 40;
      strip.s.origin_longitude_deg = -111;
      strip.s.origin_altitude_m = 1387;
      strip.s.origin_valid = true;
    }
    strip.approach();
    const LandingProgress& p = strip.at(300, 5, 25);
    CHECK(std::abs(p.along_m - at.along_m) < 0.05);
    CHECK(std::abs(p.cross_m - at.cross_m) < 0.05);
    CHECK(std::abs(p.height_m - at.height_m) < 0.05);
  }
}

TEST_CASE(
    "the plan's runway is landed on, unless the landing has one of its own; without one it is refused") {
  Strip strip;
  const Runway own = strip.bench.params.runway.value;
  strip.bench.params.runway = {.doc = ""};
  strip.bench.params.plan.is_given = true;
  strip.bench.params.plan.value.runway = own;
  strip.bench.params.plan.value.runway.up_m = 30;
  REQUIRE(strip.bench.configure() == Status::ok);
  CHECK(strip.at(300, 0, 25).height_m == doctest::Approx(15));
  strip.bench.params.plan.value.runway.length_m = 200;
  CHECK(strip.bench.configure() == Status::failed);
  CHECK(std::string(strip.bench.error()).starts_with("plan.runway.length: path.runway_too_short(200, "));
  strip.bench.params.runway.value = own;
  strip.bench.params.runway.is_given = true;
  REQUIRE(strip.bench.configure() == Status::ok);
  CHECK(strip.at(300, 0, 25).height_m == doctest::Approx(25));

  const char* const words = ": path.runway_missing";
  Strip none;
  none.bench.params.runway = {.doc = ""};
  CHECK(none.bench.configure() == Status::failed);
  CHECK(std::string(none.bench.error()) == std::string("runway") + words);
  none.bench.params.plan.is_given = true;
  CHECK(none.bench.configure() == Status::failed);
  CHECK(std::string(none.bench.error()) == std::string("plan") + words);
}

TEST_CASE("a runway that is half local or half geodetic is refused") {
  for (const int what : {0, 1, 2, 3}) {
    CAPTURE(what);
    Strip strip;
    Runway& r = strip.bench.params.runway.value;
    if (what == 0) r.up_m = unknown_std;
    if (what == 1) r.lat_deg = 40;
    if (what == 2) {
      r.lat_deg = 40;
      r.lon_deg = -111;
      r.alt_msl_m = 1387;
    }
    if (what == 3) {
      r.north_m = r.east_m = r.up_m = unknown_std;
      r.lat_deg = 40;
    }
    CHECK(strip.bench.configure() == Status::failed);
    CHECK(std::string(strip.bench.error()) == "runway: path.runway_place_ambiguous");
  }
}

TEST_CASE("who takes over again begins with the circle") {
  Strip strip;
  strip.approach();
  strip.bench.activate();
  CHECK(strip.at(300, 0, strip.slope(300)).stage == LandingStage::join);
}

}  // namespace landing_test
