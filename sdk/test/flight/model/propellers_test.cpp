// SPDX-License-Identifier: BSD-3-Clause
// Propellers at their places: forces and moments by hand, differential thrust, trim and the linear model.
#include "fulmar/flight/model/propellers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "fulmar/flight/model/linear_model.hpp"
#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/sim/plant.hpp"
#include "sdk/test/sim/anaconda.hpp"

namespace propellers_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.0025, Va = 17;

PropellerPlace at(double x, double y, double z, Turns turns = Turns::right) {
  PropellerPlace p;
  p.at_m = {x, y, z};
  p.turns = turns;
  return p;
}

/// The Anaconda with these propellers, each with half its power.
Airframe with(std::initializer_list<PropellerPlace> places) {
  Airframe a = anaconda();
  for (const PropellerPlace& p : places) a.propulsion.propellers.push_back(p);
  return a;
}

/// Left and right propeller with opposite rotation.
Airframe twin(double differential = 0) {
  PropellerPlace left = at(0.2, -0.5, 0, Turns::right), right = at(0.2, 0.5, 0, Turns::left);
  left.differential_frac = right.differential_frac = differential;
  return with({left, right});
}

struct Pushed {
  Vector3d force, moment;  ///< minus those of the aircraft with an idle propeller
  double thrust, torque;   ///< of one propeller
};

/// Load in still air at `Va` with the propellers at the speed of `throttle`.
Pushed pushed(const Airframe& a, double throttle) {
  const auto felt = [&](const Airframe& airframe, double& Omega) {
    Plant plant(airframe, {}, 1387, 1);
    RigidBody x;
    x.p_n.z() = -300;
    x.v_n.x() = Va;
    for (int i = 0; i < 400; ++i) {
      plant.set_state(x);
      plant.advance({throttle, 0, 0, 0}, 1, dt);
    }
    plant.set_state(x);
    Omega = plant.propeller_radps();
    const Vector3d force = a.mass_kg * plant.specific_force();
    constexpr double short_s = 1e-6;
    plant.advance({throttle, 0, 0, 0}, 1, short_s);
    return std::pair<Vector3d, Vector3d>(force, inertia_matrix(a.inertia) * plant.state().omega_b / short_s);
  };
  Airframe none = a;
  Propulsion& p = none.propulsion;
  p.ct0_ratio = p.ct1_ratio = p.ct2_ratio = 0;
  p.cq0_ratio = 1e-9;
  p.cq1_ratio = p.cq2_ratio = 0;
  double Omega = 0, other = 0;
  const auto all = felt(a, Omega), rest = felt(none, other);
  const Propeller propeller(a.propulsion);
  const double rho = standard_air(1387 + 300).density_kgm3;
  return {all.first - rest.first, all.second - rest.second, propeller.thrust(Omega, Va, rho),
          propeller.torque(Omega, Va, rho)};
}

}  // namespace

TEST_CASE("one propeller on the x axis, given or not, is the same aircraft") {
  Plant said(with({at(0.3, 0, 0)}), {}, 1387, 1), unsaid(anaconda(), {}, 1387, 1);
  for (Plant* p : {&said, &unsaid}) {
    REQUIRE(p->fly({0, 0, -300}, 0, Va));
    for (int i = 0; i < 400; ++i) p->advance({0.7, 0.02, 0.1, -0.02}, 1, dt);
  }
  CHECK((said.state().p_n - unsaid.state().p_n).norm() < 1e-9);
  CHECK((said.state().omega_b - unsaid.state().omega_b).norm() < 1e-9);
}

