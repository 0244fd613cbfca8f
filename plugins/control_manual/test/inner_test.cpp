// SPDX-License-Identifier: BSD-3-Clause
// Surfaces, rates and attitudes, axis by axis, against derivatives of the Anaconda worked out by hand.
#include "plugins/control_manual/inner.hpp"

#include "kit.hpp"

namespace inner_test {

using namespace fulmar;
using kit::level;
using kit::stick;
using manual::Inner;

using Law = Inner::Law;

namespace {
struct Bench : kit::Hand<Inner> {
  explicit Bench(Law law) {
    params.aileron.value = params.elevator.value = law;
    params.rudder.value = law == Law::surface ? Inner::Rudder::surface : Inner::Rudder::damper;
    params.blend.value = 0.01;
    params.integral.value = 0;
  }
  Actuators settle(const Rc& rc, const VehicleState& state = level(), int steps = 100) {
    for (int i = 0; i < steps; ++i) fly(rc, state);
    return out.actuators;
  }
};

constexpr double trim = 0.12, end = 0.698;  // of the elevator; of all throws
const double rho = 1.225 * std::pow(1 - 0.0065 * 1457 / 288.15, 4.25588), q_bar = 0.5 * rho * 17 * 17;
}  // namespace

TEST_CASE("surfaces go with their sticks from the trim: right, back is nose up, yaw is nose right") {
  Bench bench(Law::surface);
  const Actuators u = bench.settle(stick(0.3, 0.2, 0.4, 0.25));
  CHECK(u.aileron_rad == doctest::Approx(0.3 * end));
  CHECK(u.elevator_rad == doctest::Approx(trim - 0.2 * end));
  CHECK(u.rudder_rad == doctest::Approx(-0.25 * end));
  CHECK(u.throttle_frac == doctest::Approx(0.4));
  CHECK(bench.settle(stick(0, -1)).elevator_rad == doctest::Approx(end));  // its stop, not beyond
  bench.params.throw_share.value = 0.5;
  bench.retune();
  CHECK(bench.settle(stick(0.3)).aileron_rad == doctest::Approx(0.15 * end));
}

TEST_CASE("a roll rate takes the aileron that holds it against the roll damping, and is damped beyond") {
  Bench bench(Law::rate);
  VehicleState s = level();
  s.rate_radps.x = 0.6;
  // p is the demand: -b/(2V) Clp/Cla p
  const double steady = 2.08 / 34 * 0.51 / 0.17 * 0.6;
  CHECK(bench.settle(stick(0.4), s).aileron_rad == doctest::Approx(steady));
  s.rate_radps.x = 0.1;
  const double power = q_bar * 0.52 * 2.08 * 0.17 / 0.24855;
  CHECK(bench.settle(stick(0.4), s).aileron_rad == doctest::Approx(steady + 8 / power * 0.5).epsilon(1e-4));
  CHECK(bench.out.roll_rate_demand_radps.value == doctest::Approx(0.6));
}

TEST_CASE("a pitch rate takes the elevator of its lift and damping, and is damped beyond; back is up") {
  Bench bench(Law::rate);
  VehicleState s = level();
  s.rate_radps.y = 0.15;
  // CL = m V q / (q_bar S), Cm = 0: two equations in alpha and elevator, by Cramer
  const double hat = 0.235 / 34, qS = q_bar * 0.52;
  const double lift = 4.5 * 17 * 0.15 / qS - 7.95 * hat * 0.15, moment = 38.21 * hat * 0.15;
  const double steady = (5.61 * moment + 2.74 * lift) / (5.61 * -0.99 + 2.74 * 0.13);
  CHECK(bench.settle(stick(0, 0.25), s).elevator_rad == doctest::Approx(trim + steady).epsilon(1e-4));
  s.rate_radps.y = 0.05;
  const double power = qS * 0.235 * -0.99 / 0.3784;
  CHECK(bench.settle(stick(0, 0.25), s).elevator_rad ==
        doctest::Approx(trim + steady + 12 / power * 0.1).epsilon(1e-4));
}

TEST_CASE("sticks in the middle of a banked turn ask for the rates of the turn") {
  Bench bench(Law::rate);
  VehicleState s = level();
  s.roll_rad = 0.6;
  s.pitch_rad = 0.1;
  const double psi = 9.80665 * std::tan(0.6) / 17;
  bench.settle(stick(), s);
  CHECK(bench.out.roll_rate_demand_radps.value == doctest::Approx(-psi * std::sin(0.1)));
  CHECK(bench.out.pitch_rate_demand_radps.value == doctest::Approx(psi * std::sin(0.6) * std::cos(0.1)));
}

TEST_CASE("a constant rate error is integrated in flight, and not on the ground") {
  Bench bench(Law::rate);
  bench.params.integral.value = 3;
  const double power = q_bar * 0.52 * 2.08 * 0.17 / 0.24855, kp = 8 / power;
  bench.fly(stick(0.2));
  const double first = bench.out.actuators.aileron_rad;
  const double later = bench.settle(stick(0.2), level(), 100).aileron_rad;
  CHECK(later - first == doctest::Approx(3 * kp * 0.3).epsilon(0.01));
  VehicleState s = level(0);
  s.height_m = 0;
  // At rest the gains are those of half the minimum airspeed.
  const double slow = 0.5 * 12, power_slow = power * slow * slow / (17 * 17);
  CHECK(bench.settle(stick(0.2), s, 1500).aileron_rad ==
        doctest::Approx((2.08 / (2 * slow) * 0.51 / 0.17 + 8 / power_slow) * 0.3).epsilon(0.03));
}

TEST_CASE("an attitude is the outer law's: rate by error, within the largest rate") {
  Bench bench(Law::attitude);
  bench.params.throttle.value = Inner::Throttle::automatic;
  bench.set(bench.in.attitude, AttitudeCommand{0.2, 0.1, 0.7});
  CHECK(bench.fly(stick(-1, -1, 0)) == Status::ok);
  CHECK(bench.out.roll_rate_demand_radps.value == doctest::Approx(4 * 0.2));
  CHECK(bench.out.pitch_rate_demand_radps.value == doctest::Approx(3 * 0.1));
  CHECK(bench.out.actuators.throttle_frac == 0.7);
  bench.set(bench.in.attitude, AttitudeCommand{-0.7, -0.3, 0.7});
  bench.fly(stick());
  CHECK(bench.out.roll_rate_demand_radps.value == doctest::Approx(-1.5));
  CHECK(bench.out.pitch_rate_demand_radps.value == doctest::Approx(-0.6));
}

TEST_CASE("axes are chosen one by one") {
  Bench bench(Law::attitude);
  bench.params.aileron.value = Law::surface;
  bench.set(bench.in.attitude, AttitudeCommand{0.2, 0.1, 0.7});
  bench.fly(stick(0.3, 1));
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.3 * end));
  CHECK(bench.out.roll_rate_demand_radps.value == 0);
  CHECK(bench.out.pitch_rate_demand_radps.value == doctest::Approx(0.3));
}

