// SPDX-License-Identifier: BSD-3-Clause
// Aircraft steps per second of a batch through the library, by one thread and by two: the Anaconda in level
// flight, 2.5 ms, no turbulence. bench_batch [--json]
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

double steps_per_second(const fulmar::Airframe& a, unsigned threads) {
  constexpr std::size_t n = 1024;
  constexpr unsigned steps = 20;
  Batch batch(a, n, {.origin_altitude_m = 1387}, 1, threads);
  std::vector<double> actions(n * action_columns), rows(n * row_columns);
  for (std::size_t i = 0; i < n; ++i) {
    batch[i].fly({0, 0, -300}, 0, 17);
    const fulmar::Deflections d = batch[i].state().deflections;
    const double all[] = {a.limits.throttle_cruise_frac, d.aileron, d.elevator, d.rudder};
    std::copy(std::begin(all), std::end(all), &actions[i * action_columns]);
  }
  double best = 0;
  for (int k = 0; k < 40; ++k) {
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
  const double one = steps_per_second(a, 1), two = steps_per_second(a, 2);
  std::printf(json ? "{\"one_thread_per_s\": %.0f, \"two_threads_per_s\": %.0f}\n"
                   : "one thread   %9.0f aircraft steps per second\ntwo threads  %9.0f\n",
              one, two);
  return 0;
}
