// SPDX-License-Identifier: BSD-3-Clause
// Contact points: statics by hand, a belly that slides, landings, and gears that are none.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "fly.hpp"
#include "fulmar/sim/airframe_rules.hpp"

namespace gear_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.0025, g = 9.80665;

GearContact contact(double x, double y, double z, double carries, ContactKind kind = ContactKind::wheel) {
  GearContact c;
  c.at_m = {x, y, z};
  c.carries_ratio = carries;
  c.kind = kind;
  return c;
}

Airframe on(std::initializer_list<GearContact> contacts) {
  Airframe a = anaconda();
  for (const GearContact& c : contacts) a.gear.contacts.push_back(c);
  return a;
}

/// A flying wing's belly: four skids, 0.12 m below the centre of gravity, which is nearer to the front ones.
Airframe belly() {
  using enum ContactKind;
  Airframe a = on({contact(0.2, -0.08, 0.12, 0.3, skid), contact(0.2, 0.08, 0.12, 0.3, skid),
                   contact(-0.3, -0.08, 0.12, 0.2, skid), contact(-0.3, 0.08, 0.12, 0.2, skid)});
  a.gear.side_friction_ratio = 0.4;
  for (const double y : {-1.0, 1.0}) a.gear.hull_m.push_back({-0.2, y, -0.1});
  a.gear.hull_m.push_back({0, 0, -0.1});
  return a;
}

Plant plant(const Airframe& a) { return Plant(a, {}, 1387, 1); }

void run(Plant& p, double seconds) {
  for (int i = 0; i < std::lround(seconds / dt); ++i) p.advance({}, 1, dt);
}

PropellerPlace yawing(double y) {
  PropellerPlace p;
  p.at_m.y = y;
  p.differential_frac = 0.2;
  return p;
}

/// How deep the unloaded foot of a contact would be in the ground.
double depth(const Plant& p, const GearContact& c) {
  const double sag = c.carries_ratio > 0 ? 0.01 : 0;
  return p.state().p_n.z() + (p.state().q_nb * Vector3d(c.at_m.x, c.at_m.y, c.at_m.z + sag)).z();
}

}  // namespace