TEST_CASE("the yaw damper turns the rudder against a yaw rate beyond the turn's, beside the stick") {
  Bench bench(Law::rate);
  VehicleState s = level();
  bench.settle(stick(), s);
  s.rate_radps.z = 0.2;  // nose to the right: the rudder goes left
  bench.fly(stick(), s);
  const double damping = bench.out.actuators.rudder_rad;
  CHECK(damping == doctest::Approx(0.3 * 0.2).epsilon(0.01));
  bench.params.rudder.value = Inner::Rudder::surface;
  bench.retune();
  CHECK(bench.settle(stick(0, 0, 0.57, 0.5), s).rudder_rad == doctest::Approx(-0.5 * end));
}

TEST_CASE("without the pilot each axis holds the outer law's attitude, without that level flight at cruise") {
  for (const Law law : {Law::surface, Law::rate}) {
    for (const bool lawful : {true, false}) {
      Bench bench(law);
      VehicleState s = level();
      s.roll_rad = 0.3;
      Rc lost = stick(1, 1, 0);
      lost.link = false;
      for (int i = 0; i < 100; ++i) {
        if (lawful) bench.set(bench.in.attitude, AttitudeCommand{0.2, 0.1, 0.7});
        CHECK(bench.fly(lost, s) == Status::degraded);
      }
      CHECK(bench.out.roll_rate_demand_radps.value == doctest::Approx(4 * ((lawful ? 0.2 : 0) - 0.3)));
      CHECK(bench.out.actuators.throttle_frac == doctest::Approx(lawful ? 0.7 : 0.57));
    }
  }
}

