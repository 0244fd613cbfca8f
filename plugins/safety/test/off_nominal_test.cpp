// SPDX-License-Identifier: BSD-3-Clause
// A second run of each component, and the wind that moves the best glide off its bound.
#include "kit.hpp"
#include "plugins/safety/glide.hpp"
#include "plugins/safety/home.hpp"
#include "plugins/safety/monitor.hpp"

namespace off_nominal_test {

using namespace fulmar;
using namespace fulmar::safety;
using doctest::Approx;

namespace {

/// A monitor in flight; only the position comes and goes.
struct Lost : Bench<Monitor> {
  Lost() {
    kit::give_anaconda(params);
    fly(true, 2);
  }
  std::uint32_t warnings = 0, notices = 0;
  const SafetyState& fly(bool position, double seconds) {
    VehicleState state = kit::level();
    state.position_valid = position;
    VehicleStatus status;
    status.armed = true;
    status.battery_volt = 24;
    for (double t = 0; t < seconds - 0.01; t += 0.02) {
      set(in.state, state, -0.02);
      set(in.status, status, -0.02);
      REQUIRE(step(0.02) == Status::ok);
      notices += out.notices.count;
      for (std::uint32_t i = 0; i < out.notices.count; ++i)
        warnings += out.notices.items[i].severity == Severity::info ? 0 : 1;
    }
    return out.safety;
  }
};

/// A square of 1200 m around the origin, from 20 to 120 m.
void fence(Bench<Monitor>& w) {
  kit::give_anaconda(w.params);
  Fence& f = w.params.fence.value;
  for (const auto& [n, e] : {std::pair{600.0, -600.0}, {600.0, 600.0}, {-600.0, 600.0}, {-600.0, -600.0}}) {
    FencePoint corner;
    corner.north_m = n;
    corner.east_m = e;
    f.corners.push_back(corner);
  }
  f.floor_m = 20;
  f.ceiling_m = 120;
  w.params.fence.is_given = true;
}

/// Of all airspeeds from the least to the most, the one that goes farthest over the ground, and how far.
std::pair<double, double> farthest(double height_m, double head_wind_mps) {
  const Airframe a = test::anaconda();
  const double rho = standard_air(test::FlightModel::field_m + height_m).density_kgm3;
  std::pair<double, double> best{0, 0};
  for (double Va = 1.2 * a.limits.airspeed_min_mps; Va <= a.limits.airspeed_max_mps; Va += 0.01)
    best = std::max(best, {height_m * (Va - head_wind_mps) / sink_rate(a, Va, 0, rho), Va});
  return best;
}

}  // namespace

TEST_CASE("a position that is lost a second time is waited for as long as the first time") {
  Lost w;
  const double wait_s = w.params.gnss.wait_time;
  CHECK(w.fly(false, wait_s - 1).answer == SafetyAnswer::wait);
  CHECK(w.fly(true, 30).answer == SafetyAnswer::none);
  CHECK(w.fly(false, wait_s - 1).answer == SafetyAnswer::wait);
  CHECK(w.fly(false, 10).answer == SafetyAnswer::descend);
}

TEST_CASE("the reach in strong wind is that of the airspeed that goes farthest, from any side") {
  for (const double bearing : {0.0, 0.8, -2.4})
    for (const double head : {14.0, 11.0, -11.0}) {
      CAPTURE(bearing);
      CAPTURE(head);
      Bench<Home> home;
      kit::give_anaconda(home.params);
      home.params.mode.value = HomeMode::glide;
      REQUIRE(home.retune() == Status::ok);
      VehicleState s = kit::level(-300 * std::cos(bearing), -300 * std::sin(bearing), bearing);
      s.wind_mps = {-head * std::cos(bearing), -head * std::sin(bearing), 0};
      home.set(home.in.state, s);
      REQUIRE(home.activate() == Status::ok);
      home.step(0.02);
      CHECK(home.out.progress.reach_m / farthest(70, head).first == Approx(1).epsilon(0.02));
    }
}

TEST_CASE("on the glide the airspeed is the one that goes farthest on the course that is asked for") {
  for (const double head : {14.0, 10.0, -11.0}) {
    CAPTURE(head);
    Bench<Home> home;
    kit::give_anaconda(home.params);
    home.params.mode.value = HomeMode::glide;
    REQUIRE(home.retune() == Status::ok);
    VehicleState s = kit::level(-3000, 0, 0);
    s.position_m.down = -400;
    s.height_m = 400;
    s.wind_mps = {-head, 0, 0};
    home.set(home.in.state, s);
    REQUIRE(home.activate() == Status::ok);
    home.step(0.02);
    REQUIRE_FALSE(home.out.progress.final);
    const double along = std::cos(home.out.command.course_rad);
    CHECK(std::abs(home.out.command.airspeed_mps - farthest(400, head * along).second) < 0.3);
  }
}

TEST_CASE("a change is told once, and once when it is over, each time") {
  Lost w;
  for (std::uint32_t i = 1; i <= 2; ++i) {
    w.fly(false, 20);
    CHECK(w.warnings == i);
    CHECK(w.notices == 2 * i - 1);
    w.fly(true, 20);
    CHECK(w.warnings == i);
    CHECK(w.notices == 2 * i);
  }
}

TEST_CASE("home outside of the fence, to the north or to the east, is named by its own place") {
  for (const auto& [north, east, words] : {std::tuple{700.0, -40.0, "safety.home_outside_fence(700, -40)"},
                                           {20.0, 800.0, "safety.home_outside_fence(20, 800)"}}) {
    Bench<Monitor> w;
    fence(w);
    for (const auto& [n, e] : {std::pair{north, east}, {10.0, 20.0}}) {
      Place place;
      place.north_m = n;
      place.east_m = e;
      w.params.places.value.places.push_back(place);
    }
    w.params.places.is_given = true;
    CHECK(w.configure() == Status::failed);
    CHECK(w.error().find(words) != std::string::npos);
  }
}

TEST_CASE(
    "the fence is near on each of its sides, and only there; without one there is no floor and no ceiling") {
  const auto flown = [](double north, double east, double course, bool fenced) {
    Bench<Monitor> w;
    kit::give_anaconda(w.params);
    if (fenced) fence(w);
    REQUIRE(w.configure() == Status::ok);
    VehicleStatus status;
    status.armed = true;
    status.battery_volt = 24;
    for (int i = 0; i < 150; ++i) {
      const bool there = i >= 100;
      w.set(w.in.state, kit::level(there ? north : 0, there ? east : 0, there ? course : 0), -0.02);
      w.set(w.in.status, status, -0.02);
      REQUIRE(w.step(0.02) == Status::ok);
    }
    return w.out.safety;
  };
  constexpr double pi = std::numbers::pi;
  for (const auto& [n, e, course] :
       {std::tuple{560.0, 50.0, 0.0}, {-60.0, 560.0, pi / 2}, {-560.0, 20.0, pi}, {70.0, -560.0, -pi / 2}}) {
    CHECK(flown(n, e, course, true).fence);
    CHECK_FALSE(flown(0.2 * n, 0.2 * e, course, true).fence);
    CHECK_FALSE(flown(n, e, course, false).fence);
  }
  const SafetyState free = flown(0, 0, 0, false), held = flown(0, 0, 0, true);
  CHECK(free.floor_m < -1e6);
  CHECK(free.ceiling_m > 1e6);
  CHECK(held.floor_m == 20);
  CHECK(held.ceiling_m == 120);
}

TEST_CASE("a fence that is taken away is gone: configured a second time without one") {
  Bench<Monitor> w;
  fence(w);
  REQUIRE(w.configure() == Status::ok);
  w.params.fence.is_given = false;
  REQUIRE(w.configure() == Status::ok);
  VehicleStatus status;
  status.armed = true;
  status.battery_volt = 24;
  for (int i = 0; i < 150; ++i) {
    w.set(w.in.state, kit::level(i < 100 ? 0 : 590, 0, 0), -0.02);
    w.set(w.in.status, status, -0.02);
    REQUIRE(w.step(0.02) == Status::ok);
  }
  CHECK_FALSE(w.out.safety.fence);
}

TEST_CASE("a second glide does not begin in the flare of the first") {
  Bench<Glide> law;
  kit::give_anaconda(law.params.common);
  GuidanceCommand command;
  command.course_rad = 0.5;
  command.airspeed_mps = 14;
  const auto fly = [&](double height_m, double climb_mps) {
    VehicleState s = kit::level(0, 0, 0.5, 14);
    s.height_m = height_m;
    s.position_m.down = -height_m;
    s.climb_rate_mps = climb_mps;
    for (int i = 0; i < 20; ++i) {
      law.set(law.in.state, s, -0.01);
      law.set(law.in.command, command, -0.01);
      REQUIRE(law.step(0.01) != Status::failed);
    }
    return law.out.flare_ratio.value;
  };
  CHECK(fly(5, -5) == 1);
  CHECK(fly(12, -1) == 1);  // a bump is no end of the flare
  REQUIRE(law.activate() == Status::ok);
  CHECK(fly(12, -1) == 0);
  CHECK(fly(5, -5) == 1);
}

TEST_CASE(
    "at the ground the flare's pitch is that of level flight, and not below the stalling speed, less the "
    "sink") {
  const double stall_mps = 12 / 1.2;
  for (const double Va : {7.0, 9.0, 11.0, 13.0}) {
    CAPTURE(Va);
    Bench<Glide> law;
    kit::give_anaconda(law.params.common);
    law.params.airspeed_ki.value = law.params.airspeed_kd.value = law.params.flare_kd.value = 0;
    VehicleState s = kit::level(0, 0, 0.5, Va);
    GuidanceCommand command;
    command.course_rad = 0.5;
    command.airspeed_mps = 14;
    const auto fly = [&](double height_m, double climb_mps, double seconds) {
      s.height_m = height_m;
      s.position_m.down = -height_m;
      s.climb_rate_mps = climb_mps;
      for (double t = 0; t < seconds; t += 0.01) {
        law.set(law.in.state, s, -0.01);
        law.set(law.in.command, command, -0.01);
        REQUIRE(law.step(0.01) != Status::failed);
      }
    };
    fly(5, -10, 1);
    REQUIRE(law.out.flare_ratio.value == 1);
    fly(0, -0.5, 4);
    const double rho = standard_air(test::FlightModel::field_m).density_kgm3;
    const double alpha = turn_trim(test::anaconda(), 0, std::max(Va, stall_mps), rho).alpha_rad;
    const double limit = test::anaconda().limits.pitch_max_rad;
    const double wanted = std::min(alpha - law.params.touch_sink / Va, limit);
    CHECK(std::abs(law.out.attitude.pitch_rad - wanted) < 0.004);
  }
}

}  // namespace off_nominal_test
