// SPDX-License-Identifier: BSD-3-Clause
// Air data of the navigator (navigator.hpp): barometer, pitot, and zero sideslip.
#pragma once
#include "fulmar/flight/navigation/navigator.hpp"

namespace fulmar::navigation {

inline ekf::Scalar Navigator::pressure_height(double pressure_pa) const {
  return airborne_ ? ekf::baro_height_in_flight(filter_.state(), pressure_pa, altitude_m_)
                   : ekf::baro_height(filter_.state(), pressure_pa, altitude_m_);
}

inline void Navigator::baro(double pressure_pa, const Params& p) {
  if (!(pressure_pa > 1e4 && pressure_pa < 1.2e5)) return;
  if (airborne_ && time_s_ - baro_s_ > outage_after_s) baro_back_s_ = time_s_;
  baro_s_ = time_s_;
  baro_pa_ = pressure_pa;
  if (!seen_.origin && !seen_.altitude) {
    altitude_m_ = pressure_altitude(pressure_pa);
    seen_.altitude = true;
  }
  if (!aligned() || stuck(health_.baro)) return;
  air_ = standard_air(altitude_m_ - filter_.state().p_n.z());
  if (!seen_.baro_zero) {
    ekf::Vector dx = ekf::Vector::Zero();
    dx(ekf::baro) = pressure_height(pressure_pa).innovation;
    filter_.correct(dx);
    const double height_std = seen_.height ? filter_.std(ekf::pos + 2) : 0.5;
    if (!seen_.height) filter_.forget(ekf::pos + 2, 1, 0.5);
    filter_.forget(ekf::baro, 1, std::max(height_std, 1.0));
    seen_.height = seen_.baro_zero = true;
  }
  const double dynamic_pa =
      airborne_ ? 0.5 * air_.density_kgm3 * ekf::air_velocity(filter_.state()).squaredNorm() : 0;
  const double load = filter_.specific_force_b().norm() / p.gravity - 1;
  const double std =
      std::hypot(p.baro_noise, p.baro_load_error * load * dynamic_pa) * ekf::metres_per_pascal(air_);
  // Back after an outage it moves the height by degrees.
  const ekf::Scalar z = pressure_height(pressure_pa);
  double variance = std * std;
  if (time_s_ - baro_back_s_ < baro_back_for_s) {
    const double known = filter_.expected_std(z, 0), off = std::abs(z.innovation);
    if (off <= p.air_gate * std::hypot(known, std))
      variance = std::max(variance, known * known * (off / baro_step_m - 1));
  }
  // A possible step is not accepted by degrees through the wider gate of a turn.
  const double alone = p.baro_noise * ekf::metres_per_pascal(air_);
  const bool may_step = health_.baro_step.may_be() &&
                        std::abs(z.innovation) > p.air_gate * filter_.expected_std(z, alone * alone);
  const ekf::Fused fused = fuse(z, variance, may_step ? 0.0 : p.air_gate.value, health_.baro);
  if (const auto step_m = health_.baro_step.sampled(z.innovation, std, fused.accepted, time_s_)) {
    ekf::Vector dx = ekf::Vector::Zero();
    dx(ekf::baro) = *step_m;
    filter_.correct(dx);
    filter_.inflate(ekf::baro, 1, std);
  }
  if (!fused.accepted && time_s_ - std::max(health_.baro.accepted_s, aligned_s_) > p.gnss_reset_after) {
    seen_.baro_zero = false;
    health_.baro.accepted_s = time_s_;
  }
}

/// A pitot that has stepped is not used until it has stepped back, or for long enough that a small error may
/// be right; nor one whose error exceeds gusts.
inline bool Navigator::tube_contradicts(double Va, const Params& p) {
  const double noise = p.pitot_noise / (air_.density_kgm3 * std::max(Va, 0.5 * p.min_airspeed)),
               sample = std::hypot(noise, p.pitot_speed_std) * health_.pitot.innovations.std();
  ekf::Scalar z = ekf::true_airspeed(filter_.state(), Va);
  z.H(ekf::gust) = 0;  // by their learnt strength
  const double without_tube = ekf::air_velocity(filter_.state()).norm();
  const double doubt = std::hypot(std::clamp(gusts_.std_mps(p), min_gust_mps, max_gust_mps),
                                  filter_.expected_std(z, 0), late_mps_);
  health_.tube.sampled(Va, without_tube, sample, doubt, time_s_);
  health_.pitot.contradicts = health_.tube.stepped() || health_.tube.off();
  return health_.pitot.contradicts;
}

inline void Navigator::pitot(double pressure_pa, const Params& p) {
  if (!std::isfinite(pressure_pa)) return;
  if (time_s_ - baro_s_ > 1) air_ = standard_air(altitude_m_ - (aligned() ? filter_.state().p_n.z() : 0));
  const double Va = p.pitot_scale * std::sqrt(2 * std::max(pressure_pa, 0.0) / air_.density_kgm3);
  const double dt = std::clamp(time_s_ - pitot_s_, 0.0, 1.0);
  pitot_mps_ = pitot_s_ == never ? Va : pitot_mps_ + (Va - pitot_mps_) * (1 - std::exp(-dt / 0.2));
  pitot_s_ = time_s_;
  if (!aligned() || !airborne_ || stuck(health_.pitot)) return;
  if (tube_contradicts(Va, p) || Va < 0.5 * p.min_airspeed) {  // or it stands still in flight
    const ekf::Scalar z = ekf::true_airspeed(filter_.state(), Va);
    health_.pitot.record(
        {false, z.innovation / filter_.expected_std(z, p.pitot_speed_std * p.pitot_speed_std)}, time_s_);
    return;
  }
  const Gusts::MeanWind wind = mean_wind();
  const double noise = p.pitot_noise / (air_.density_kgm3 * Va);
  const Vector3d before = air();
  const ekf::Scalar z = ekf::true_airspeed(filter_.state(), Va);
  // A late sample is that of another airspeed: in a launch by several m/s.
  const double variance = noise * noise + p.pitot_speed_std * p.pitot_speed_std + late_mps_ * late_mps_;
  if (!fuse(z, variance, p.air_gate, health_.pitot).accepted) return;
  gusts_.airspeed(wind, Va, time_s_, p);
  spoil_wind(before, z, p);
}

/// After a start in flight the attitude may be almost unknown about one axis, where the field is along the
/// specific force; zero sideslip then adds information. Updates more often than gusts last add none: three of
/// 800 starts of bench_air_start then had a small standard deviation of a wrong attitude.
inline void Navigator::sideslip(const Params& p) {
  constexpr double gust_lasts_s = 2;
  sideslip_s_ = time_s_;
  const double side = p.sideslip_ratio * ekf::air_velocity(filter_.state()).norm(),
               variance = p.sideslip_speed_std * p.sideslip_speed_std + side * side;
  const ekf::Scalar z = ekf::zero_sideslip(filter_.state());
  const Vector3d before = air();
  const bool nose = (settling() || time_s_ < nose_until_s_) && time_s_ - nose_s_ > gust_lasts_s - 1e-4;
  if (nose) nose_s_ = time_s_;
  const ekf::Fused fused = nose ? filter_.fuse(z, variance, p.air_gate)
                                : filter_.fuse_considering_attitude(z, variance, p.air_gate);
  health_.sideslip.record(fused, time_s_);
  if (!fused.accepted) return;
  gusts_.sideslip(mean_wind(), filter_.R_nb().col(1), side, time_s_, p);
  spoil_wind(before, z, p);
}

}  // namespace fulmar::navigation
