// SPDX-License-Identifier: BSD-3-Clause
// The solution of the Riccati equation against closed forms and its own residual; the model against the
// formulas of Beard & McLain; the regulator at switches and limits, and on the nonlinear aircraft.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "lqr.hpp"

namespace {

using X = Plant;
constexpr double deg = std::numbers::pi / 180, rho = 1.06;
constexpr double field_m = 1387;

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
  a.propulsion = {0.381,     0.06288743, -0.02704452, -0.31320732, 0.00614891, -0.0106795,
                  -0.011779, 0.01705,    0.042,       1.5,         24,         0.05};
  for (Surface* s : {&a.aileron, &a.elevator, &a.rudder}) *s = {40 * deg, 8.7, 0.01, 0, false};
  a.limits = {12, 17, 27, 45 * deg, 25 * deg, -20 * deg, 5, 3, 0.57};
  return a;
}

struct Flown : Bench<Lqr> {
  Flown() {
    params.airframe.value = anaconda();
    params.airframe.is_given = true;
    params.origin.value.alt_msl_m = field_m;
    configure();
  }
  void see(const VehicleState& state, const GuidanceCommand& command) {
    set(in.state, state);
    set(in.command, command);
  }
  Status fly(double dt = 0.01) {
    Status status = Status::ok;
    REQUIRE(allocations([&] { status = step(dt); }) == 0);
    REQUIRE(validation_error() == "");
    return status;
  }
  Eigen::Vector4d u() const {
    const Actuators& a = out.actuators;
    return {a.throttle_frac, a.elevator_rad, a.aileron_rad, a.rudder_rad};
  }
};

GuidanceCommand cruise(double course_rad = 0) {
  GuidanceCommand command;
  command.course_rad = course_rad;
  command.height_m = 70;
  command.airspeed_mps = 17;
  return command;
}

/// State in calm air.
VehicleState flying(double Va = 17, double course_rad = 0, double roll_rad = 0) {
  VehicleState s;
  s.height_m = 70;
  s.airspeed_mps = s.ground_speed_mps = Va;
  s.course_rad = s.yaw_rad = course_rad;
  s.roll_rad = roll_rad;
  s.pitch_rad = s.alpha_rad = 0.0054;
  s.origin_altitude_m = field_m;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = s.wind_valid =
      true;
  return s;
}

/// The nonlinear aircraft in calm air, 100 Hz.
struct Flight {
  Flown lqr;
  Airframe a = anaconda();
  RigidBody x;
  double Omega = 560, t = 0;
  Deflections d{0, 0.1212, 0};
  GuidanceCommand command = cruise();
  bool known = true;
  VehicleState state;

  Flight() {
    x.p_n.z() = -70;
    x.v_n.x() = 17;
    look();
    lqr.see(state, command);
    lqr.activate();
  }
  void look() {
    const Euler e = euler_from(x.q_nb);
    const AirData air(x.q_nb.conjugate() * x.v_n);
    state = flying(air.Va, std::atan2(x.v_n.y(), x.v_n.x()), e.roll_rad);
    state.pitch_rad = e.pitch_rad;
    state.yaw_rad = e.yaw_rad;
    state.ground_speed_mps = x.v_n.head<2>().norm();
    state.height_m = -x.p_n.z();
    state.climb_rate_mps = -x.v_n.z();
    state.alpha_rad = air.alpha;
    state.beta_rad = air.beta;
    state.rate_radps = from_eigen<Body>(x.omega_b);
    state.attitude_valid = known;
    if (!known) {
      state.roll_rad = state.pitch_rad = state.alpha_rad = 0;
      state.rate_radps = {};
    }
  }
  void air(double dt) {
    Eigen::Matrix3d J = Eigen::Vector3d(a.inertia.xx_kgm2, a.inertia.yy_kgm2, a.inertia.zz_kgm2).asDiagonal();
    J(0, 2) = J(2, 0) = -a.inertia.xz_kgm2;
    const double lag = 1 - std::exp(-dt / 0.02), density = standard_air(field_m - x.p_n.z()).density_kgm3;
    const Actuators& u = lqr.out.actuators;
    d.aileron += lag * (u.aileron_rad - d.aileron);
    d.elevator += lag * (u.elevator_rad - d.elevator);
    d.rudder += lag * (u.rudder_rad - d.rudder);
    const Propeller propeller(a.propulsion);
    Omega +=
        (propeller.steady_speed(u.throttle_frac, x.v_n.norm(), density) - Omega) * (1 - std::exp(-dt / 0.05));
    const auto load_at = [&](const RigidBody& b, double) {
      const Eigen::Vector3d v_b = b.q_nb.conjugate() * b.v_n;
      Load load = Aerodynamic(a).load(v_b, b.omega_b, d, density);
      load.force_b.x() += propeller.thrust(Omega, v_b.norm(), density);
      load.moment_b.x() -= propeller.torque(Omega, v_b.norm(), density);
      return load;
    };
    x = runge_kutta(x, load_at(x, 0), dt, {a.mass_kg, J}, {0, 0, isa::g0}, load_at);
  }
  template <class Observe>
  void run(double seconds, Observe observe) {
    for (const double end = t + seconds; t < end - 1e-9; t += 0.01) {
      look();
      lqr.see(state, command);
      REQUIRE(lqr.fly() == (known ? Status::ok : Status::degraded));
      air(0.01);
      observe();
    }
  }
  void run(double seconds) {
    run(seconds, [] {});
  }
};

