// SPDX-License-Identifier: BSD-3-Clause
// ROSplane's formulas against numbers worked out by hand, its faults and their corrected forms, and one seed
// of bench_laws.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <complex>
#include <cstdio>
#include <fulmar/testing.hpp>
#include <string>

#include "bench/rosplane_laws/controller.hpp"
#include "bench/rosplane_laws/follower.hpp"

namespace rosplane_laws_test {

using namespace fulmar;
using namespace fulmar::rosplane;
using doctest::Approx;

namespace {

VehicleState flying(double height_m, double airspeed_mps = 17) {
  VehicleState s;
  s.height_m = height_m;
  s.airspeed_mps = s.ground_speed_mps = airspeed_mps;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
  return s;
}

struct Flown : Bench<Controller> {
  VehicleState s = flying(70);
  GuidanceCommand c{.course_rad = 0, .height_m = 70, .airspeed_mps = 17};
  void fly(int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      set(in.state, s);
      set(in.command, c);
      step(0.01);
    }
  }
  /// Two steps in which there is nothing to do: from take-off by the climb to the altitude hold.
  void reach_hold() {
    const auto wanted = c;
    const auto is = s;
    c.height_m = 70;
    c.course_rad = 0;
    c.airspeed_mps = 17;
    c.roll_feedforward_rad = 0;
    s = flying(70);
    fly(2);
    REQUIRE(out.zone_ratio.value == 1);
    c = wanted;
    s = is;
  }
  void without_integrals() {
    for (Param* ki : {&params.c_ki, &params.a_ki, &params.a_t_ki, &params.e_ki, &params.l_ki}) ki->value = 0;
  }
};

/// What the rudder makes of r = sin(w t) after it has settled, over that: by correlation, whole periods.
std::complex<double> yaw_response(double w, bool mended) {
  Flown flown;
  flown.params.mended.value = mended;
  flown.params.max_r.value = 1.5;
  flown.reach_hold();
  const int period = static_cast<int>(std::lround(2 * 3.14159265358979 / w / 0.01));
  w = 2 * 3.14159265358979 / (period * 0.01);
  std::complex<double> sum = 0;
  for (int k = 1; k <= 3000 + 10 * period; ++k) {
    flown.s.rate_radps.z = 0.1 * std::sin(w * 0.01 * k);
    flown.fly();
    if (k > 3000) sum += flown.out.actuators.rudder_rad * std::exp(std::complex<double>(0, -w * 0.01 * k));
  }
  return sum * std::complex<double>(0, 2) / (0.1 * 10 * period);
}

}  // namespace

TEST_CASE("the zones follow the height alone: take-off, climb, altitude hold, and back below 5 m") {
  Flown f;
  f.c.height_m = 70;
  const auto zone = [&](double height) {
    f.s = flying(height);
    f.fly(2);
    return f.out.zone_ratio.value;
  };
  CHECK(zone(4.9) == 0);
  CHECK(f.out.attitude.roll_rad == 0);
  CHECK(f.out.attitude.pitch_rad == Approx(15 * 3.14159265 / 180));
  CHECK(zone(5) == 1);
  CHECK(zone(49.9) == 1);
  CHECK(zone(50) == 2);
  CHECK(zone(5.1) == 2);  // no way back to the climb
  f.s = flying(5);        // there it chatters: take-off and climb in turns
  for (const double z : {2, 0, 1, 0, 1}) {
    f.fly();
    CHECK(f.out.zone_ratio.value == z);
  }
}

TEST_CASE("successive loops: gain times error, both signs, and their limits") {
  for (const double side : {1.0, -1.0}) {
    Flown f;
    f.without_integrals();
    f.c.course_rad = 0.1 * side;
    f.c.height_m = 70 + 4 * side;
    f.c.airspeed_mps = 17 + 2 * side;
    f.c.roll_feedforward_rad = 0.05 * side;
    f.s.course_rad = 6.2831853 * side;  // as far from it as north is from itself
    f.reach_hold();
    f.s.pitch_rad = 0.02 * side;
    f.s.rate_radps = {0.1 * side, 0.2 * side, 0};
    f.fly();
    CHECK(f.out.attitude.roll_rad / side == Approx(2 * 0.1 + 0.05).epsilon(1e-6));
    CHECK(f.out.attitude.pitch_rad / side == Approx(0.015 * 4));
    CHECK(f.out.attitude.throttle_frac == Approx(0.5 + 0.1 * 2 * side));
    CHECK(f.out.actuators.aileron_rad / side == Approx(0.55 * 0.25 - 0.2 * 0.1).epsilon(1e-6));
    CHECK(f.out.actuators.elevator_rad == Approx(-(0.075 + side * (4.25 * (0.06 - 0.02) - 0.6 * 0.2))));
    f.c.course_rad = 2 * side;
    f.c.height_m = 70 + 100 * side;
    f.c.airspeed_mps = 17 + 30 * side;
    f.params.a_kp.value = 0.1;
    f.retune();
    f.fly();
    CHECK(f.out.attitude.roll_rad == Approx(side * 0.7853982));
    CHECK(f.out.attitude.pitch_rad == Approx(side * 0.3490659));
    CHECK(f.out.attitude.throttle_frac == (side > 0 ? 1 : 0));
  }
}

