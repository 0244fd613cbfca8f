// SPDX-License-Identifier: BSD-3-Clause
// The inversion against finite differences of the flight model. The law on the nonlinear aircraft with a
// servo, with external moments, and with surfaces that have more or less effect than modelled.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/flight/math/attitude.hpp>
#include <fulmar/testing.hpp>

#include "indi.hpp"

namespace {

constexpr double deg = std::numbers::pi / 180, field_m = 1387;

/// The shipped Anaconda.
Airframe anaconda() {
  Airframe a;
  a.mass_kg = 4.5;
  a.inertia = {0.24855, 0.3784, 0.618, 0.06};
  a.wing = {0.52, 2.08, 0.235, 0.9, 15 * deg, 50};
  a.aero.parasite_drag_ratio = 0.043;
  a.aero.lift = {0.506, 5.61, 0, 0, 7.95, 0, 0, 0.13, 0};
  a.aero.drag.elevator_ratio = 0.0135;
  a.aero.side = {0, 0, -0.98, 0, 0, 0, 0.075, 0, 0.19};
  a.aero.roll = {0, 0, -0.13, -0.51, 0, 0.25, 0.17, 0, 0.0024};
  a.aero.pitch = {0.135, -2.74, 0, 0, -38.21, 0, 0, -0.99, 0};
  a.aero.yaw = {0, 0, 0.1301, -0.0364, 0, -0.1541, -0.011, 0, -0.069};
  a.propulsion = {0.381, 0.06288743, -0.02704452, -0.31320732, 0.00614891, -0.0106795, -0.011779, 0.01705,
                  0.042, 1.5,        24,          0.05,        {},         {},         {}};
  for (Surface* s : {&a.aileron, &a.elevator, &a.rudder}) *s = {40 * deg, 8.7, 0.01, 0, false};
  a.limits = {12, 17, 27, 45 * deg, 25 * deg, -20 * deg, 5, 3, 0.57};
  return a;
}

/// Attitude of the nonlinear aircraft at constant speed, under the law, 200 Hz.
struct Flight {
  Bench<Indi> indi;
  Airframe real = anaconda();
  RigidBody x;
  Deflections d{0, 0.1212, 0};
  AttitudeCommand command{0, 0.0054, 0.5};
  double roll_wanted = 0;  // changes at 1 rad/s, as outer laws command it
  VehicleState s;
  Eigen::Vector3d more_moment = Eigen::Vector3d::Zero();  // N m

  explicit Flight(double Va = 17) {
    indi.params.airframe.value = real;
    indi.params.airframe.is_given = true;
    x.v_n = Eigen::Vector3d(Va, 0, 0);
    x.q_nb = quaternion_from({0, 0.0054, 0});
    look();
    indi.set(indi.in.state, s);
    indi.set(indi.in.attitude, command);
    Indi::Outputs last;
    last.actuators = {0.5, 0, 0.1212, 0};
    REQUIRE(indi.activate(last) == Status::ok);
  }
  void look() {
    const Euler e = euler_from(x.q_nb);
    s.roll_rad = e.roll_rad;
    s.pitch_rad = e.pitch_rad;
    s.yaw_rad = e.yaw_rad;
    s.rate_radps = from_eigen<Body>(x.omega_b);
    s.airspeed_mps = s.ground_speed_mps = x.v_n.norm();
    s.height_m = 70;
    s.origin_altitude_m = field_m;
    s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
  }
  template <class Observe>
  void run(double seconds, Observe observe) {
    const double dt = 0.005, rho = standard_air(field_m + 70).density_kgm3;
    const MassProperties mass(real.mass_kg, inertia_matrix(real.inertia));
    for (int k = 0; k < static_cast<int>(std::lround(seconds / dt)); ++k) {
      look();
      command.roll_rad += std::clamp(roll_wanted - command.roll_rad, -dt, dt);
      indi.set(indi.in.state, s);
      indi.set(indi.in.attitude, command);
      REQUIRE(allocations([&] { indi.step(dt); }) == 0);
      REQUIRE(indi.validation_error() == "");
      const Actuators& u = indi.out.actuators;
      const double lag = 1 - std::exp(-dt / 0.012), Va = x.v_n.norm();
      d.aileron += lag * (u.aileron_rad - d.aileron);
      d.elevator += lag * (u.elevator_rad - d.elevator);
      d.rudder += lag * (u.rudder_rad - d.rudder);
      const auto load_at = [&](const RigidBody& b, double) {
        Load load = Aerodynamic(real).load(b.q_nb.conjugate() * b.v_n, b.omega_b, d, rho);
        load.moment_b += more_moment;
        return load;
      };
      x = runge_kutta(x, load_at(x, 0), dt, mass, {0, 0, isa::g0}, load_at);
      // The flight path turns with the bank, without sideslip, at constant airspeed: the test has no height
      // hold.
      const Euler e = euler_from(x.q_nb);
      x.v_n = Va * Eigen::Vector3d(std::cos(e.yaw_rad), std::sin(e.yaw_rad), 0);
      observe();
    }
  }
  void run(double seconds) {
    run(seconds, [] {});
  }
};

}  // namespace

