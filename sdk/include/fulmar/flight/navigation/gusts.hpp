// SPDX-License-Identifier: BSD-3-Clause
// Gusts beside the filter's steady wind: their strength and the present gust. The filter does not use them:
// docs/decisions.md, record 62.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "fulmar/flight/math/filters.hpp"
#include "fulmar/flight/navigation/params.hpp"

namespace fulmar::navigation {

/// Standard deviation and time constant of gusts. Of a first-order Gauss-Markov process of standard deviation
/// s the mean square of the change over a time t is D(t) = 2 s^2 (1 - exp(-t / tau)); a wrong mean wind or
/// pitot scale changes little. With r = exp(-1 s / tau), D(4 s) / D(1 s) is 1 + r + r^2 + r^3.
class GustStrength {
 public:
  /// `excess` is the airspeed of the pitot minus that of the mean wind.
  void add(double excess_mps, double time_s, const Params& p) {
    const double dt = time_s - last_s_;
    last_s_ = time_s;
    if (!(dt < 1)) {  // the pitot had a gap, or the flight begins
      smooth_ = excess_mps;
      count_ = 0;
    }
    smooth_ += (excess_mps - smooth_) * (1 - std::exp(-std::clamp(dt, 0.0, 1.0) / smooth_s));
    if (count_ > 0 && time_s - stepped_s_ < 1) return;
    stepped_s_ = time_s;
    if (std_ < 0) {  // as if the first guess had been seen
      const double s2 = 2 * p.wind_gust_std * p.wind_gust_std;
      change_1_ = -s2 * std::expm1(-1 / p.wind_gust_time);
      change_4_ = -s2 * std::expm1(-4 / p.wind_gust_time);
    }
    std::rotate(past_.begin(), past_.end() - 1, past_.end());
    past_[0] = smooth_;
    count_ = std::min(count_ + 1, 5);
    if (count_ > 1) change_1_ += (square(past_[0] - past_[1]) - change_1_) / window_s;
    if (count_ > 4) change_4_ += (square(past_[0] - past_[4]) - change_4_) / window_s;
    solve(p);
  }
  double std_mps(const Params& p) const { return std_ < 0 ? p.wind_gust_std.value : std_; }
  double time_s(const Params& p) const { return std_ < 0 ? p.wind_gust_time.value : time_; }

 private:
  static constexpr double smooth_s = 0.2, window_s = 40, shortest_s = 2, min_mps = 0.1;

  static double square(double x) { return x * x; }
  void solve(const Params& p) {
    // The smoothing reduces both by 2 s^2 smooth_s / tau, for a lag much shorter than tau.
    const double lost = 2 * square(std_mps(p)) * smooth_s / time_s(p), change_4 = change_4_ + lost;
    const double ratio = change_4 / std::max(change_1_ + lost, 1e-12);
    double r = 0.8;
    for (int i = 0; i < 4; ++i)  // Newton; the sum rises with r
      r = std::clamp(r - (1 + r * (1 + r * (1 + r)) - ratio) / (1 + r * (2 + 3 * r)), 1e-6, 1 - 1e-6);
    time_ = std::clamp(-1 / std::log(r), shortest_s, p.wind_gust_time.value);
    std_ = std::max(std::sqrt(change_4 / (-2 * std::expm1(-4 / time_))), min_mps);
  }

  std::array<double, 5> past_{};  ///< the excess, second by second, the last one first
  double smooth_ = 0, last_s_ = -1e9, stepped_s_ = -1e9, change_1_ = 0, change_4_ = 0, std_ = -1, time_ = 0;
  int count_ = 0;
};

/// The present gust, north and east: a Kalman filter of two states beside the main filter. An error of the
/// mean wind is part of the gust here, so its variance adds to that of the gusts.
class Gusts {
 public:
  /// Of the large filter: v - w, and the variances of w.
  struct MeanWind {
    Eigen::Vector3d u_n;
    Eigen::Vector2d variance;
  };

  /// A sample of the pitot.
  void airspeed(const MeanWind& wind, double Va_mps, double time_s, const Params& p) {
    strength_.add(Va_mps - wind.u_n.norm(), time_s, p);
    predict(wind, time_s, p);
    const Eigen::Vector3d u_g = wind.u_n - Eigen::Vector3d(g_.x(), g_.y(), 0);
    const double length = std::max(u_g.norm(), 1.0);
    fuse(Va_mps - u_g.norm(), -u_g.head<2>() / length, speed_std * speed_std);
  }
  /// Zero sideslip; `side_mps` is the standard deviation of the side component without gusts, m/s, `r_y` the
  /// direction of the wing, NED.
  void sideslip(const MeanWind& wind, const Eigen::Vector3d& r_y, double side_mps, double time_s,
                const Params& p) {
    predict(wind, time_s, p);
    const double gusts = p.wind_side_ratio * strength_.std_mps(p);
    fuse(-r_y.dot(wind.u_n) + r_y.head<2>().dot(g_), -r_y.head<2>(), gusts * gusts + side_mps * side_mps);
  }
  /// Nothing is known of the gust: on the ground, and where a flight begins.
  void forget(const MeanWind& wind, double time_s, const Params& p) {
    const double std = strength_.std_mps(p);
    g_.setZero();
    P_ = (wind.variance.array() + std * std).matrix().asDiagonal();
    time_s_ = time_s;
  }

