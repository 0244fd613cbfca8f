// SPDX-License-Identifier: BSD-3-Clause
// Error-state (multiplicative) extended Kalman filter of a vehicle with an inertial measurement unit: state,
// prediction, scalar update. Measurement models are in ekf_models.hpp; a new sensor is one function that
// returns an innovation and a row of derivatives.
// Sources: Sola, Quaternion kinematics for the error-state Kalman filter (2017), section 7 (global angular
// error); Groves, Principles of GNSS, Inertial and Multisensor Integrated Navigation Systems (2013), ch. 14.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/flight/math/filters.hpp"
#include "fulmar/flight/navigation/ekf_more.hpp"

namespace fulmar {

namespace ekf {

/// Where each part of the error state begins. Attitude is a small rotation about the NED axes: R_true =
/// exp(theta) R_estimate.
inline constexpr int theta = 0, vel = 3, pos = 6, gyro_bias = 9, accel_bias = 12, wind = 15, gust = 17,
                     baro = 18, port = 19, heading = 20, gnss = 21, delay = 23, size = 24;

using Vector = Eigen::Matrix<double, size, 1>;
using Row = Eigen::Matrix<double, 1, size>;
using Covariance = Eigen::Matrix<double, size, size>;

/// Continuous noise: spectral densities and walks, so that nothing depends on a sensor's rate.
struct Noise {
  double gyro = 5e-4;      ///< rad/s/sqrt(Hz), angular random walk
  double accel = 0.02;     ///< m/s2/sqrt(Hz), velocity random walk
  double gyro_scale = 0;   ///< share of a lasting turn rate that is error: adds gyro_scale times the root of
                           ///< omega now and over the last seconds to `gyro`, in 1/sqrt(Hz)
  double accel_scale = 0;  ///< share of a lasting load beyond 1 g that is error, in 1/sqrt(Hz)
  double gyro_bias_walk = 2e-5;   ///< rad/s/sqrt(s)
  double accel_bias_walk = 1e-3;  ///< m/s2/sqrt(s)
  double wind_walk = 0.02;        ///< m/s/sqrt(s)
  double wind_shear = 0.005;      ///< per m/s of climb: added to wind_walk for wind that changes with height
  double gust_std = 1.0;          ///< m/s, first-order Gauss-Markov along the flight direction
  double gust_time = 3.0;         ///< s
  double baro_walk = 0.05;        ///< m/sqrt(s)
  double port_walk = 0;           ///< 1/sqrt(s): share of the dynamic pressure, see Nominal::port_ratio
  double heading_std = 0.035;     ///< rad, first-order Gauss-Markov: magnetometer error after calibration
  double heading_time = 300;      ///< s
  double gnss_std = 0;            ///< m, first-order Gauss-Markov: horizontal GNSS error over minutes
  double gnss_time = 150;         ///< s
  double delay_walk = 1e-4;       ///< s/sqrt(s), of a receiver's delay
};

/// Nominal state: _n in NED, wind as the velocity of the air, biases in body axes. `baro_m`: offset of the
/// barometer, positive when it reads high. `port_ratio`: share of the dynamic pressure at the static port;
/// the barometer reads low by this share of u^2/2g. `heading_rad`: offset of the magnetic heading.
/// `gnss_delay_s`: delay of fixes after their time stamps. The horizontal GNSS error is in the covariance
/// alone.
struct Nominal {
  Eigen::Quaterniond q_nb = Eigen::Quaterniond::Identity();
  Eigen::Vector3d v_n = Eigen::Vector3d::Zero(), p_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero(), accel_bias = Eigen::Vector3d::Zero();
  Eigen::Vector2d wind = Eigen::Vector2d::Zero();
  double gust_mps = 0, baro_m = 0, port_ratio = 0, heading_rad = 0, gnss_delay_s = 0;