TEST_CASE("a thrust line beside the centre of gravity turns by thrust times arm") {
  for (const double z : {-0.2, 0.15}) {  // above: nose down
    const Pushed p = pushed(with({at(-0.3, 0, z)}), 0.8);
    CHECK(p.thrust > 5);
    CHECK(p.force.x() / p.thrust == Approx(1).epsilon(1e-6));
    CHECK(p.moment.y() / (z * p.thrust) == Approx(1).epsilon(1e-3));
  }
  for (const double y : {-0.4, 0.4}) {  // on the right: nose left
    const Pushed p = pushed(with({at(0, y, 0)}), 0.8);
    CHECK(p.moment.z() / (-y * p.thrust) == Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("torque rolls against the propeller's sense; two that turn against each other do not roll") {
  const Pushed right = pushed(with({at(0.2, 0, 0, Turns::right)}), 0.8);
  const Pushed left = pushed(with({at(0.2, 0, 0, Turns::left)}), 0.8);
  CHECK(right.torque > 0.05);
  CHECK(right.moment.x() / -right.torque == Approx(1).epsilon(1e-3));
  CHECK(left.moment.x() / left.torque == Approx(1).epsilon(1e-3));
  const Pushed two = pushed(twin(), 0.8);
  CHECK(two.moment.norm() / two.torque < 1e-3);
  CHECK(two.force.x() / (2 * two.thrust) == Approx(1).epsilon(1e-6));
}

TEST_CASE("an axis tilts up and toes right: force and torque go along") {
  PropellerPlace p = at(0.3, 0.1, -0.2);
  for (const double tilt : {0.2, -0.3})
    for (const double toe : {0.15, -0.25}) {
      p.tilt_rad = tilt;
      p.toe_rad = toe;
      const Pushed f = pushed(with({p}), 0.8);
      const Vector3d axis(std::cos(tilt) * std::cos(toe), std::cos(tilt) * std::sin(toe), -std::sin(tilt));
      CHECK((f.force / f.thrust - axis).norm() < 1e-6);
      const Vector3d moment = Vector3d(0.3, 0.1, -0.2).cross(f.thrust * axis) - f.torque * axis;
      CHECK((f.moment - moment).norm() / moment.norm() < 2e-3);
      CHECK(f.force.z() * tilt < 0);  // up
      CHECK(f.force.y() * toe > 0);   // right
    }
}

TEST_CASE("many propellers are the sum of each") {
  Airframe a = anaconda();
  Vector3d axes = Vector3d::Zero(), arms = Vector3d::Zero(), spins = Vector3d::Zero();
  for (int i = 0; i < 8; ++i) {
    PropellerPlace p = at(0.1 * i, 0.3 * i - 1, -0.05 * i, i % 3 == 0 ? Turns::left : Turns::right);
    p.tilt_rad = 0.1 * i - 0.3;
    p.toe_rad = 0.2 - 0.06 * i;
    REQUIRE(a.propulsion.propellers.push_back(p));
    const Vector3d axis(std::cos(p.tilt_rad) * std::cos(p.toe_rad),
                        std::cos(p.tilt_rad) * std::sin(p.toe_rad), -std::sin(p.tilt_rad));
    axes += axis;
    arms += Vector3d(p.at_m.x, p.at_m.y, p.at_m.z).cross(axis);
    spins += i % 3 == 0 ? -axis : axis;
  }
  CHECK_FALSE(a.propulsion.propellers.push_back({}));
  Load load;
  Propellers(a).add<double>(7.0, 0.3, load);
  CHECK((load.force_b - 7 * axes).norm() / load.force_b.norm() < 1e-12);
  CHECK((load.moment_b - (7 * arms - 0.3 * spins)).norm() / load.moment_b.norm() < 1e-12);
  CHECK((Propellers(a).spin() - spins).norm() < 1e-12);
}

TEST_CASE("differential thrust yaws to the rudder's side, by the difference of thrust times arm") {
  const Airframe a = twin(0.3);
  const double limit = a.rudder.limit_rad, rho = standard_air(1387 + 300).density_kgm3;
  for (const double share : {0.5, -0.5, 1.0}) {
    const auto yaw = [&](const Airframe& airframe) {
      Airframe no_rudder = airframe;
      for (Derivatives* d : {&no_rudder.aero.yaw, &no_rudder.aero.roll, &no_rudder.aero.side})
        d->rudder_ratio = 0;
      Plant plant(no_rudder, {}, 1387, 1);
      RigidBody x;
      x.p_n.z() = -300;
      x.v_n.x() = Va;
      for (int i = 0; i < 400; ++i) {
        plant.set_state(x);
        plant.advance({0.6, 0, 0, share * limit}, 1, dt);
      }
      plant.set_state(x);
      constexpr double short_s = 1e-6;
      plant.advance({0.6, 0, 0, share * limit}, 1, short_s);
      return Vector3d(inertia_matrix(a.inertia) * plant.state().omega_b / short_s);
    };
    const Vector3d moment = yaw(a) - yaw(twin(0));
    const Propeller p(a.propulsion);
    const auto thrust = [&](double throttle) { return p.thrust(p.steady_speed(throttle, Va, rho), Va, rho); };
    const double more = thrust(0.6 + 0.3 * share), less = thrust(0.6 - 0.3 * share);
    CHECK(moment.z() / (-0.5 * (more - less)) == Approx(1).epsilon(2e-3));
    CHECK(moment.z() * share < 0);  // positive rudder: nose left
  }
}

TEST_CASE("a share of the rudder is that of the command: a rudder that is stuck leaves it") {
  Plant plant(twin(0.3), {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0, Va));
  Fault stuck;
  stuck.kind = FaultKind::stuck;
  plant.suffer({}, {}, stuck);
  for (int i = 0; i < 200; ++i) plant.advance({0.6, 0, 0.1, 0.5 * anaconda().rudder.limit_rad}, 1, dt);
  CHECK(plant.propeller_radps(1) > 1.1 * plant.propeller_radps(0));
  for (int i = 0; i < 2000; ++i) plant.advance({0.6, 0, 0.1, 0.3}, 0, dt);  // unpowered
  CHECK(plant.propeller_radps(0) < 60);
  CHECK(plant.battery_amp() == 0);
}

TEST_CASE("a twin trims on its propellers alone, and flies level with this trim") {
  Airframe a = twin(0.3);
  for (Derivatives* d : {&a.aero.yaw, &a.aero.roll, &a.aero.side}) d->rudder_ratio = 0;
  a.aero.yaw.zero_ratio = 0.002;  // a yawing moment to balance
  const AircraftModel model(a, 1387 + 300);
  const SteadyFlight f = steady_flight(model, {.airspeed_mps = Va});
  REQUIRE(f.found());
  CHECK(f.input(model::rudder) > 0.005);  // balances the moment to the left
  CHECK(std::abs(f.x(model::roll)) < 1e-9);
  Plant plant(a, {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0.3, Va));
  const double throttle = f.input(model::throttle);
  for (int i = 0; i < 2000; ++i)
    plant.advance({throttle, f.input(model::aileron), f.input(model::elevator), f.input(model::rudder)}, 1,
                  dt);
  CHECK(-plant.state().p_n.z() == Approx(300).epsilon(0.002));
  CHECK(plant.air_velocity_b().norm() == Approx(Va).epsilon(0.005));
  CHECK(plant.state().omega_b.norm() < 0.02);
}

TEST_CASE(
    "the linear model includes the places of the propellers: its columns are finite differences of it") {
  Airframe a = twin(0.25);
  a.propulsion.propellers[0].at_m.z = a.propulsion.propellers[1].at_m.z = -0.2;
  a.propulsion.pack.resistance_ohm = 0.05;
  const AircraftModel model(a, 1687);
  const SteadyFlight f = steady_flight(model, {.airspeed_mps = Va});
  REQUIRE(f.found());
  const LinearModel linear = linear_model(model, f.x, f.input);
  for (const int input : {int(model::rudder), int(model::throttle)}) {
    model::InputVector<double> up = f.input, down = f.input;
    up(input) += 1e-5;
    down(input) -= 1e-5;
    const model::StateVector<double> column =
        (model.rate<double>(f.x, up) - model.rate<double>(f.x, down)) / 2e-5;
    CHECK((linear.B.col(input) - column).norm() / column.norm() < 1e-5);
  }
  CHECK(linear.B(model::q, model::throttle) < -1);  // thrust above: nose down
  const double rudder_alone = [&] {
    const AircraftModel plain(twin(0), 1687);
    const SteadyFlight g = steady_flight(plain, {.airspeed_mps = Va});
    return linear_model(plain, g.x, g.input).B(model::r, model::rudder);
  }();
  CHECK(linear.B(model::r, model::rudder) < 1.1 * rudder_alone);  // both nose left, with a larger sum
}

}  // namespace propellers_test
