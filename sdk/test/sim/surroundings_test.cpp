// SPDX-License-Identifier: BSD-3-Clause
// Gusts, thermals, sloping ground, ground effect, angular momentum of the propeller, and departures from the
// model.
#include <doctest/doctest.h>

#include <limits>
#include <numbers>

#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/sim/plant.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace surroundings_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.0025, g = 9.80665, pi = std::numbers::pi;

const Airframe& anaconda() {
  static const Airframe airframe = test::airframe_file("anaconda");
  return airframe;
}

Plant plant(const Airframe& a = anaconda(), const Weather& weather = {}, const Earth& earth = {}) {
  return Plant(a, weather, 1387, 1, earth);
}

Earth sloping(double angle, double towards, double friction = 1) {
  return {EarthModel::flat, 0, 0, {angle, towards, friction, false}};
}

void run(Plant& p, double seconds, const Actuators& a = {}) {
  for (int i = 0; i < std::lround(seconds / dt); ++i) p.advance(a, true, dt);
}

/// No air forces, no thrust: a rigid body with a motor.
Airframe bare(double propeller_inertia) {
  Airframe a = anaconda();
  a.aero = {};
  a.wing.stall_alpha_rad = 10;
  a.propulsion.ct0_ratio = a.propulsion.ct1_ratio = a.propulsion.ct2_ratio = 0;
  a.propulsion.propeller_inertia_kgm2 = propeller_inertia;
  return a;
}

}  // namespace

TEST_CASE("a gust is 1 - cos of the way through the air, in every shape") {
  const GustSpec pulse{{2, -3, -6}, 30, GustShape::pulse}, rise{{2, -3, -6}, 30, GustShape::rise};
  for (const GustSpec& spec : {pulse, rise}) {
    Gust gust;
    CHECK_FALSE(gust.active());
    gust.fire(spec);
    for (int i = 1; i <= 100; ++i) {
      const double s = 0.9 * i, Va = i % 2 ? 18.0 : 12.0;  // m
      const Vector3d v = gust.advance(0.9 / Va, Va);
      const double part = s < 30                          ? std::pow(std::sin(pi * s / 60), 2)
                          : spec.shape == GustShape::rise ? 1
                          : s < 60                        ? std::pow(std::sin(pi * s / 60), 2)
                                                          : 0;
      CHECK((v - part * Vector3d(2, -3, -6)).norm() < 1e-9);
    }
    CHECK(gust.active() == (spec.shape == GustShape::rise));
  }
}

TEST_CASE("an aircraft meets the gust where it is fired, and the truth's wind shows it") {
  Plant p = plant(), calm = plant();
  for (Plant* each : {&p, &calm}) REQUIRE(each->fly({0, 0, -200}, 0.4, 17));
  const Actuators a{0.57, 0, 0.12, 0};
  run(p, 1, a);
  run(calm, 1, a);
  CHECK(p.state().v_n == calm.state().v_n);
  p.fire({{0, 0, -4}, 20, GustShape::pulse});  // from below
  double most = 0, s = 0;
  for (int i = 0; i < 2000; ++i) {
    s += dt * p.air_velocity_b().norm();
    p.advance(a, true, dt);
    calm.advance(a, true, dt);
    const Vector3d wind_b = p.state().q_nb.conjugate() * p.wind_n();
    const double expected = s < 40 ? -4 * std::pow(std::sin(pi * s / 40), 2) : 0;
    CHECK(wind_b.z() == Approx(expected).epsilon(1e-9).scale(4));
    most = std::max(most, std::abs(wind_b.z()));
    if (i == 100) CHECK(p.state().v_n.z() < calm.state().v_n.z() - 0.1);  // carried up
  }
  CHECK(most == Approx(4).epsilon(1e-3));
}

TEST_CASE("a thermal lifts by its strength on the axis, and less as radius and height say") {
  Thermals t;
  t.thermals.count = 2;
  t.thermals.items[0] = {100, -50, 3, 60, 1000, false};
  t.thermals.items[1] = {2000, 0, -1, 80, 800, true};
  Updrafts u(t);
  const double strongest = 1000 / 4.4;
  CHECK(u.at({100, -50, -strongest}) == Approx(3));
  for (double h : {200.0, 260.0}) CHECK(u.at({100, -50, -h}) < 3);
  CHECK(u.at({160, -50, -strongest}) == Approx(3 / std::numbers::e));
  CHECK(u.at({100, 70, -strongest}) == Approx(3 / std::pow(std::numbers::e, 4)));
  // Lenschow & Stephens at z/zi 0.5 and 0.2: 0.7937 x 0.45 and 0.58480 x 0.78
  CHECK(u.at({100, -50, -500}) / u.at({100, -50, -200}) == Approx(0.357165 / 0.456144).epsilon(1e-4));
  CHECK(u.at({100, -50, 0}) == 0);
  CHECK(u.at({100, -50, 10}) == 0);
  CHECK(u.at({100, -50, -910}) == 0);
  CHECK(u.at({2000, 0, -800 / 4.4}) == Approx(-1));
  for (int i = 0; i < 100; ++i) u.drift(1, {-5, 2, 0});
  CHECK(u.at({1500, 200, -800 / 4.4}) == Approx(-1));
  CHECK(u.at({100, -50, -strongest}) == Approx(3));
  CHECK_FALSE(Updrafts().any());
}