TEST_CASE("total energy: the shares of the energy that is wanted, both signs; trim is beyond the limit") {
  for (const double side : {1.0, -1.0}) {
    Flown f;
    f.params.law.value = Law::total_energy;
    f.without_integrals();
    f.reach_hold();
    f.c.height_m = 70 + 3 * side;
    f.fly();
    const double U = 9.8 * 3 / (0.5 * 17 * 17);
    CHECK(f.out.attitude.pitch_rad == Approx(side * 0.5 * U));
    CHECK(f.out.attitude.throttle_frac == Approx(side > 0 ? 0.5 + 0.5 * U : 0.5));  // never below trim
    f.params.mended.value = true;
    f.retune();
    f.fly();
    CHECK(f.out.attitude.throttle_frac == Approx(0.5 + side * 0.5 * U));
    f.c.height_m = 70;
    f.s.airspeed_mps = 17 - 3 * side;
    f.fly();
    const double K = 1 - std::pow((17 - 3 * side) / 17, 2);
    CHECK(f.out.attitude.pitch_rad == Approx(-0.5 * K));
    CHECK(f.out.attitude.throttle_frac == Approx(0.5 + 0.5 * K));
  }
  Flown f;  // the limit of pitch is that of roll
  f.params.law.value = Law::total_energy;
  f.reach_hold();
  f.s.airspeed_mps = 34;
  f.params.l_kp.value = 1;
  f.retune();
  f.fly();
  CHECK(f.out.attitude.pitch_rad == Approx(0.7853982));
  f.params.mended.value = true;
  f.retune();
  f.fly();
  CHECK(f.out.attitude.pitch_rad == Approx(0.3490659));
  f.c.airspeed_mps = 0;
  f.fly();
  CHECK(f.validation_error() == "");
}

TEST_CASE("a saturated integral stays where it is; mended it unwinds") {
  for (const bool mended : {false, true}) {
    CAPTURE(mended);
    Flown f;
    f.params.mended.value = mended;
    f.params.a_t_kp.value = 0;
    f.params.a_t_ki.value = 1;
    f.reach_hold();
    f.c.airspeed_mps = 18;
    f.fly(600);  // to the limit of the throttle, and long against it
    CHECK(f.out.attitude.throttle_frac > 0.98);
    f.params.trim_t.value = 1;
    f.retune();  // now half a throttle beyond it
    f.c.airspeed_mps = 16;
    f.fly(100);
    CHECK((f.out.attitude.throttle_frac < 0.7) == mended);
  }
}

TEST_CASE("the yaw damper is a 37th of what was meant at 5 rad/s; mended it is the wash-out") {
  const std::complex<double> jw(0, 5.0265);  // 125 steps a period
  const std::complex<double> meant = 0.85137 * jw / (jw + 0.6349);
  CHECK(std::abs(yaw_response(5.0265, true) / meant - 1.0) < 0.02);
  CHECK(std::abs(meant) / 0.845 == Approx(1).epsilon(0.002));
  // 0.849 |1 - 1/z| / |1 + 0.846/z| at 0.01 s
  CHECK(std::abs(yaw_response(5.0265, false)) / 0.0231 == Approx(1).epsilon(0.01));
  CHECK(std::abs(yaw_response(30, false)) / 0.14 == Approx(1).epsilon(0.03));
}

TEST_CASE("the follower's line and orbit, both sides; behind the line's point it climbs the wrong way") {
  Bench<Follower> f;
  Path path;
  path.origin_m = {10, 20, -70};
  path.direction_ratio = {0, 0.8, -0.6};
  path.airspeed_mps = 18;
  VehicleState s = flying(70);
  s.position_m = {14, 60, -70};
  s.course_rad = 1.5;
  const auto step = [&]() -> const GuidanceCommand& {
    f.set(f.in.state, s);
    f.set(f.in.path, path);
    f.step(0.1);
    return f.out.command;
  };
  const double pi = 3.14159265358979;
  CHECK(step().course_rad == Approx(pi / 2 - 1.2 * 2 / pi * std::atan(0.0175 * -4)));
  CHECK(f.out.command.height_m == Approx(70 + std::hypot(4, 40) * 0.75));
  CHECK(f.out.command.roll_feedforward_rad == 0);
  CHECK(f.out.command.airspeed_mps == 18);
  s.position_m.east = -20;
  CHECK(step().height_m > 90);  // 40 m before it the path is 30 m lower, not higher
  path.kind = PathKind::orbit;
  path.radius_m = 50;
  for (const double side : {1.0, -1.0}) {
    path.turn = side > 0 ? Turn::right : Turn::left;
    s.position_m = {10, 80, -70};  // 60 m east of the centre
    CHECK(step().course_rad == Approx(wrap_pi(pi / 2 + side * (pi / 2 + std::atan(0.5 * 10 / 50)))));
    CHECK(f.out.command.height_m == 70);
    s.yaw_rad = s.course_rad - 0.2;
    CHECK(step().roll_feedforward_rad / side == Approx(std::atan(17 * 17 / (9.81 * 50 * std::cos(0.2)))));
  }
}

TEST_CASE("one seed of the bench: everything is flown and Fulmar's laws are as far ahead as is promised") {
  const auto shell = [](const std::string& arguments) {
    FILE* pipe = popen((FULMAR_BIN_DIR "/bench_laws " + arguments + " 2>&1").c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string said;
    char buffer[4096];
    for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) said.append(buffer, n);
    return std::pair(WEXITSTATUS(pclose(pipe)), said);
  };
  const auto flown = shell("--seeds 1 --markdown");
  const std::string& said = flown.second;
  CAPTURE(said);
  CHECK(flown.first == 0);
  CHECK(said.find("| 8 | surface_rate_rms_radps | ") != std::string::npos);
  CHECK(said.find("nan") == std::string::npos);
  CHECK(shell("--seeds none").first == 2);
}

}  // namespace rosplane_laws_test
