// SPDX-License-Identifier: BSD-3-Clause
// Motions that count as an oscillation and others that do not, and the reaction of the inner loops. In
// flight: core/app/test/quieten_test.cpp.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/control/oscillation.hpp>
#include <fulmar/testing.hpp>
#include <functional>
#include <string>

#include "plugins/control_slc/inner.hpp"

namespace oscillation_test {

using namespace fulmar;
using Inner = slc::Inner;

namespace {

/// When swings beyond 0.1 are an oscillation, s; below 0: never in 5 s.
double recognised(
    const std::function<double(double)>& signal,
    const std::function<double(double)>& caused = [](double) { return 0.0; }) {
  Swings swings;
  for (int k = 0; k < 500; ++k)
    if (swings.step(signal(0.01 * k), caused(0.01 * k), 0.1, 0.01)) return 0.01 * k;
  return -1;
}
double sine(double amplitude, double w, double t) { return amplitude * std::sin(w * t); }

VehicleState flying() {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = 15;
  s.airspeed_valid = s.attitude_valid = true;
  return s;
}

/// The inner loops of an aircraft that shakes at 20 rad/s about one axis.
struct Shaken : Bench<Inner> {
  VehicleState s = flying();
  AttitudeCommand command;
  int k = 0, notices = 0;
  std::string reported;
  Status status = Status::ok;
  Shaken() { params.roll_ki.value = params.pitch_ki.value = 0; }
  void fly(double seconds, const std::function<void(Shaken&, double)>& shake) {
    for (const int end = k + static_cast<int>(std::lround(seconds * 100)); k < end; ++k) {
      shake(*this, std::sin(20 * 0.01 * k));
      set(in.state, s);
      set(in.attitude, command);
      REQUIRE(allocations([&] { status = step(0.01); }) == 0);
      notices += static_cast<int>(out.notices.count);
      if (out.notices.count > 0) reported = out.notices.items[0].text.bytes.data();
    }
  }
  /// Aileron, elevator and rudder per error of roll and pitch and yaw rate.
  Actuators answer() {
    Shaken& self = *this;
    self.s = flying();
    command = {};
    for (int i = 0; i < 300; ++i) {
      set(in.state, s);
      set(in.attitude, command);
      step(0.01);
    }
    const Actuators before = out.actuators;
    s.roll_rad = -0.01;
    s.pitch_rad = -0.01;
    s.rate_radps.z = 0.01;
    set(in.state, s);
    step(0.01);
    return {0, (out.actuators.aileron_rad - before.aileron_rad) / 0.01,
            -(out.actuators.elevator_rad - before.elevator_rad) / 0.01,
            (out.actuators.rudder_rad - before.rudder_rad) / 0.01};
  }
};
const auto by_roll = [](Shaken& f, double wave) { f.s.roll_rad = 0.3 * wave; };

}  // namespace

TEST_CASE("five swings in a row are an oscillation, in its band and beyond the threshold alone") {
  const double half = 3.14159265 / 20;
  const double at = recognised([](double t) { return sine(0.2, 20, t); });
  CHECK(at > 4.5 * half);
  CHECK(at < 6.5 * half);
  CHECK(recognised([](double t) { return sine(0.09, 20, t); }) < 0);
  CHECK(recognised([](double t) { return sine(3, 5, t); }) < 0);      // as slow as the loop itself
  CHECK(recognised([](double t) { return sine(0.5, 100, t); }) < 0);  // noise of a sensor
  CHECK(recognised([](double t) { return 0.5 + sine(0.2, 20, t); }) > 0);
  CHECK(recognised([](double t) { return sine(0.2, 12, t); }) > 0);
  CHECK(recognised([](double t) { return sine(0.2, 50, t); }) > 0);
  CHECK(recognised([](double t) { return t < 3.5 * 3.14159265 / 20 ? sine(0.2, 20, t) : 0; }) < 0);
  CHECK(recognised([](double t) { return std::fmod(t, 1.6) < 0.62 ? sine(0.2, 20, t) : 0; }) < 0);
}

TEST_CASE("swings that die, and those of the command, are none") {
  const double half = 3.14159265 / 20;
  CHECK(recognised([&](double t) { return std::pow(0.6, t / half) * sine(9, 20, t); }) < 0);
  CHECK(recognised([&](double t) { return std::pow(1.2, t / half) * sine(0.1, 20, t); }) > 0);
  const auto swing = [](double t) { return sine(0.2, 20, t); };
  CHECK(recognised(swing, [](double t) { return sine(0.12, 20, t + 0.1); }) < 0);
  CHECK(recognised(swing, [](double t) { return sine(-0.12, 20, t); }) < 0);
  CHECK(recognised(swing, [](double t) { return sine(0.08, 20, t + 0.1); }) > 0);
  CHECK(recognised(swing, [](double) { return 5.0; }) > 0);  // a constant command moves nothing
}

TEST_CASE("each oscillation leaves 0.4 of the gain, a tenth is left in the end, until it is restored") {
  Quietening axis;
  const auto oscillate = [&] {
    int cuts = 0;
    for (int k = 0; k < 95; ++k) cuts += axis.step(sine(0.2, 20, 0.01 * k), 0, 0.1, 0.01);
    axis.begin();
    return cuts;
  };
  for (const double gain : {0.4, 0.16, 0.1}) {
    CHECK(oscillate() == 1);
    CHECK(axis.gain() == doctest::Approx(gain));
  }
  CHECK(oscillate() == 0);
  CHECK(axis.gain() == doctest::Approx(0.1));
  axis.restore();
  CHECK(axis.gain() == 1);
}

TEST_CASE("an axis that oscillates loses gain, the others do not, and it is told once a cut") {
  struct Axis {
    const char* name;
    std::function<void(Shaken&, double)> shake;
    double roll, pitch, yaw;
  };
  const std::vector<Axis> axes = {
      {"roll", by_roll, 0.4, 1, 1},
      {"pitch", [](Shaken& f, double wave) { f.s.pitch_rad = 0.05 * wave; }, 1, 0.4, 1},
      {"yaw", [](Shaken& f, double wave) { f.s.rate_radps.z = 0.6 * wave; }, 1, 1, 0.4}};
  Shaken still;
  const Actuators whole = still.answer();
  CHECK(still.notices == 0);
  for (const Axis& axis : axes) {
    CAPTURE(axis.name);
    Shaken f;
    f.fly(1.3, axis.shake);
    CHECK(f.notices == 1);
    CHECK(f.reported == "control_slc.axis_oscillates(" + std::string(axis.name) + ", 0.40)");
    CHECK(f.status == Status::degraded);
    const Actuators now = f.answer();
    CHECK(now.aileron_rad / whole.aileron_rad == doctest::Approx(axis.roll).epsilon(1e-3));
    CHECK(now.elevator_rad / whole.elevator_rad == doctest::Approx(axis.pitch).epsilon(1e-3));
    CHECK(now.rudder_rad / whole.rudder_rad == doctest::Approx(axis.yaw).epsilon(1e-3));
  }
}

TEST_CASE("a hand-over leaves what was learnt, other gains begin anew, the same ones do not") {
  Shaken f;
  f.fly(1.3, by_roll);
  REQUIRE(f.status == Status::degraded);
  f.activate();
  f.retune();
  f.fly(0.01, [](Shaken& g, double) { g.s.roll_rad = 0; });
  CHECK(f.status == Status::degraded);
  f.params.roll_kp.value = 0.6;
  f.retune();
  f.fly(0.01, [](Shaken& g, double) { g.s.roll_rad = 0; });
  CHECK(f.status == Status::ok);
  f.fly(1.3, by_roll);
  CHECK(f.status == Status::degraded);
  f.params.quieten.value = false;
  f.retune();
  f.fly(2, by_roll);
  CHECK(f.status == Status::ok);
}

TEST_CASE("the command, the ground, an attitude that is not known and an aileron's yaw are no oscillations") {
  Shaken swept;
  swept.fly(3, [](Shaken& f, double wave) {
    f.command.roll_rad = 0.3 * wave;
    f.command.pitch_rad = 0.05 * wave;
  });
  CHECK(swept.notices == 0);
  Shaken ground;
  ground.fly(3, [](Shaken& f, double wave) {
    by_roll(f, wave);
    f.s.airspeed_mps = f.s.ground_speed_mps = 3;
  });
  CHECK(ground.notices == 0);
  Shaken blind;
  blind.fly(3, [](Shaken& f, double wave) {
    by_roll(f, wave);
    f.s.attitude_valid = false;
  });
  CHECK(blind.notices == 0);
  Shaken yaws;  // the aileron is swept and the aircraft yaws with it
  yaws.fly(3, [](Shaken& f, double wave) {
    f.command.roll_rad = 0.3 * wave;
    f.s.rate_radps.z = 0.6 * wave;
  });
  CHECK(yaws.notices == 0);
}

}  // namespace oscillation_test