TEST_CASE("a thermal's air is the wind of the truth and carries the aircraft up") {
  Weather w{{4, 0, 0}, Turbulence::none};
  w.thermals.thermals.count = 1;
  w.thermals.thermals.items[0] = {0, 0, 2.5, 5000, 880, true};
  Plant p = plant(anaconda(), w), still = plant(anaconda(), {{4, 0, 0}, Turbulence::none});
  for (Plant* each : {&p, &still}) {
    REQUIRE(each->fly({0, 0, -200}, 0, 17));
    run(*each, 8, {0.5667, 0.0041, 0.1212, 0});
  }
  const double n = p.state().p_n.x() - 32, e = p.state().p_n.y();  // drifted by 8 s of 4 m/s
  const double expected =
      2.5 * updraft_over_height(-p.state().p_n.z() / 880) * std::exp(-(n * n + e * e) / 25e6);
  CHECK(p.wind_n().z() == Approx(-expected).epsilon(1e-3));
  CHECK(p.wind_n().x() == Approx(4).epsilon(1e-6));
  CHECK(still.state().p_n.z() - p.state().p_n.z() > 10);  // of the 20 m that the air rises
  CHECK(still.state().p_n.z() - p.state().p_n.z() < 21);
}

TEST_CASE("on a slope with enough friction it stands without creeping, for any heading") {
  for (const double towards : {0.0, 2.1, -1.0}) {
    const double heading = towards + pi / 2;  // across
    Plant p = plant(anaconda(), {}, sloping(0.15, towards));
    p.stand(30, -20, heading);
    run(p, 3);
    const Vector3d there = p.state().p_n;
    run(p, 30);
    CHECK((p.state().p_n - there).norm() < 1e-3);
    CHECK_FALSE(p.crashed());
    CHECK(p.on_ground());
    CHECK(p.height_above_ground() == Approx(anaconda().gear.height_m).epsilon(0.02));
    // the plane rises by tan(0.15) of the way towards `towards`
    const double up = std::tan(0.15) * (30 * std::cos(towards) - 20 * std::sin(towards));
    CHECK(-there.z() - up == Approx(anaconda().gear.height_m / std::cos(0.15)).epsilon(0.1));
    const Vector3d nose = p.state().q_nb * Vector3d::UnitX();
    CHECK(std::remainder(std::atan2(nose.y(), nose.x()) - heading, 2 * pi) ==
          Approx(0).scale(1).epsilon(1e-3));
    const Vector3d felt = p.specific_force();  // the weight, in axes that lean
    CHECK(felt.norm() == Approx(g).epsilon(1e-3));
    CHECK(felt.y() / g == Approx(-std::sin(0.15)).epsilon(0.02));  // uphill is to its left
  }
}

TEST_CASE("set on a slope the nose has the given heading, with the wheels on the plane") {
  for (const double heading : {0.0, 0.7, 2.0, -2.5}) {
    Plant p = plant(anaconda(), {}, sloping(0.5, 1.0));
    p.stand(10, 5, heading);
    const Vector3d nose = p.state().q_nb * Vector3d::UnitX(), top = p.state().q_nb * -Vector3d::UnitZ();
    CHECK(std::remainder(std::atan2(nose.y(), nose.x()) - heading, 2 * pi) ==
          Approx(0).scale(1).epsilon(1e-9));
    CHECK(top.z() == Approx(-std::cos(0.5)));  // leans back from the rise, towards 1 rad
    CHECK(top.x() == Approx(-std::sin(0.5) * std::cos(1.0)));
    CHECK(p.height_above_ground() == Approx(anaconda().gear.height_m));
  }
}

TEST_CASE("turbulence goes with the height of the flight, up and down") {
  Weather w{{0, 0, 0}, Turbulence::moderate};
  w.turbulence_height = TurbulenceHeight::actual;
  Disturbances d(w, 5);
  CHECK(d.of_place());
  CHECK_FALSE(Disturbances({{0, 0, 0}, Turbulence::moderate}, 5).of_place());
  for (const double height : {700.0, 20.0, 150.0, 700.0}) {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 30000; ++i)
      sum += d.advance_at(20, 17, RigidBody{}, height, Vector3d::Zero()).cwiseAbs2() / 30000;
    const Vector3d expected = dryden_scales_at(Turbulence::moderate, height).sigma;
    for (int k = 0; k < 3; ++k) CHECK(std::sqrt(sum(k)) / expected(k) == Approx(1).epsilon(0.03));
  }
}

