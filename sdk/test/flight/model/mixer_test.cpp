// SPDX-License-Identifier: BSD-3-Clause
// Elevons and ruddervators: the algebra by hand, and the effect of stops and faults of one physical surface.
#include "fulmar/flight/model/mixer.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "fulmar/sim/plant.hpp"
#include "sdk/test/sim/anaconda.hpp"

namespace mixer_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.0025, Va = 17;

Airframe mixed(Mixer mixer) {
  Airframe a = anaconda();
  a.mixer = mixer;
  return a;
}

struct Held {  ///< in its trimmed flight: only surfaces and motor move
  explicit Held(const Airframe& airframe) : plant(airframe, {}, 1387, 1) {
    REQUIRE(plant.fly({0, 0, -300}, 0, Va));
    state = plant.state();
  }
  void blow(const Actuators& command, double seconds = 1) {
    for (int i = 0; i < std::lround(seconds / dt); ++i) {
      plant.advance(command, 1, dt);
      plant.set_state(state);
    }
  }
  void fail(FaultKind aileron, FaultKind elevator, FaultKind rudder) {
    Fault a, e, r;
    a.kind = aileron;
    e.kind = elevator;
    r.kind = rudder;
    a.growth = e.growth = r.growth = 1;
    plant.suffer(a, e, r);
  }
  /// Change of the body rate within a tenth of a second.
  Vector3d turns(const Actuators& command) {
    for (int i = 0; i < 40; ++i) plant.advance(command, 1, dt);
    return plant.state().omega_b;
  }
  Plant plant;
  RigidBody state;
};

void check_deflections(const Deflections& d, double aileron, double elevator, double rudder) {
  CHECK(d.aileron == Approx(aileron).epsilon(1e-6));
  CHECK(d.elevator == Approx(elevator).epsilon(1e-6));
  CHECK(d.rudder == Approx(rudder).epsilon(1e-6));
}

constexpr auto none = FaultKind::none;
}  // namespace

TEST_CASE("elevons: elevator is the mean, aileron half of left less right") {
  const Deflections s = to_servos(Mixer::elevons, {0.1, 0.2, 0.3});
  check_deflections(s, 0.3, 0.1, 0.3);  // left down 0.3, right down 0.1
  check_deflections(from_servos(Mixer::elevons, {0.4, -0.2, 0}), 0.3, 0.1, 0);
  // both down: nose down; left down alone rolls right and noses down
  check_deflections(from_servos(Mixer::elevons, {0.2, 0.2, 0}), 0, 0.2, 0);
  check_deflections(from_servos(Mixer::elevons, {0.2, 0, 0}), 0.1, 0.1, 0);
}

TEST_CASE("ruddervators: elevator is the mean, rudder half of left less right") {
  check_deflections(to_servos(Mixer::v_tail, {0.05, -0.1, 0.2}), 0.05, 0.1, -0.3);
  check_deflections(from_servos(Mixer::v_tail, {0.05, 0.1, -0.3}), 0.05, -0.1, 0.2);
}

TEST_CASE("every mixer gives back what went in, and the conventional one changes nothing") {
  for (const Mixer m : {Mixer::conventional, Mixer::elevons, Mixer::v_tail}) {
    const Deflections d{0.11, -0.23, 0.07};
    const Deflections back = from_servos(m, to_servos(m, d));
    check_deflections(back, d.aileron, d.elevator, d.rudder);
  }
  const Deflections same = to_servos(Mixer::conventional, {0.11, -0.23, 0.07});
  CHECK(same.aileron == 0.11);
  CHECK(same.elevator == -0.23);
  CHECK(same.rudder == 0.07);
}

TEST_CASE("with alike servos within their limits a mixed aircraft flies as one without a mixer") {
  for (const Mixer m : {Mixer::elevons, Mixer::v_tail}) {
    Plant plain(anaconda(), {}, 1387, 1), other(mixed(m), {}, 1387, 1);
    for (Plant* p : {&plain, &other}) REQUIRE(p->fly({0, 0, -300}, 0.4, Va));
    for (int i = 0; i < 800; ++i) {
      const double t = i * dt;
      const Actuators a{0.55, 0.03 * std::sin(3 * t), 0.12 + 0.02 * std::sin(2 * t), 0.03 * std::cos(t)};
      for (Plant* p : {&plain, &other}) p->advance(a, 1, dt);
    }
    CHECK(plain.state().omega_b.norm() > 0.01);
    CHECK((plain.state().p_n - other.state().p_n).norm() < 1e-9);
    CHECK(plain.state().q_nb.angularDistance(other.state().q_nb) < 1e-9);
  }
}

