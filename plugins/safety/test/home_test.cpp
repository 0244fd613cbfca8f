// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/safety/home.hpp"

#include "kit.hpp"

namespace home_test {

using namespace fulmar;
using namespace fulmar::safety;

namespace {

/// A point that flies the course that is commanded as fast as a bank of 35 deg allows, at the airspeed that
/// is commanded.
struct Way : Bench<Home> {
  VehicleState state = kit::level();
  Vec3<Ned> wind;
  double sink_mps = 0;

  Way() { kit::give_anaconda(params); }
  void place(double north, double east) {
    Place p;
    p.north_m = north;
    p.east_m = east;
    params.places.value.places.push_back(p);
    params.places.is_given = true;
  }
  void begin(HomeMode mode) {
    params.mode.value = mode;
    REQUIRE(retune() == Status::ok);
    set(in.state, state);
    REQUIRE(activate() == Status::ok);
  }
  const GuidanceCommand& look(double dt = 0.02) {
    state.wind_mps = wind;
    set(in.state, state, -dt);
    step(dt);
    REQUIRE(validation_error() == "");
    return out.command;
  }
  void fly(double seconds, double dt = 0.02) {
    for (double t = 0; t < seconds; t += dt) {
      const GuidanceCommand& c = look(dt);
      const double rate = 9.80665 * std::tan(0.61) / std::max(state.ground_speed_mps, 5.0);
      const double to = state.course_rad +
                        std::clamp(angle_difference(c.course_rad, state.course_rad), -rate * dt, rate * dt);
      const WindTriangle way = fly_course(to, c.airspeed_mps, wind);
      state.course_rad = wrap_pi(to);
      state.yaw_rad = way.heading_rad;
      state.ground_speed_mps = way.ground_speed_mps;
      state.position_m.north += way.ground_speed_mps * std::cos(to) * dt;
      state.position_m.east += way.ground_speed_mps * std::sin(to) * dt;
      state.height_m -= sink_mps * dt;
    }
  }
  double distance() const { return std::hypot(state.position_m.north, state.position_m.east); }
};

}  // namespace

TEST_CASE("home: a straight track there in any wind, and a circle of its radius") {
  for (const auto& wind : {Vec3<Ned>{0, 0, 0}, Vec3<Ned>{8, 0, 0}, Vec3<Ned>{0, -10, 0}}) {
    Way w;
    w.wind = wind;
    w.state = kit::level(800, 300, 200 * kit::deg);
    w.begin(HomeMode::home);
    w.fly(12);
    CHECK_FALSE(w.out.progress.there);
    const double bearing = std::atan2(-w.state.position_m.east, -w.state.position_m.north);
    CHECK(std::abs(angle_difference(w.state.course_rad, bearing)) < 8 * kit::deg);
    w.fly(170);
    CHECK(w.out.progress.there);
    const double fastest = 17 + std::hypot(wind.north, wind.east);  // 31.5 deg of bank
    CHECK(w.distance() == doctest::Approx(std::max(70.0, fastest * fastest / 6.006)).epsilon(0.15));
    CHECK(w.out.command.height_m == 70);
  }
}

TEST_CASE("against the wind it flies as fast as it takes, up to the airframe's most") {
  Way w;
  w.state = kit::level(800, 0, std::numbers::pi);
  w.wind = {14, 0, 0};
  w.begin(HomeMode::home);
  CHECK(w.look().airspeed_mps == doctest::Approx(20).epsilon(0.01));  // 6 m/s against 14
  w.wind = {40, 0, 0};
  CHECK(w.look().airspeed_mps == 25);
  w.wind = {-14, 0, 0};
  CHECK(w.look().airspeed_mps == 17);
}

TEST_CASE("the way round that the fence leaves is flown, either side, until home lies ahead") {
  for (const double side : {-1.0, 1.0}) {
    Way w;
    w.state = kit::level(800, 0, -side * 30 * kit::deg);  // the short turn would be the other one
    SafetyState safety;
    safety.turn = side > 0 ? SafetyTurn::right : SafetyTurn::left;
    w.set(w.in.safety, safety);
    w.begin(HomeMode::home);
    CHECK(angle_difference(w.look().course_rad, w.state.course_rad) * side > 1);
    w.fly(25);
    CHECK(w.state.position_m.east * side > 20);
    const double bearing = std::atan2(-w.state.position_m.east, -w.state.position_m.north);
    CHECK(std::abs(angle_difference(w.state.course_rad, bearing)) < 10 * kit::deg);
  }
}

TEST_CASE("the heights of home and of waiting stay within floor and ceiling of the fence") {
  Way w;
  SafetyState safety;
  safety.floor_m = 20;
  safety.ceiling_m = 60;
  w.set(w.in.safety, safety);
  w.begin(HomeMode::home);
  CHECK(w.look().height_m == 50);
  w.begin(HomeMode::wait);
  CHECK(w.look().height_m == 50);
}

TEST_CASE("waiting is a bank through the air at the height that it had, 40 m at least") {
  Way w;
  w.begin(HomeMode::wait);
  w.state.position_valid = w.state.velocity_valid = false;
  CHECK(w.look().lateral == LateralMode::acceleration);
  CHECK(w.out.command.lateral_acceleration_mps2 == doctest::Approx(9.80665 * std::tan(0.26)));
  CHECK(w.out.command.height_m == 70);
  w.state.reset_count = 1;
  w.state.reset_position_m = {0, 0, 5};  // all heights are 5 m lower now
  CHECK(w.look().height_m == 65);
  w.state.height_m = 12;
  w.begin(HomeMode::wait);
  CHECK(w.look().height_m == 40);
  w.begin(HomeMode::descend);
  CHECK(w.look().lateral == LateralMode::acceleration);
  CHECK(w.out.command.airspeed_mps < 17);
}

TEST_CASE("level is straight on") {
  Way w;
  w.state.course_rad = 1;
  w.begin(HomeMode::level);
  CHECK(w.look().course_rad == 1);
  w.state.course_rad = 1.2;
  CHECK(w.look().course_rad == 1.2);
  CHECK(w.out.command.roll_feedforward_rad == 0);
}

TEST_CASE("a glide goes to the nearest place, circles, and comes down onto it into the wind") {
  for (const double from : {0.0, 90 * kit::deg, 200 * kit::deg}) {
    Way w;
    w.place(2000, 0);
    w.place(-60, 80);
    w.place(0, 900);
    w.state.height_m = 200;
    w.wind = {-5 * std::cos(from), -5 * std::sin(from), 0};
    w.begin(HomeMode::glide);
    w.look();
    CHECK(w.out.progress.distance_m == doctest::Approx(100));
    const BestGlide best = best_glide(test::anaconda(), 1.063, 0, 1.2);
    w.sink_mps = best.sink_mps;
    while (w.state.height_m > 0) w.fly(0.1);
    CHECK(w.out.progress.final);
    CHECK(std::abs(angle_difference(w.state.course_rad, from)) < 15 * kit::deg);
    CHECK(w.out.progress.distance_m < 90);
  }
}

TEST_CASE("its reach is the height times the ratio of ground speed and sink, less against the wind") {
  Way w;
  w.place(500, 0);
  w.begin(HomeMode::glide);
  w.look();
  const BestGlide still = best_glide(test::anaconda(), 1.0575, 0, 1.2);
  CHECK(w.out.progress.reach_m == doctest::Approx(70 / still.sink_mps * still.airspeed_mps).epsilon(0.02));
  const double before = w.out.progress.reach_m;
  w.wind = {-5, 0, 0};
  w.look();
  CHECK(w.out.progress.reach_m < 0.8 * before);
  w.wind = {5, 0, 0};
  w.look();
  CHECK(w.out.progress.reach_m > 1.2 * before);
}

TEST_CASE("low down it goes straight on, whatever the wind") {
  Way w;
  w.state.height_m = 10;
  w.state.course_rad = 1;
  w.wind = {5, 0, 0};
  w.begin(HomeMode::glide);
  CHECK(w.look().course_rad == 1);
  CHECK(w.out.progress.final);
}

TEST_CASE("places that are none, or have no position, are refused") {
  Way none;
  none.params.places.is_given = true;
  CHECK(none.configure() == Status::failed);
  CHECK(none.error().find("places.places: safety.places_missing") == 0);
  Way lost;
  lost.params.places.value.places.push_back({});
  lost.params.places.is_given = true;
  CHECK(lost.configure() == Status::failed);
  CHECK(lost.error().find("places.places[0]: flight.place_missing") == 0);
}

TEST_CASE(
    "without satellites it flies home by the reckoned position; beyond its accuracy it circles by bank") {
  for (const HomeMode mode : {HomeMode::wait, HomeMode::descend}) {
    Way w;
    w.wind = {0, 6, 0};
    w.state = kit::level(500, -300, 1);
    w.state.position_valid = false;
    w.state.position_std_m = {20, 20, 2};
    w.begin(mode);
    w.fly(120);
    CHECK(w.out.command.lateral == LateralMode::course);
    CHECK(w.distance() < 190);  // the circle that 23 m/s over the ground need at a bank of 0.35 rad: 142 m
    w.state.position_std_m = {51, 20, 2};
    CHECK(w.look().lateral == LateralMode::acceleration);
    w.state.position_std_m = {49, 20, 2};  // an aircraft on a circle does not continue for a second
    CHECK(w.look().lateral == LateralMode::acceleration);
    w.state.position_valid = true;
    CHECK(w.look().lateral == LateralMode::course);
    w.state.position_valid = w.state.velocity_valid = false;
    CHECK(w.look().lateral == LateralMode::acceleration);
  }
}

TEST_CASE("the descent by reckoning levels its wings near the ground") {
  Way w;
  w.state = kit::level(200, 0, 1);
  w.begin(HomeMode::descend);
  w.state.height_m = 16;
  CHECK(w.look().lateral == LateralMode::course);
  w.state.height_m = 14;
  CHECK(w.look().lateral == LateralMode::acceleration);
  CHECK(w.out.command.lateral_acceleration_mps2 == 0);
}

TEST_CASE("in more wind than its largest airspeed it turns the nose into the wind and holds it there") {
  Way w;
  w.wind = {0, -30, 0};  // from the east
  w.state = kit::level(300, 0, std::numbers::pi);
  w.begin(HomeMode::home);
  w.look();
  CHECK(w.out.command.airspeed_mps == fulmar::test::anaconda().limits.airspeed_max_mps);
  CHECK(w.out.command.lateral == LateralMode::acceleration);
  for (double yaw = -3.1; yaw < 3.1; yaw += 0.1) {  // for any course over the ground
    w.state.yaw_rad = yaw;
    const double a = w.look().lateral_acceleration_mps2, off = angle_difference(0.5 * std::numbers::pi, yaw);
    if (std::abs(off) > 0.05) CHECK(a * off > 0);
    CHECK(std::abs(a) < 9.80665 * std::tan(0.785));
  }
  w.wind = {0, -10, 0};
  CHECK(w.look().lateral == LateralMode::course);
}

}  // namespace home_test