using Square = Eigen::Matrix<double, X::n, X::n>;
/// True if all eigenvalues of `A` lie left of -`rate`: Cayley's transform maps that half plane into the unit
/// circle.
bool decays(Square A, double rate) {
  const Square I = Square::Identity();
  A += rate * I;
  Square M = (I + 0.1 * A) * Square((I - 0.1 * A).partialPivLu().inverse());
  for (int i = 0; i < 20; ++i) M = (M * M).eval();
  return M.norm() < 1e-6;
}

}  // namespace

TEST_CASE("the Riccati equation of a scalar and of a double integrator has its closed form") {
  using Scalar = Eigen::Matrix<double, 1, 1>;
  Scalar x;  // x = r/b^2 (a + sqrt(a^2 + q b^2/r))
  REQUIRE(riccati<1, 1>(Scalar(0.7), Scalar(2.0), Scalar(3.0), Scalar(0.5), x));
  CHECK(x(0) == doctest::Approx(0.5 / 4 * (0.7 + std::sqrt(0.49 + 3.0 * 4 / 0.5))));
  for (const double q : {0.01, 1.0, 400.0}) {  // K = (sqrt(q), sqrt(2 sqrt(q)))
    const Eigen::Matrix2d A = (Eigen::Matrix2d() << 0, 1, 0, 0).finished();
    const Eigen::Matrix2d Q = Eigen::Vector2d(q, 1e-12).asDiagonal();
    Eigen::Matrix2d solution;
    REQUIRE(riccati<2, 1>(A, Eigen::Vector2d(0, 1), Q, Scalar(1.0), solution));
    CHECK(solution(1, 0) == doctest::Approx(std::sqrt(q)));
    CHECK(solution(1, 1) == doctest::Approx(std::sqrt(2 * std::sqrt(q))));
  }
}

TEST_CASE("the solution leaves no residual, and what it closes is stable, with a course and without") {
  const Plant plant = Plant::linearised(anaconda(), rho);
  const Square Q = Square::Identity();
  const Eigen::Matrix4d R = Eigen::Vector4d(3, 20, 50, 50).asDiagonal();
  Square x;
  REQUIRE(riccati<X::n, X::m>(plant.A, plant.B, Q, R, x));
  const Lqr::Gain gain = R.inverse() * plant.B.transpose() * x;
  CHECK((plant.A.transpose() * x + x * plant.A - gain.transpose() * R * gain + Q).norm() < 1e-10);
  CHECK(decays(plant.A - plant.B * gain, 0.05));

  Flown lqr;
  Lqr::Gain K = lqr.component().gain();
  const auto& model = lqr.component().plant();
  CHECK(decays(model.A - model.B * K, 0.1));
  CHECK_FALSE(decays(model.A, 0));
  CHECK_FALSE(decays(model.A - model.B * K, 0.13));  // an integral of 8 s is no faster
  K.col(X::chi).setZero();
  K.col(X::int_chi).setZero();  // an acceleration is commanded: course is not fed back
  Square closed = model.A - model.B * K;
  closed(X::chi, X::chi) = closed(X::int_chi, X::int_chi) = -1;
  CHECK(decays(closed, 0.1));
}

