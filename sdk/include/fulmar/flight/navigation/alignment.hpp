// SPDX-License-Identifier: BSD-3-Clause
// First attitude of the filter: at rest from gravity and the magnetic field, in the air from the acceleration
// that the GNSS velocity shows.
#pragma once
#include <array>
#include <cmath>
#include <optional>

#include "fulmar/flight/math/attitude.hpp"

namespace fulmar::navigation {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Detects rest of the inertial unit: a second of quarter-second blocks with little noise and equal means.
/// Absolute values do not count, because gyros may have any bias.
class Stillness {
 public:
  void update(const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    if (dt > 0.1 || moves(omega_b, f_b)) *this = {};
    if (n_ == 0) {
      first_omega_ = omega_b;
      first_f_ = f_b;
    }
    const Vector3d domega = omega_b - first_omega_,
                   df = f_b - first_f_;  // shifted: a large bias costs no digits
    omega_sum_ += domega;
    f_sum_ += df;
    omega_squares_ += domega.cwiseAbs2();
    f_squares_ += df.cwiseAbs2();
    ++n_;
    time_ += dt;
    if (time_ >= block_s && n_ >= 8) close_block();
  }

  bool still() const { return blocks_still_ >= blocks; }
  Vector3d omega() const { return mean(omega_); }  ///< over the last second
  Vector3d f() const { return mean(f_); }

 private:
  static constexpr int blocks = 4;
  static constexpr double block_s = 0.25, gyro_noise = 0.03, gyro_step = 0.02, accel_noise = 0.6,
                          accel_step = 0.25, gyro_jump = 0.5, accel_jump = 3;

  /// A throw is not at rest until its block ends: that would be 10 m/s later.
  bool moves(const Vector3d& omega_b, const Vector3d& f_b) const {
    const std::size_t last = (next_ + blocks - 1) % blocks;
    return blocks_still_ > 0 && ((f_b - f_[last]).cwiseAbs().maxCoeff() > accel_jump ||
                                 (omega_b - omega_[last]).cwiseAbs().maxCoeff() > gyro_jump);
  }
  void close_block() {
    const Vector3d omega_mean = omega_sum_ / n_, f_mean = f_sum_ / n_;
    const double omega_std = std::sqrt((omega_squares_ / n_ - omega_mean.cwiseAbs2()).maxCoeff());
    const double f_std = std::sqrt((f_squares_ / n_ - f_mean.cwiseAbs2()).maxCoeff());
    const Vector3d w = first_omega_ + omega_mean, f = first_f_ + f_mean;
    const std::size_t last = (next_ + blocks - 1) % blocks;
    const bool calm = omega_std < gyro_noise && f_std < accel_noise;
    const bool agrees = (w - omega_[last]).cwiseAbs().maxCoeff() < gyro_step &&
                        (f - f_[last]).cwiseAbs().maxCoeff() < accel_step;
    blocks_still_ = !calm ? 0 : agrees && blocks_still_ > 0 ? blocks_still_ + 1 : 1;
    omega_[next_] = w;
    f_[next_] = f;
    next_ = (next_ + 1) % blocks;
    n_ = 0;
    time_ = 0;
    omega_sum_ = f_sum_ = omega_squares_ = f_squares_ = Vector3d::Zero();
  }
  static Vector3d mean(const std::array<Vector3d, blocks>& v) { return 0.25 * (v[0] + v[1] + v[2] + v[3]); }