TEST_CASE("it rolls down as friction permits, nose uphill and downhill") {
  Airframe a = bare(0);
  for (const double heading : {0.0, pi}) {
    Plant p = plant(a, {}, sloping(0.12, 0));  // rises to the north
    p.stand(0, 0, heading);
    run(p, 1);
    const double v0 = p.state().v_n.norm();
    run(p, 1);
    const double expected = g * (std::sin(0.12) - 0.05 * std::cos(0.12));
    CHECK(p.state().v_n.norm() - v0 == Approx(expected).epsilon(0.02));
    CHECK(p.state().v_n.x() < -0.5);
    CHECK(p.state().v_n.z() / -p.state().v_n.x() == Approx(std::tan(0.12)).epsilon(0.02));
  }
  Plant holds = plant(a, {}, sloping(0.04, 0));  // tan 0.04 is less than 0.05
  holds.stand(0, 0, 0);
  run(holds, 2);
  const Vector3d there = holds.state().p_n;
  run(holds, 20);
  CHECK((holds.state().p_n - there).norm() < 1e-3);
  Plant slick = plant(a, {}, sloping(0.04, 0, 0.2));
  slick.stand(0, 0, 0);
  run(slick, 1);
  const double v0 = slick.state().v_n.norm();
  run(slick, 1);
  CHECK(slick.state().v_n.norm() - v0 == Approx(g * (std::sin(0.04) - 0.01 * std::cos(0.04))).epsilon(0.03));
}

TEST_CASE("across a slope it slides off on ice and not on grass") {
  for (const double friction : {1.0, 0.2}) {  // 0.6 and 0.12 sideways; tan 0.2 is 0.203
    Plant p = plant(bare(0), {}, sloping(0.2, 0, friction));
    p.stand(0, 0, pi / 2);
    run(p, 2);
    CHECK((p.state().v_n.norm() > 0.5) == (friction < 1));
  }
}

TEST_CASE("a slope is the ground to fly into") {
  Plant p = plant(anaconda(), {}, sloping(0.3, 0));
  REQUIRE(p.fly({0, 0, -30}, 0, 17));  // towards the hill, whose height there is 97 m after 313 m
  double t = 0;
  while (!p.crashed() && t < 20) {
    run(p, 0.1, {0.5667, 0.0041, 0.1212, 0});
    t += 0.1;
  }
  CHECK(p.crashed());
  CHECK(t == Approx(30 / std::tan(0.3) / 17).epsilon(0.05));
}

TEST_CASE("close to the ground the induced drag follows McCormick, and nothing else changes") {
  // (16 h/b)^2 / (1 + (16 h/b)^2) by hand: h/b = 0.1: 2.56 / 3.56
  CHECK(induced_drag_near_ground(0.2, 2) == Approx(0.719101).epsilon(1e-5));
  CHECK(induced_drag_near_ground(-1, 2) == 0);
  CHECK(induced_drag_near_ground(200, 2) == Approx(1).epsilon(1e-5));
  const Airframe& a = anaconda();
  Earth earth;
  earth.terrain.ground_effect = true;
  Plant with = plant(a, {}, earth), without = plant(a);
  const double h = 0.8;
  for (Plant* p : {&with, &without}) REQUIRE(p->fly({0, 0, -h}, 0, 17));
  const Vector3d v = with.air_velocity_b();
  const double alpha = std::atan2(v.z(), v.x()), q = 0.5 * with.air().density_kgm3 * v.squaredNorm();
  const double CL = a.aero.lift.zero_ratio + a.aero.lift.alpha_ratio * alpha;
  const double CDi = CL * CL / (pi * a.wing.oswald_ratio * a.wing.span_m * a.wing.span_m / a.wing.area_m2);
  const double x = 16 * h / a.wing.span_m, phi = x * x / (1 + x * x);
  const Vector3d gained = a.mass_kg * (with.specific_force() - without.specific_force());
  CHECK(gained.dot(v.normalized()) == Approx((1 - phi) * CDi * q * a.wing.area_m2).epsilon(0.01));
  CHECK(gained.cross(v.normalized()).norm() < 1e-3 * gained.norm());
  with.set_aerodynamics(a);  // as with ice that melts
  run(with, 0.1);
  run(without, 0.1);
  CHECK(with.state().v_n.x() > without.state().v_n.x());
}

