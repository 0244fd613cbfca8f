// SPDX-License-Identifier: BSD-3-Clause
// Error-state (multiplicative) extended Kalman filter: prediction, scalar update, late measurements. Every
// slow error is a state (states.hpp), so that the diagonal of the covariance is the variance of the estimate.
// Sources: Sola, Quaternion kinematics for the error-state Kalman filter (2017), section 7 (global angular
// error); Groves, Principles of GNSS, Inertial and Multisensor Integrated Navigation Systems (2013), ch. 14;
// Schmidt's considered states: Bierman, Factorization Methods for Discrete Sequential Estimation (1977), ch.
// 8.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "bench/second_filter/faults.hpp"
#include "bench/second_filter/past.hpp"

namespace fulmar::second_filter {

/// Noise of the inertial unit as spectral densities, so that nothing depends on its rate.
struct Unit {
  double gyro = 5e-4;      ///< rad/s/sqrt(Hz)
  double accel = 0.02;     ///< m/s2/sqrt(Hz)
  double gyro_scale = 0;   ///< 1/sqrt(Hz): share of the turn rate that is error
  double accel_scale = 0;  ///< 1/sqrt(Hz): share of the load beyond 1 g that is error
  double motion = 1;       ///< factor on the variance of both, as the innovations show it
};

/// Time is seconds on any clock that does not jump.
class Filter {
 public:
  Unit unit;
  double gravity_mps2 = 9.80665;
  double sideslip_gust = 0;  ///< share of a change of the gust across the aircraft that becomes sideslip
  double wind_shear = 0;     ///< 1/sqrt(s): added to the walk of the wind per m/s of climb

  /// Model of the block that begins at `first`. Throws std::out_of_range when there is none.
  Block& block(int first) {
    for (int i = 0; i < blocks_; ++i)
      if (table_[static_cast<std::size_t>(i)].first == first) return table_[static_cast<std::size_t>(i)];
    throw std::out_of_range("no block of the filter begins here");
  }
  void add_block(const Block& block) {
    if (blocks_ == most_blocks) throw std::length_error("the filter has no room for another block");
    table_[static_cast<std::size_t>(blocks_++)] = block;
  }
  /// Appends one state of a component; returns its index. Throws std::length_error when there is no room.
  int append(double std, double walk, double time_s = 0, Drive effect = nullptr) {
    if (last_ == size) throw std::length_error("at most 3 states can be appended to the filter");
    add_block({last_, 1, std, walk, time_s, effect});
    P_(last_, last_) = std * std;
    return last_++;
  }
  /// Recomputes what follows from the table, after a change of a block.
  void renew() { step_of_decay_ = -1; }

  /// Begins with `nominal`, the standard deviations of the first fifteen states, and the others as in the
  /// table.
  void reset(const Nominal& nominal, const Eigen::Matrix<double, 15, 1>& std, double time_s) {
    P_.setZero();
    for (int i = 0; i < 15; ++i) P_(i, i) = std(i) * std(i);
    for (int i = 0; i < blocks_; ++i) {
      const Block& b = table_[static_cast<std::size_t>(i)];
      if (b.first >= wind) forget(b.first, b.count, b.std);
    }
    restart(nominal, time_s);
  }
  /// A new estimate at another time; the covariance stays.
  void restart(const Nominal& nominal, double time_s) {
    x_ = nominal;
    x_.q_nb.normalize();
    R_nb_ = x_.q_nb.toRotationMatrix();
    time_s_ = time_s;
    begin_jumps();
    has_sample_ = false;
    step_ = {};
    memory_.clear();
    remember();
  }