TEST_CASE("without an attitude a stick moves its surface, and an axis that was to be held goes to its trim") {
  Bench bench(Law::rate);
  VehicleState s = level();
  s.attitude_valid = false;
  s.roll_rad = 2;
  s.rate_radps = {9, 9, 9};
  Actuators u = bench.settle(stick(0.3, 0.2), s);
  CHECK(u.aileron_rad == doctest::Approx(0.3 * end));
  CHECK(u.elevator_rad == doctest::Approx(trim - 0.2 * end));
  CHECK(u.rudder_rad == 0);
  CHECK(bench.fly(stick(), s) == Status::degraded);
  Rc lost = stick(1, 1);
  lost.link = false;
  u = bench.settle(lost, s);
  CHECK(u.aileron_rad == doctest::Approx(0).epsilon(1e-6));
  CHECK(u.elevator_rad == doctest::Approx(trim));
}

TEST_CASE("towards the largest bank the stick's rate falls to nothing, beyond it leads back, in both laws") {
  for (const Law law : {Law::rate, Law::surface}) {
    Bench bench(law);
    VehicleState s = level();
    s.roll_rad = 0.785 - 0.1;
    bench.settle(stick(1), s);
    const double near = bench.out.actuators.aileron_rad;
    const double steady = 2.08 / 34 * 0.51 / 0.17, kp = 8 / (q_bar * 0.52 * 2.08 * 0.17 / 0.24855);
    CHECK(near == doctest::Approx((steady + kp) * 0.4).epsilon(1e-3));
    s.roll_rad = 0.785 + 0.1;
    CHECK(bench.settle(stick(1), s).aileron_rad == doctest::Approx(-(steady + kp) * 0.4).epsilon(1e-3));
    CHECK(bench.settle(stick(-0.2), s).aileron_rad < 0);
    bench.params.envelope.protection.value = false;
    bench.retune();
    CHECK(bench.settle(stick(1), s).aileron_rad > (steady + kp) * 1.49);
  }
}

TEST_CASE("what flew before goes over into the sticks without a step of any surface") {
  for (const Law law : {Law::surface, Law::rate, Law::attitude}) {
    Bench bench(law);
    bench.params.blend.value = 0.3;
    bench.set(bench.in.state, level());
    Inner::Outputs last;
    last.actuators = {0.8, 0.1, 0.05, -0.04};
    bench.activate(last);
    bench.fly(stick(0.2, 0.1, 0.5));
    CHECK(bench.out.actuators.throttle_frac == doctest::Approx(0.8));
    CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0.1));
    CHECK(bench.out.actuators.elevator_rad == doctest::Approx(0.05));
    CHECK(bench.out.actuators.rudder_rad == doctest::Approx(-0.04));
    // and from one law to another in flight, as a phase sets it
    for (const Law next : {Law::rate, Law::surface, Law::rate}) {
      for (int i = 0; i < 20; ++i) bench.fly(stick(0.2, 0.1, 0.5));
      const Actuators before = bench.out.actuators;
      bench.params.aileron.value = bench.params.elevator.value = next;
      bench.retune();
      bench.fly(stick(0.2, 0.1, 0.5));
      CHECK(std::abs(bench.out.actuators.aileron_rad - before.aileron_rad) < 0.01);
      CHECK(std::abs(bench.out.actuators.elevator_rad - before.elevator_rad) < 0.01);
    }
  }
}

TEST_CASE("an airframe whose surfaces move nothing is flown by its trims") {
  Bench bench(Law::rate);
  bench.params.airframe.value.aero.roll.aileron_ratio = 0;
  bench.params.airframe.value.aero.pitch.elevator_ratio = 0;
  bench.configure();
  bench.settle(stick(1, 1));
  CHECK(bench.validation_error() == "");
  CHECK(bench.out.actuators.aileron_rad == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("whatever stick and state, what is commanded is finite and within the throws") {
  for (const Law law : {Law::surface, Law::rate, Law::attitude})
    for (const double roll : {-3.1, -0.5, 0.0, 2.0})
      for (const double pitch : {-1.5, 0.0, 1.5})
        for (const double airspeed : {0.0, 8.0, 40.0}) {
          Bench bench(law);
          VehicleState s = level(airspeed);
          s.roll_rad = roll;
          s.pitch_rad = pitch;
          s.rate_radps = {5, -5, 5};
          const Actuators u = bench.settle(stick(1, -1, 2, 1), s, 10);
          CHECK(bench.validation_error() == "");
          for (double surface : {u.aileron_rad, u.elevator_rad, u.rudder_rad})
            CHECK(std::abs(surface) <= end);
        }
}

TEST_CASE("a step of the inner law allocates nothing") {
  Bench bench(Law::rate);
  bench.set(bench.in.attitude, AttitudeCommand{});
  bench.fly(stick(1, 1));
  CHECK(allocations([&] { bench.step(0.01); }) == 0);
}

}  // namespace inner_test
