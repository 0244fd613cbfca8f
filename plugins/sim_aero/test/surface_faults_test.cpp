// SPDX-License-Identifier: BSD-3-Clause
// Effect of failing surfaces, motor, battery and ice on the aircraft, against the equations by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "faulty.hpp"
#include "fulmar/sim/drive.hpp"

namespace surface_faults_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {
constexpr double dt = 0.0025, Va = 17;

struct Tunnel {  ///< an aircraft that is held in its trimmed flight: only surfaces and motor move
  Tunnel() : plant(anaconda(), {}, 1387, 1) {
    REQUIRE(plant.fly({0, 0, -300}, 0, Va));
    held = plant.state();
    trim = plant.deflections();
  }
  void fail(SurfaceFault aileron, SurfaceFault elevator, SurfaceFault rudder) {
    FaultParams p;
    p.body_that_fails.aileron_fault.value = aileron;
    p.body_that_fails.elevator_fault.value = elevator;
    p.body_that_fails.rudder_fault.value = rudder;
    const Faults faults = in_force(p);
    plant.suffer(faults[FaultTarget::aileron], faults[FaultTarget::elevator], faults[FaultTarget::rudder]);
  }
  void blow(double seconds, const Actuators& command) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) {
      plant.advance(command, 1, dt);
      plant.set_state(held);
    }
  }
  /// The moment about the centre of gravity, from the angular acceleration at zero body rate.
  Vector3d moment(const Actuators& command) {
    RigidBody still = held;
    still.omega_b.setZero();
    plant.set_state(still);
    constexpr double short_s = 1e-6;
    plant.advance(command, 1, short_s);
    const Vector3d acceleration = plant.state().omega_b / short_s;
    plant.set_state(held);
    const Inertia& I = anaconda().inertia;
    Eigen::Matrix3d J = Vector3d(I.xx_kgm2, I.yy_kgm2, I.zz_kgm2).asDiagonal();
    J(0, 2) = J(2, 0) = -I.xz_kgm2;
    return J * acceleration;
  }
  double qS() const { return 0.5 * plant.air().density_kgm3 * Va * Va * anaconda().wing.area_m2; }

  Plant plant;
  RigidBody held;
  Deflections trim;
};

const Actuators neutral{0.5, 0, 0, 0};
constexpr auto none = SurfaceFault::none;
}  // namespace

TEST_CASE("a surface that is stuck stays where it is, whatever is commanded") {
  Tunnel t;
  t.blow(0.5, {0.5, 0.1, 0.2, -0.1});
  t.fail(SurfaceFault::stuck, SurfaceFault::stuck, SurfaceFault::stuck);
  t.blow(0.5, {0.5, -0.5, -0.5, 0.5});
  const Deflections d = t.plant.deflections();
  CHECK(d.aileron == Approx(0.1).epsilon(1e-6).scale(0));
  CHECK(d.elevator == Approx(0.2).epsilon(1e-6).scale(0));
  CHECK(d.rudder == Approx(-0.1).epsilon(1e-6).scale(0));
  t.fail(none, none, none);
  t.blow(0.5, {0.5, -0.3, 0.3, 0});
  CHECK(t.plant.deflections().aileron == Approx(-0.3).epsilon(1e-6));
}

TEST_CASE("a surface that is hard over goes to its limit at its servo's speed, either way") {
  for (const bool positive : {true, false}) {
    const auto kind = positive ? SurfaceFault::hardover_positive : SurfaceFault::hardover_negative;
    const double sign = positive ? 1 : -1, limit = anaconda().aileron.limit_rad;
    Tunnel t;
    t.blow(0.5, neutral);
    t.fail(kind, kind, kind);
    t.blow(0.02, neutral);
    CHECK(std::abs(t.plant.deflections().aileron) <= anaconda().aileron.rate_limit_radps * 0.02 * (1 + 1e-9));
    t.blow(1, neutral);
    CHECK(sign * t.plant.deflections().aileron / limit == Approx(1));
    CHECK(sign * t.plant.deflections().elevator / limit == Approx(1));
    CHECK(sign * t.plant.deflections().rudder / limit == Approx(1));
  }
}

TEST_CASE("the moments of surfaces that are hard over are those of their derivatives, alike either way") {
  const Aerodynamics& c = anaconda().aero;
  const double limit = anaconda().aileron.limit_rad, b = anaconda().wing.span_m,
               chord = anaconda().wing.chord_m;
  const auto hard = [&](int surface, bool positive) {
    const auto kind = positive ? SurfaceFault::hardover_positive : SurfaceFault::hardover_negative;
    Tunnel t;
    t.fail(surface == 0 ? kind : none, surface == 1 ? kind : none, surface == 2 ? kind : none);
    t.blow(1, neutral);
    const Vector3d failed = t.moment(neutral);
    t.fail(none, none, none);
    t.blow(1, neutral);
    return Vector3d((failed - t.moment(neutral)) / (t.qS() * limit));
  };
  for (const bool positive : {true, false}) {
    const double sign = positive ? 1 : -1;
    CAPTURE(positive);
    CHECK(sign * hard(0, positive).x() / (b * c.roll.aileron_ratio) == Approx(1).epsilon(1e-3));
    CHECK(sign * hard(1, positive).y() / (chord * c.pitch.elevator_ratio) == Approx(1).epsilon(1e-3));
    CHECK(sign * hard(2, positive).z() / (b * c.yaw.rudder_ratio) == Approx(1).epsilon(1e-3));
  }
  for (int surface : {0, 1, 2})
    CHECK((hard(surface, true) + hard(surface, false)).norm() / hard(surface, true).norm() < 1e-3);
}

