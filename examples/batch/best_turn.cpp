// SPDX-License-Identifier: BSD-3-Clause
// The core of a model-predictive controller: of several aileron deflections, held for half a second, it
// selects the one whose bank is closest to 30 deg. A copy of the simulation flies each of them; the original
// stays unchanged.
#include <cmath>
#include <cstdio>
#include <exception>
#include <fulmar/sim/airframe_file.hpp>
#include <fulmar/sim/simulation.hpp>

using namespace fulmar;

namespace {

double bank_after_half_a_second(sim::Simulation sim, double aileron_rad) {
  Actuators command = sim.trim();
  command.aileron_rad += aileron_rad;
  for (int i = 0; i < 200; ++i) sim.step(command, 0.0025);
  const Eigen::Quaterniond& q = sim.body().q_nb;
  return std::atan2(2 * (q.w() * q.x() + q.y() * q.z()), 1 - 2 * (q.x() * q.x() + q.y() * q.y()));
}

}  // namespace

int main() try {
  constexpr double degree = 0.017453292519943295;
  sim::Simulation sim(sim::read_airframe("fulmar:airframes/anaconda.yaml"));
  if (!sim.fly({0, 0, -100}, 0, 17)) throw std::runtime_error("it does not fly at 17 m/s");
  double best = 0, best_error = 1e9;
  for (double aileron = 0; aileron < 20.5; aileron += 1) {
    const double error = std::abs(bank_after_half_a_second(sim, aileron * degree) - 30 * degree);
    if (error < best_error) {
      best = aileron;
      best_error = error;
    }
  }
  std::printf("%.0f deg of aileron: %.1f deg of bank\n", best,
              bank_after_half_a_second(sim, best * degree) / degree);
  return 0;
} catch (const std::exception& refusal) {
  std::fprintf(stderr, "%s\n", refusal.what());
  return 1;
}