  /// The state moved by an error: x (+) dx.
  Nominal plus(const Vector& dx) const {
    Nominal n = *this;
    n.add(dx);
    return n;
  }
  void add(const Vector& dx) {
    q_nb = exp_map(dx.segment<3>(theta)) * q_nb;
    q_nb.coeffs() *= 1.5 - 0.5 * q_nb.squaredNorm();  // first-order normalisation
    v_n += dx.segment<3>(vel);
    p_n += dx.segment<3>(pos);
    gyro_bias += dx.segment<3>(ekf::gyro_bias);
    accel_bias += dx.segment<3>(ekf::accel_bias);
    wind += dx.segment<2>(ekf::wind);
    gust_mps += dx(gust);
    baro_m += dx(baro);
    port_ratio += dx(port);
    heading_rad += dx(heading);
    gnss_delay_s += dx(delay);
  }
  /// The error that leads from `from` to here: dx with from (+) dx = *this.
  Vector minus(const Nominal& from) const {
    Vector dx;
    dx << log_map(q_nb * from.q_nb.conjugate()), v_n - from.v_n, p_n - from.p_n, gyro_bias - from.gyro_bias,
        accel_bias - from.accel_bias, wind - from.wind, gust_mps - from.gust_mps, baro_m - from.baro_m,
        port_ratio - from.port_ratio, heading_rad - from.heading_rad, Eigen::Vector2d::Zero(),
        gnss_delay_s - from.gnss_delay_s;
    return dx;
  }
};

/// A scalar measurement: measured minus expected, and the derivative of the expected value by the error
/// state, and by the states that were appended.
struct Scalar {
  double innovation = 0;
  Row H = Row::Zero();
  MoreRow more = MoreRow::Zero();
};

struct Fused {  ///< result of one scalar update
  bool accepted = false;
  double ratio = 0;  ///< innovation / its standard deviation
};

}  // namespace ekf

/// The filter. Time is seconds on any clock that does not jump.
class ErrorStateEkf {
 public:
  using Vector3 = Eigen::Vector3d;
  using More = ekf::MoreStates<ekf::size>;

  ekf::Noise noise;
  double gravity_mps2 = 9.80665;
  double covariance_period_s = 0.01;  ///< the state follows every sample, its covariance this often

  void reset(const ekf::Nominal& nominal, const ekf::Vector& std, double time_s) {
    x_ = nominal;
    x_.q_nb.normalize();
    R_nb_ = x_.q_nb.toRotationMatrix();
    P_ = std.cwiseAbs2().asDiagonal();
    more_.forget(0, ekf::size);
    time_s_ = time_s;
    has_sample_ = false;
    step_ = {};
    past_count_ = 0;
    remember();
  }

  /// Integrates one IMU sample, valid `dt` seconds after the one before; linear in between.
  void predict(const Vector3& omega_b, const Vector3& f_b, double dt) {
    if (!(dt > 0)) return;
    if (!has_sample_) {
      omega_ = omega_b;
      f_ = f_b;
      has_sample_ = true;
    }
    const Eigen::Matrix3d R_before = R_nb_;
    const Vector3 turn = (0.5 * (omega_ + omega_b) - x_.gyro_bias) * dt;
    x_.q_nb = x_.q_nb * exp_map(turn);
    x_.q_nb.coeffs() *= 1.5 - 0.5 * x_.q_nb.squaredNorm();
    R_nb_ = x_.q_nb.toRotationMatrix();
    const Vector3 dv = 0.5 * dt * (R_before * (f_ - x_.accel_bias) + R_nb_ * (f_b - x_.accel_bias));
    const Vector3 v_before = x_.v_n;
    x_.v_n += dv;
    x_.v_n.z() += gravity_mps2 * dt;
    x_.p_n += 0.5 * dt * (v_before + x_.v_n);
    omega_ = omega_b;
    f_ = f_b;
    time_s_ += dt;
    step_.R_dt += (0.5 * dt) * (R_before + R_nb_);
    step_.dv += dv;
    step_.turn += turn;
    step_.time += dt;
    if (step_.time >= covariance_period_s - 1e-9) propagate_covariance();
  }

  /// One scalar update. The slow GNSS error is considered and not estimated (Schmidt): it is not observable
  /// apart from position, and an estimate follows the drift of the filter. Its gain is 0, so its variance
  /// stays. The measurement is rejected when its innovation exceeds `gate` standard deviations, by
  /// `variance`. Callers that enlarge `variance` for correlated samples gate by `expected_std` first.
  ekf::Fused fuse(const ekf::Scalar& z, double variance, double gate) {
    const ekf::Vector PHt = project(z);
    const double S = expected_variance(z, PHt) + variance;
    const double deviation = std::sqrt(S), ratio = z.innovation / deviation;
    if (!(std::abs(ratio) <= gate)) return {false, ratio};
    const ekf::Vector k = PHt / deviation;
    if (more_.count() > 0) more_.fused(k, more_.project(z.H, z.more) / deviation, ratio);
    const Eigen::Matrix2d considered = P_.block<2, 2>(ekf::gnss, ekf::gnss);
    for (int i = 0; i < ekf::size; ++i) P_.col(i).noalias() -= k(i) * k;  // k k': symmetric to the last bit
    P_.block<2, 2>(ekf::gnss, ekf::gnss) = considered;
    for (int i = 0; i < ekf::size; ++i) P_(i, i) = std::max(P_(i, i), floor_);
    correct(k * ratio);
    return {true, ratio};
  }

