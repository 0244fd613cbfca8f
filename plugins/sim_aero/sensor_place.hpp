// SPDX-License-Identifier: BSD-3-Clause
// Effects of a sensor's place: away from the centre of gravity, near a motor, in the pressure field of the
// aircraft.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "fulmar/random.hpp"
#include "fulmar/sim/plant.hpp"
#include "presets.hpp"

namespace fulmar::sim {

class SensorPlaces {
 public:
  SensorPlaces() = default;
  SensorPlaces(const SensorSpec& s, double imu_dt, std::uint64_t seed)
      : spec_(s),
        imu_dt_(imu_dt),
        shaken_(s.vibration_speed > 0 && (s.gyro_vibration != 0 || s.accel_vibration != 0)),
        lever_(!s.imu_at.isZero(0)),
        imu_(lever_ || shaken_ || s.gyro_per_g > 0),
        mag_(!s.mag_per_amp.isZero(0)),
        pitot_(!s.pitot_at.isZero(0) || s.pitot_static_port != 0 || s.pitot_alpha != 0 || s.pitot_beta != 0),
        antenna_(!s.antenna_at.isZero(0)) {
    Random random(seed);
    for (int i = 0; i < 3; ++i) per_g_[i] = s.gyro_per_g * random.uniform(-1, 1);
  }
  bool reach_imu() const { return imu_; }
  bool reach_mag() const { return mag_; }
  bool reach_pitot() const { return pitot_; }
  bool reach_antenna() const { return antenna_; }

  /// Transforms body rate and specific force from the centre of gravity to the place of the unit.
  void imu(const Plant& plant, Eigen::Vector3d& omega_b, Eigen::Vector3d& f_b) {
    const Eigen::Vector3d& r = spec_.imu_at;
    if (lever_) f_b += plant.angular_acceleration().cross(r) + omega_b.cross(omega_b.cross(r));
    if (shaken_) shake(plant.propeller_radps(), omega_b, f_b);
    omega_b += rate_by(f_b);
  }
  /// Rate error of gyroscopes by a specific force.
  Eigen::Vector3d rate_by(const Eigen::Vector3d& f_b) const { return per_g_.cwiseProduct(f_b) / isa::g0; }

  /// An unbalance turns with the propeller, in its plane, and grows with the square of its speed. The second
  /// harmonic comes from two blades and acts along the shaft. It is sampled without a filter, so with
  /// aliases.
  void shake(double Omega, Eigen::Vector3d& omega_b, Eigen::Vector3d& f_b) {
    phase_ = std::fmod(phase_ + Omega * imu_dt_, 2 * std::numbers::pi);
    const double share = Omega / spec_.vibration_speed * (Omega / spec_.vibration_speed);
    const Eigen::Vector3d wave = share * Eigen::Vector3d(spec_.vibration_second * std::sin(2 * phase_),
                                                         std::cos(phase_), std::sin(phase_));
    f_b += spec_.accel_vibration * wave;
    omega_b += spec_.gyro_vibration * wave;
  }

  /// `taken`: the share of the flow that enters the pitot.
  double pitot(const Plant& plant, const Eigen::Vector3d& v_r, double taken, double pressure_pa) const {
    const double alpha = std::atan2(v_r.z(), v_r.x()), Va = v_r.norm();
    const double beta = Va > 0 ? std::asin(std::clamp(v_r.y() / Va, -1.0, 1.0)) : 0;
    const double q = 0.5 * plant.air().density_kgm3 * plant.air_velocity_b().squaredNorm();
    const double askew = taken > 0 ? spec_.pitot_alpha * alpha + spec_.pitot_beta * std::abs(beta) : 0;
    return pressure_pa * (1 + askew) - spec_.pitot_static_port * q;
  }

  void antenna(const Plant& plant, Eigen::Vector3d& p_n, Eigen::Vector3d& v_n) const {
    p_n += plant.state().q_nb * spec_.antenna_at;
    v_n += plant.seen().q_nb * plant.seen().omega_b.cross(spec_.antenna_at);
  }

 private:
  SensorSpec spec_;
  double imu_dt_ = 0, phase_ = 0;
  bool shaken_ = false, lever_ = false, imu_ = false, mag_ = false, pitot_ = false, antenna_ = false;
  Eigen::Vector3d per_g_ = Eigen::Vector3d::Zero();
};

}  // namespace fulmar::sim