  /// Integrates one IMU sample, valid `dt` seconds after the one before; linear in between.
  void predict(const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    if (!(dt > 0)) return;
    if (!has_sample_) {
      omega_ = omega_b;
      f_ = f_b;
      has_sample_ = true;
    }
    const Vector3d bg = x_.at<3>(gyro_bias), ba = x_.at<3>(accel_bias);
    const Matrix3d R_before = R_nb_;
    const Vector3d turn = (0.5 * (omega_ + omega_b) - bg) * dt;
    x_.q_nb = x_.q_nb * exp_map(turn);
    x_.q_nb.coeffs() *= 1.5 - 0.5 * x_.q_nb.squaredNorm();
    R_nb_ = x_.q_nb.toRotationMatrix();
    const Vector3d dv = 0.5 * dt * (R_before * (f_ - ba) + R_nb_ * (f_b - ba));
    const Vector3d v_before = x_.v_n();
    x_.x.segment<3>(vel) += dv + Vector3d(0, 0, gravity_mps2 * dt);
    x_.x.segment<3>(pos) += 0.5 * dt * (v_before + x_.v_n());
    omega_ = omega_b;
    f_ = f_b;
    time_s_ += dt;
    step_.R_dt += (0.5 * dt) * (R_before + R_nb_);
    step_.dv += dv;
    step_.turn += turn;
    step_.time += dt;
    if (step_.time >= covariance_period_s - 1e-9) propagate();
  }

  /// One scalar update. `gain`: 0 for a state that is considered and not corrected, else 1. The measurement
  /// is rejected when its innovation exceeds `gate` standard deviations; with `force` it then has the weight
  /// of one that is there. P' = (I - K H) P (I - K H)' + K R K'.
  Fused fuse(const Scalar& z, double variance, double gate, const Vector& gain, bool force = false) {
    const Vector PHt = project(z);
    const double expected = z.H.dot(PHt) + variance, std = std::sqrt(expected), ratio = z.innovation / std;
    if (!std::isfinite(ratio)) return {false, ratio};
    const bool accepted = std::abs(ratio) <= gate;
    if (!accepted && !force) {
      // The first rejection: a jump has just happened, and a window that began before would blur it.
      if (time_s_ - rejected_s_ > calm_s) jumps_[0].begin(time_s_);
      rejected_s_ = time_s_;
      for (Jumps& jumps : jumps_) jumps.fused(z.H, Vector::Zero(), z.innovation, expected, gate);
      return {false, ratio};
    }
    const double S = accepted ? expected : expected * (ratio / gate) * (ratio / gate);
    const Vector K = PHt.cwiseProduct(gain) / S, u = PHt - 0.5 * S * K;
    for (Jumps& jumps : jumps_) jumps.fused(z.H, K, z.innovation, expected, gate);
    for (int i = 0; i < size; ++i) P_.col(i).noalias() -= K(i) * u + u(i) * K;
    for (int i = 0; i < size; ++i) P_(i, i) = std::max(P_(i, i), 0.0);
    correct(K * z.innovation);
    return {accepted, ratio};
  }
  /// From now on jumps are looked for.
  void begin_jumps() {
    for (Jumps& jumps : jumps_) jumps.begin(time_s_);
  }
  /// Looks for a jump whose likelihood ratio exceeds `least`, by more in a short window and with a unit that
  /// errs under motion, where a motion outside the model may look like one. The state becomes the mean of all
  /// hypotheses, weighted with their likelihoods, and the covariance that of their mixture.
  Fault find_fault(double least, bool judge_unit = true) {
    Fault fault;
    const double doubt = 1 + std::max(0.0, 0.5 * std::log(unit.motion));
    for (Jumps& jumps : jumps_) {
      const Jumps::PerJump ratio = jumps.ratio(time_s_, judge_unit && unit.motion < judged_motion);
      const auto best =
          static_cast<std::size_t>(std::max_element(ratio.begin(), ratio.end()) - ratio.begin());
      const double most = ratio[best];
      const MayJump& suspect = may_jump[best];
      if (!(most > least * doubt * (1 + Jumps::hasty_s / jumps.window_s())) ||
          std::abs(jumps.size_of(best)) < suspect.least) {
        if (jumps.over(time_s_)) jumps.begin(time_s_);
        continue;
      }
      fault = {suspect.first, jumps.size_of(best), most, suspect.ramp};
      Vector mean = Vector::Zero();
      Covariance spread = Covariance::Zero();
      double weights = 0;
      for (std::size_t i = 0; i < Jumps::count; ++i) {
        const double weight = std::exp(0.5 * (ratio[i] - most));
        if (weight < 0.01) continue;
        const Vector jump = jumps.change(i);
        weights += weight;
        mean += weight * jump;
        spread += weight * (jump * jump.transpose() + jumps.spread(i));
      }
      mean /= weights;
      P_ += spread / weights - mean * mean.transpose();
      inflate(suspect.first, suspect.count, relearnt_share * std::abs(fault.size));
      correct(mean);
      for (Jumps& each : jumps_) each.begin(time_s_);
      return fault;
    }
    return fault;
  }