  Eigen::Vector2d gust_mps() const { return g_; }
  const Eigen::Matrix2d& covariance() const { return P_; }
  double std_mps(const Params& p) const { return strength_.std_mps(p); }
  double time_s(const Params& p) const { return strength_.time_s(p); }

 private:
  static constexpr double speed_std = 0.1;  ///< m/s, of a sample of the pitot

  void predict(const MeanWind& wind, double time_s, const Params& p) {
    const double std = strength_.std_mps(p), dt = std::clamp(time_s - time_s_, 0.0, 1e3);
    time_s_ = time_s;
    const double phi = std::exp(-dt / strength_.time_s(p));
    g_ *= phi;
    P_ *= phi * phi;
    P_.diagonal() += ((wind.variance.array() + std * std) * (1 - phi * phi)).matrix();
  }
  /// Joseph's form.
  void fuse(double innovation, const Eigen::Vector2d& h, double variance) {
    const Eigen::Vector2d PH = P_ * h;
    const Eigen::Vector2d K = PH / (h.dot(PH) + variance);
    const Eigen::Matrix2d A = Eigen::Matrix2d::Identity() - K * h.transpose();
    P_ = A * P_ * A.transpose() + variance * K * K.transpose();
    g_ += K * innovation;
  }

  GustStrength strength_;
  Eigen::Vector2d g_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d P_ = Eigen::Matrix2d::Zero();
  double time_s_ = 0;
};

/// Error of the filter's mean wind due to gusts. The filter takes gusts across as white and gusts along as a
/// process of its own; both last longer. The result is the covariance of the errors under the gains of the
/// filter, which differ from those of this model: the error budget of a suboptimal filter (Gelb, Applied
/// Optimal Estimation (1974), section 7.2). Errors are those of the mean wind, gusts north and east, and the
/// gust along that the filter estimates, a.
class MeanWindError {
 public:
  /// A measurement of the air along `h_n` (NED, north and east), and of a where `along` is 1. `gain`: by how
  /// much mean wind and a followed its innovation.
  void fused(const Eigen::Vector3d& gain, const Eigen::Vector2d& h_n, double along, const Gusts& gusts,
             double time_s, const Params& p) {
    const double std = slow_std * gusts.std_mps(p);
    advance(std, slow_time * gusts.time_s(p), time_s, p);
    Vector H, K;
    H << h_n, -h_n, along;
    K << gain.head<2>(), 0, 0, gain.z();
    // The innovation is h (g - e) - a = -H x, with estimate minus truth e: x becomes (1 - K H) x.
    const Vector MH = M_ * H;
    const double S = H.dot(MH);
    for (int i = 0; i < 5; ++i) M_.col(i) += S * K(i) * K - MH * K(i) - K * MH(i);
  }
  /// Where a flight begins.
  void forget(const Gusts& gusts, double time_s, const Params& p) {
    M_.setZero();
    M_.diagonal().segment<2>(2).setConstant(slow_std * slow_std * gusts.std_mps(p) * gusts.std_mps(p));
    time_s_ = time_s;
  }
  /// m/s, north and east.
  Eigen::Vector2d std_mps() const { return M_.diagonal().head<2>().cwiseMax(0).cwiseSqrt(); }

 private:
  using Vector = Eigen::Matrix<double, 5, 1>;
  /// Changes over one and four seconds show the fast part of gusts; the slow part of Dryden's is larger, so
  /// the standard deviation is underestimated.
  static constexpr double slow_std = 1.2, slow_time = 1.4;

  void advance(double std, double tau_s, double time_s, const Params& p) {
    const double dt = std::clamp(time_s - time_s_, 0.0, 1e3);
    time_s_ = time_s;
    const double phi = gust_decay_.of(dt / tau_s), own = own_decay_.of(dt / p.gust_time);
    M_.middleRows<2>(2) *= phi;
    M_.middleCols<2>(2) *= phi;
    M_.row(4) *= own;
    M_.col(4) *= own;
    M_.diagonal().segment<2>(2).array() += std * std * (1 - phi * phi);
  }

  Eigen::Matrix<double, 5, 5> M_ = Eigen::Matrix<double, 5, 5>::Zero();
  Decay gust_decay_, own_decay_;
  double time_s_ = 0;
};

}  // namespace fulmar::navigation