TEST_CASE("an elevon at its stop takes from roll and pitch alike; either way") {
  Airframe a = mixed(Mixer::elevons);
  for (Surface* s : {&a.aileron, &a.elevator}) {
    s->min_rad = -0.5;
    s->max_rad = 0.4;
  }
  Held h(a);
  h.blow({0.5, 0.3, 0.3, 0});  // left 0.6, right 0
  check_deflections(h.plant.servos(), 0.4, 0, 0);
  check_deflections(h.plant.deflections(), 0.2, 0.2, 0);
  h.blow({0.5, 0.3, -0.3, 0});  // left 0, right -0.6
  check_deflections(h.plant.deflections(), 0.25, -0.25, 0);
  h.blow({0.5, -0.3, 0.3, 0});  // left 0, right 0.6
  check_deflections(h.plant.deflections(), -0.2, 0.2, 0);
}

TEST_CASE("a fault in the aileron's place is the left elevon's, in the elevator's the right one's") {
  using enum FaultKind;
  Held h(mixed(Mixer::elevons));
  const Actuators command{0.5, 0.1, 0.2, -0.1};  // left 0.3, right 0.1
  h.blow(command);
  h.fail(lost, none, none);
  check_deflections(h.plant.deflections(), -0.05, 0.05, -0.1);
  h.fail(none, lost, none);
  check_deflections(h.plant.deflections(), 0.15, 0.15, -0.1);
  h.fail(stuck, none, none);
  h.blow({0.5, -0.1, -0.1, 0});  // left stays at 0.3, right goes to 0
  check_deflections(h.plant.deflections(), 0.15, 0.15, 0);
  const double limit = anaconda().aileron.limit_rad;
  h.fail(hardover_positive, hardover_negative, none);
  h.blow(command);
  check_deflections(h.plant.deflections(), limit, 0, -0.1);
}

TEST_CASE("a lost elevon rolls the aircraft to the side that the other one leaves it") {
  const Actuators neutral{0.5, 0, 0.1212, 0};  // both down
  for (const bool left : {true, false}) {
    Held whole(mixed(Mixer::elevons)), broken(mixed(Mixer::elevons));
    broken.fail(left ? FaultKind::lost : none, left ? none : FaultKind::lost, none);
    const double rolls = broken.turns(neutral).x() - whole.turns(neutral).x();
    CHECK((left ? -rolls : rolls) > 0.1);  // the working right elevon, down, lifts its side
  }
}

TEST_CASE("a fault of a ruddervator") {
  using enum FaultKind;
  Held h(mixed(Mixer::v_tail));
  h.blow({0.5, 0.05, 0.2, 0.1});  // left 0.3, right 0.1
  h.fail(none, lost, none);
  check_deflections(h.plant.deflections(), 0.05, 0.05, -0.05);
  h.fail(none, none, lost);
  check_deflections(h.plant.deflections(), 0.05, 0.15, 0.15);
}

TEST_CASE("elevons that are free trail as ailerons and elevator would") {
  const auto trailed = [](Mixer mixer) {
    Held h(mixed(mixer));
    h.state.q_nb.setIdentity();
    h.state.v_n = Va * Vector3d(std::cos(0.08), 0, std::sin(0.08));
    h.state.omega_b = {0.5, 0, 0};
    h.plant.set_state(h.state);
    h.fail(FaultKind::free, FaultKind::free, none);
    h.blow({0.5, 0.3, 0.3, 0});
    return h.plant.deflections();
  };
  const Deflections plain = trailed(Mixer::conventional), elevons = trailed(Mixer::elevons);
  CHECK(std::abs(plain.elevator) > 0.03);
  CHECK(std::abs(plain.aileron) > 0.005);
  CHECK(elevons.elevator / plain.elevator == Approx(1).epsilon(1e-6));
  CHECK(elevons.aileron / plain.aileron == Approx(1).epsilon(1e-6));
}

TEST_CASE("a trim that an elevon does not reach is none, though each command is within its throw") {
  Airframe a = mixed(Mixer::elevons);
  Plant plant(a, {}, 1387, 1);
  REQUIRE(plant.fly({0, 0, -300}, 0, Va));
  const double left = plant.servos().aileron;
  CHECK(left > plant.deflections().elevator);  // includes some aileron
  a.aileron.max_rad = left - 1e-4;
  CHECK_FALSE(Plant(a, {}, 1387, 1).fly({0, 0, -300}, 0, Va));
  a.aileron.max_rad = left + 1e-4;
  CHECK(Plant(a, {}, 1387, 1).fly({0, 0, -300}, 0, Va));
  CHECK(beyond_stops(a, {0.1, left, 0}) == Beyond::aileron);
  CHECK(beyond_stops(a, {-0.3, 0.5, 0}) == Beyond::elevator);
  CHECK(beyond_stops(a, {0, 0, 0.8}) == Beyond::rudder);
  CHECK(beyond_stops(a, {0, 0, 0}) == Beyond::none);
}

}  // namespace mixer_test