  /// (m/s)^2: variance of the velocity by errors of the unit under motion, since the last call.
  double take_motion_variance() { return std::exchange(motion_variance_, 0.0); }

  /// Standard deviation that `fuse` expects of this innovation.
  double expected_std(const Scalar& z, double variance) const {
    return std::sqrt(z.H.dot(project(z)) + variance);
  }

  /// Moves the state and leaves its covariance.
  void correct(const Vector& dx) {
    if (dx.head<3>().squaredNorm() > 1e-4) turn_past(dx);
    x_.add(dx);
    R_nb_ = x_.q_nb.toRotationMatrix();
    memory_.correct(dx.segment<3>(pos), dx.segment<3>(vel), time_s_);
  }
  void correct(int i, double dx) {
    Vector all = Vector::Zero();
    all(i) = dx;
    correct(all);
  }

  /// Resets the variance of a part of the state; no correlation with the rest.
  void forget(int first, int count, double std) {
    begin_jumps();
    for (int i = first; i < first + count; ++i) {
      P_.row(i).setZero();
      P_.col(i).setZero();
      P_(i, i) = std * std;
    }
  }
  /// Adds uncertainty for an event outside the model: a gap, a collision, a fault of a sensor.
  void inflate(int first, int count, double std) {
    for (int i = first; i < first + count; ++i) P_(i, i) += std * std;
  }
  void place(const Vector3d& p_n, const Vector3d& v_n) {
    Vector dx = Vector::Zero();
    dx.segment<3>(vel) = v_n - x_.v_n();
    dx.segment<3>(pos) = p_n - x_.p_n();
    correct(dx);
  }
  void set_attitude(const Quaterniond& q_nb) {
    x_.q_nb = q_nb.normalized();
    R_nb_ = x_.q_nb.toRotationMatrix();
  }
  /// A linear change of the error state by a factor of its covariance: P += A A'.
  template <int n>
  void widen(const Eigen::Matrix<double, size, n>& A) {
    P_.noalias() += A * A.transpose();
  }

  /// State of the past by the present estimate.
  Past at(double time_s) const { return memory_.at(time_s, now()); }

  const Nominal& state() const { return x_; }
  double operator()(int i) const { return x_.x(i); }
  const Matrix3d& R_nb() const { return R_nb_; }
  const Covariance& covariance() const { return P_; }
  double time_s() const { return time_s_; }
  double std(int i) const { return std::sqrt(P_(i, i)); }
  Vector3d rate_b() const { return omega_ - x_.at<3>(gyro_bias); }
  Vector3d specific_force_b() const { return f_ - x_.at<3>(accel_bias); }

 private:
  static constexpr double covariance_period_s = 0.01;  ///< the state follows every sample
  static constexpr double judged_motion = 4;  ///< beyond, a motion outside the model looks like a fault
  static constexpr double biased_share =
      0.007;                             ///< 1/s: scale errors of the unit that look like a bias for a time
  static constexpr double calm_s = 0.5;  ///< without a rejection
  static constexpr double relearnt_share = 0.1;  ///< of a jump: its standard deviation afterwards
  static constexpr int most_blocks = 21 + size - appended;

