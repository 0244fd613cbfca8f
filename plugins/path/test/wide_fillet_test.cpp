// SPDX-License-Identifier: BSD-3-Clause
// Fillets that the wind makes too tight: their wider radius, its time, and its benefit.
#include "plugins/path/wide_fillet.hpp"

#include <doctest/doctest.h>

#include "flight.hpp"
#include "fulmar/random.hpp"

namespace wide_fillet_test {

using namespace fulmar;
using namespace fulmar::test;
using fulmar::path::radius_in_wind;

namespace {

constexpr double pi = std::numbers::pi, g = 9.80665;

Plan square(double side_m = 500) {
  Plan plan = plan_of({point(side_m, 0), point(side_m, side_m), point(0, side_m), point(0, 0)});
  std::uint32_t id = 0;
  for (std::uint32_t i = 0; i < 4; ++i) plan.waypoints[i].id = ++id;
  return plan;
}

/// Radius with which each corner was entered, by its waypoint, over some circuits.
std::array<double, 4> corners(Flight& flight, std::uint32_t circuits) {
  std::array<double, 4> radius{};
  Progress before = flight.progress();
  double last = 0;
  const std::uint32_t until = before.circuits + circuits;
  flight.fly(1000, [&] {
    if (flight.progress().reached > before.reached && !before.joining) radius[before.item] = last;
    before = flight.progress();
    last = flight.path().kind == PathKind::orbit ? flight.path().radius_m : 0;
    return before.circuits == until;
  });
  return radius;
}

}  // namespace

TEST_CASE("a turn in wind takes the radius of its fastest part") {
  const double bank = 0.7;
  CHECK(radius_in_wind(0.3, 2, 17, {}, bank) == doctest::Approx(17 * 17 / (g * std::tan(bank))));
  // turning onto the wind's direction: fastest at the end, without crab
  for (const double side : {1.0, -1.0})
    CHECK(radius_in_wind(-side * pi / 2, side * pi / 2, 17, {8, 0, 0}, bank) ==
          doctest::Approx(25 * 25 / (g * std::tan(bank))));
  // away from it: at the beginning; up wind altogether: nowhere
  CHECK(radius_in_wind(0, pi / 2, 17, {8, 0, 0}, bank) == doctest::Approx(25 * 25 / (g * std::tan(bank))));
  CHECK(radius_in_wind(pi - 0.1, 0.2, 17, {8, 0, 0}, bank) < 10 * 10 / (g * std::tan(bank)));
}

TEST_CASE("no turn takes more than the bound that is asked first") {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double Va = 10 + 15 * random.uniform(), speed = 0.9 * Va * random.uniform(),
                 from = 2 * pi * random.uniform(), bank = 0.3 + 0.8 * random.uniform();
    const Vec3<Ned> wind{speed * std::cos(from), speed * std::sin(from), 0};
    const double turn = 5 * (random.uniform() - 0.5), course = 2 * pi * random.uniform();
    CHECK(radius_in_wind(course, turn, Va, wind, bank) <=
          path::radius_in_any_wind(Va, wind, bank) * (1 + 1e-9));
  }
  CHECK(path::radius_in_any_wind(17, {}, 0.7) == doctest::Approx(17 * 17 / (g * std::tan(0.7))));
}

TEST_CASE("what a bank turns over the ground is what the radius says, by a flown circle in wind") {
  // chi_dot = g tan(phi) cos(chi - psi) / Vg: the ground track's radius at each place is Vg / chi_dot
  const double Va = 20, bank = 0.6, dt = 1e-4;
  const Vec3<Ned> wind{6, -3, 0};
  double widest = 0;
  for (double psi = 0; psi < 2 * pi; psi += 0.01) {
    const auto course = [&](double heading) {
      return std::atan2(Va * std::sin(heading) + wind.east, Va * std::cos(heading) + wind.north);
    };
    const double chi_dot = wrap_pi(course(psi + g / Va * std::tan(bank) * dt) - course(psi)) / dt;
    const double Vg = std::hypot(Va * std::cos(psi) + wind.north, Va * std::sin(psi) + wind.east);
    widest = std::max(widest, Vg / chi_dot);
  }
  CHECK(radius_in_wind(std::atan2(wind.east, wind.north) - 0.4, 0.8, Va, wind, bank) ==
        doctest::Approx(widest).epsilon(0.001));
}

TEST_CASE("a wide corner is tangent to the same legs, and the widest is what fits beside its neighbours") {
  const Plan plan = square();
  const WideCorner wide[] = {{2, 80}};
  const Route route(plan, wide), planned(plan);
  CHECK(route.passage(1).entry.north_m == doctest::Approx(500));
  CHECK(route.passage(1).entry.east_m == doctest::Approx(500 - 80));
  CHECK(route.passage(1).exit.north_m == doctest::Approx(500 - 80));
  CHECK(route.passage(1).exit.east_m == doctest::Approx(500));
  const double cut = 80 * (std::sqrt(2.0) - 1);  // off the waypoint
  CHECK(route.passage(1).middle.north_m == doctest::Approx(500 - cut / std::sqrt(2.0)));
  CHECK(route.passage(0).entry.north_m == planned.passage(0).entry.north_m);
  CHECK(planned.widest_fillet_m(1) == doctest::Approx(450));
  CHECK(route.widest_fillet_m(2) == doctest::Approx(420));
  CHECK(planned.widest_fillet_m(0) == planned.widest_fillet_m(2));
  // both legs are one line: each ends where the next begins, with the same course
  for (std::uint32_t i = 0; i < 4; ++i) {
    const RouteLeg leg = route.leg(i), next = route.leg((i + 1) % 4);
    CHECK(leg.end.north_m == doctest::Approx(next[0].pose_at(0).north_m));
    CHECK(leg.end.east_m == doctest::Approx(next[0].pose_at(0).east_m));
    CHECK(std::abs(wrap_pi(leg.end.course_rad - next[0].pose_at(0).course_rad)) < 1e-9);
  }
  Plan pointed = plan;
  pointed.waypoints[1].has_course = true;
  CHECK(Route(pointed).widest_fillet_m(1) == 0);
}