  /// The same without correcting attitude, sensor biases and appended states; their uncertainty counts
  /// (Schmidt's considered states). For pseudo-measurements with time-correlated errors. P' = (I - K H) P (I
  /// - K H)' + K R K'.
  ekf::Fused fuse_considering_attitude(const ekf::Scalar& z, double variance, double gate) {
    const ekf::Vector PHt = project(z);
    const double S = expected_variance(z, PHt) + variance, ratio = z.innovation / std::sqrt(S);
    if (!(std::abs(ratio) <= gate)) return {false, ratio};
    ekf::Vector K = PHt / S;
    K.segment<3>(ekf::theta).setZero();
    K.segment<6>(ekf::gyro_bias).setZero();
    K.segment<2>(ekf::gnss).setZero();
    if (more_.count() > 0) more_.considered(K, more_.project(z.H, z.more));
    const ekf::Vector u = PHt - 0.5 * S * K;
    for (int i = 0; i < ekf::size; ++i) P_.col(i) -= K(i) * u + u(i) * K;
    correct(K * z.innovation);
    return {true, ratio};
  }

  /// Deviation that `fuse` expects of this innovation, without touching the state.
  double expected_std(const ekf::Scalar& z, double variance) const {
    return std::sqrt(expected_variance(z, project(z)) + variance);
  }

  /// Appends a state of a component (ekf_more.hpp); measurements use it by `Scalar::more`. Returns its index;
  /// throws when there is no room, so call at set-up.
  int append(const ekf::MoreState& state) { return more_.append(state); }
  const More& more() const { return more_; }
  More& more() { return more_; }

  /// Moves the state and leaves its covariance.
  void correct(const ekf::Vector& dx) {
    if (dx.head<3>().squaredNorm() > 1e-4) turn_past(dx);
    x_.add(dx);
    R_nb_ = x_.q_nb.toRotationMatrix();
    corrected_.p += dx.segment<3>(ekf::pos);
    corrected_.v += dx.segment<3>(ekf::vel);
    corrected_.vt += dx.segment<3>(ekf::vel) * time_s_;
  }

  /// Resets a part of the state: new value in `nominal`, new standard deviation, no correlation with the
  /// rest.
  void forget(int first, int count, double std) {
    for (int i = first; i < first + count; ++i) {
      P_.row(i).setZero();
      P_.col(i).setZero();
      P_(i, i) = std * std;
    }
    more_.forget(first, count);
  }
  /// Adds uncertainty for an event outside the model: a gap, a collision.
  void inflate(int first, int count, double std) {
    for (int i = first; i < first + count; ++i) P_(i, i) += std * std;
  }
  void place(const Vector3& p_n, const Vector3& v_n) {
    ekf::Vector dx = ekf::Vector::Zero();
    dx.segment<3>(ekf::vel) = v_n - x_.v_n;
    dx.segment<3>(ekf::pos) = p_n - x_.p_n;
    correct(dx);
  }
  void set_attitude(const Eigen::Quaterniond& q_nb) {
    x_.q_nb = q_nb.normalized();
    R_nb_ = x_.q_nb.toRotationMatrix();
  }

  /// Past state by the present estimate, for late measurements. `age_s` is 0 for the present.
  struct Past {
    Vector3 p_n, v_n;
    double age_s = 0;
    bool known = false;  ///< false: older than the memory
  };
  Past at(double time_s) const {
    if (time_s >= time_s_ || past_count_ == 0) return {x_.p_n, x_.v_n, 0, time_s >= time_s_};
    const auto back = [&](std::size_t i) -> const Memory& {
      return past_[(past_next_ + past_.size() - 1 - i) % past_.size()];
    };
    const Memory now{time_s_, x_.p_n, x_.v_n, corrected_};
    for (std::size_t i = 0; i < past_count_; ++i) {
      const Memory& before = back(i);
      if (before.time > time_s) continue;
      const Memory& after = i > 0 ? back(i - 1) : now;
      const double k = after.time > before.time ? (time_s - before.time) / (after.time - before.time) : 0;
      const Past a = as_known_now(before), b = as_known_now(after);
      return {a.p_n + k * (b.p_n - a.p_n), a.v_n + k * (b.v_n - a.v_n), time_s_ - time_s, true};
    }
    return {x_.p_n, x_.v_n, 0, false};
  }

