// SPDX-License-Identifier: BSD-3-Clause
// The model as a library: one aircraft, and many in one call.
#define FULMAR_COUNT_ALLOCATIONS
#include "fulmar/sim/simulation.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "fulmar/sim/batch.hpp"
#include "fulmar/testing.hpp"
#include "sdk/test/sim/anaconda.hpp"

using namespace fulmar;
using namespace fulmar::sim;

namespace {

using Row = std::array<double, row_columns>;
constexpr double dt = 0.0025;

Row row(const Simulation& sim) {
  Row r;
  write_row(sim, r.data());
  return r;
}
bool same(const Row& a, const Row& b) { return std::memcmp(a.data(), b.data(), sizeof a) == 0; }

SimulationOptions windy() {
  SimulationOptions options;
  options.origin_altitude_m = 1387;
  options.weather.wind_n = {3, -4, 0};
  options.weather.turbulence = Turbulence::light;
  return options;
}

/// Different surfaces each half second.
Actuators weaving(int step, double phase = 0) {
  const double s = (step / 200) % 2 ? 0.03 : -0.03;
  return {0.57 + s, s * (1 + phase), 0.12 + 0.5 * s, -s};
}

Simulation flying(std::uint64_t seed) {
  Simulation sim(anaconda(), windy(), seed);
  REQUIRE(sim.fly({0, 0, -300}, 0.3, 17));
  return sim;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a copy flies on by itself, the same with the same commands, another way with others") {
  Simulation a = flying(7);
  for (int i = 0; i < 400; ++i) a.step(weaving(i), dt);
  Simulation b = a, c = a;
  const Row before = row(a);
  for (int i = 0; i < 400; ++i) {
    b.step(weaving(i), dt);
    c.step(weaving(i, 0.5), dt);
  }
  CHECK(same(row(a), before));
  for (int i = 0; i < 400; ++i) a.step(weaving(i), dt);
  CHECK(same(row(a), row(b)));
  CHECK_FALSE(same(row(a), row(c)));
  CHECK(a.time_s() == doctest::Approx(2));
}

TEST_CASE("a seed and a reset give the flight again; another seed another one") {
  const auto fly = [](Simulation& sim) {
    REQUIRE(sim.fly({0, 0, -300}, 0.3, 17));
    for (int i = 0; i < 800; ++i) sim.step(weaving(i), dt);
    return row(sim);
  };
  Simulation sim(anaconda(), windy(), 7), other(anaconda(), windy(), 8);
  const Row first = fly(sim);
  sim.reset(7);
  CHECK(sim.time_s() == 0);
  CHECK(sim.plant().on_ground());
  CHECK(same(first, fly(sim)));
  CHECK_FALSE(same(first, fly(other)));
}

TEST_CASE("a state that was set is the one that is read, surfaces and propeller too") {
  Simulation a = flying(7), b(anaconda(), windy(), 7);
  for (int i = 0; i < 300; ++i) a.step(weaving(i), dt);
  const Row r = row(a);
  b.set(state_of_row(r.data()));
  const FlightState s = b.state();
  CHECK(s.body.v_n == a.body().v_n);
  CHECK(s.deflections.rudder == r[21]);
  CHECK(s.propeller_radps == r[22]);
  CHECK(r[22] > 100);
  CHECK(row(b)[13] == doctest::Approx(b.air_data().Va));
}

TEST_CASE("its trim keeps it in the steady flight that it began with") {
  SimulationOptions calm = windy();
  calm.weather.turbulence = Turbulence::none;
  Simulation sim(anaconda(), calm);
  for (const double Va : {14.0, 17.0, 20.0}) {
    REQUIRE(sim.fly({0, 0, -300}, 0, Va));
    for (int i = 0; i < 800; ++i) sim.step(sim.trim(), dt);
    CHECK((sim.body().p_n - Eigen::Vector3d((Va + 3) * 2, -4 * 2, -300)).norm() < 0.1);
    CHECK(sim.air_data().Va == doctest::Approx(Va).epsilon(1e-3));
  }
}

TEST_CASE("what has crashed stays there until it is put elsewhere") {
  Simulation sim = flying(7);
  const FlightState begin = sim.state();
  while (!sim.plant().crashed() && sim.time_s() < 60) sim.step({0, 0, 0.3, 0}, dt);
  REQUIRE(sim.plant().crashed());
  const Eigen::Vector3d wreck = sim.body().p_n;
  sim.step({1, 0, 0, 0}, dt);
  CHECK(sim.body().p_n == wreck);
  Simulation standing = sim, again = sim;
  standing.stand(0, 0, 0);
  CHECK_FALSE(standing.plant().crashed());
  REQUIRE(again.fly({0, 0, -300}, 0, 17));
  CHECK_FALSE(again.plant().crashed());
  sim.set(begin);
  sim.step({0.5, 0, 0, 0}, dt);
  CHECK_FALSE(sim.plant().crashed());
  CHECK((sim.body().p_n - begin.body.p_n - dt * begin.body.v_n).norm() < 1e-3);
}

TEST_CASE("an aircraft beyond the model reports it, and stays until its state is set") {
  Simulation sim = flying(7);
  FlightState s = sim.state();
  s.body.omega_b.y() = 9e4;  // within the valid range, but too fast for a step of 2.5 ms
  sim.set(s);
  sim.step({0.5, 0, 0, 0}, dt);
  REQUIRE(sim.plant().departure() == Departure::diverged);
  CHECK(row(sim)[25] == 1);
  const Row left = row(sim);
  sim.step({0.5, 0, 0, 0}, dt);
  CHECK(same(row(sim), left));
  REQUIRE(sim.fly({0, 0, -300}, 0, 17));
  sim.step({0.5, 0, 0, 0}, dt);
  CHECK(row(sim)[25] == 0);
}

TEST_CASE("a step takes nothing from the heap") {
  Simulation sim = flying(7);
  CHECK(allocations([&] {
          for (int i = 0; i < 100; ++i) sim.step(weaving(i), dt);
        }) == 0);
}

TEST_CASE("what is no command, step or state is refused, and nothing has moved") {
  Simulation sim = flying(7);
  const Row before = row(sim);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal([&] { sim.step({0.5, 0, nan, 0}, dt); }) == "sim.command_not_finite(elevator_rad, nan)");
  CHECK(refusal([&] { sim.step({0.5, 0, 0, 0}, 0); }) == "sim.step_invalid(0)");
  CHECK(refusal([&] { sim.step({0.5, 0, 0, 0}, 0.11); }) == "sim.step_invalid(0.11)");
  FlightState s = sim.state();
  s.body.v_n.y() = nan;
  CHECK(refusal([&] { sim.set(s); }) == "sim.state_not_finite");
  s = sim.state();
  s.body.q_nb.w() = 3;
  CHECK(refusal([&] { sim.set(s); }) == "sim.state_not_normalised");
  s = sim.state();
  s.body.p_n.x() = 2e8;
  CHECK(refusal([&] { sim.set(s); }) == "sim.state_beyond_model");
  CHECK(same(row(sim), before));
}