TEST_CASE("the model has the derivatives of Beard & McLain, tables 5.1 and 5.2") {
  const Airframe a = anaconda();
  const Plant plant = Plant::linearised(a, rho);
  const double V = 17, S = a.wing.area_m2, b = a.wing.span_m, c = a.wing.chord_m, qS = rho * V * V * S / 2;
  const double Gamma = a.inertia.xx_kgm2 * a.inertia.zz_kgm2 - a.inertia.xz_kgm2 * a.inertia.xz_kgm2;
  const double G3 = a.inertia.zz_kgm2 / Gamma, G4 = a.inertia.xz_kgm2 / Gamma, G8 = a.inertia.xx_kgm2 / Gamma;
  const auto &l = a.aero.roll, &n = a.aero.yaw, &Y = a.aero.side, &M = a.aero.pitch;
  const auto same = [](double is, double should) { CHECK(is == doctest::Approx(should).epsilon(1e-3)); };
  same(plant.A(X::p, X::p), rho * V * S * b * b / 4 * (G3 * l.p_ratio + G4 * n.p_ratio));
  same(plant.A(X::p, X::r), rho * V * S * b * b / 4 * (G3 * l.r_ratio + G4 * n.r_ratio));
  same(plant.A(X::r, X::r), rho * V * S * b * b / 4 * (G4 * l.r_ratio + G8 * n.r_ratio));
  same(plant.A(X::p, X::beta), qS * b * (G3 * l.beta_ratio + G4 * n.beta_ratio));
  same(plant.A(X::r, X::beta), qS * b * (G4 * l.beta_ratio + G8 * n.beta_ratio));
  same(plant.B(X::p, X::aileron), qS * b * (G3 * l.aileron_ratio + G4 * n.aileron_ratio));
  same(plant.B(X::r, X::rudder), qS * b * (G4 * l.rudder_ratio + G8 * n.rudder_ratio));
  same(plant.B(X::beta, X::rudder), qS * Y.rudder_ratio / (a.mass_kg * V));
  same(plant.A(X::q, X::q), rho * V * S * c * c / 4 * M.q_ratio / a.inertia.yy_kgm2);
  same(plant.A(X::q, X::alpha), qS * c * M.alpha_ratio / a.inertia.yy_kgm2);
  same(plant.B(X::q, X::elevator), qS * c * M.elevator_ratio / a.inertia.yy_kgm2);
  same(plant.A(X::V, X::theta), -isa::g0);
  same(plant.A(X::h, X::theta), V);
  same(plant.A(X::h, X::alpha), -V);
  CHECK(plant.B(X::V, X::throttle) > 5);
  CHECK(plant.A(X::chi, X::phi) == doctest::Approx(isa::g0 / V).epsilon(0.01));
  CHECK(Plant::derivative(a, plant.x0, plant.u0, rho).norm() < 1e-8);
}

TEST_CASE("an aircraft that cannot fly level at its cruise speed is refused, and so is none") {
  Bench<Lqr> bench;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == Lqr::airframe_missing);
  bench.params.airframe.value = anaconda();
  bench.params.airframe.is_given = true;
  bench.params.airframe.value.mass_kg = 40;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == Plant::level_flight_missing);
}

