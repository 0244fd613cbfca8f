// SPDX-License-Identifier: BSD-3-Clause
// Comparison of the component with the simulation library.
#include <doctest/doctest.h>

#include "fly.hpp"
#include "fulmar/sim/simulation.hpp"

namespace library_test {

using namespace fulmar;
using namespace fulmar::sim;

namespace {

constexpr double dt = 0.0025;

/// Other surfaces each half second.
Actuators weaving(int step) {
  const double s = (step / 200) % 2 ? 0.03 : -0.03;
  return {0.57 + s, s, 0.12 + 0.5 * s, -s};
}

}  // namespace

TEST_CASE("the library flies what the plugin flies, to the bit") {
  Bench<Aircraft> bench;
  bench.params.airframe.value = anaconda();
  bench.params.settle.value = 0;
  bench.params.start.start_height.value = 200;
  bench.params.wind.wind_ned.value = {3, -4, 0};
  SimulationOptions options;
  options.origin_altitude_m = 1387;
  options.weather.wind_n = {3, -4, 0};
  Simulation sim(anaconda(), options);
  bench.read();
  arm(bench);
  bench.write();
  Actuators given = weaving(0);
  for (int i = 0; i < 4; ++i) pass(bench, &given);  // armed, released, and one step flown
  const Plant& plant = bench.component().plant();
  sim.set({plant.state(), plant.deflections(), plant.propeller_radps()});
  for (int i = 0; i < 2000; ++i) {
    sim.step(given, dt);  // the actions before this read
    pass(bench, &(given = weaving(i)));
  }
  CHECK((plant.state().p_n - sim.body().p_n).norm() == 0);
  CHECK(plant.state().q_nb.coeffs() == sim.body().q_nb.coeffs());
  CHECK(plant.specific_force() == sim.plant().specific_force());
  CHECK(sim.body().v_n.norm() > 5);
}

}  // namespace library_test
