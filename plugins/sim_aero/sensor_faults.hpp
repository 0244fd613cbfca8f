// SPDX-License-Identifier: BSD-3-Clause
// Outputs of failed sensors. A fault changes the output of one sensor only: it has a separate random
// generator, so that all other errors stay the same.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "faults.hpp"
#include "fulmar/random.hpp"
#include "presets.hpp"

namespace fulmar::sim {

/// A quantity that one sensor measures; a scalar is in x.
class Channel {
 public:
  Channel(double dt, const Eigen::Vector3d& deviation, const Eigen::Vector3d& own, bool zero_when_off,
          std::uint64_t seed)
      : dt_(dt), deviation_(deviation), own_(own), zero_when_off_(zero_when_off), random_(seed) {}

  /// Turns the output of a working sensor into that of the faulty one.
  Eigen::Vector3d operator()(const Eigen::Vector3d& right) {
    if (fault_.kind != FaultKind::none) return said_ = faulted(right);
    return said_ = right;
  }
  double operator()(double right) { return (*this)(Eigen::Vector3d(right, 0, 0)).x(); }

  void suffer(const Fault& fault) {
    if (fault.kind != fault_.kind) jump_.setZero();
    fault_ = fault;
  }
  bool off() const { return fault_.kind == FaultKind::off; }

 private:
  /// A separate function, so that a sensor without fault costs no more time than before.
  [[gnu::noinline]] Eigen::Vector3d faulted(const Eigen::Vector3d& right) {
    const double g = fault_.growth;
    switch (fault_.kind) {
      case FaultKind::off: return zero_when_off_ ? Eigen::Vector3d::Zero() : said_;
      case FaultKind::stuck: return said_;
      case FaultKind::wrong: return (1 + g * (fault_.scale - 1)) * right + g * fault_.size;
      case FaultKind::slow: return right + std::exp(-dt_ / (g * fault_.time_s)) * (said_ - right);
      case FaultKind::noisy: return right + noise(1 + g * (fault_.noise - 1));
      case FaultKind::jumping: return right + jump(g * fault_.size);
      default: return right;
    }
  }

  /// Together with the sensor's own errors the standard deviation becomes `times` theirs.
  Eigen::Vector3d noise(double times) {
    Eigen::Vector3d out;
    for (int i = 0; i < 3; ++i) {
      const double square = times * times * deviation_[i] * deviation_[i] - own_[i] * own_[i];
      out[i] = std::sqrt(std::max(square, 0.0)) * random_.normal();
    }
    return out;
  }

  /// An offset within +-`bound`, drawn again at the events of a Poisson process.
  Eigen::Vector3d jump(const Eigen::Vector3d& bound) {
    if (random_.uniform() < -std::expm1(-dt_ / fault_.time_s))
      for (int i = 0; i < 3; ++i) jump_[i] = random_.uniform(-1, 1) * bound[i];
    return jump_;
  }

  double dt_;
  Eigen::Vector3d deviation_, own_;  ///< own: of the sensor's own errors, which may be 0
  bool zero_when_off_;
  Random random_;
  Fault fault_;
  Eigen::Vector3d said_ = Eigen::Vector3d::Zero(), jump_ = Eigen::Vector3d::Zero();
};

class SensorFaults {
 public:
  SensorFaults(const SensorSpec& spec, double tick_hz, std::uint64_t seed)
      : gyro(channel<&SensorSpec::gyro>(spec, period(spec.imu_hz, tick_hz), true, mix_seed(seed, 20))),
        accel(channel<&SensorSpec::accel>(spec, period(spec.imu_hz, tick_hz), true, mix_seed(seed, 21))),
        position(channel<&SensorSpec::gnss_position>(spec, period(spec.gnss_hz, tick_hz), false,
                                                     mix_seed(seed, 22))),
        velocity(channel<&SensorSpec::gnss_velocity>(spec, period(spec.gnss_hz, tick_hz), true,
                                                     mix_seed(seed, 23))),
        mag(channel<&SensorSpec::mag>(spec, period(spec.mag_hz, tick_hz), false, mix_seed(seed, 24))),
        baro(channel<&SensorSpec::baro>(spec, period(spec.baro_hz, tick_hz), false, mix_seed(seed, 25))),
        pitot(channel<&SensorSpec::pitot>(spec, period(spec.pitot_hz, tick_hz), false, mix_seed(seed, 26))) {}

  void suffer(const Faults& faults) {
    gyro.suffer(faults[FaultTarget::gyro]);
    accel.suffer(faults[FaultTarget::accel]);
    position.suffer(faults[FaultTarget::gnss_position]);
    velocity.suffer(faults[FaultTarget::gnss_velocity]);
    mag.suffer(faults[FaultTarget::mag]);
    baro.suffer(faults[FaultTarget::baro]);
    pitot.suffer(faults[FaultTarget::pitot]);
  }
  bool imu_off() const { return gyro.off() && accel.off(); }

 private:
  static double period(double hz, double tick_hz) { return 1 / std::min(hz, tick_hz); }
  static double random_part(const NoiseSpec& s) { return std::hypot(s.white, s.drift); }
  static Eigen::Vector3d random_part(const std::array<NoiseSpec, 3>& s) {
    return {random_part(s[0]), random_part(s[1]), random_part(s[2])};
  }
  static Eigen::Vector3d vector(const Eigen::Vector3d& v) { return v; }
  static Eigen::Vector3d vector(double x) { return {x, 0, 0}; }

  /// A noise fault of a sensor without errors uses the noise of one of the data sheets.
  template <auto member>
  static Channel channel(const SensorSpec& spec, double dt, bool zero_when_off, std::uint64_t seed) {
    const Eigen::Vector3d own = vector(random_part(spec.*member));
    const bool perfect = own.norm() == 0;
    return Channel(dt, perfect ? vector(random_part(ublox_sensors().*member)) : own, own, zero_when_off,
                   seed);
  }

 public:
  Channel gyro, accel, position, velocity, mag, baro, pitot;
};

}  // namespace fulmar::sim
