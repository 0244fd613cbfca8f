// SPDX-License-Identifier: BSD-3-Clause
// Airspeed without a pitot: the forward specific force as a function of throttle, airspeed and load is learnt
// while the pitot works, and inverted when it is lost. With V the equivalent airspeed and d the throttle
// behind the propeller's lag, thrust over a small range of both and a parabolic polar give (Beard & McLain,
// Small Unmanned Aircraft (2012), sections 4.2 and 4.3, lift from f_z in drag and in the tilt of the lift)
//   f_x = c0 + c1 d + c2 d^2 + c3 d V + c4 V^2 + c5 f_z + c6 f_z^2 / V^2
// linear in the unknowns. f_z contains alpha, so vertical gusts and turns are no error, and no attitude is
// needed. Recursive least squares in the form of a Kalman filter with random-walk parameters (Ljung, System
// Identification (1999), section 11.2): unexcited directions keep their uncertainty.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace fulmar {

/// Recursive least squares for the seven parameters c0 to c6; speeds are equivalent airspeed, m/s.
class AirspeedModel {
 public:
  static constexpr int size = 7;
  static constexpr double block_s = 0.2;  ///< samples of this time are one
  using Vector = Eigen::Matrix<double, size, 1>;
  using Matrix = Eigen::Matrix<double, size, size>;

  /// Means over one block.
  struct Block {
    double f_x_mps2 = 0, f_z_mps2 = 0;  ///< body frame, without biases
    double throttle_frac = 0;           ///< behind the lag
    double Va_mps = 0;                  ///< equivalent: true times the root of the density ratio
  };
  /// Equivalent airspeed from the force, near a given one.
  struct Said {
    double Va_mps = 0;
    double noise_std_mps = 0;  ///< of one block, enlarged for the correlation of successive blocks
    double model_std_mps = 0;  ///< the same in every block: of the parameters
    bool known = false;        ///< the slope of the force by the airspeed is
  };

  AirspeedModel() { P_ = prior().cwiseAbs2().asDiagonal(); }

  /// Learns from a block whose airspeed is measured.
  void learn(const Block& b) {
    const Vector phi = regressors(b), P_phi = P_ * phi;
    const double R = square(std_mps2()) * alone(), S = phi.dot(P_phi) + R;
    const double off = b.f_x_mps2 - phi.dot(theta_);
    const Vector K = P_phi / S;
    theta_ += K * std::clamp(off, -max_off * std::sqrt(S), max_off * std::sqrt(S));
    P_ -= K * P_phi.transpose();
    P_ = (0.5 * (P_ + P_.transpose())).eval();
    seen_s_ += block_s;
    const double share = block_s / (std::min(seen_s_, window_s) + min_s), left = off * R / S;
    square_ += share * (off * left - square_);
    shared_ += share * (off * before_ - shared_);
    before_ = left;
  }
  /// Random walk of the parameters over `dt_s`, with or without learning.
  void wander(double dt_s) {
    const Vector most = prior().cwiseAbs2();
    for (int i = 0; i < size; ++i) P_(i, i) = std::min(P_(i, i) + square(walk * prior()(i)) * dt_s, most(i));
  }

  /// One Newton step from the airspeed of the block; the uncertainty of the slope counts.
  Said airspeed(const Block& b) const {
    Said said;
    const Vector along = slopes(b);
    const double slope = along.dot(theta_), slope_std = std::sqrt(along.dot(P_ * along));
    said.known = seen_s_ > learnt_s && -slope > sure * slope_std;
    if (!said.known) return said;
    Block there = b;
    const double off = b.f_x_mps2 - regressors(b).dot(theta_);
    there.Va_mps = said.Va_mps = std::clamp(b.Va_mps + off / slope, 0.5 * b.Va_mps, 2 * b.Va_mps);
    const Vector phi = regressors(there);
    said.noise_std_mps = std_mps2() * std::sqrt(alone()) / -slope;
    said.model_std_mps = std::sqrt(phi.dot(P_ * phi)) / -slope;
    return said;
  }

  double slope_per_s(const Block& b) const { return slopes(b).dot(theta_); }  ///< df_x/dV
  double std_mps2() const { return std::sqrt(std::max(square_, square(min_mps2))); }
  /// Number of correlated blocks with the information of one independent block.
  double alone() const {
    const double r = std::clamp(shared_ / std::max(square_, square(min_mps2)), 0.0, max_shared);
    return (1 + r) / (1 - r);
  }
  const Matrix& covariance() const { return P_; }

 private:
  static constexpr double V0 = 15, g = 9.80665;                     ///< scales: m/s, m/s2
  static constexpr double window_s = 60, min_s = 5, learnt_s = 20;  ///< of the residual; before it is used
  static constexpr double min_mps2 = 0.02, max_shared = 0.9, max_off = 3;
  static constexpr double sure = 3;     ///< standard deviations of the slope
  static constexpr double walk = 2e-3;  ///< of the prior standard deviation, per root of a second

  static double square(double x) { return x * x; }
  /// m/s2: thrust below 2 g, drag and lift's tilt below some g.
  static Vector prior() { return (Vector() << 3, 20, 20, 20, 3, 3, 3).finished(); }
  static Vector regressors(const Block& b) {
    const double d = b.throttle_frac, v = std::max(b.Va_mps / V0, 0.1), z = b.f_z_mps2 / g;
    return (Vector() << 1, d, d * d, d * v, v * v, z, z * z / (v * v)).finished();
  }
  /// By the airspeed.
  static Vector slopes(const Block& b) {
    const double d = b.throttle_frac, v = std::max(b.Va_mps / V0, 0.1), z = b.f_z_mps2 / g;
    return (Vector() << 0, 0, 0, d, 2 * v, 0, -2 * z * z / (v * v * v)).finished() / V0;
  }

  Vector theta_ = Vector::Zero();
  Matrix P_;
  double square_ = 0.25, shared_ = 0.1, before_ = 0, seen_s_ = 0;
};

}  // namespace fulmar
