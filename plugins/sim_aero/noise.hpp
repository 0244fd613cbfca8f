// SPDX-License-Identifier: BSD-3-Clause
// Errors of a sensor's channel: white noise, a constant bias, a random walk, a Gauss-Markov process. All are
// given per root of time or as stationary standard deviations and discretised exactly, so they do not depend
// on the rate.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

#include "fulmar/random.hpp"

namespace fulmar::sim {

struct NoiseSpec {
  double white = 0;           ///< standard deviation of each sample
  double bias = 0;            ///< constant, drawn from [-bias, bias]
  double walk = 0;            ///< standard deviation of the random walk after one second
  double drift = 0;           ///< stationary standard deviation of the Gauss-Markov process
  double drift_tau_s = 1;     ///< its time constant
  bool drift_settled = true;  ///< true: starts at its stationary standard deviation; false: at zero
  double offset = 0;          ///< decays with offset_tau_s
  double offset_tau_s = 1;
};

class Noise {
 public:
  Noise() = default;
  Noise(const NoiseSpec& spec, double dt, Random& random) : spec_(spec) {
    bias_ = spec.bias > 0 ? random.uniform(-spec.bias, spec.bias) : 0;
    drift_ = spec.drift > 0 && spec.drift_settled ? spec.drift * random.normal() : 0;
    offset_ = spec.offset;
    drift_decay_ = std::exp(-dt / spec.drift_tau_s);
    drift_step_ = spec.drift * std::sqrt(-std::expm1(-2 * dt / spec.drift_tau_s));
    offset_decay_ = std::exp(-dt / spec.offset_tau_s);
    walk_step_ = spec.walk * std::sqrt(dt);
  }

  /// Error of the next sample.
  double next(Random& random) {
    if (walk_step_ > 0) bias_ += walk_step_ * random.normal();
    if (drift_step_ > 0) drift_ = drift_decay_ * drift_ + drift_step_ * random.normal();
    offset_ *= offset_decay_;
    return bias() + (spec_.white > 0 ? spec_.white * random.normal() : 0);
  }
  /// The part that is not white.
  double bias() const { return bias_ + drift_ + offset_; }
  /// A calibration at this time removes the part that is not white.
  void calibrate() { bias_ = -(drift_ + offset_); }

 private:
  NoiseSpec spec_;
  double bias_ = 0, drift_ = 0, offset_ = 0;
  double drift_decay_ = 0, drift_step_ = 0, offset_decay_ = 0, walk_step_ = 0;
};

/// The same kind of error, independent on three axes.
struct Noise3 {
  Noise3() = default;
  Noise3(const std::array<NoiseSpec, 3>& spec, double dt, Random& random)
      : axis{Noise(spec[0], dt, random), Noise(spec[1], dt, random), Noise(spec[2], dt, random)} {}
  Eigen::Vector3d next(Random& random) {
    const double x = axis[0].next(random), y = axis[1].next(random), z = axis[2].next(random);
    return {x, y, z};
  }
  Eigen::Vector3d bias() const { return {axis[0].bias(), axis[1].bias(), axis[2].bias()}; }
  void calibrate() {
    for (Noise& one : axis) one.calibrate();
  }
  std::array<Noise, 3> axis;
};

}  // namespace fulmar::sim
