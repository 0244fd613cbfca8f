// SPDX-License-Identifier: BSD-3-Clause
// Is what an estimate says of its errors true? Errors beside the deviations that were claimed for them, the
// normalised squared error of nine states, and whether innovations are white and as large as expected.
// Bar-Shalom, Li & Kirubarajan, Estimation with Applications to Tracking and Navigation (2001), section 5.4.
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/attitude.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::consistency {

/// Of one quantity: how large its errors are, and how often they stay within what was claimed.
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

/// Of one sensor, over many flights: the mean of the squared innovations in deviations (1: as large as
/// expected), and how far they follow each other. Their mean is not taken off: it should be 0.
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

/// e' P^-1 e of attitude, velocity and position, from deviations and the correlations between them.
class Nees {
 public:
  static constexpr double low = 2.70, high = 19.02;  ///< 95 % of chi-square of 9 degrees of freedom
  using Errors = Eigen::Matrix<double, 9, 1>;

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
  double mean() const { return n_ > 0 ? sum_ / static_cast<double>(n_) : 0; }
  double inside() const { return n_ > 0 ? static_cast<double>(inside_) / static_cast<double>(n_) : 0; }

 private:
  double sum_ = 0;
  std::size_t n_ = 0, inside_ = 0;
};

/// What is said of all flights with one set of sensors in one kind of air.
struct Table {
  std::vector<std::string> order;
  std::map<std::string, Channel> channels;
  std::map<std::string, Innovations> innovations;
  std::vector<Nees> flights;

  Channel& channel(const std::string& name) {
    const auto [at, is_new] = channels.try_emplace(name);
    if (is_new) order.push_back(name);
    return at->second;
  }
  void judge(const VehicleState& x, const VehicleState& s, const FilterCheck& check,
             const Vec3<Ned>& mean_wind_mps, Nees& nees) {
    constexpr double degree = 0.017453292519943295;
    Nees::Errors e, std;
    e << log_map(eigen(x.attitude) * eigen(s.attitude).conjugate()),
        eigen(x.velocity_mps) - eigen(s.velocity_mps), eigen(x.position_m) - eigen(s.position_m);
    std << eigen(s.attitude_std_rad), eigen(s.velocity_std_mps), eigen(s.position_std_m);
    static const std::array<const char*, 9> names{
        "attitude about north, deg", "attitude about east, deg", "attitude about down, deg",
        "velocity north, m/s",       "velocity east, m/s",       "velocity down, m/s",
        "position north, m",         "position east, m",         "position down, m"};
    for (int i = 0; i < 9; ++i) {
      const double unit = i < 3 ? degree : 1;
      channel(names[static_cast<std::size_t>(i)]).add(e(i) / unit, std(i) / unit);
    }
    channel("wind north, m/s").add(x.wind_mps.north - s.wind_mps.north, s.wind_std_mps.north);
    channel("wind east, m/s").add(x.wind_mps.east - s.wind_mps.east, s.wind_std_mps.east);
    channel("mean wind north, m/s")
        .add(mean_wind_mps.north - check.mean_wind_mps.north, check.mean_wind_std_mps.north);
    channel("mean wind east, m/s")
        .add(mean_wind_mps.east - check.mean_wind_mps.east, check.mean_wind_std_mps.east);
    channel("airspeed, m/s").add(x.airspeed_mps - s.airspeed_mps, s.airspeed_std_mps);
    nees.add(Nees::of(e, std, check.correlation_ratio));
  }
};

}  // namespace fulmar::consistency