TEST_CASE("a batch flies as each of its aircraft alone, for any number of threads") {
  constexpr std::size_t n = 65;
  std::vector<double> actions(n * action_columns), one(n * row_columns), three(n * row_columns);
  Batch a(anaconda(), n, windy(), 5, 1), b(anaconda(), n, windy(), 5, 3);
  std::vector<Simulation> alone;
  for (std::size_t i = 0; i < n; ++i) {
    alone.emplace_back(anaconda(), windy(), mix_seed(5, i));
    const double Va = 16 + 0.05 * static_cast<double>(i);
    for (Simulation* sim : {&a[i], &b[i], &alone[i]}) REQUIRE(sim->fly({0, 0, -300}, 0, Va));
  }
  for (int k = 0; k < 50; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const Actuators c = weaving(k * 40, 0.01 * static_cast<double>(i));
      const std::array<double, 4> all{c.throttle_frac, c.aileron_rad, c.elevator_rad, c.rudder_rad};
      std::copy(all.begin(), all.end(), &actions[i * action_columns]);
      for (int j = 0; j < 4; ++j) alone[i].step(c, dt);
    }
    a.step(actions, dt, 4, one);
    b.step(actions, dt, 4, three);
  }
  CHECK(one == three);
  for (std::size_t i = 0; i < n; ++i)
    REQUIRE(std::memcmp(row(alone[i]).data(), &one[i * row_columns], sizeof(Row)) == 0);
  CHECK(one[0] != one[row_columns]);
}

