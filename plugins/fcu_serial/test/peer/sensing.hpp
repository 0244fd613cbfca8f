// SPDX-License-Identifier: BSD-3-Clause
// Sensor processing of ROSflight 2.0: biases, calibrations, scaling, and the complementary filter of
// ATTITUDE_QUATERNION.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "params.hpp"

namespace fulmar::fcu::peer {

using Vec = std::array<double, 3>;
inline double norm(const Vec& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Averages 1001 samples of gyro or accelerometer.
class ImuCalibration {
 public:
  void start() {
    *this = {};
    running_ = true;
  }
  bool running() const { return running_; }
  /// True with the last sample.
  bool add(const Vec& v, double temperature) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum_[k] += v[k];
      least_[k] = count_ == 0 ? v[k] : std::min(least_[k], v[k]);
      most_[k] = count_ == 0 ? v[k] : std::max(most_[k], v[k]);
    }
    temperature_ += temperature;
    if (++count_ <= 1000) return false;
    running_ = false;
    return true;
  }
  Vec mean() const { return {sum_[0] / count_, sum_[1] / count_, sum_[2] / count_}; }
  double temperature() const { return temperature_ / count_; }
  double spread() const { return norm({most_[0] - least_[0], most_[1] - least_[1], most_[2] - least_[2]}); }

 private:
  bool running_ = false;
  int count_ = 0;
  Vec sum_{}, least_{}, most_{};
  double temperature_ = 0;
};

/// Lets 128 samples of a pressure pass and averages 127, each more than 20 ms after the one before; begins
/// again when they scatter.
class PressureCalibration {
 public:
  explicit PressureCalibration(double max_variance) : max_variance_(max_variance) {}
  void start() {
    done_ = scattered_ = false;
    count_ = 0;
    sum_ = squares_ = 0;
  }
  bool done() const { return done_; }
  bool scattered() const { return scattered_; }  ///< with the last sample
  /// The mean, with the last sample of a success.
  std::optional<double> add(double value, std::int64_t now_us) {
    scattered_ = false;
    if (done_ || (count_ > 0 && now_us - last_us_ <= 20000)) return std::nullopt;
    last_us_ = now_us;
    if (++count_ <= 128) {
      reference_ = value;
      return std::nullopt;
    }
    sum_ += value - reference_;
    squares_ += (value - reference_) * (value - reference_);
    if (count_ < 128 + 127) return std::nullopt;
    const double mean = sum_ / 127, variance = squares_ / 127 - mean * mean;
    start();
    if (variance >= max_variance_) {
      scattered_ = true;
      return std::nullopt;
    }
    done_ = true;
    return mean + reference_;
  }

 private:
  double max_variance_;
  bool done_ = false, scattered_ = false;
  int count_ = 0;
  std::int64_t last_us_ = 0;
  double sum_ = 0, squares_ = 0, reference_ = 0;
};

/// Mahony's filter with the accelerometer: no yaw reference.
class Attitude {
 public:
  std::array<double, 4> q{1, 0, 0, 0};
  Vec rate{};

  void advance(const Params& p, const Vec& accel, const Vec& gyro, double dt, std::int64_t clock_us) {
    const double lpf = p.f(param("GYRO_XY_LPF")), lpf_z = p.f(param("GYRO_Z_LPF"));
    for (std::size_t k = 0; k < 3; ++k)
      low_[k] = (k == 2 ? lpf_z : lpf) * low_[k] + (1 - (k == 2 ? lpf_z : lpf)) * gyro[k];
    Vec correction{};
    const double a = norm(accel), g = 9.80665;
    const bool early = clock_us < 1000 * p.i(param("FILT_INIT_T"));
    if (external_) {
      correction = axis_to(*external_, p.f(param("FILT_EXT_KP")));
      external_.reset();
    } else if (p.i(param("FILT_USE_ACC")) &&
               std::abs(a - g) < p.f(param("FILT_ACC_MARGIN")) * g * (early ? 10 : 1)) {
      const auto& [w, x, y, z] = q;  // down by the quaternion, compared with the accelerometer
      const Vec down{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
          felt{-accel[0] / a, -accel[1] / a, -accel[2] / a};
      const double kp = p.f(param("FILT_ACC_KP")) * (early ? 10 : 1);
      correction = {kp * (felt[1] * down[2] - felt[2] * down[1]),
                    kp * (felt[2] * down[0] - felt[0] * down[2]),
                    kp * (felt[0] * down[1] - felt[1] * down[0])};
      for (std::size_t k = 0; k < 3; ++k)
        bias_[k] -= p.f(param("FILT_KI")) * (early ? 10 : 1) * correction[k] / std::max(kp, 1e-9) * dt;
    }
    for (std::size_t k = 0; k < 3; ++k) rate[k] = low_[k] - bias_[k];
    turn({rate[0] + correction[0], rate[1] + correction[1], rate[2] + correction[2]}, dt);
  }
  void correct(const std::array<double, 4>& external) { external_ = external; }
  double roll() const {
    return std::atan2(2 * (q[0] * q[1] + q[2] * q[3]), 1 - 2 * (q[1] * q[1] + q[2] * q[2]));
  }
  double pitch() const { return std::asin(std::clamp(2 * (q[0] * q[2] - q[3] * q[1]), -1.0, 1.0)); }

 private:
  /// The rotation from the present attitude to another one, as a body rate.
  Vec axis_to(const std::array<double, 4>& r, double gain) const {
    const auto& [w, x, y, z] = q;
    const double ew = w * r[0] + x * r[1] + y * r[2] + z * r[3], sign = ew < 0 ? -2 * gain : 2 * gain;
    return {sign * (w * r[1] - x * r[0] - y * r[3] + z * r[2]),
            sign * (w * r[2] + x * r[3] - y * r[0] - z * r[1]),
            sign * (w * r[3] - x * r[2] + y * r[1] - z * r[0])};
  }
  void turn(const Vec& omega, double dt) {
    const auto [w, x, y, z] = q;
    const double h = 0.5 * dt;
    q = {w - h * (x * omega[0] + y * omega[1] + z * omega[2]),
         x + h * (w * omega[0] + y * omega[2] - z * omega[1]),
         y + h * (w * omega[1] - x * omega[2] + z * omega[0]),
         z + h * (w * omega[2] + x * omega[1] - y * omega[0])};
    const double n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& c : q) c /= n;
  }
  Vec low_{}, bias_{};
  std::optional<std::array<double, 4>> external_;
};

/// m in the standard atmosphere.
inline double pressure_altitude(double pascal) {
  return 44318.1386 * (1 - std::pow(pascal / 101325, 0.190326730));
}
inline double indicated(double pascal) {
  return std::copysign(std::sqrt(std::abs(pascal) / (0.5 * 1.225)), pascal);
}

}  // namespace fulmar::fcu::peer