TEST_CASE("corners down wind are flown wider by a third of what they lack, the others as planned") {
  for (const double side : {1.0, -1.0}) {
    Plan plan = square();
    for (std::uint32_t i = 0; i < 4; ++i) plan.waypoints[i].position_m.east *= side;
    Flight flight(plan);
    flight.aircraft.north = 100;
    flight.aircraft.wind_north = 8;
    const double bank = flight.manager.params.fillet_bank;
    corners(flight, 1);
    const std::array<double, 4> radius = corners(flight, 1);
    const double needed = 25 * 25 / (g * std::tan(bank));
    CAPTURE(side);
    CHECK(radius[0] == doctest::Approx(50 + (needed - 50) / 3).epsilon(0.01));  // north, then aside
    CHECK(radius[3] == doctest::Approx(50 + (needed - 50) / 3).epsilon(0.01));  // aside, then north
    CHECK(radius[1] == 50);
    CHECK(radius[2] == 50);
    CHECK(flight.finite);
    flight.aircraft.wind_north = 0;  // the next lap is flown as planned
    corners(flight, 1);
    for (const double r : corners(flight, 1)) CHECK(r == 50);
  }
}

TEST_CASE("no corner is widened in calm air, without a known wind, or by who does not want it") {
  for (const int why : {0, 1, 2}) {
    Flight flight(square());
    flight.aircraft.wind_north = why == 0 ? 0 : 12;
    if (why == 1) flight.manager.params.fillet_bank.value = 0;
    if (why == 2) flight.aircraft.knows_wind = false;
    CAPTURE(why);
    for (const double r : corners(flight, 2)) CHECK(r == 50);
  }
}

TEST_CASE("a corner becomes no wider than there is room for, and the legs are all flown") {
  Flight flight(square(105));
  flight.aircraft.wind_north = 14;
  flight.aircraft.wind_east = 3;
  const std::array<double, 4> radius = corners(flight, 3);
  for (const double r : radius) CHECK(r <= 55 + 1e-9);
  CHECK(*std::max_element(radius.begin(), radius.end()) == doctest::Approx(55));
  for (std::size_t i = 1; i < flight.passed.size(); ++i)
    CHECK(flight.passed[i] == (flight.passed[i - 1] + 1) % 4);
}

TEST_CASE(
    "a change of the plan elsewhere leaves a wide corner as it is, one that takes its room narrows it") {
  for (const bool elsewhere : {true, false}) {
    Flight flight(square());
    flight.aircraft.wind_north = 12;
    const auto in_corner = [&] {
      return flight.aircraft.north > 400 && flight.progress().item == 0 && !flight.progress().joining &&
             flight.path().radius_m > 55 && flight.path().kind == PathKind::orbit;
    };
    REQUIRE(flight.fly(300, in_corner));
    const double before = flight.path().radius_m;
    Plan plan = flight.plan();
    plan.revision = 2;
    if (elsewhere)
      plan.waypoints[2].position_m.north = -100;
    else
      plan.waypoints[1].position_m.east = 85;
    flight.change(plan);
    flight.step();
    CAPTURE(elsewhere);
    CHECK(flight.path().radius_m == doctest::Approx(elsewhere ? before : 50));
    CHECK(flight.finite);
  }
}

TEST_CASE(
    "a corner behind a waypoint with a course, and the first one of an open plan, become wider as well") {
  for (const bool open : {true, false}) {
    Plan plan = square();
    if (open)
      plan.end = PlanEnd::orbit;
    else {
      plan.waypoints[0].has_course = true;
      plan.waypoints[0].course_rad = pi / 2;
    }
    Flight flight(plan);
    flight.aircraft.wind_east = 10;  // along the leg to waypoint 1
    double widest = 0;
    CAPTURE(open);
    CHECK(flight.fly(400, [&] {
      const bool leads_there = flight.progress().item == 1 && !flight.progress().joining;
      if (leads_there && flight.path().kind == PathKind::orbit)
        widest = std::max(widest, flight.path().radius_m);
      return flight.progress().item == 2;
    }));
    CHECK(widest > 55);
    CHECK(flight.finite);
    CHECK(flight.passed == std::vector<std::uint32_t>{0, 1});
  }
}

TEST_CASE("in strong wind the route is left by half, and the course follows") {
  double worst[2], rms[2];
  for (const int wide : {0, 1}) {
    Plan plan = hourglass();
    std::uint32_t id = 0;
    for (std::uint32_t i = 0; i < 4; ++i) plan.waypoints[i].id = ++id;
    Flight flight(plan);
    flight.aircraft.wind_north = 7;
    flight.aircraft.wind_east = -7;
    if (wide == 0) flight.manager.params.fillet_bank.value = 0;
    CHECK(flight.fly(600, [&] { return flight.progress().circuits == 3; }));
    worst[wide] = flight.worst_m;
    rms[wide] = std::hypot(flight.rms(flight.rms_north), flight.rms(flight.rms_east));
  }
  MESSAGE("off the route at most " << worst[0] << " and " << worst[1] << " m, rms " << rms[0] << " and "
                                   << rms[1]);
  CHECK(worst[1] < 0.6 * worst[0]);
  CHECK(rms[1] < 0.6 * rms[0]);
}

}  // namespace wide_fillet_test