  const ekf::Nominal& state() const { return x_; }
  const Eigen::Matrix3d& R_nb() const { return R_nb_; }
  const ekf::Covariance& covariance() const { return P_; }
  void set_covariance(const ekf::Covariance& P) { P_ = P; }
  double time_s() const { return time_s_; }
  double std(int i) const { return std::sqrt(P_(i, i)); }
  Vector3 rate_b() const { return omega_ - x_.gyro_bias; }
  Vector3 specific_force_b() const { return f_ - x_.accel_bias; }

 private:
  static constexpr double floor_ = 1e-14, scale_time_s = 2;

  struct Step {  ///< since the last update of the covariance
    Eigen::Matrix3d R_dt = Eigen::Matrix3d::Zero();
    Vector3 dv = Vector3::Zero(), turn = Vector3::Zero();
    double time = 0;
  };
  struct Corrections {  ///< sums over all updates; vt is weighted with their time
    Vector3 p = Vector3::Zero(), v = Vector3::Zero(), vt = Vector3::Zero();
  };
  struct Memory {
    double time = 0;
    Vector3 p = Vector3::Zero(), v = Vector3::Zero();
    Corrections corrected;
  };

  ekf::Vector project(const ekf::Scalar& z) const {  // P H'
    ekf::Vector PHt = ekf::Vector::Zero();
    for (int i = 0; i < ekf::size; ++i)
      if (z.H(i) != 0) PHt.noalias() += z.H(i) * P_.col(i);
    if (more_.count() > 0) PHt.noalias() += more_.cross().transpose() * z.more.transpose();
    return PHt;
  }
  double expected_variance(const ekf::Scalar& z, const ekf::Vector& PHt) const {  // H P H'
    const double own = z.H.dot(PHt);
    return more_.count() > 0 ? own + z.more.dot(more_.project(z.H, z.more)) : own;
  }

  /// P <- Phi P Phi' + Q over the accumulated step, with T its length, B = sum R dt, [dv]x the specific force
  /// integrated:
  /// - theta' = theta - B bg
  /// - v' = v - [dv]x theta - B ba + [dv]x B bg / 2
  /// - p' = p + T v + T/2 (-[dv]x theta - B ba)
  ///
  /// Only the first nine rows of Phi differ from the identity, and P is symmetric: W = P Phi' is made column
  /// by column, which vectorises.
  void propagate_covariance() {
    using namespace ekf;
    const double T = step_.time;
    const Eigen::Matrix3d& B = step_.R_dt;
    const Eigen::Matrix3d D = -skew(step_.dv);
    const Eigen::Matrix3d E = -0.5 * D * B;
    const auto shear = [&](const auto& in, auto& out) {  // in * Phi' for the columns theta, vel, pos
      for (int i = 0; i < 3; ++i) {
        const auto bg = [&](const Eigen::Matrix3d& M) {
          return M(i, 0) * in.col(ekf::gyro_bias) + M(i, 1) * in.col(ekf::gyro_bias + 1) +
                 M(i, 2) * in.col(ekf::gyro_bias + 2);
        };
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out.col(vel + i) = D(i, j) * in.col(theta + j) + D(i, k) * in.col(theta + k) -
                           B(i, 0) * in.col(accel_bias) - B(i, 1) * in.col(accel_bias + 1) -
                           B(i, 2) * in.col(accel_bias + 2);
        out.col(pos + i) = in.col(pos + i) + T * in.col(vel + i) + 0.5 * T * out.col(vel + i);
        out.col(vel + i) += in.col(vel + i) + bg(E);
        out.col(theta + i) = in.col(theta + i) - bg(B);
      }
    };
    Eigen::Matrix<double, size, 9> W;
    shear(P_, W);
    const Eigen::Matrix<double, 9, size> Wt = W.transpose();
    Eigen::Matrix<double, 9, 9> A;
    shear(Wt, A);
    P_.topLeftCorner<9, 9>() = 0.5 * (A + A.transpose());
    P_.bottomLeftCorner<size - 9, 9>() = W.bottomRows<size - 9>();
    P_.topRightCorner<9, size - 9>() = W.bottomRows<size - 9>().transpose();
    if (more_.count() > 0) {
      Eigen::Matrix<double, ekf::max_more, 9> turned;
      shear(more_.cross(), turned);
      ekf::Vector moved = ekf::Vector::Zero();
      moved.head<9>() =
          more_.propagate({T, B / T, step_.turn / T, B.transpose() * step_.dv / (T * T)}, turned, P_);
      x_.add(moved);
      R_nb_ = x_.q_nb.toRotationMatrix();
    }
    add_noise(T);
    step_ = {};
    remember();
  }

