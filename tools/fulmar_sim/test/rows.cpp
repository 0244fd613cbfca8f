// SPDX-License-Identifier: BSD-3-Clause
// The flight of the Python test with the C++ headers: rows as raw doubles on the standard output.
#include <cstdio>

#include "fulmar/sim/airframe_file.hpp"
#include "fulmar/sim/batch.hpp"

using namespace fulmar::sim;

int main() {
  constexpr std::size_t n = 5;
  SimulationOptions options;
  options.origin_altitude_m = 1387;
  options.weather.turbulence = fulmar::Turbulence::light;
  Batch batch(read_airframe("configs/airframes/anaconda.yaml"), n, options, 7);
  std::vector<double> actions(n * action_columns), rows(n * row_columns);
  for (std::size_t i = 0; i < n; ++i) {
    batch[i].plant().set_wind({3, -4, 0.25});
    if (!batch[i].fly({0, 0, -300}, 0.5, 17)) return 1;
  }
  for (int k = 0; k < 40; ++k) {
    const double s = k % 2 ? 0.03125 : -0.03125;
    for (std::size_t i = 0; i < n; ++i) {
      const double way = static_cast<double>(i) * 0.5;
      const double all[] = {0.5625 + s, s * way, 0.125 + 0.5 * s, -s};
      std::copy(std::begin(all), std::end(all), &actions[i * action_columns]);
    }
    batch.step(actions, 0.0025, 20, rows);
  }
  return std::fwrite(rows.data(), sizeof(double), rows.size(), stdout) == rows.size() ? 0 : 1;
}
