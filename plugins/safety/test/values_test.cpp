// SPDX-License-Identifier: BSD-3-Clause
// Numbers of this plugin against closed forms and fine searches: the motor's thrust and its smoothing,
// battery and delays at their thresholds, a drift, the circle of a glide; and a second flight that begins as
// the first.
#include "fulmar/flight/earth/wind_triangle.hpp"
#include "kit.hpp"
#include "plugins/safety/battery.hpp"
#include "plugins/safety/home.hpp"
#include "plugins/safety/reckoned.hpp"
#include "watch.hpp"

namespace values_test {

using namespace fulmar;
using namespace fulmar::safety;
using doctest::Approx;

namespace {

constexpr double g = 9.80665, dt = 0.02;

/// Steady flight in which so large a share of the expected thrust is found: by climb or by acceleration.
struct Thrust {
  Airframe a = test::anaconda();
  double Va = 17, throttle = 0.7, height_m = 2000;
  double rho() const { return standard_air(height_m).density_kgm3; }
  double expected() const { return thrust_of(a, throttle, Va, rho()); }
  VehicleState state(double share, bool by_climb, double roll_rad = 0) const {
    VehicleState s = kit::level(0, 0, 0.7, Va);
    s.origin_altitude_m = 0;
    s.height_m = height_m;
    s.roll_rad = roll_rad;
    const double gain = share * expected() - turn_trim(a, roll_rad, Va, rho()).drag_newton;
    if (by_climb)
      s.climb_rate_mps = gain * Va / (a.mass_kg * g);
    else
      s.specific_force_mps2.x = gain / a.mass_kg;
    return s;
  }
};

}  // namespace

TEST_CASE("a motor obeys the share of the throttle whose thrust is found") {
  const Thrust t;
  for (const double share : {0.15, 0.5, 0.92})
    CHECK(effectiveness(t.a, 0.8, thrust_of(t.a, share * 0.8, 15, 1.1), 15, 1.1) ==
          Approx(share).epsilon(0.001));
  CHECK(effectiveness(t.a, 0.8, 1e3, 15, 1.1) == Approx(1).epsilon(0.001));
  CHECK(effectiveness(t.a, 0.8, -1e3, 15, 1.1) == 0);
  CHECK(volt_share(0.8 * t.a.propulsion.battery_volt, t.a) == Approx(0.8));
  CHECK(volt_share(1.2 * t.a.propulsion.battery_volt, t.a) == 1);
  CHECK(volt_share(0.9, t.a) == 1);  // none is measured
  CHECK(volt_share(1.1, t.a) == Approx(1.1 / t.a.propulsion.battery_volt));
}

TEST_CASE("level flight is held by three quarters of the drag at the best speed up to cruise") {
  const Thrust t;
  for (const double rho : {1.2, 0.9}) {
    double least = 2;  // throttle, by a fine search
    for (double Va = 1.1 * t.a.limits.airspeed_min_mps; Va <= t.a.limits.airspeed_cruise_mps; Va += 0.05) {
      double throttle = 0;
      while (thrust_of(t.a, throttle, Va, rho) < 0.75 * turn_trim(t.a, 0, Va, rho).drag_newton)
        throttle += 1e-3;
      least = std::min(least, throttle);
    }
    CHECK_FALSE(holds_level(t.a, 0.98 * least, rho));
    CHECK(holds_level(t.a, 1.02 * least, rho));
  }
}

TEST_CASE("thrust is found from climb, from acceleration and in a turn alike, over that of the model") {
  const Thrust t;
  const EngineLimits e;
  for (const bool by_climb : {true, false})
    for (const double roll : {0.0, 0.6})
      for (const double share : {0.9, 0.4, -0.2}) {
        Motor motor;
        for (int k = 0; k < 500; ++k) motor.step(t.state(share, by_climb, roll), t.a, t.throttle, 1, e, dt);
        CHECK(motor.ratio() == Approx(share).epsilon(0.005));
      }
}

TEST_CASE("the ratio follows by its time constant, and a weak motor is reported after its delay") {
  const Thrust t;
  EngineLimits e;
  e.engine_smoothing.value = 2;
  Motor motor;
  for (int k = 0; k < 1000; ++k) motor.step(t.state(1, true), t.a, t.throttle, 1, e, dt);
  int weak = -1;
  for (int k = 1; k < 1000 && weak < 0; ++k) {
    motor.step(t.state(0.4, true), t.a, t.throttle, 1, e, dt);
    if (k < 200) CHECK(motor.ratio() == Approx(0.4 + 0.6 * std::exp(-k * dt / 2)).epsilon(0.001));
    if (motor.weak()) weak = k;
  }
  // below half after 2 s ln(6), then 8 s
  CHECK(weak * dt == Approx(2 * std::log(6.0) + 8).epsilon(0.005));
  for (const double share : {0.67, 0.73}) {
    for (int k = 0; k < 2000; ++k) motor.step(t.state(share, true), t.a, t.throttle, 1, e, dt);
    CHECK(motor.weak() == (share < 0.7));
  }
  motor.reset();
  CHECK_FALSE(motor.weak());
}

TEST_CASE("a motor that brakes has failed after its delay, the later the less it is below the limit") {
  const Thrust t;
  EngineLimits e;
  e.engine_smoothing.value = 0.05;
  const auto until = [&](Motor& motor, double share, bool failed) {
    for (int k = 1; k < 1000; ++k) {
      motor.step(t.state(share, true), t.a, t.throttle, 1, e, dt);
      if (motor.failed() == failed) return k * dt;
    }
    return -1.0;
  };
  const double stopped = thrust_of(t.a, 0, t.Va, t.rho()) / t.expected();
  // 2 s over the share of 0.5 that it lies below the limit
  for (const auto& [limit, raise_s, clear] : {std::tuple{0.25, 2.0, 0.5}, {stopped + 0.2, 5.0, 0.2}}) {
    e.engine_share.value = limit;
    Motor motor;
    for (int k = 0; k < 100; ++k) motor.step(t.state(1, true), t.a, t.throttle, 1, e, dt);
    CHECK(std::abs(until(motor, stopped, true) - raise_s) < 0.25);
    CHECK_FALSE(motor.weak());
    CHECK(until(motor, clear - 0.03, false) == -1);
    CHECK(std::abs(until(motor, clear + 0.03, false) - 5) < 0.25);
  }
}

TEST_CASE("thrust counts from a twentieth of the weight on, and a tenth of it has to be missing") {
  Thrust t;
  const EngineLimits e;
  const double mg = t.a.mass_kg * g;
  const auto ratio_at = [&](double thrust_share) {  // of the weight
    t.throttle = 0;
    while (t.expected() < thrust_share * mg) t.throttle += 1e-3;
    Motor motor;
    for (int k = 0; k < 1000; ++k) motor.step(t.state(0.4, true), t.a, t.throttle, 1, e, dt);
    return std::pair{motor.ratio(), motor.weak()};
  };
  CHECK(ratio_at(0.045).first == 1);
  CHECK(ratio_at(0.055).first == Approx(0.4).epsilon(0.01));
  CHECK_FALSE(ratio_at(0.15).second);  // 0.6 of it: 0.09
  CHECK(ratio_at(0.18).second);
}

TEST_CASE("without demand, below the stall and without an airspeed the motor is judged as it should be") {
  const Thrust t;
  const EngineLimits e;
  const auto ratio = [&](VehicleState s, double throttle) {
    Motor motor;
    for (int k = 0; k < 500; ++k) motor.step(s, t.a, throttle, 1, e, dt);
    return motor.ratio();
  };
  CHECK(ratio(t.state(0.4, true), 0) == 1);  // no demand
  VehicleState slow = t.state(0.4, true);
  slow.airspeed_mps = 0.69 * t.a.limits.airspeed_min_mps;
  CHECK(ratio(slow, t.throttle) == 1);
  slow.airspeed_mps = 0.71 * t.a.limits.airspeed_min_mps;
  CHECK(ratio(slow, t.throttle) != 1);
  VehicleState blind = t.state(0.4, true);  // without a pitot: the air velocity and its climb are invalid
  blind.airspeed_valid = false;
  blind.velocity_mps = {3, 17, 5};
  blind.wind_mps = {-5, 5, 0};
  blind.airspeed_mps = 0;
  CHECK(ratio(blind, t.throttle) == Approx([&] {
                                      Thrust other = t;
                                      other.Va = std::sqrt(8 * 8 + 12 * 12 + 5 * 5);
                                      const double gain = t.a.mass_kg * g * blind.climb_rate_mps / other.Va;
                                      return (gain + turn_trim(t.a, 0, other.Va, t.rho()).drag_newton) /
                                             other.expected();
                                    }())
                                        .epsilon(0.005));
}

TEST_CASE("a flag rises and falls after its delays, and what is neither bad nor good holds none of them") {
  Alarm a;
  const auto steps = [&](bool bad, bool good) {
    int n = 0;
    const bool before = a.raised();
    while (a.raised() == before && n < 1000) {
      a.step(bad, good, 1.5, 3, 0.1);
      ++n;
    }
    return n;
  };
  for (int again = 0; again < 2; ++again) {
    CHECK(std::abs(steps(true, false) - 15) <= 1);
    for (int k = 0; k < 20; ++k) a.step(false, true, 1.5, 3, 0.1);
    a.step(false, false, 1.5, 3, 0.1);  // the condition must hold for a time
    CHECK(std::abs(steps(false, true) - 30) <= 1);
    for (int k = 0; k < 10; ++k) a.step(true, false, 1.5, 3, 0.1);
    a.step(false, false, 1.5, 3, 0.1);
  }
  Alarm at_once;
  CHECK(at_once.step(true, 0, 0, 0.1));
  at_once.reset();
  CHECK_FALSE(at_once.raised());
}

TEST_CASE("a battery is low and empty by charge or voltage, on both sides of each limit") {
  const BatteryLimits b;
  const auto after = [&](safety::Battery& battery, double volt_share, double frac, double seconds) {
    VehicleStatus s;
    s.battery_volt = 22 * volt_share;
    s.battery_frac = frac;
    for (double t = 0; t < seconds; t += 0.1) battery.step(s, 22, b, 0.1);
  };
  for (const bool by_volt : {true, false}) {
    const double low = by_volt ? b.volt_low : b.battery_low, empty = by_volt ? b.volt_empty : b.battery_empty;
    safety::Battery battery;
    const auto at = [&](double share, double seconds) {
      after(battery, by_volt ? share : 1, by_volt ? 1 : share, seconds);
    };
    at(low + 0.01, 10);
    CHECK_FALSE(battery.low());
    at(low - 0.01, 2.8);
    CHECK_FALSE(battery.low());
    at(low - 0.01, 0.5);
    CHECK(battery.low());
    CHECK_FALSE(battery.empty());
    at(empty - 0.01, 4);
    CHECK(battery.empty());
    at(low + 0.09, 40);
    CHECK(battery.low());
    CHECK_FALSE(battery.empty());
    at(low + 0.11, 29);
    CHECK(battery.low());
    at(low + 0.11, 2);
    CHECK_FALSE(battery.low());
  }
  safety::Battery none;
  after(none, 0, 1, 10);
  CHECK_FALSE(none.low());
}

TEST_CASE("a reckoned position is the state's until it is too unsure, then it drifts with the wind") {
  Reckoned r;
  VehicleState s = kit::level(100, -40);
  s.position_valid = false;
  s.position_std_m = {10, 30, 99};
  r.step(s, {1, 1, 0}, 50, dt);
  CHECK_FALSE(r.known());
  for (int again = 0; again < 2; ++again) {
    s.position_valid = true;
    s.position_std_m = {10, 30, 99};
    r.step(s, {4, -3, 0}, 50, dt);
    CHECK(r.known());
    CHECK_FALSE(r.drifts());
    CHECK(r.std_m() == 30);
    s.position_valid = false;
    s.position_m = {120, -50, -70};
    r.step(s, {4, -3, 0}, 50, dt);
    CHECK(r.north_m() == 120);
    CHECK(r.east_m() == -50);
    s.position_std_m = {51, 20, 0};
    for (int k = 0; k < 500; ++k) r.step(s, {4, -3, 0}, 50, dt);
    CHECK(r.drifts());
    CHECK(r.north_m() == Approx(120 + 4 * 10));
    CHECK(r.east_m() == Approx(-50 - 3 * 10));
    CHECK(r.std_m() == Approx(30 + 10));
    s.position_std_m = {10, 10, 0};  // it does not return without a valid one
    r.step(s, {4, -3, 0}, 50, dt);
    CHECK(r.drifts());
  }
  s.velocity_valid = false;
  s.position_valid = true;
  CHECK_FALSE(located(s, 50));
  s.velocity_valid = true;
  s.attitude_valid = false;
  CHECK_FALSE(located(s, 50));
}

TEST_CASE("the circle of a glide lies down wind of the place by the way of the last piece") {
  for (const auto& wind :
       {Vec3<Ned>{5, -3, 0}, Vec3<Ned>{-2, 6, 0}, Vec3<Ned>{0.5, 0.5, 0}, Vec3<Ned>{0, 14, 0}}) {
    Bench<Home> home;
    kit::give_anaconda(home.params);
    home.params.mode.value = HomeMode::glide;
    Place place;
    place.north_m = 100;
    place.east_m = -50;
    home.params.places.value.places.push_back(place);
    home.params.places.is_given = true;
    VehicleState s = kit::level(160, -130, 0.4);
    s.height_m = 300;
    s.position_m.down = -300;
    s.wind_mps = wind;
    home.set(home.in.state, s);
    REQUIRE(home.activate() == Status::ok);
    home.set(home.in.state, s);
    REQUIRE(home.step(dt) == Status::ok);
    const Airframe a = test::anaconda();
    const double rho = standard_air(s.origin_altitude_m + 300).density_kgm3,
                 margin = home.params.glide_margin, R = home.params.glide_radius,
                 speed = std::hypot(wind.north, wind.east);
    const BestGlide best = best_glide(a, rho, 0, margin);
    const double way = std::max(best.airspeed_mps - speed, 0.0) * home.params.final_height / best.sink_mps;
    const double share = speed > 1 ? way / speed : 0;  // in calm air the circle is above the place
    const double north = s.position_m.north - (100 + share * wind.north),
                 east = s.position_m.east - (-50 + share * wind.east), d = std::hypot(north, east);
    // Beard & McLain (10.13), to the right
    const double course = std::atan2(east, north) + std::numbers::pi / 2 + std::atan(2 * (d - R) / R);
    const GuidanceCommand& c = home.out.command;
    CHECK(std::abs(wrap_pi(c.course_rad - course)) < 1e-9);
    CHECK(c.height_m == 0);
    const double head = -(std::cos(course) * wind.north + std::sin(course) * wind.east);
    CHECK(c.airspeed_mps == Approx(best_glide(a, rho, head, margin).airspeed_mps));
    const WindTriangle there =
        fly_course(std::atan2(80, -60),
                   best_glide(a, rho, -(-0.6 * wind.north + 0.8 * wind.east), margin).airspeed_mps, wind);
    const double sink = best_glide(a, rho, -(-0.6 * wind.north + 0.8 * wind.east), margin).sink_mps;
    CHECK(home.out.progress.reach_m == Approx(300 / sink * there.ground_speed_mps));
    CHECK(home.out.progress.distance_m == Approx(100));
    CHECK_FALSE(home.out.progress.final);
  }
}

TEST_CASE("a second flight begins as the first, whatever was wrong at the end of it") {
  kit::Watch once, twice;
  for (kit::Watch* w : {&once, &twice}) {
    w->fence();
    w->has_ground = w->has_health = true;
    w->ground.contact = Contact::air;
  }
  twice.fly(5);
  twice.state.roll_rad = 1.4;
  twice.state.position_m = {990, 0, -115};
  twice.state.height_m = 115;
  twice.state.wind_mps = {14, 0, 0};
  twice.health.pitot.state = SensorState::silent;
  twice.state.position_valid = false;
  twice.actuators.throttle_frac = 1;
  twice.state.climb_rate_mps = -4;
  twice.fly(30);
  const SafetyState& bad = twice.out.safety;
  REQUIRE(bad.attitude_excessive);
  REQUIRE(bad.wind_excessive);
  REQUIRE(bad.pitot_lost);
  REQUIRE(bad.gnss_lost);
  twice.state = once.state;
  twice.actuators = once.actuators;
  twice.health = once.health;
  twice.ground.contact = Contact::ground;
  twice.fly(8);
  twice.ground.contact = Contact::air;
  once.fly(1.5);
  twice.fly(1.5);
  const SafetyState &a = once.out.safety, &b = twice.out.safety;
  CHECK(b.airborne);
  CHECK(b.fence == a.fence);
  CHECK(b.gnss_lost == a.gnss_lost);
  CHECK(b.pitot_lost == a.pitot_lost);
  CHECK(b.attitude_excessive == a.attitude_excessive);
  CHECK(b.engine_failed == a.engine_failed);
  CHECK(b.engine_weak == a.engine_weak);
  CHECK(b.wind_excessive == a.wind_excessive);
  CHECK(b.answer == a.answer);
  CHECK(b.fence_margin_m == Approx(a.fence_margin_m));
  CHECK(b.waiting_s == a.waiting_s);
  CHECK(b.returning_s == a.returning_s);
}

}  // namespace values_test