TEST_CASE("a propeller that turns right yaws the nose to the right when it goes up, and back") {
  const Airframe a = bare(2e-4);
  for (const double q : {2.0, -2.0}) {
    Plant with = plant(a), without = plant(bare(0));
    for (Plant* p : {&with, &without}) {
      RigidBody x;
      x.p_n.z() = -500;
      p->set_state(x);
      run(*p, 2, {0.6, 0, 0, 0});  // spins up
      x.v_n = p->state().v_n;
      x.omega_b = {0, q, 0};
      p->set_state(x);
      p->advance({0.6, 0, 0, 0}, 1, dt);
    }
    const double Omega = with.propeller_radps();
    CHECK(Omega > 200);
    const Vector3d change = (with.state().omega_b - without.state().omega_b) / dt;
    CHECK(change.z() == Approx(2e-4 * Omega * q / a.inertia.zz_kgm2).epsilon(0.05));
    CHECK(std::abs(change.y()) < 0.05 * std::abs(change.z()));
  }
}

TEST_CASE("aircraft and propeller keep their angular momentum but for the torque of the air") {
  Airframe a = bare(3e-4);
  for (const double tau : {a.propulsion.time_constant_s, 0.0}) {
    a.propulsion.time_constant_s = tau;
    Plant p = plant(a);
    RigidBody x;
    x.p_n.z() = -5000;
    x.omega_b = {0.5, 0.8, -0.6};
    p.set_state(x);
    const Propeller propeller(a.propulsion);
    const Eigen::Matrix3d J = inertia_matrix(a.inertia);
    const auto momentum = [&] {
      return Vector3d(p.state().q_nb *
                      (J * p.state().omega_b + 3e-4 * p.propeller_radps() * Vector3d::UnitX()));
    };
    const auto torque = [&] {  // on the propeller, so on the whole
      return Vector3d(p.state().q_nb * (-propeller.torque(p.propeller_radps(), p.air_velocity_b().norm(),
                                                          p.air().density_kgm3) *
                                        Vector3d::UnitX()));
    };
    const Vector3d before = momentum();
    Vector3d impulse = Vector3d::Zero(), last = torque();
    double gained = 0;
    for (int i = 0; i < 800; ++i) {
      p.advance({i < 400 ? 1.0 : 0.2, 0, 0, 0}, 1, dt);
      const Vector3d now = torque();
      // without lag the speed jumps at the beginning of a step
      impulse += tau > 0 ? Vector3d(dt / 2 * (last + now)) : Vector3d(dt * now);
      last = now;
      gained = std::max(gained, 3e-4 * p.propeller_radps());
    }
    CHECK(gained > 0.1);
    CHECK((momentum() - before - impulse).norm() < 0.004 * gained);
  }
}

TEST_CASE("a trimmed turn counts the propeller's angular momentum, as the simulator does") {
  Airframe a = anaconda();
  a.propulsion.propeller_inertia_kgm2 = 1e-3;
  const AircraftModel with(a, 1387), without(anaconda(), 1387);
  const SteadyCondition turn{17, 0, Turn::bank, 0.6};
  const SteadyFlight f = steady_flight(with, turn), o = steady_flight(without, turn);
  REQUIRE(f.found());
  REQUIRE(o.found());
  // to the right the nose is pushed down: -I Omega r, balanced by more elevator
  const double q = 0.5 * f.density_kgm3 * 17 * 17 * a.wing.area_m2 * a.wing.chord_m;
  const double moment = -1e-3 * f.propeller_radps * f.x(model::r);
  CHECK((f.input(model::elevator) - o.input(model::elevator)) ==
        Approx(-moment / (q * a.aero.pitch.elevator_ratio)).epsilon(0.1));
}

TEST_CASE("a motion that is no number, or faster than anything that flies, has left the model") {
  Plant p = plant();
  REQUIRE(p.fly({0, 0, -200}, 0, 17));
  run(p, 1);
  CHECK(p.departure() == Departure::none);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double wrong : {nan, inf, -inf, 3e5}) {
    Plant q = p;
    RigidBody x = q.state();
    x.omega_b.y() = wrong;
    q.set_state(x);
    q.advance({}, 1, dt);
    CHECK(q.departure() == Departure::diverged);
    q.advance({}, 1, dt);
    CHECK(q.departure() == Departure::diverged);
  }
  for (int part = 0; part < 3; ++part)
    for (const double wrong : {nan, inf, 2e8}) {
      RigidBody x;
      CHECK_FALSE(diverged(x));
      (part == 0 ? x.p_n : part == 1 ? x.v_n : x.omega_b).z() = wrong;
      CHECK(diverged(x));
    }
}

}  // namespace surroundings_test