TEST_CASE("it goes on from what was applied last: either way, off the cruise speed, heading north") {
  for (const double side : {1.0, -1.0})
    for (const double Va : {13.0, 17.0, 24.0})
      for (const double course : {0.0, 0.02, -0.02, 180 * deg}) {
        Flown lqr;
        GuidanceCommand command = cruise(wrap_pi(course + 0.1 * side));
        if (Va > 20) command.lateral = LateralMode::acceleration;
        lqr.see(flying(Va, course, 0.5 * side), command);
        Lqr::Outputs last;
        last.attitude = {0.5 * side, 0.1, 0.7};
        last.actuators = {0.7, 0.12 * side, 0.1 - 0.08 * side, -0.05 * side};
        REQUIRE(lqr.activate(last) == Status::ok);
        lqr.fly();
        CHECK((lqr.u() - Eigen::Vector4d(0.7, 0.1 - 0.08 * side, 0.12 * side, -0.05 * side)).norm() < 1e-9);
        const Eigen::Vector4d first = lqr.u();
        lqr.fly();
        CHECK((lqr.u() - first).cwiseAbs().maxCoeff() < 0.05);
        for (int i = 0; i < 1000; ++i) lqr.fly();
        CHECK(lqr.out.bump_ratio.value < 1e-3);
      }
}

TEST_CASE("when nobody flew it begins at trim, without a bump or an integral") {
  Flown lqr;
  lqr.see(flying(), cruise());
  REQUIRE(lqr.activate() == Status::ok);
  lqr.fly();
  CHECK((lqr.u() - lqr.component().plant().u0).norm() < 0.02);
  CHECK(lqr.out.bump_ratio.value == 0);
}

TEST_CASE("the course wraps through north, and it turns the shorter way") {
  const auto response = [](double course, double wanted) {
    Flown lqr;
    lqr.see(flying(17, course), cruise(wanted));
    lqr.activate();
    lqr.fly();
    return lqr.u();
  };
  const Eigen::Vector4d east = response(90 * deg, 100 * deg);
  CHECK(east(X::aileron) > 0.02);
  CHECK((response(-5 * deg, 5 * deg) - east).norm() < 1e-9);
  CHECK((response(355 * deg, 5 * deg) - east).norm() < 1e-9);
  CHECK((response(175 * deg, -175 * deg) - east).norm() < 1e-9);
  CHECK(response(-175 * deg, 175 * deg)(X::aileron) < -0.02);
}

TEST_CASE("new weights are a new gain and no step of a surface, without memory") {
  Flown lqr;
  lqr.see(flying(16, 0.05, 0.1), cruise());
  lqr.activate();
  for (int i = 0; i < 50; ++i) lqr.fly();
  const Eigen::Vector4d before = lqr.u();
  const Lqr::Gain gain = lqr.component().gain();
  lqr.params.height.value = 0.3;
  lqr.params.aileron.value = 0.5;
  REQUIRE(allocations([&] { lqr.retune(); }) == 0);
  CHECK((lqr.component().gain() - gain).norm() > 0.5);
  lqr.fly();
  CHECK((lqr.u() - before).norm() < 1e-9);
}

TEST_CASE("for any input the outputs are finite and within throws") {
  Flown lqr;
  for (int i = 0; i < 3000; ++i) {
    const auto wave = [&](double k) { return std::sin(k * i); };
    VehicleState s = flying(15 + 15 * wave(0.11), wrap_pi(0.07 * i), 3 * wave(0.05));
    s.pitch_rad = 1.5 * wave(0.03);
    s.alpha_rad = wave(0.17);
    s.beta_rad = wave(0.13);
    s.rate_radps = {5 * wave(0.2), 5 * wave(0.3), 5 * wave(0.4)};
    s.height_m = 1000 * wave(0.01);
    s.attitude_valid = i % 7 != 0;
    s.velocity_valid = i % 5 != 0;
    s.height_valid = i % 11 != 0;
    s.airspeed_valid = i % 13 != 0;
    s.wind_valid = i % 3 != 0;
    GuidanceCommand c = cruise(wrap_pi(0.2 * i));
    c.airspeed_mps = 60 * wave(0.02);
    c.climb_rate_mps = 30 * wave(0.06);
    c.lateral = i % 100 < 50 ? LateralMode::course : LateralMode::acceleration;
    c.roll_feedforward_rad = 2 * wave(0.08);
    c.lateral_acceleration_mps2 = 100 * wave(0.09);
    lqr.see(s, c);
    if (i % 200 == 0) lqr.activate();
    lqr.fly(i % 17 == 0 ? 3.0 : 0.01);
    CHECK(std::abs(lqr.out.actuators.aileron_rad) <= 40 * deg);
  }
}