TEST_CASE("a surface that is lost has no moment; found again, it has") {
  Tunnel t, clean;
  const Actuators deflected{0.5, 0.3, -0.3, 0.3};
  t.fail(SurfaceFault::lost, SurfaceFault::lost, SurfaceFault::lost);
  t.blow(1, deflected);
  clean.blow(1, neutral);
  const Vector3d without = clean.moment(neutral);
  CHECK((t.moment(deflected) - without).norm() / without.norm() < 1e-3);
  t.fail(none, none, none);
  clean.blow(1, deflected);
  t.blow(1, deflected);
  const Vector3d with = clean.moment(deflected);
  CHECK((t.moment(deflected) - with).norm() / with.norm() < 1e-3);
}

TEST_CASE("a slow servo takes as many times as long as it has lost speed, rate and lag") {
  Tunnel right, slow;
  right.blow(0.5, neutral);
  slow.blow(0.5, neutral);
  slow.fail(SurfaceFault::slow, SurfaceFault::slow, none);
  const Actuators command{0.5, 0.4, -0.4, 0};
  for (int i = 0; i < 20; ++i) {
    right.blow(dt, command);
    slow.blow(10 * dt, command);  // 0.1 of the speed
    CHECK(slow.plant.deflections().aileron / right.plant.deflections().aileron == Approx(1).epsilon(1e-9));
    CHECK(slow.plant.deflections().elevator / right.plant.deflections().elevator == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE(
    "free surfaces trail with the flow: each by half its angle, in the sense that has no hinge moment") {
  Tunnel t;
  for (const double sign : {1.0, -1.0}) {
    const double alpha = sign * 0.08, beta = sign * 0.06, p = sign * 0.5;
    t.held.q_nb.setIdentity();
    t.held.v_n =
        Va * Vector3d(std::cos(alpha) * std::cos(beta), std::sin(beta), std::sin(alpha) * std::cos(beta));
    t.held.omega_b = {p, 0, 0};
    t.plant.set_state(t.held);
    t.fail(SurfaceFault::free, SurfaceFault::free, SurfaceFault::free);
    t.blow(1, {0.5, 0.4, 0.4, 0.4});
    const Deflections d = t.plant.deflections();
    CHECK(d.elevator / (-0.5 * alpha) == Approx(1).epsilon(0.02));  // flow from below: trailing edge up
    CHECK(d.rudder / (0.5 * beta) == Approx(1).epsilon(0.02));      // flow from the right: to the left
    CHECK(d.aileron / (0.5 * 0.35 * anaconda().wing.span_m * p / Va) == Approx(1).epsilon(0.02));
  }
}

TEST_CASE("a free elevator takes from the pitch stiffness what it would give: half its effect") {
  const auto slope = [](SurfaceFault kind) {
    const auto at = [&](double alpha) {
      Tunnel t;
      t.held.q_nb.setIdentity();
      t.held.v_n = {Va * std::cos(alpha), 0, Va * std::sin(alpha)};
      t.held.omega_b.setZero();
      t.plant.set_state(t.held);
      t.fail(none, kind, none);
      t.blow(1, neutral);
      return t.moment(neutral).y() / (t.qS() * anaconda().wing.chord_m);
    };
    return (at(0.04) - at(-0.04)) / 0.08;
  };
  const Derivatives& Cm = anaconda().aero.pitch;
  CHECK(slope(none) / Cm.alpha_ratio == Approx(1).epsilon(0.01));
  CHECK(slope(SurfaceFault::free) / (Cm.alpha_ratio - 0.5 * Cm.elevator_ratio) == Approx(1).epsilon(0.01));
}

namespace {
/// Motor speed after two seconds.
double motor_speed(double throttle, EngineFault fault, double share, bool works = true) {
  auto b = airborne(SensorSet::perfect);
  BodyFaultParams& p = b->params.faults.body_that_fails;
  p.engine_fault.value = fault;
  p.engine_fault_share.value = share;
  b->params.motor.value = works;
  Actuators command = level;
  command.throttle_frac = throttle;
  for (int i = 0; i < 40; ++i) pass(*b, &command);  // 0.1 s: two time constants, hardly another airspeed
  return b->component().plant().propeller_radps();
}
}  // namespace

TEST_CASE(
    "a weak motor turns as one that gets that share of the throttle; one that is off as the flag says") {
  CHECK(motor_speed(1, EngineFault::weak, 0.6) / motor_speed(0.6, EngineFault::none, 0.6) ==
        Approx(1).epsilon(1e-6));
  CHECK(motor_speed(1, EngineFault::off, 1) == motor_speed(1, EngineFault::none, 1, false));
  CHECK(motor_speed(1, EngineFault::weak, 1) == motor_speed(1, EngineFault::none, 1));
}

TEST_CASE(
    "an empty battery's voltage fades evenly to nothing, its status says so, and a full one is back at "
    "once") {
  auto b = airborne(SensorSet::perfect);
  const double full = anaconda().propulsion.battery_volt;
  const auto volt = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) pass(*b, &level);
    while (!b->out.status.written) pass(*b, &level);
    return b->out.status.value.battery_volt;
  };
  CHECK(volt(1) == full);
  b->params.faults.body_that_fails.battery_fault.value = BatteryFault::empty;
  b->params.faults.body_that_fails.battery_fault_time.value = 10;
  b->retune();
  CHECK(volt(5) / (0.5 * full) == Approx(1).epsilon(0.03));
  CHECK(volt(2.5) / (0.25 * full) == Approx(1).epsilon(0.09));
  CHECK(volt(4) == 0);
  CHECK(b->component().plant().battery_amp() == 0);
  b->params.faults.body_that_fails.battery_fault.value = BatteryFault::none;
  b->retune();
  CHECK(volt(0.1) == full);
}

TEST_CASE("ice grows at its rate up to all of it, stays when that is zero, and melts when it is below") {
  auto b = airborne(SensorSet::perfect);
  const auto ice = [&](double rate, double seconds) {
    b->params.faults.body_that_fails.icing_rate.value = rate;
    b->retune();
    for (int i = 0; i < std::lround(seconds / dt); ++i) pass(*b, &level);
    return b->component().ice();
  };
  CHECK(ice(0, 1) == 0);
  CHECK(ice(0.1, 4) == Approx(0.4).epsilon(1e-6));
  CHECK(ice(0, 2) == Approx(0.4).epsilon(1e-6));
  CHECK(ice(-0.1, 1) == Approx(0.3).epsilon(1e-6));
  CHECK(ice(0.5, 2) == 1);
  CHECK(ice(-1, 2) == 0);
}

TEST_CASE("ice takes lift and gives drag as its parameters say, by the share of it that there is") {
  const BodyFaultParams p;
  Plant plant(anaconda(), {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0, Va));
  const double qS = 0.5 * plant.air().density_kgm3 * Va * Va * anaconda().wing.area_m2;
  const double alpha = std::atan2(plant.air_velocity_b().z(), plant.air_velocity_b().x());
  const auto force = [&](double ice) {  // along and across the flow
    plant.set_aerodynamics(iced(anaconda(), ice, p));
    plant.set_state(plant.state());
    const Vector3d f = anaconda().mass_kg * plant.specific_force();
    return Eigen::Vector2d(-f.x() * std::cos(alpha) - f.z() * std::sin(alpha),
                           f.x() * std::sin(alpha) - f.z() * std::cos(alpha));
  };
  const Aerodynamics& c = anaconda().aero;
  const Eigen::Vector2d clean = force(0), half = force(0.5), all = force(1);
  const double elevator = plant.deflections().elevator * c.lift.elevator_ratio;
  CHECK((all.y() - clean.y()) / (-0.3 * qS * (c.lift.alpha_ratio * alpha + elevator)) ==
        Approx(1).epsilon(0.01));
  CHECK((half.y() - clean.y()) / (0.5 * (all.y() - clean.y())) == Approx(1).epsilon(0.01));
  const double parasite = 1.3 * qS * c.parasite_drag_ratio;
  const auto induced = [&](double slope) {  // (CL0 + CLa alpha)^2 / (pi e AR)
    const double CL = c.lift.zero_ratio + slope * c.lift.alpha_ratio * alpha;
    const Wing& w = anaconda().wing;
    return CL * CL / (3.14159265358979 * w.oswald_ratio * w.span_m * w.span_m / w.area_m2);
  };
  CHECK((all.x() - clean.x()) / (parasite + qS * (induced(0.7) - induced(1))) == Approx(1).epsilon(0.01));
  CHECK(force(0) == clean);
}

TEST_CASE("with ice the wing stalls earlier and the surfaces do less") {
  const BodyFaultParams p;
  const Airframe a = iced(anaconda(), 1, p);
  CHECK(a.wing.stall_alpha_rad / (0.7 * anaconda().wing.stall_alpha_rad) == Approx(1));
  CHECK(a.aero.roll.aileron_ratio / (0.7 * anaconda().aero.roll.aileron_ratio) == Approx(1));
  CHECK(a.aero.pitch.elevator_ratio / (0.7 * anaconda().aero.pitch.elevator_ratio) == Approx(1));
  CHECK(a.aero.yaw.rudder_ratio / (0.7 * anaconda().aero.yaw.rudder_ratio) == Approx(1));
  CHECK(a.aero.pitch.alpha_ratio == anaconda().aero.pitch.alpha_ratio);
}

}  // namespace surface_faults_test
