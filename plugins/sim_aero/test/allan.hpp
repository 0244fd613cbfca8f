// SPDX-License-Identifier: BSD-3-Clause
// Allan deviations of the simulated inertial sensors at rest.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "plugins/sim_aero/suite_spec.hpp"

namespace fulmar::sim {

/// Overlapping Allan deviation at the averaging time of `m` samples. NIST SP 1065 (2008), (11); IEEE Std
/// 952-1997, C.1. `sum[k]` is the sum of the first k samples.
inline double allan_deviation(const std::vector<double>& sum, std::size_t m) {
  const std::size_t n = sum.size() - 1;
  double squares = 0;
  for (std::size_t k = 0; k + 2 * m <= n; ++k) {
    const double d = sum[k + 2 * m] - 2 * sum[k + m] + sum[k];
    squares += d * d;
  }
  const double averages = static_cast<double>(n - 2 * m + 1), M = static_cast<double>(m);
  return std::sqrt(squares / (2 * M * M * averages));
}

/// Averaging times from one second to a tenth of the record, sqrt(2) apart.
struct Curve {
  std::vector<double> tau_s, deviation;  ///< mean square of three axes
  double at_1s() const { return deviation.front(); }
  double lowest() const {
    double least = std::numeric_limits<double>::infinity();
    for (const double d : deviation) least = std::min(least, d);
    return least;
  }
};

/// One sensor's errors for `seconds`, and their means over 0.1 s, which is all that is kept of them.
inline Curve allan_curve(const std::array<NoiseSpec, 3>& noise, const SheetSpec& sheet, double rate_hz,
                         double seconds, std::uint64_t seed) {
  Random random(mix_seed(seed, 1));
  Noise3 axes(noise, 1 / rate_hz, random);
  Sheet rest(sheet, 1 / rate_hz, mix_seed(seed, 2));
  const int each = static_cast<int>(std::lround(0.1 * rate_hz));
  const auto count = static_cast<std::size_t>(10 * seconds);
  std::array<std::vector<double>, 3> sum;
  for (auto& s : sum) s.assign(count + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int k = 0; k < each; ++k) {
      const Eigen::Vector3d none = Eigen::Vector3d::Zero();
      mean += rest.digits(rest.smooth(rest.bent(none) + axes.next(random)));
    }
    for (std::size_t a = 0; a < 3; ++a) sum[a][i + 1] = sum[a][i] + mean[static_cast<Eigen::Index>(a)] / each;
  }
  Curve curve;
  for (double tau = 1; tau <= seconds / 10; tau *= std::sqrt(2)) {
    const auto m = static_cast<std::size_t>(std::lround(10 * tau));
    double squares = 0;
    for (const auto& s : sum) squares += std::pow(allan_deviation(s, m), 2);
    curve.tau_s.push_back(static_cast<double>(m) / 10);
    curve.deviation.push_back(std::sqrt(squares / 3));
  }
  return curve;
}

}  // namespace fulmar::sim
