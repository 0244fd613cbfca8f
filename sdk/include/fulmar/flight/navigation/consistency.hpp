// SPDX-License-Identifier: BSD-3-Clause
// Consistency of an estimate: errors against reported standard deviations, the normalised squared error of
// nine states, whiteness and size of innovations. Source: Bar-Shalom, Li & Kirubarajan, Estimation with
// Applications to Tracking and Navigation (2001), section 5.4.
#pragma once
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::consistency {

/// Errors of one quantity, and the share within its reported standard deviation.
struct Channel {
  double error2 = 0, claim2 = 0;
  std::size_t n = 0, within_1 = 0, within_2 = 0;

  void add(double error, double std) {
    error2 += error * error;
    claim2 += std * std;
    ++n;
    within_1 += std::abs(error) < std;
    within_2 += std::abs(error) < 2 * std;
  }
  double over_n(double x) const { return n > 0 ? x / static_cast<double>(n) : 0; }
  double rms() const { return std::sqrt(over_n(error2)); }
  double claim() const { return std::sqrt(over_n(claim2)); }
  double share_1() const { return over_n(static_cast<double>(within_1)); }
  double share_2() const { return over_n(static_cast<double>(within_2)); }
};

/// One sensor over many flights: mean squared innovation in standard deviations (1: as expected), and
/// correlation of successive ones. Their mean is not subtracted, because it should be 0.
struct Innovations {
  static constexpr std::size_t lags = 5;
  std::array<double, lags + 1> products{};
  std::size_t n = 0;

  void add_flight(const std::vector<double>& ratios) {
    n += ratios.size();
    for (std::size_t lag = 0; lag <= lags; ++lag)
      for (std::size_t i = lag; i < ratios.size(); ++i) products[lag] += ratios[i] * ratios[i - lag];
  }
  double nis() const { return n > 0 ? products[0] / static_cast<double>(n) : 0; }
  double correlation(std::size_t lag) const { return products[0] > 0 ? products[lag] / products[0] : 0; }
};

/// e' P^-1 e of attitude, velocity and position, from standard deviations and the correlations between them.
class Nees {
 public:
  static constexpr double low = 2.70, high = 19.02;  ///< 95 % of chi-square of 9 degrees of freedom
  using Errors = Eigen::Matrix<double, 9, 1>;

  /// Truth minus estimate: the small rotation about the NED axes, velocity, position.
  static Errors errors(const VehicleState& truth, const VehicleState& estimate) {
    Errors e;
    e << log_map(eigen(truth.attitude) * eigen(estimate.attitude).conjugate()),
        eigen(truth.velocity_mps) - eigen(estimate.velocity_mps),
        eigen(truth.position_m) - eigen(estimate.position_m);
    return e;
  }
  /// The standard deviations that the estimate reports.
  static Errors claims(const VehicleState& estimate) {
    Errors std;
    std << eigen(estimate.attitude_std_rad), eigen(estimate.velocity_std_mps), eigen(estimate.position_std_m);
    return std;
  }

  static double of(const Errors& error, const Errors& std, const std::array<double, 36>& correlation) {
    Eigen::Matrix<double, 9, 9> C = Eigen::Matrix<double, 9, 9>::Identity();
    std::size_t k = 0;
    for (int i = 1; i < 9; ++i)
      for (int j = 0; j < i; ++j) C(i, j) = C(j, i) = correlation[k++];
    const Errors e = error.cwiseQuotient(std);
    return e.dot(C.ldlt().solve(e));
  }
  void add(double nees) {
    sum_ += nees;
    ++n_;
    inside_ += nees > low && nees < high;
  }
  bool any() const { return n_ > 0; }  ///< moment that was judged
  double mean() const { return n_ > 0 ? sum_ / static_cast<double>(n_) : 0; }
  double inside() const { return n_ > 0 ? static_cast<double>(inside_) / static_cast<double>(n_) : 0; }

 private:
  double sum_ = 0;
  std::size_t n_ = 0, inside_ = 0;
};

}  // namespace fulmar::consistency