TEST_CASE("it stands on its contacts as they say, and each bears what the lever arms give it") {
  const double ahead = 0.4, behind = 0.1, share = behind / (ahead + behind);
  const Airframe a = on({contact(ahead, 0, 0.25, share), contact(-behind, -0.2, 0.25, (1 - share) / 2),
                         contact(-behind, 0.2, 0.25, (1 - share) / 2)});
  Plant p = plant(a);
  CHECK(-p.state().p_n.z() == Approx(0.25).epsilon(1e-6));
  run(p, 20);
  CHECK(-p.state().p_n.z() == Approx(0.25).epsilon(1e-3));
  CHECK(p.state().q_nb.angularDistance(Eigen::Quaterniond::Identity()) < 1e-3);
  CHECK(p.state().v_n.norm() < 1e-4);
  CHECK(p.on_ground());
  const double weight = a.mass_kg * g;
  for (const GearContact& c : a.gear.contacts) {
    const double bears = c.carries_ratio * weight / 0.01 * depth(p, c);
    CHECK(bears / (c.carries_ratio * weight) == Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("shares that are not those of the lever arms: it tilts until the springs give them") {
  // alike springs, the centre of gravity nearer to the rear: more weight there, nose up
  const Airframe a = on({contact(0.6, 0, 0.25, 1.0 / 3), contact(-0.2, -0.2, 0.25, 1.0 / 3),
                         contact(-0.2, 0.25, 0.25, 1.0 / 3)});
  Plant p = plant(a);
  const RigidBody begin = p.state();
  const double weight = a.mass_kg * g, k = weight / 3 / 0.01;
  const auto force = [&](std::size_t i) { return k * depth(p, a.gear.contacts[i]); };
  run(p, 20);
  CHECK((force(0) + force(1) + force(2)) / weight == Approx(1).epsilon(1e-3));
  CHECK(force(0) / (weight * 0.2 / 0.8) == Approx(1).epsilon(0.02));  // about the rear ones
  CHECK(force(1) / force(2) == Approx(0.25 / 0.2).epsilon(0.02));
  CHECK((p.state().q_nb * Vector3d::UnitX()).z() < -0.002);
  // it was set down as it stands
  CHECK(std::abs(begin.p_n.z() - p.state().p_n.z()) < 1e-4);
  CHECK(begin.q_nb.angularDistance(p.state().q_nb) < 1e-3);
}

TEST_CASE("an aircraft with a tail wheel stands nose up, with its heading") {
  Airframe a = on({contact(0.15, -0.2, 0.3, 0.4), contact(0.15, 0.2, 0.3, 0.4), contact(-0.6, 0, 0.1, 0.2)});
  a.gear.hull_m.push_back({0, 0, -0.3});
  Plant p = plant(a);
  p.stand(3, -2, 0.7);
  const auto nose = [&] { return Vector3d(p.state().q_nb * Vector3d::UnitX()); };
  CHECK(std::asin(-nose().z()) == Approx(std::atan2(0.2, 0.75)).epsilon(0.02));
  CHECK(std::atan2(nose().y(), nose().x()) == Approx(0.7));
  const RigidBody begin = p.state();
  run(p, 20);
  CHECK((p.state().p_n - begin.p_n).norm() < 0.002);
  CHECK(p.state().q_nb.angularDistance(begin.q_nb) < 0.002);
  CHECK_FALSE(p.crashed());
}

TEST_CASE("a belly stands without creeping, in wind, too") {
  Plant p(belly(), {{-3, 2, 0}, Turbulence::none}, 1387, 1);
  run(p, 3);
  const Vector3d there = p.state().p_n;
  run(p, 60);
  CHECK((p.state().p_n - there).norm() < 1e-3);
  CHECK_FALSE(p.crashed());
}

TEST_CASE("a skid slides as far as friction lets it, alike in every direction; a wheel does not") {
  const auto slides = [](const Airframe& a, double direction) {
    Plant p = plant(a);
    run(p, 1);
    RigidBody x = p.state();
    const Vector3d from = x.p_n;
    x.v_n = 2 * Vector3d(std::cos(direction), std::sin(direction), 0);
    p.set_state(x);
    run(p, 5);
    CHECK(p.state().v_n.norm() < 1e-3);
    CHECK_FALSE(p.crashed());
    return (p.state().p_n - from).norm();
  };
  const double way = 2 * 2 / (2 * 0.4 * g);  // v^2 / (2 mu g)
  for (const double direction : {0.0, 0.7854, 1.5708, -1.5708, 3.1416})
    CHECK(slides(belly(), direction) / way == Approx(1).epsilon(0.06));
  Airframe slippery = belly();
  for (GearContact& c : slippery.gear.contacts) c.friction_ratio = 0.1;
  CHECK(slides(slippery, 0.5) / (4 * way) == Approx(1).epsilon(0.06));
  Airframe wheels = belly();
  for (GearContact& c : wheels.gear.contacts) c.kind = ContactKind::wheel;
  CHECK(slides(wheels, 1.5708) / way == Approx(1).epsilon(0.1));
  CHECK(slides(wheels, 0) > 3 * way);
}

TEST_CASE(
    "a landing on the belly: it slides to a stop and gives its energy to the ground; too hard is a crash") {
  for (const double sink : {1.0, 2.8, 3.3}) {
    Plant p = plant(belly());
    REQUIRE(p.fly({0, 0, -1}, 0, 15));
    RigidBody x = p.state();
    x.p_n.z() = -0.14;
    x.v_n = {12, 0, sink};
    x.q_nb = Eigen::Quaterniond::Identity();
    x.omega_b.setZero();
    p.set_state(x);
    const double mass = anaconda().mass_kg;
    const auto energy = [&] {
      return 0.5 * mass * p.state().v_n.squaredNorm() - mass * g * p.state().p_n.z();
    };
    double most = energy(), rises = 0;
    for (int i = 0; i < 6000; ++i) {
      p.advance({}, 1, dt);
      rises = std::max(rises, energy() - most);
      most = std::min(most, energy());
    }
    CHECK(p.crashed() == (sink > 3));
    if (p.crashed()) continue;
    CHECK(p.state().v_n.norm() < 1e-3);
    CHECK(p.on_ground());
    CHECK(rises / (0.5 * mass * 12 * 12) < 0.02);  // energy returned by the springs
    CHECK(p.state().p_n.x() > 0.7 * 12 * 12 / (2 * 0.4 * g));
    CHECK(p.state().p_n.x() < 2 * 12 * 12 / (2 * 0.4 * g));  // the wing bears a part at first
    CHECK(-p.state().p_n.z() == Approx(0.12).epsilon(0.02));
  }
}

TEST_CASE("a touch-down names the part and keeps sink, attitude and place; a bounce is none") {
  Plant p = plant(anaconda());
  const double stands = anaconda().gear.height_m;
  run(p, 1);
  CHECK(p.touch().count == 0);  // it stands
  REQUIRE(p.fly({0, 0, -30}, 0, 15));
  RigidBody x = p.state();
  x.p_n = {30, -4, -stands - 0.05};
  x.v_n = {12, 0, 0.8};
  x.q_nb = Eigen::AngleAxisd(0.06, Vector3d::UnitX());  // the right wheel is 1.2 cm lower
  x.omega_b.setZero();
  p.set_state(x);
  for (int i = 0; i < 2000; ++i) p.advance({}, 0, dt);  // it bounces, and rolls
  CHECK(p.touch().count == 1);
  CHECK_FALSE(p.crashed());
  CHECK(std::string(p.touch().part) == "right main wheel");
  CHECK(p.touch().at.v_n.z() == Approx(0.8).epsilon(0.5));
  CHECK(p.touch().at.p_n.x() > 30);
  CHECK(-p.touch().at.p_n.z() < stands + 0.1);
}

TEST_CASE("a crash names what broke: left or right wing tip, nose, a wheel that came down too hard") {
  const auto broken = [](double roll, double pitch, double sink) {
    Plant p = plant(anaconda());
    RigidBody x = p.state();
    x.q_nb = Eigen::AngleAxisd(pitch, Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Vector3d::UnitX());
    x.p_n.z() = -3;
    x.v_n = x.q_nb * Vector3d(14, 0, 0) + Vector3d(0, 0, sink);
    p.set_state(x);
    for (int i = 0; i < 2000 && !p.crashed(); ++i) p.advance({}, 0, dt);
    REQUIRE(p.crashed());
    CHECK(p.touch().count == 1);
    CHECK(p.touch().at.v_n.z() > 1);  // before it came to rest
    return std::string(p.touch().part);
  };
  CHECK(broken(-1.2, 0, 4) == "left wing tip");
  CHECK(broken(1.2, 0, 4) == "right wing tip");
  CHECK(broken(0, -1.5, 4) == "nose");
  CHECK(broken(0, 0, 8).find("wheel") != std::string::npos);
}

TEST_CASE("what the hull says breaks, and nothing else") {
  const auto crashes = [](const Airframe& a, double roll) {
    Plant p = plant(a);
    REQUIRE(p.fly({0, 0, -1}, 0, 15));
    RigidBody x = p.state();
    x.p_n.z() = -0.25;
    x.v_n = {3, 0, 0.1};
    x.q_nb = Eigen::AngleAxisd(roll, Vector3d::UnitX());
    p.set_state(x);
    p.advance({}, 1, dt);
    return p.crashed();
  };
  Airframe a = belly();
  for (const double roll : {0.4, -0.4}) CHECK(crashes(a, roll));  // a tip, 1 m out, is 0.05 m deep
  CHECK_FALSE(crashes(a, 0.2));
  a.gear.hull_m.clear();
  a.gear.hull_m.push_back({0, 0, -0.1});
  CHECK_FALSE(crashes(a, 0.4));
  a.gear.hull_m.clear();  // the usual tips, half of 2 m out and 0.1 m up
  CHECK(crashes(a, 0.4));
}

TEST_CASE("a contact that bears nothing at rest is one that the tail comes down on") {
  Airframe a = on({contact(0.4, 0, 0.25, 0.2), contact(-0.1, -0.2, 0.25, 0.4), contact(-0.1, 0.2, 0.25, 0.4),
                   contact(-0.6, 0, 0.1, 0, ContactKind::skid)});
  Plant p = plant(a);
  run(p, 5);
  CHECK(depth(p, a.gear.contacts[3]) < -0.1);
  RigidBody x = p.state();
  x.q_nb = Eigen::AngleAxisd(0.4, Vector3d::UnitY());
  x.p_n.z() = -0.3;
  Ground with(a), without(on({a.gear.contacts[0], a.gear.contacts[1], a.gear.contacts[2]}));
  Load tail, none;
  with.add_load(x, tail);
  without.add_load(x, none);
  const double deep = -0.3 + (x.q_nb * Vector3d(-0.6, 0, 0.1)).z(), k = 0.15 * a.mass_kg * g / 0.01;
  REQUIRE(deep > 0);
  CHECK((x.q_nb * (tail.force_b - none.force_b)).z() / (-k * deep) == Approx(1).epsilon(1e-9));
}

TEST_CASE("a gear on which nothing stands is refused, with the field and what is wrong") {
  const auto words = [](std::initializer_list<GearContact> contacts) {
    const AirframeFault f = airframe_fault(on(contacts));
    return f ? f.field + ": " + f.sentence : std::string();
  };
  CHECK(words({}) == "");
  CHECK(words({contact(0.3, 0, 0.2, 0.5), contact(-0.3, 0, 0.2, 0.5)}) ==
        "gear.contacts: sim.contacts_few(2)");
  CHECK(words({contact(0.3, 0, 0.2, 0.5), contact(-0.3, 0.2, 0.2, 0.3), contact(-0.3, -0.2, 0.2, 0.3)}) ==
        "gear.contacts: sim.contacts_shares_wrong(1.1)");
  CHECK(words({contact(0.3, 0, 0.2, 0.3), contact(0, 0, 0.2, 0.3), contact(-0.3, 0, 0.2, 0.4)}) ==
        "gear.contacts: sim.contacts_on_line");
  CHECK(words({contact(-0.1, 0, 0.2, 0.4), contact(-0.5, 0.2, 0.2, 0.3), contact(-0.5, -0.2, 0.2, 0.3)}) ==
        "gear.contacts: sim.contacts_beside(behind)");
  CHECK(words({contact(0.1, 0, 0.2, 0.4), contact(0.5, 0.2, 0.2, 0.3), contact(0.5, -0.2, 0.2, 0.3)}) ==
        "gear.contacts: sim.contacts_beside(ahead of)");
  CHECK(words({contact(0.3, 0.1, 0.2, 0.4), contact(-0.5, 0.2, 0.2, 0.3), contact(-0.5, 0.4, 0.2, 0.3)}) ==
        "gear.contacts: sim.contacts_beside(right of)");
  // around three of its corners, but outside of it
  CHECK(words({contact(0.5, 0.1, 0.2, 0.4), contact(-0.1, -0.5, 0.2, 0.3), contact(0.6, -0.4, 0.2, 0.3)}) ==
        "gear.contacts: sim.contacts_beside(on one side of)");
  CHECK(words({contact(0.3, 0, 0.2, 0.4), contact(-0.3, 0.2, 0.2, 0.3), contact(-0.3, -0.2, 0.2, 0.3)}) ==
        "");
  CHECK_FALSE(airframe_fault(belly()));
}

TEST_CASE("servos, propellers and batteries that are none are refused") {
  const auto words = [](const std::function<void(Airframe&)>& change) {
    Airframe a = anaconda();
    change(a);
    const AirframeFault f = airframe_fault(a);
    return f ? f.field + ": " + f.sentence : std::string();
  };
  CHECK(words([](Airframe& a) { a.elevator.min_rad = a.elevator.max_rad = 0.2; }) ==
        "elevator.min_rad: sim.servo_fixed(0.2, 0.2)");
  CHECK(words([](Airframe& a) { a.propulsion.propellers.push_back(yawing(0)); }) ==
        "propulsion.propellers[0].differential_frac: sim.propeller_in_middle");
  CHECK(words([](Airframe& a) {
          a.rudder.limit_rad = 0;
          a.propulsion.propellers.push_back(yawing(1));
        }) == "propulsion.propellers[0].differential_frac: sim.propeller_without_rudder");
  const auto curve = [&](std::vector<double> used, std::vector<double> volt, double capacity_ah = 1) {
    return words([&](Airframe& a) {
      a.propulsion.battery_volt = 12;
      a.propulsion.pack.capacity_ah = capacity_ah;
      for (const double u : used) a.propulsion.pack.curve.used_frac.push_back(u);
      for (const double v : volt) a.propulsion.pack.curve.open_volt.push_back(v);
    });
  };
  CHECK(curve({0, 0.5, 1}, {12, 11, 10}) == "");
  CHECK(curve({0, 0.5, 1}, {12, 11}) == "propulsion.pack.curve: sim.battery_curve_mismatched(3, 2)");
  CHECK(curve({0, 0.5, 0.5}, {12, 11, 10}) ==
        "propulsion.pack.curve.used_frac: sim.battery_curve_not_rising(0.5, 0.5)");
  CHECK(curve({0.1, 0.5}, {12, 11}) == "propulsion.pack.curve: sim.battery_curve_start_wrong(12)");
  CHECK(curve({0, 0.5}, {11, 10}) == "propulsion.pack.curve: sim.battery_curve_start_wrong(12)");
  CHECK(curve({0, 1}, {12, 11}, 0) == "propulsion.pack.curve: sim.battery_capacity_missing");
  CHECK(words([](Airframe& a) {
          a.propulsion.battery_volt = 12;
          a.propulsion.pack.empty_volt = 13;
        }) == "propulsion.pack.empty_volt: sim.battery_empty_high(13, 12)");
}

}  // namespace gear_test