  struct Step {  ///< since the last update of the covariance
    Matrix3d R_dt = Matrix3d::Zero();
    Vector3d dv = Vector3d::Zero(), turn = Vector3d::Zero();
    double time = 0;
  };
  Vector project(const Scalar& z) const {  // P H'
    Vector PHt = Vector::Zero();
    for (int i = 0; i < size; ++i)
      if (z.H(i) != 0) PHt.noalias() += z.H(i) * P_.col(i);
    return PHt;
  }

  /// P <- Phi P Phi' + Q over the accumulated step, with T its length, B = sum R dt, [dv]x the specific force
  /// integrated:
  /// - theta' = theta - B bg
  /// - v' = v - [dv]x theta - B ba + [dv]x B bg / 2
  /// - p' = p + T v + T/2 (-[dv]x theta - B ba)
  ///
  /// and a column of its own for each appended state that drives the motion. Only the first nine rows of Phi
  /// differ from a diagonal, and P is symmetric: W = P Phi' is made column by column, which vectorises.
  void propagate() {
    const double T = step_.time;
    const Matrix3d& B = step_.R_dt;
    const Matrix3d D = -skew(step_.dv), E = -0.5 * D * B;
    const auto shear = [&](const auto& in, auto& out) {  // in * Phi' for the columns theta, vel, pos
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out.col(vel + i) = D(i, j) * in.col(theta + j) + D(i, k) * in.col(theta + k) -
                           B(i, 0) * in.col(accel_bias) - B(i, 1) * in.col(accel_bias + 1) -
                           B(i, 2) * in.col(accel_bias + 2);
        out.col(pos + i) = in.col(pos + i) + T * in.col(vel + i) + 0.5 * T * out.col(vel + i);
        out.col(vel + i) += in.col(vel + i) + E(i, 0) * in.col(gyro_bias) + E(i, 1) * in.col(gyro_bias + 1) +
                            E(i, 2) * in.col(gyro_bias + 2);
        out.col(theta + i) = in.col(theta + i) - B(i, 0) * in.col(gyro_bias) -
                             B(i, 1) * in.col(gyro_bias + 1) - B(i, 2) * in.col(gyro_bias + 2);
      }
      for (int i = 0; i < last_ - appended; ++i)
        if (driven_[static_cast<std::size_t>(i)])
          for (int k = 0; k < 9; ++k) out.col(k) += drives_(k, i) * in.col(appended + i);
    };
    drive(T, B);
    Eigen::Matrix<double, size, 9> W;
    shear(P_, W);
    const Eigen::Matrix<double, 9, size> Wt = W.transpose();
    Eigen::Matrix<double, 9, 9> A;
    shear(Wt, A);
    P_.topLeftCorner<9, 9>() = 0.5 * (A + A.transpose());
    P_.bottomLeftCorner<size - 9, 9>() = W.bottomRows<size - 9>();
    P_.topRightCorner<9, size - 9>() = W.bottomRows<size - 9>().transpose();
    add_noise(T);
    for (Jumps& jumps : jumps_) jumps.predicted(B, D, E, T, decay_);
    step_ = {};
    remember();
  }
  /// The columns of appended states that drive the motion, and what their values do to it.
  void drive(double T, const Matrix3d& B) {
    const Motion motion{T, B / T, step_.turn / T, B.transpose() * step_.dv / (T * T)};
    Vector moved = Vector::Zero();
    bool any = false;
    for (int i = 0; i < blocks_; ++i) {
      const Block& b = table_[static_cast<std::size_t>(i)];
      if (b.first < appended) continue;
      driven_[static_cast<std::size_t>(b.first - appended)] = b.drive != nullptr;
      if (!b.drive) continue;
      drives_.col(b.first - appended) = b.drive(motion);
      moved.head<9>() += drives_.col(b.first - appended) * x_.x(b.first);
      any = true;
    }
    if (!any) return;
    x_.add(moved);
    R_nb_ = x_.q_nb.toRotationMatrix();
  }

