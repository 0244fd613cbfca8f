// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/sim_aero/actuation.hpp"

#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "fly.hpp"
#include "plugins/sim_aero/aircraft.hpp"

namespace actuation_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {
constexpr std::int64_t period_ns = 2500000;

/// The aileron that is applied in each period, when the command of tick k is k * 1e-4 rad.
std::vector<double> applied(const ActuationSpec& spec, int ticks) {
  Actuation a(spec, anaconda(), 0);
  std::vector<double> out;
  for (int k = 0; k < ticks; ++k) {
    a.put({0, k * 1e-4, 0, 0}, k * period_ns);
    out.push_back(a.at(k * period_ns).aileron_rad);
  }
  return out;
}
}  // namespace

TEST_CASE("off, a command is applied as it is and at once") {
  const auto out = applied({}, 100);
  for (int k = 0; k < 100; ++k) CHECK(out[static_cast<std::size_t>(k)] == k * 1e-4);
}

TEST_CASE("latency delays each command by its time") {
  const auto out = applied({0, 0, 0.01}, 100);  // four ticks
  for (int k = 4; k < 100; ++k) CHECK(out[static_cast<std::size_t>(k)] == (k - 4) * 1e-4);
  CHECK(out[3] == 0);
}

TEST_CASE("with frames at 111 Hz the outputs change 111 times a second, to the newest command") {
  const auto out = applied({111, 0, 0}, 4001);  // 10 s and the tick at 0
  int changes = 0;
  double oldest = 0;
  for (std::size_t k = 1; k < out.size(); ++k) {
    if (out[k] != out[k - 1]) {
      ++changes;
      CHECK(out[k] == static_cast<double>(k) * 1e-4);
    }
    oldest = std::max(oldest, static_cast<double>(k) - out[k] * 1e4);
  }
  CHECK(changes == 1110);
  CHECK(oldest == Approx(3));  // a frame each 9.009 ms: three ticks without one at most
}

TEST_CASE("a pulse of 10 us resolution puts the surface within half a step of the command") {
  const double limit = anaconda().aileron.limit_rad, step = 2 * limit / 100;
  const auto out = applied({0, 10e-6, 0}, 2000);
  std::set<long> levels;
  for (std::size_t k = 0; k < out.size(); ++k) {
    CHECK(std::abs(out[k] - static_cast<double>(k) * 1e-4) <= 0.5 * step + 1e-12);
    levels.insert(std::lround(out[k] / step));
  }
  CHECK(static_cast<double>(levels.size()) == Approx(0.2 / step).epsilon(0.1));
}

TEST_CASE("the aircraft's servo moves a latency later") {
  const auto deflection_after = [](double latency, int passes) {
    Bench<Aircraft> b;
    b.params.airframe.value = anaconda();
    b.params.start.start_height.value = 100;
    b.params.settle.value = 0;
    b.params.outputs.link_latency.value = latency;
    arm(b);
    const Actuators neutral{0.5, 0, 0, 0}, roll{0.5, 0.3, 0.1, 0};
    for (int k = 0; k < 100; ++k) pass(b, &neutral);  // from the trim that it begins with
    for (int k = 0; k < passes; ++k) pass(b, &roll);
    return b.component().plant().deflections().aileron;
  };
  CHECK(deflection_after(0, 12) > 0.05);
  CHECK(std::abs(deflection_after(0.05, 12)) < 0.01);  // no command has arrived yet
  CHECK(deflection_after(0.05, 12 + 20) == Approx(deflection_after(0, 12)).epsilon(1e-3).scale(0));
}

}  // namespace actuation_test
