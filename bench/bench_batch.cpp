// SPDX-License-Identifier: BSD-3-Clause
// Aircraft steps per second of a batch of 1000 through the library, by one thread and by two, with one step a
// call and with 20: the Anaconda in level flight, 2.5 ms, no turbulence. bench_batch [--json]
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "fulmar/sim/batch.hpp"
#include "sdk/test/flight/airframe_file.hpp"

using namespace fulmar::sim;

namespace {

double now_s() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double steps_per_second(const fulmar::Airframe& a, unsigned threads, unsigned steps) {
  constexpr std::size_t n = 1000;
  Batch batch(a, n, {.origin_altitude_m = 1387}, 1, threads);
  std::vector<double> actions(n * action_columns), rows(n * row_columns);
  for (std::size_t i = 0; i < n; ++i) {
    batch[i].fly({0, 0, -300}, 0, 17);
    const fulmar::Actuators c = batch[i].trim();
    const double all[] = {c.throttle_frac, c.aileron_rad, c.elevator_rad, c.rudder_rad};
    std::copy(std::begin(all), std::end(all), &actions[i * action_columns]);
  }
  double best = 0;
  for (int k = 0; k < 60; ++k) {
    const double begin = now_s();
    batch.step(actions, 0.0025, steps, rows);
    best = std::max(best, n * steps / (now_s() - begin));
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const bool json = argc > 1 && std::strcmp(argv[1], "--json") == 0;
  const fulmar::Airframe a = fulmar::test::airframe_file("anaconda");
  const char* between = json ? "{" : "";
  for (const unsigned threads : {1u, 2u})
    for (const unsigned steps : {1u, 20u}) {
      std::printf(json ? "%s\"threads_%u_steps_%u_per_s\": %.0f"
                       : "%s%u threads, %2u steps a call  %9.0f aircraft steps per second\n",
                  between, threads, steps, steps_per_second(a, threads, steps));
      if (json) between = ", ";
    }
  if (json) std::printf("}\n");
  return 0;
}