TEST_CASE("course, height and airspeed are reached and kept") {
  Flight flight;
  flight.run(20);
  flight.command = {90 * deg, 80, 0, 19, 0, LateralMode::course, 0};
  double furthest = 0, highest = 0, slip = 0, bank = 0;
  flight.run(30, [&] {
    furthest = std::max(furthest, flight.state.course_rad);
    highest = std::max(highest, flight.state.height_m);
    slip = std::max(slip, std::abs(flight.state.beta_rad));
    bank = std::max(bank, flight.state.roll_rad);
  });
  CHECK(furthest < 93 * deg);
  CHECK(highest < 80.6);
  CHECK(slip < 6 * deg);
  CHECK(bank < 50 * deg);
  CHECK(std::abs(flight.state.course_rad - 90 * deg) < 0.3 * deg);
  CHECK(std::abs(flight.state.height_m - 80) < 0.1);
  CHECK(std::abs(flight.state.airspeed_mps - 19) < 0.05);
}

TEST_CASE("an acceleration turns the course by a/V, either way, and costs little height") {
  for (const double a : {5.0, -5.0}) {
    Flight flight;
    flight.command.lateral = LateralMode::acceleration;
    flight.command.lateral_acceleration_mps2 = a;
    flight.run(20);
    const double course = flight.state.course_rad;
    double sag = 0;
    flight.run(4, [&] { sag = std::max(sag, std::abs(flight.state.height_m - 70)); });
    CHECK(wrap_pi(flight.state.course_rad - course) == doctest::Approx(wrap_pi(4 * a / 17)).epsilon(0.03));
    CHECK(sag < 0.3);
  }
}

TEST_CASE("what a limit held back is not wound up") {
  Flight flight;
  flight.command.height_m = 270;  // 40 s at the climb limit
  flight.run(30);
  CHECK(flight.state.climb_rate_mps == doctest::Approx(5).epsilon(0.1));
  double highest = 0;
  flight.run(40, [&] { highest = std::max(highest, flight.state.height_m); });
  CHECK(highest < 271);
  CHECK(flight.state.height_m == doctest::Approx(270).epsilon(0.001));

  Flown lqr;  // after a minute of saturation the throttle responds within a second
  GuidanceCommand command = cruise();
  command.airspeed_mps = 27;
  lqr.see(flying(15), command);
  lqr.activate();
  for (int i = 0; i < 6000; ++i) lqr.fly();
  CHECK(lqr.out.actuators.throttle_frac == 1);
  CHECK(lqr.out.saturated_ratio.value >= 1);
  lqr.see(flying(18), cruise());
  lqr.fly();
  CHECK(lqr.out.actuators.throttle_frac < 0.7);
}

TEST_CASE("blind in a turn it comes level by the model, without a step, and flies on when it sees again") {
  for (const double side : {1.0, -1.0}) {
    Flight flight;
    flight.command.lateral = LateralMode::acceleration;
    flight.command.lateral_acceleration_mps2 = side * isa::g0 * std::tan(40 * deg);
    flight.run(15);
    CHECK(flight.state.roll_rad == doctest::Approx(side * 40 * deg).epsilon(0.05));
    Eigen::Vector4d before = flight.lqr.u();
    double step = 0;
    const auto smooth = [&] {
      step = std::max(step, (flight.lqr.u() - before).cwiseAbs().maxCoeff());
      before = flight.lqr.u();
    };
    flight.known = false;
    flight.run(3, smooth);
    CHECK(std::abs(euler_from(flight.x.q_nb).roll_rad) < 12 * deg);
    flight.known = true;
    flight.command = cruise();
    flight.run(0.02, smooth);
    CHECK(step < 0.05);  // as it rolls into a turn
    flight.run(20);
    CHECK(std::abs(flight.state.roll_rad) < 1 * deg);
    CHECK(std::abs(flight.state.height_m - 70) < 0.5);
  }
}

TEST_CASE("on the ground the engine is off") {
  Flown lqr;
  lqr.see(VehicleState{}, cruise());
  CHECK(lqr.fly() == Status::ok);
  CHECK(lqr.u().norm() == 0);
}