TEST_CASE("one member of a batch restarts, the others continue") {
  Batch batch(anaconda(), 2, windy());
  for (std::size_t i : {0u, 1u}) REQUIRE(batch[i].fly({0, 0, -300}, 0, 17));
  std::vector<double> actions{0.5, 0, 0.1, 0, 0.5, 0, 0.1, 0}, rows(2 * row_columns);
  batch.step(actions, dt, 10, rows);
  batch[1].reset(3);
  batch.rows(rows);
  CHECK(rows[2] < -299);
  CHECK(rows[row_columns + 2] > -1);
  CHECK(rows[row_columns + 23] == 1);
}

TEST_CASE("arrays of another shape, numbers that are none and empty batches are refused") {
  Batch batch(anaconda(), 2, windy());
  std::vector<double> actions(9), rows(2 * row_columns), before(2 * row_columns);
  batch.rows(before);
  const auto step = [&](std::size_t a, std::size_t r) {
    return refusal([&] { batch.step({actions.data(), a}, dt, 1, {rows.data(), r}); });
  };
  CHECK(step(7, 52) == "actions: sim.number_count_invalid(2, 4, 7)");
  CHECK(step(9, 52) == "actions: sim.number_count_invalid(2, 4, 9)");
  CHECK(step(8, 49) == "rows: sim.number_count_invalid(2, 26, 49)");
  actions[5] = std::numeric_limits<double>::infinity();
  CHECK(step(8, 52) == "aircraft 1: sim.command_not_finite(aileron_rad, inf)");
  batch.rows(rows);
  CHECK(rows == before);
  CHECK(refusal([] { Batch none(anaconda(), 0); }) == "sim.batch_empty");
  CHECK(refusal([] { Batch none(anaconda(), 1, {}, 1, 0); }) == "sim.batch_threads_invalid(0)");
}

TEST_CASE(
    "turbulence of one height and one airspeed is the Dryden model's, however fast the aircraft flies") {
  Weather w;
  w.turbulence = Turbulence::severe;
  w.fixed_height_m = 100;
  w.gust_airspeed_mps = 25;
  Disturbances air(w, 5);
  Dryden model(dryden_scales_at(Turbulence::severe, 100), 5);
  bool all = true;
  for (int i = 0; i < 100; ++i) all = all && air.advance(0.01, 10 + 0.3 * i) == model.advance(0.01, 25);
  CHECK(all);
  CHECK(!air.rotates());
}

TEST_CASE(
    "turbulence that turns leaves the gusts along the axes as they are, and rolls the aircraft by its "
    "damping") {
  SimulationOptions straight = windy(), turning = windy();
  const Airframe a = test::airframe_file("x8");
  turning.weather.gust_span_m = a.wing.span_m;
  Simulation one(a, straight, 7), other(a, turning, 7);
  for (Simulation* sim : {&one, &other}) {
    REQUIRE(sim->fly({0, 0, -300}, 0, 18));
    sim->step(sim->trim(), dt);
  }
  CHECK(one.plant().wind_n() == other.plant().wind_n());
  CHECK(one.body().omega_b == other.body().omega_b);  // the rotation of the air starts at the end of the step
  // Angular acceleration by air rotation p, q, r: that of a body with the opposite rotation.
  Disturbances air(turning.weather, 7);
  air.advance(dt, 18);
  REQUIRE(air.rotates());
  const Eigen::Vector3d turn = air.rotation(dt, 18);
  CHECK(turn.norm() > 0);
  const auto moment = [&](const Simulation& sim, const Eigen::Vector3d& omega) {
    return sim.plant()
        .aerodynamic()
        .load(sim.plant().air_velocity_b(), omega, sim.plant().deflections(), sim.plant().air().density_kgm3)
        .moment_b;
  };
  const Eigen::Vector3d by_air = moment(one, one.body().omega_b - turn) - moment(one, one.body().omega_b);
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  J.diagonal() << a.inertia.xx_kgm2, a.inertia.yy_kgm2, a.inertia.zz_kgm2;
  J(0, 2) = J(2, 0) = -a.inertia.xz_kgm2;
  const Eigen::Vector3d gained = other.plant().angular_acceleration() - one.plant().angular_acceleration();
  CHECK((J * gained - by_air).norm() / by_air.norm() < 1e-9);
}

TEST_CASE("still air does not rotate, for any span") {
  Weather w;
  w.gust_span_m = 2;
  CHECK(!Disturbances(w, 1).rotates());
}