  Vector3d omega_sum_ = Vector3d::Zero(), f_sum_ = Vector3d::Zero(), omega_squares_ = Vector3d::Zero(),
           f_squares_ = Vector3d::Zero();
  Vector3d first_omega_ = Vector3d::Zero(), first_f_ = Vector3d::Zero();
  int n_ = 0, blocks_still_ = 0;
  double time_ = 0;
  std::size_t next_ = 0;
  std::array<Vector3d, blocks> omega_{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()},
      f_ = omega_;
};

/// Attitude at rest. Only the horizontal direction of the field is used: its dip may be disturbed by the
/// ground.
inline Quaterniond attitude_at_rest(const Vector3d& f_b, const Vector3d& field_b, double declination_rad) {
  const Vector3d magnetic_north(std::cos(declination_rad), std::sin(declination_rad), 0);
  return attitude_from_directions(f_b, -Vector3d::UnitZ(), field_b, magnetic_north);
}
inline Quaterniond attitude_at_rest(const Vector3d& f_b) {  // yaw unknown: north
  const Vector3d ahead = std::abs(f_b.normalized().x()) < 0.99 ? Vector3d::UnitX() : Vector3d::UnitZ();
  return attitude_from_directions(f_b, -Vector3d::UnitZ(), ahead, Vector3d::UnitX());
}

/// Gyro biases from the magnetic field in flight, before there is an attitude. Turned back by the gyros, the
/// field is constant but for their bias. y = y0 - G b with G = integral of Q [m]x, by least squares; the
/// component along the field is not observable.
class FieldDrift {
 public:
  /// `y` = Q m: the field's direction, turned back.
  void add(const Vector3d& y, const Quaterniond& q, const Vector3d& field_b, double time_s) {
    const Matrix3d rate = q.toRotationMatrix() * skew(field_b);
    if (n_ > 0) G_ += 0.5 * (time_s - last_s_) * (rate + rate_);
    if (n_ == 0) {
      first_s_ = time_s;
      y0_ = y;
      q0_ = q;
    }
    rate_ = rate;
    last_s_ = time_s;
    turned_rad_ = q0_.angularDistance(q);
    const Vector3d dy = y - y0_;
    ++n_;
    sum_G_ += G_;
    sum_y_ += dy;
    sum_GG_ += G_.transpose() * G_;
    sum_Gy_ += G_.transpose() * dy;
    sum_yy_ += dy.squaredNorm();
  }
  struct Bias {
    Vector3d bias_b;
    Matrix3d covariance;
  };
  /// With a prior of standard deviation `std`, rad/s, each axis. `deviation_rad`: field error that turns with
  /// the aircraft. Gyros without a bias across the field are taken as calibrated along it as well.
  Bias bias(double std, double deviation_rad) const {
    const double T = last_s_ - first_s_;
    if (n_ < 4 || T < 0.3) return {Vector3d::Zero(), std * std * Matrix3d::Identity()};
    const Matrix3d N = sum_GG_ - sum_G_.transpose() * sum_G_ / n_;
    const Vector3d r = -(sum_Gy_ - sum_G_.transpose() * sum_y_ / n_);
    const auto solve = [&](double prior, double variance) {
      const Matrix3d P = (N / variance + Matrix3d::Identity() / (prior * prior)).inverse();
      return Bias{P * r / variance, P};
    };
    const auto left = [&](const Vector3d& b) {  // of the sum of squares
      return sum_yy_ - sum_y_.squaredNorm() / n_ - 2 * r.dot(b) + b.dot(N * b);
    };
    // Errors of the field last: a sample counts as many as come in a tenth of a second.
    const double each =
        std::max(left(solve(std, 1e-6).bias_b) / (2 * n_), 0.003 * 0.003) * std::max(0.1 * n_ / T, 1.0);
    const double turned = deviation_rad * turned_rad_ / T;
    const Bias wide = solve(std, each);
    const double across = std::sqrt(wide.bias_b.squaredNorm() + 12 * each / (n_ * T * T) + turned * turned);
    Bias b = solve(std::clamp(2 * across, 0.01, std), each);
    b.covariance += turned * turned * Matrix3d::Identity();
    return b;
  }

