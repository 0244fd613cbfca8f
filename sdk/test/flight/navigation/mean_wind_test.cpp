// SPDX-License-Identifier: BSD-3-Clause
// Effect of gusts on the mean wind, with given gains.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/navigation/gusts.hpp>

namespace mean_wind_test {

using namespace fulmar;

TEST_CASE("what gusts make of a mean wind that follows them with a constant gain is as in the closed form") {
  navigation::Params p;
  navigation::Gusts gusts;  // defaults: 1 m/s and 12 s, used times 1.2 and 1.4
  for (const double side : {1.0, -1.0})
    for (const double gain : {0.02, 0.2}) {
      navigation::MeanWindError error;
      error.forget(gusts, 0, p);
      for (int k = 1; k <= 20000; ++k) error.fused({side * gain, 0, 0}, {side, 0}, 0, gusts, 0.1 * k, p);
      // e' = (1 - k) e + k g', g of first order: var e = k^2 s^2 (1 + a phi) / ((1 - a^2) (1 - a phi))
      const double phi = std::exp(-0.1 / (1.4 * 12)), a = 1 - gain;
      const double variance = gain * gain * 1.44 * (1 + a * phi) / ((1 - a * a) * (1 - a * phi));
      CHECK(error.std_mps().x() == doctest::Approx(std::sqrt(variance)).epsilon(1e-6));
      CHECK(error.std_mps().y() == 0);
    }
}

TEST_CASE("what the filter takes for a gust along does not put its mean wind off") {
  navigation::Params p;
  navigation::Gusts gusts;
  const auto after = [&](double follows) {
    navigation::MeanWindError error;
    error.forget(gusts, 0, p);
    for (int k = 1; k <= 3000; ++k) error.fused({-0.002, 0, follows}, {-1, 0}, 1, gusts, 0.01 * k, p);
    return error.std_mps().x();
  };
  CHECK(after(0.5) < 0.7 * after(0));
}

}  // namespace mean_wind_test