  void add_noise(double T) {
    if (T != step_of_decay_) new_step(T);
    if (decays_) {
      x_.x = x_.x.cwiseProduct(decay_);
      for (int i = 0; i < size; ++i) P_.col(i) = P_.col(i).cwiseProduct(decay_ * decay_(i));
    }
    P_.diagonal() += noise_;
    // A gust from the side is sideslip until the aircraft has turned into it.
    const Vector2d across = R_nb_.col(1).head<2>(), slipped = sideslip_gust * noise_(gust) * across;
    P_(slip, slip) += sideslip_gust * slipped.dot(across);
    P_.block<2, 1>(gust, slip) -= slipped;
    P_.block<1, 2>(slip, gust) -= slipped.transpose();
    const double turn = unit.gyro_scale * step_.turn.norm() / T,
                 load = unit.accel_scale * std::abs(step_.dv.norm() / T - gravity_mps2);
    const double by_load = unit.motion * load * load * T;
    const double bias_T = unit.motion * biased_share * biased_share * T;
    P_.diagonal().segment<3>(gyro_bias).array() += turn * turn * bias_T;
    P_.diagonal().segment<3>(accel_bias).array() += load * load * bias_T;
    P_.diagonal().segment<3>(theta).array() += (unit.gyro * unit.gyro + unit.motion * turn * turn) * T;
    P_.diagonal().segment<3>(vel).array() += unit.accel * unit.accel * T + by_load;
    motion_variance_ += by_load;
    const double shear = wind_shear * x_.x(vel + 2);
    P_.diagonal().segment<2>(wind).array() += shear * shear * T;
  }
  void new_step(double T) {
    step_of_decay_ = T;
    decay_.setOnes();
    noise_.setZero();
    decays_ = false;
    for (int i = 0; i < blocks_; ++i) {
      const Block& b = table_[static_cast<std::size_t>(i)];
      const double phi = b.time_s > 0 ? std::exp(-T / b.time_s) : 1;
      decays_ = decays_ || phi != 1;
      decay_.segment(b.first, b.count).setConstant(phi);
      noise_.segment(b.first, b.count)
          .setConstant((b.time_s > 0 ? b.std * b.std * (1 - phi * phi) : 0) + b.walk * b.walk * T);
    }
  }

  Memory::Now now() const { return {time_s_, x_.p_n(), x_.v_n()}; }
  void remember() { memory_.remember(now()); }
  /// A correction of the attitude applies to past states as well: their velocity changes by the specific
  /// force since then. Corrections below half a degree are left out.
  void turn_past(const Vector& dx) {
    const Vector3d R_dba = R_nb_ * dx.segment<3>(accel_bias), R_dbg = R_nb_ * dx.segment<3>(gyro_bias);
    memory_.change(time_s_, [&](const Past& then) -> Vector3d {
      const Vector3d f_age = x_.v_n() - then.v_n - Vector3d(0, 0, gravity_mps2 * then.age_s);
      return f_age.cross(dx.head<3>() + 0.5 * then.age_s * R_dbg) + then.age_s * R_dba;
    });
  }

  std::array<Jumps, 3> jumps_{Jumps(2), Jumps(8), Jumps(40)};  ///< s
  std::array<Block, most_blocks> table_{};
  int blocks_ = 0, last_ = appended;
  Eigen::Matrix<double, 9, size - appended> drives_ = Eigen::Matrix<double, 9, size - appended>::Zero();
  std::array<bool, size - appended> driven_{};
  Vector decay_ = Vector::Ones(), noise_ = Vector::Zero();  ///< over a step of `step_of_decay_`
  double step_of_decay_ = -1;
  bool decays_ = false;

  Nominal x_;
  Matrix3d R_nb_ = Matrix3d::Identity();
  Covariance P_ = Covariance::Zero();
  double time_s_ = 0, rejected_s_ = -1e9;
  Vector3d omega_ = Vector3d::Zero(), f_ = Vector3d::Zero();
  bool has_sample_ = false;
  Step step_;
  double motion_variance_ = 0;
  Memory memory_;
};

}  // namespace fulmar::second_filter
