// SPDX-License-Identifier: BSD-3-Clause
// Aircraft steps per second of a batch of 1000 through the library, by one thread and by two, with one step a
// call and with 20: the Anaconda in level flight, 2.5 ms, no turbulence.
// bench_batch [--json | --asked]
// --asked: for each line `threads steps calls` on standard input it prints the processor time in ns of a
// step of one aircraft (bench_batch.py).
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "fulmar/sim/batch.hpp"
#include "sdk/test/flight/airframe_file.hpp"

using namespace fulmar::sim;

namespace {

constexpr std::size_t n = 1000;

double now_s(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Flight {
  Batch batch;
  std::vector<double> actions = std::vector<double>(n * action_columns);
  std::vector<double> rows = std::vector<double>(n * row_columns);

  Flight(const fulmar::Airframe& a, unsigned threads) : batch(a, n, {.origin_altitude_m = 1387}, 1, threads) {
    for (std::size_t i = 0; i < n; ++i) {
      batch[i].fly({0, 0, -300}, 0, 17);
      const fulmar::Actuators c = batch[i].trim();
      const double all[] = {c.throttle_frac, c.aileron_rad, c.elevator_rad, c.rudder_rad};
      std::copy(std::begin(all), std::end(all), &actions[i * action_columns]);
    }
  }

  /// The smallest time of a call per step of one aircraft.
  double step_s(clockid_t clock, unsigned steps, unsigned calls) {
    double best = 1e9;
    for (unsigned k = 0; k < calls; ++k) {
      const double begin = now_s(clock);
      batch.step(actions, 0.0025, steps, rows);
      best = std::min(best, now_s(clock) - begin);
    }
    return best / (n * steps);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const auto is = [&](const char* option) { return argc > 1 && std::strcmp(argv[1], option) == 0; };
  const fulmar::Airframe a = fulmar::test::airframe_file("anaconda");
  Flight one(a, 1), two(a, 2);
  if (is("--asked")) {
    unsigned threads = 0, steps = 0, calls = 0;
    while (std::scanf("%u %u %u", &threads, &steps, &calls) == 3) {
      std::printf("%.2f\n", 1e9 * (threads == 1 ? one : two).step_s(CLOCK_PROCESS_CPUTIME_ID, steps, calls));
      std::fflush(stdout);
    }
    return 0;
  }
  const char* between = is("--json") ? "{" : "";
  for (const unsigned threads : {1u, 2u})
    for (const unsigned steps : {1u, 20u}) {
      std::printf(is("--json") ? "%s\"threads_%u_steps_%u_per_s\": %.0f"
                               : "%sthreads %u, steps a call %2u  %9.0f aircraft steps per second\n",
                  between, threads, steps, 1 / (threads == 1 ? one : two).step_s(CLOCK_MONOTONIC, steps, 60));
      if (is("--json")) between = ", ";
    }
  if (is("--json")) std::printf("}\n");
  return 0;
}
