// SPDX-License-Identifier: BSD-3-Clause
// Errors of a data sheet in addition to noise: turn-on bias, bias instability, scale, misalignment and
// cross-coupling of axes, bandwidth, range, resolution. They have a separate random generator.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "figures.hpp"
#include "fulmar/random.hpp"
#include "messages.hpp"

namespace fulmar::sim {

struct SheetSpec {
  double bias_std = 0;             ///< at turn-on, normal
  double instability = 0;          ///< minimum of the Allan deviation
  double instability_time_s = 30;  ///< averaging time of that minimum
  double noise_after_1s = 0;       ///< part of white noise in a mean over one second, for the Allan deviation
  double walk = 0;                 ///< standard deviation of the rate random walk after one second, likewise
  double scale = 0, cross_axis = 0;                         ///< each drawn evenly from +-this
  Eigen::Matrix3d mount = Eigen::Matrix3d::Identity();      ///< body to sensor
  Eigen::Matrix3d soft_iron = Eigen::Matrix3d::Identity();  ///< of the sensor's axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double bandwidth_hz = 0, range = 0, step = 0;

  bool used() const {
    return bias_std > 0 || instability > 0 || scale > 0 || cross_axis > 0 || !mount.isIdentity(0) ||
           !soft_iron.isIdentity(0) || !offset.isZero(0) || bandwidth_hz > 0 || range > 0 || step > 0;
  }
};

/// A bias that wanders as 1/f noise: three Gauss-Markov processes of one standard deviation, with time
/// constants in ratios of eight. The Allan deviation of one process has its maximum at 1.89 time constants;
/// three make it flat around `time_s`.
struct Wander {
  static constexpr double apart = 8, peak = 1.89;
  static constexpr std::array<double, 3> time_constants(double time_s) {
    return {time_s / peak / apart, time_s / peak, time_s / peak * apart};
  }
  /// Allan variance of a Gauss-Markov process of standard deviation 1, time constant T, averaged over tau.
  /// IEEE Std 952-1997, C.1.1.7 (with q^2 = 2/T).
  static double variance(double tau, double T) {
    const double x = tau / T;
    if (x < 1e-3) return 2 * x / 3;
    return 2 / x * (1 - (3 - 4 * std::exp(-x) + std::exp(-2 * x)) / (2 * x));
  }
  /// Minimum of the Allan variance of noise, walk and three processes of standard deviation s together.
  static double lowest(const SheetSpec& sheet, double s) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = -40; i <= 40; ++i) {
      const double tau = sheet.instability_time_s * std::pow(2, 0.125 * i);
      double sum = sheet.noise_after_1s * sheet.noise_after_1s / tau + sheet.walk * sheet.walk * tau / 3;
      for (const double T : time_constants(sheet.instability_time_s)) sum += s * s * variance(tau, T);
      least = std::min(least, sum);
    }
    return least;
  }
  /// Standard deviation of each process for which the minimum of the Allan deviation equals that of the data
  /// sheet.
  static double deviation(const SheetSpec& sheet) {
    const double wanted = sheet.instability * sheet.instability;
    if (lowest(sheet, 0) > wanted)
      throw std::runtime_error(
          located("sensor_file", sim_aero_messages::instability_too_small(
                                     figures(sheet.instability), figures(std::sqrt(lowest(sheet, 0)))))
              .line());
    double low = 0, high = 4 * sheet.instability;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (lowest(sheet, middle) < wanted ? low : high) = middle;
    }
    return high;
  }
};

/// Errors of three axes; a scalar is in x.
class Sheet {
 public:
  Sheet() : random_(0) {}
  Sheet(const SheetSpec& spec, double dt, std::uint64_t seed)
      : spec_(spec), used_(spec.used()), random_(seed) {
    if (!used_) return;
    bias_ = spec.offset;
    for (int i = 0; i < 3; ++i) {
      bias_[i] += spec.bias_std * random_.normal();
      for (int k = 0; k < 3; ++k)
        matrix_(i, k) += random_.uniform(-1, 1) * (i == k ? spec.scale : spec.cross_axis);
    }
    matrix_ = spec.soft_iron * matrix_ * spec.mount;
    smoothing_ = spec.bandwidth_hz > 0 ? -std::expm1(-2 * std::numbers::pi * spec.bandwidth_hz * dt) : 1;
    if (spec.instability > 0) begin_to_wander(dt);
  }
  bool used() const { return used_; }

  /// Transforms a vector from body axes to the axes of the sensor, with their errors.
  Eigen::Vector3d bent(const Eigen::Vector3d& v) {
    if (wanders_ && --rest_ <= 0) wander();
    return matrix_ * v + bias();
  }
  /// Low-pass of the bandwidth.
  Eigen::Vector3d smooth(const Eigen::Vector3d& v) {
    if (smoothing_ == 1) return v;
    last_ = fresh_ ? v : Eigen::Vector3d(last_ + smoothing_ * (v - last_));
    fresh_ = false;
    return last_;
  }
  /// Applies the range and the resolution.
  Eigen::Vector3d digits(Eigen::Vector3d v) const {
    for (int i = 0; i < 3; ++i) v[i] = digits(v[i]);
    return v;
  }
  double digits(double x) const {
    if (spec_.step > 0) x = spec_.step * std::round(x / spec_.step);
    return spec_.range > 0 ? std::clamp(x, -spec_.range, spec_.range) : x;
  }
  /// A calibration at rest: the bias is chosen so that the output is `wanted` for the input `there`.
  void calibrate(const Eigen::Vector3d& there, const Eigen::Vector3d& wanted) {
    if (used_) bias_ = wanted - matrix_ * there - wander_.rowwise().sum();
  }
  Eigen::Vector3d bias() const { return wanders_ ? Eigen::Vector3d(bias_ + wander_.rowwise().sum()) : bias_; }

 private:
  void begin_to_wander(double dt) {
    wanders_ = true;
    const double s = Wander::deviation(spec_);
    const auto T = Wander::time_constants(spec_.instability_time_s);
    // slow errors are not computed for each sample
    rest_ = every_ = std::max(1, static_cast<int>(std::min(T[0] / 20 / dt, 1000.0)));
    for (int k = 0; k < 3; ++k) {
      const double x = every_ * dt / T[static_cast<std::size_t>(k)];
      decay_[k] = std::exp(-x);
      kick_[k] = s * std::sqrt(-std::expm1(-2 * x));
      for (int i = 0; i < 3; ++i) wander_(i, k) = s * random_.normal();
    }
  }
  [[gnu::noinline]] void wander() {
    rest_ = every_;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) wander_(i, k) = decay_[k] * wander_(i, k) + kick_[k] * random_.normal();
  }

  SheetSpec spec_;
  bool used_ = false, wanders_ = false, fresh_ = true;
  Random random_;
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d wander_ = Eigen::Matrix3d::Zero();  ///< a row for each axis, a column for each process
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero(), last_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d decay_ = Eigen::Vector3d::Zero(), kick_ = Eigen::Vector3d::Zero();
  double smoothing_ = 1;
  int rest_ = 0, every_ = 1;
};

}  // namespace fulmar::sim