TEST_CASE("the effect of the surfaces is that of the flight model, by finite differences") {
  const Airframe a = anaconda();
  const double Va = 19, rho = 1.1, h = 1e-4;
  const Eigen::Vector3d v_b(Va, 0, 0), none = Eigen::Vector3d::Zero();
  const Eigen::Matrix3d J_inverse = inertia_matrix(a.inertia).inverse(),
                        G = Indi::effect(a) * 0.5 * rho * Va * Va;
  for (int i = 0; i < 3; ++i) {
    const auto moment = [&](double by) {
      const Deflections d{i == 0 ? by : 0, i == 1 ? by : 0, i == 2 ? by : 0};
      return Aerodynamic(a).load(v_b, none, d, rho).moment_b;
    };
    const Eigen::Vector3d column = J_inverse * (moment(h) - moment(-h)) / (2 * h);
    CHECK((G.col(i) - column).norm() / column.norm() < 1e-3);
  }
  CHECK(G(0, 0) > 10);   // aileron rolls right
  CHECK(G(1, 1) < -10);  // elevator down: nose down
  CHECK(G(2, 2) < -1);   // rudder left: nose left
}

TEST_CASE("a step of the attitude is followed, both signs, slow and fast") {
  for (const double Va : {13.0, 17.0, 24.0})
    for (const double side : {1.0, -1.0}) {
      CAPTURE(Va);
      CAPTURE(side);
      Flight flight(Va);
      flight.run(2);
      flight.roll_wanted = 20 * deg * side;
      double most = 0;
      flight.run(1, [&] { most = std::max(most, flight.s.roll_rad * side); });
      CHECK(flight.s.roll_rad * side / (20 * deg) == doctest::Approx(1).epsilon(0.06));
      CHECK(most < 24 * deg);
      flight.run(2);
      CHECK(flight.s.roll_rad * side / (20 * deg) == doctest::Approx(1).epsilon(0.03));
      flight.roll_wanted = 0;
      flight.command.pitch_rad += 5 * deg * side;
      flight.run(2);
      CHECK(std::abs(flight.s.pitch_rad - flight.command.pitch_rad) < 0.5 * deg);
      CHECK(std::abs(flight.s.roll_rad) < 0.5 * deg);
    }
}

TEST_CASE("an external moment is compensated without an integral") {
  for (const double side : {1.0, -1.0}) {
    Flight flight;
    flight.run(1);
    flight.more_moment = side * Eigen::Vector3d(3, 3, 0.5);
    flight.run(3);
    const double pressure = 0.5 * standard_air(field_m + 70).density_kgm3 * 17 * 17;
    const double without = 3 / (pressure * 0.52 * 0.235 * 0.99);  // elevator that balances the moment, rad
    CHECK(without > 0.15);
    CHECK(std::abs(flight.s.pitch_rad - flight.command.pitch_rad) < 0.5 * deg);
    CHECK(std::abs(flight.s.roll_rad) < 0.5 * deg);
  }
}