 private:
  double n_ = 0, first_s_ = 0, last_s_ = 0, turned_rad_ = 0, sum_yy_ = 0;
  Quaterniond q0_ = Quaterniond::Identity();
  Matrix3d G_ = Matrix3d::Zero(), rate_ = Matrix3d::Zero(), sum_G_ = Matrix3d::Zero(),
           sum_GG_ = Matrix3d::Zero();
  Vector3d y0_ = Vector3d::Zero(), sum_y_ = Vector3d::Zero(), sum_Gy_ = Vector3d::Zero();
};

/// Attitude in flight. Between two fixes at least half a second apart the mean specific force is (v2 - v1)/T
/// - g in NED, and it was measured in body axes, each sample turned back to the beginning by the gyros: over
/// the time between the fixes, however late they come. The second direction is the magnetic field, or,
/// without one, the course: an aircraft flies nose first.
class FlightAlignment {
 public:
  void imu(const Vector3d& omega_b, const Vector3d& f_b, double dt) {
    if (dt > 0.1) {
      clear();
      return;
    }
    piece_.omega_b += dt * omega_b;
    piece_.f_b += dt * f_b;
    piece_.dt += dt;
    sums_.q = sums_.q * exp_map(omega_b * dt);
    sums_.f += dt * (sums_.q * f_b);
    sums_.ahead += dt * (sums_.q * Vector3d::UnitX());
    time_ += dt;
    if (piece_.dt >= piece_s - 1e-9) close_piece();
  }
  void mag(const Vector3d& field_b) {
    sums_.field += sums_.q * field_b;
    drift_.add(sums_.q * field_b.normalized(), sums_.q, field_b.normalized(), time_);
  }
  void clear() {
    sums_ = {};
    piece_ = {};
    drift_ = {};
    time_ = 0;
    count_ = 0;
    started_ = false;
  }
  const FieldDrift& drift() const { return drift_; }