  void add_noise(double T) {
    using namespace ekf;
    const auto add = [&](int first, int count, double variance) {
      for (int i = first; i < first + count; ++i) P_(i, i) += variance;
    };
    // Scale-factor error accumulates with the load now times the load before; the alternating loads of gusts
    // cancel.
    const double lasting = scale_decay_.of(T / scale_time_s), load = step_.dv.norm() / T - gravity_mps2;
    const Vector3 turn = step_.turn / T;
    load_ = lasting * load_ + (1 - lasting) * load;
    turn_ = lasting * turn_ + (1 - lasting) * turn;
    const double gyro = noise.gyro + noise.gyro_scale * std::sqrt(std::max(turn.dot(turn_), 0.0)),
                 accel = noise.accel + noise.accel_scale * std::sqrt(std::max(load * load_, 0.0));
    add(theta, 3, gyro * gyro * T);
    add(vel, 3, accel * accel * T);
    add(ekf::gyro_bias, 3, noise.gyro_bias_walk * noise.gyro_bias_walk * T);
    add(ekf::accel_bias, 3, noise.accel_bias_walk * noise.accel_bias_walk * T);
    const double walk = noise.wind_walk + noise.wind_shear * std::abs(x_.v_n.z());
    add(ekf::wind, 2, walk * walk * T);
    add(ekf::baro, 1, noise.baro_walk * noise.baro_walk * T);
    add(ekf::port, 1, noise.port_walk * noise.port_walk * T);
    add(ekf::delay, 1, noise.delay_walk * noise.delay_walk * T);
    x_.gust_mps *= markov<1>(gust, noise.gust_std, gust_decay_.of(T / noise.gust_time));
    x_.heading_rad *= markov<1>(heading, noise.heading_std, heading_decay_.of(T / noise.heading_time));
    markov<2>(gnss, noise.gnss_std, gnss_decay_.of(T / noise.gnss_time));
  }
  /// x' = phi x + w of `n` states, each with a constant standard deviation. Returns phi.
  template <int n>
  double markov(int first, double std, double phi) {
    P_.middleRows<n>(first) *= phi;
    P_.middleCols<n>(first) *= phi;
    for (int i = first; i < first + n; ++i) P_(i, i) += std * std * (1 - phi * phi);
    more_.decay(first, n, phi);
    return phi;
  }

  void remember() {
    past_[past_next_] = {time_s_, x_.p_n, x_.v_n, corrected_};
    past_next_ = (past_next_ + 1) % past_.size();
    past_count_ = std::min(past_count_ + 1, past_.size());
  }
  /// A correction of the attitude applies to past states as well: their velocity changes by the specific
  /// force since then. Corrections below half a degree are left out.
  void turn_past(const ekf::Vector& dx) {
    const Vector3 R_dba = R_nb_ * dx.segment<3>(ekf::accel_bias),
                  R_dbg = R_nb_ * dx.segment<3>(ekf::gyro_bias);
    for (std::size_t i = 0; i < past_count_; ++i) {
      Memory& m = past_[(past_next_ + past_.size() - 1 - i) % past_.size()];
      const Past then = as_known_now(m);
      const double age = then.age_s;
      const Vector3 f_age = x_.v_n - then.v_n - Vector3(0, 0, gravity_mps2 * age);
      const Vector3 dv = f_age.cross(dx.head<3>() + 0.5 * age * R_dbg) + age * R_dba;
      m.v += dv;
      m.p -= 0.5 * age * dv;
    }
  }
  /// A correction made at time s moved position by dp and velocity by dv: at an earlier time t it means dp -
  /// (s - t) dv.
  Past as_known_now(const Memory& m) const {
    const Vector3 dv = corrected_.v - m.corrected.v;
    return {m.p + (corrected_.p - m.corrected.p) - (corrected_.vt - m.corrected.vt) + m.time * dv, m.v + dv,
            time_s_ - m.time, true};
  }

  ekf::Nominal x_;
  Eigen::Matrix3d R_nb_ = Eigen::Matrix3d::Identity();
  ekf::Covariance P_ = ekf::Covariance::Identity();
  More more_;
  double time_s_ = 0;
  Vector3 omega_ = Vector3::Zero(), f_ = Vector3::Zero();
  bool has_sample_ = false;
  Step step_;
  double load_ = 0;                 ///< m/s2, beyond 1 g
  Vector3 turn_ = Vector3::Zero();  ///< rad/s; both as they last
  Decay scale_decay_, gust_decay_, heading_decay_, gnss_decay_;
  Corrections corrected_;
  std::array<Memory, 64> past_{};
  std::size_t past_next_ = 0, past_count_ = 0;
};

}  // namespace fulmar