TEST_CASE("surfaces that do half or twice of what it believes") {
  for (const double factor : {0.5, 2.0}) {
    Flight flight;
    flight.indi.params.effectiveness.value = factor;
    flight.indi.configure();
    flight.run(1);
    flight.roll_wanted = 30 * deg;
    double most = 0;
    flight.run(2, [&] { most = std::max(most, flight.s.roll_rad); });
    CHECK(most < 38 * deg);
    CHECK(std::abs(flight.s.roll_rad - 30 * deg) < 1 * deg);
  }
}

TEST_CASE("it goes on from the surfaces as they were; after nobody from trim") {
  for (const double side : {1.0, -1.0}) {
    Flight flight;
    Indi::Outputs last;
    last.actuators = {0.5, 0.1 * side, 0.12 - 0.1 * side, 0.05 * side};
    flight.indi.set(flight.indi.in.attitude,
                    AttitudeCommand{0.3 * side, 0.1 * side, 0.9});  // a large command at the switch
    REQUIRE(flight.indi.activate(last) == Status::ok);
    flight.indi.step(0.005);
    const Actuators& u = flight.indi.out.actuators;
    CHECK(std::abs(u.throttle_frac - 0.5) < 1e-3);
    CHECK(std::abs(u.aileron_rad - 0.1 * side) < 1e-3);
    CHECK(std::abs(u.elevator_rad - 0.12 + 0.1 * side) < 1e-3);
    CHECK(std::abs(u.rudder_rad - 0.05 * side) < 1e-3);
    flight.indi.set(flight.indi.in.attitude, flight.command);
    flight.indi.params.airframe.value.elevator.trim_rad = 0.08;
    flight.indi.configure();
    REQUIRE(flight.indi.activate() == Status::ok);
    flight.indi.step(0.005);
    CHECK(std::abs(u.elevator_rad - 0.08) < 1e-3);
    CHECK(std::abs(u.aileron_rad) < 1e-3);
  }
}

TEST_CASE("at a limit nothing winds up, and without an attitude it damps the rates and says so") {
  Flight flight;
  flight.more_moment.y() = 60;  // beyond the authority of the elevator
  flight.run(1);
  CHECK(flight.indi.out.actuators.elevator_rad == doctest::Approx(40 * deg));
  flight.more_moment.y() = 0;
  flight.x = RigidBody{};
  flight.x.v_n = Eigen::Vector3d(17, 0, 0);
  flight.run(0.3);
  CHECK(flight.indi.out.actuators.elevator_rad < 30 * deg);

  Bench<Indi>& indi = flight.indi;
  flight.s = VehicleState{};
  flight.s.height_m = 70;
  flight.s.airspeed_mps = 17;
  flight.s.airspeed_valid = true;
  flight.s.velocity_valid = true;
  flight.s.ground_speed_mps = 17;
  flight.s.rate_radps = {1, -1, 0};
  indi.set(indi.in.state, flight.s);
  indi.activate();
  Status status = Status::ok;
  for (int i = 0; i < 20; ++i) status = indi.step(0.005);
  CHECK(status == Status::degraded);
  CHECK(indi.out.actuators.aileron_rad < -0.05);
  CHECK(indi.out.actuators.elevator_rad < -0.05);  // nose up
}

TEST_CASE("an airframe that its surfaces cannot turn is refused, and so is none") {
  Bench<Indi> bench;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == Indi::airframe_missing);
  bench.params.airframe.value = anaconda();
  bench.params.airframe.is_given = true;
  bench.params.airframe.value.aero.yaw.rudder_ratio = bench.params.airframe.value.aero.roll.rudder_ratio = 0;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == Indi::surfaces_insufficient);
}