  struct Found {
    Quaterniond q_nb, then_nb;  ///< now, and at the time of the fix
    Vector3d f_n;               ///< mean specific force of the window
    Vector3d a_n, jerk_n;       ///< acceleration at the fix, and how fast it changed over the window
    Vector3d since_n;           ///< by how much the velocity has changed since the fix
    Vector3d second_n;          ///< the direction that gives the heading
    bool by_field;              ///< that of the field
    double window_s;
    double unseen_s;  ///< of the window before the first sample: there it was taken to go on evenly
  };
  /// Further data beside the inertial samples; null: not available.
  struct Known {
    double gravity_mps2;
    const Vector3d* field_n;
    const Vector3d* wind_n;
    double late_s;  ///< age of the fix
  };
  /// Attitude now, when this fix ends a window.
  std::optional<Found> fix(const Vector3d& v_n, const Known& known) {
    std::optional<Found> found;
    const double T = time_ - known.late_s - first_s_;
    if (started_ && T < shortest_s) return found;
    if (piece_.dt > 0) close_piece();
    if (started_ && T < max_s) found = solve(v_n, T, known);
    started_ = true;
    first_s_ = time_ - known.late_s;
    v_first_ = v_n;
    return found;
  }
  /// The inertial samples of the last `age_s`, those of a hundredth of a second as one: each(omega_b, f_b,
  /// dt).
  template <class Each>
  void since(double age_s, Each&& each) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Piece& piece = at(i);
      const double dt = std::min(piece.dt, piece.begin_s + piece.dt - (time_ - age_s));
      if (dt > 1e-9) each(Vector3d(piece.omega_b / piece.dt), Vector3d(piece.f_b / piece.dt), dt);
    }
  }

 private:
  static constexpr double piece_s = 0.01, shortest_s = 0.45, max_s = 2.2, held_s = 0.5, edge_s = 0.05;

  struct Sums {                               ///< since the beginning, in the body axes of then
    Quaterniond q = Quaterniond::Identity();  ///< body now -> body at the beginning
    Vector3d f = Vector3d::Zero(), ahead = Vector3d::Zero(), field = Vector3d::Zero();
  };
  struct Piece {
    Vector3d omega_b = Vector3d::Zero(), f_b = Vector3d::Zero();  ///< integrals over it
    double begin_s = 0, dt = 0;
    Sums begin;
  };
  const Piece& at(std::size_t i) const {  // 0: the oldest
    return pieces_[(next_ + pieces_.size() - count_ + i) % pieces_.size()];
  }
  void close_piece() {
    pieces_[next_] = piece_;
    next_ = (next_ + 1) % pieces_.size();
    count_ = std::min(count_ + 1, pieces_.size());
    piece_ = {};
    piece_.begin_s = time_;
    piece_.begin = sums_;
  }
  /// Before the first piece everything is taken to have gone on as in its first twentieth of a second.
  Sums sums_at(double time_s) const {
    std::size_t i = count_ - 1;
    while (i > 0 && at(i).begin_s > time_s) --i;
    Vector3d omega_b = Vector3d::Zero(), f_b = Vector3d::Zero();
    double span_s = 0;
    const double enough_s = time_s < at(0).begin_s ? edge_s - 1e-9 : 0;
    for (std::size_t k = i; k < count_ && (k == i || span_s < enough_s); ++k) {
      omega_b += at(k).omega_b;
      f_b += at(k).f_b;
      span_s += at(k).dt;
    }
    const double dt = time_s - at(i).begin_s, share = dt / span_s;
    Sums s = at(i).begin;
    const Quaterniond middle = s.q * exp_map(0.5 * share * omega_b);
    s.q = s.q * exp_map(share * omega_b);
    s.f += share * (middle * f_b);
    s.ahead += dt * (middle * Vector3d::UnitX());
    return s;
  }

  std::optional<Found> solve(const Vector3d& v_n, double T, const Known& known) const {
    const double from_s = first_s_, to_s = from_s + T, unseen_s = std::max(at(0).begin_s - from_s, 0.0);
    if (unseen_s > std::min(held_s, 0.7 * T)) return std::nullopt;
    const Sums from = sums_at(from_s), to = sums_at(to_s);
    const Vector3d g_n(0, 0, known.gravity_mps2), f_n = (v_n - v_first_) / T - g_n;
    const Vector3d f_b = (to.f - from.f) / T, field_b = to.field - from.field;
    if (f_n.norm() < 3 || f_b.norm() < 3) return std::nullopt;  // near free fall: no direction in it
    Vector3d second_b = to.ahead - from.ahead, second_n = 0.5 * (v_n + v_first_);
    if (known.wind_n) second_n -= *known.wind_n;
    // In a turn the field may lie along the specific force. The nose never does, but without the wind it is
    // known less well.
    const double enough = known.wind_n ? 0.6 : 0.12;
    const bool by_field = known.field_n && field_b.norm() > 0 &&
                          known.field_n->normalized().cross(f_n.normalized()).norm() > enough;
    if (by_field) {
      second_b = field_b;
      second_n = *known.field_n;
    }
    if (second_b.normalized().cross(f_b.normalized()).norm() < 0.2 ||
        second_n.normalized().cross(f_n.normalized()).norm() < 0.2)
      return std::nullopt;
    const Quaterniond begin_nb = attitude_from_directions(f_b, f_n, second_b, second_n);
    const auto mean_f_n = [&](double time_s) {
      return Vector3d(begin_nb * (sums_at(time_s + edge_s / 2).f - sums_at(time_s - edge_s / 2).f) / edge_s);
    };
    const Vector3d then_n = mean_f_n(to_s);
    Found found;
    found.q_nb = (begin_nb * sums_.q).normalized();
    found.then_nb = (begin_nb * to.q).normalized();
    found.f_n = f_n;
    found.a_n = then_n + g_n;
    found.jerk_n = (then_n - mean_f_n(from_s)) / T;
    found.since_n = begin_nb * (sums_.f - to.f) + (time_ - to_s) * g_n;
    found.second_n = second_n;
    found.by_field = by_field;
    found.window_s = T;
    found.unseen_s = unseen_s;
    return found;
  }

  bool started_ = false;
  Sums sums_;
  Piece piece_;
  FieldDrift drift_;
  std::array<Piece, 256> pieces_{};  ///< 2.5 s
  std::size_t next_ = 0, count_ = 0;
  double time_ = 0, first_s_ = 0;  ///< since the beginning; of the fix that the window begins with
  Vector3d v_first_ = Vector3d::Zero();
};

}  // namespace fulmar::navigation
