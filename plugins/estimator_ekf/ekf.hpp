// SPDX-License-Identifier: BSD-3-Clause
// The component: sensors in, VehicleState out. Silent until it is aligned.
#pragma once
#include <fulmar/msg/imu.hpp>

#include "navigator.hpp"

namespace fulmar::estimator {

struct Ekf {
  static constexpr const char* doc = "Attitude, velocity, position, wind and sensor biases by an error-state extended Kalman filter.";
  struct Inputs {
    In<Imu> imu;
    Optional<Gnss> gnss;
    Optional<Mag> mag;
    Optional<Baro> baro;
    Optional<Pitot> pitot;
    Optional<VehicleStatus> status;
  };
  struct Outputs {
    Out<VehicleState> state;
    Probe horizontal_ratio, height_ratio, velocity_ratio, baro_ratio, pitot_ratio, sideslip_ratio,
        heading_ratio;    ///< innovations in deviations
    Probe refused_ratio;  ///< measurements refused by their gates so far
    Probe gust_mps, baro_bias_m, heading_deviation_rad;
  };
  using Params = estimator::Params;

  void configure(const Params& p) { navigator_.start(p); }
  void retune(const Params& p) { navigator_.tune(p); }

  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Outputs& last_applied) {
    const VehicleState& s = last_applied.state.value;
    const bool running = navigator_.aligned() && tick.now_ns - stepped_ns_ < 100'000'000;
    if (running || in.imu.sequence() == 0 || !(s.attitude_valid && s.velocity_valid)) return Status::ok;
    navigator_.resume(s, p, 1e-9 * static_cast<double>(in.imu.valid_at_ns()));
    imu_ns_ = in.imu.valid_at_ns();
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    stepped_ns_ = tick.now_ns;
    if (in.status && in.status.fresh()) navigator_.status(*in.status);
    if (in.imu.fresh() && !inertial(in, p)) return Status::degraded;
    if (!in.imu.fresh()) return tick.now_ns - imu_ns_ > 20'000'000 ? Status::degraded : Status::ok;
    sensors(in, p);
    if (!navigator_.aligned()) return Status::degraded;
    fill(p);
    out.state.publish(state_, in.imu.valid_at_ns());
    probes(out);
    return healthy() ? Status::ok : Status::degraded;
  }

 private:
  bool inertial(const Inputs& in, const Params& p) {
    const Vector3d omega_b = eigen(in.imu->rate_radps), f_b = eigen(in.imu->specific_force_mps2);
    if (!omega_b.allFinite() || !f_b.allFinite()) return false;
    const std::int64_t before_ns = imu_ns_;
    imu_ns_ = in.imu.valid_at_ns();
    dt_s_ = 1e-9 * static_cast<double>(imu_ns_ - before_ns);
    return navigator_.imu(omega_b, f_b, 1e-9 * static_cast<double>(imu_ns_), p);
  }
  void sensors(const Inputs& in, const Params& p) {
    if (in.mag && in.mag.fresh()) navigator_.mag(eigen(in.mag->field_tesla), p);
    if (in.baro && in.baro.fresh()) navigator_.baro(in.baro->pressure_pa, p);
    if (in.gnss && in.gnss.fresh()) navigator_.gnss(*in.gnss, 1e-9 * static_cast<double>(in.gnss.valid_at_ns()), p);
    if (in.pitot && in.pitot.fresh()) navigator_.pitot(in.pitot->pressure_pa, p);
  }
  bool healthy() const { return state_.attitude_valid && state_.velocity_valid && state_.position_valid && state_.height_valid; }

  void fill(const Params& p);
  void fill_air(const ekf::Nominal& x, const Matrix3d& R_nb);
  void fill_deviations(const Params& p);
  void probes(Outputs& out) const;

  Navigator navigator_;
  VehicleState state_;
  Vector3d rate_ = Vector3d::Zero();
  double dt_s_ = 0, deviations_s_ = never;
  std::int64_t imu_ns_ = 0, stepped_ns_ = 0;
  bool rate_started_ = false;
};

inline void Ekf::fill(const Params& p) {
  const ErrorStateEkf& f = navigator_.filter();
  const ekf::Nominal& x = f.state();
  VehicleState& s = state_;
  const Euler e = euler_from(f.R_nb());
  s.position_m = from_eigen<Ned>(x.p_n);
  s.velocity_mps = from_eigen<Ned>(x.v_n);
  s.attitude = from_eigen(x.q_nb);
  s.roll_rad = e.roll_rad;
  s.pitch_rad = e.pitch_rad;
  s.yaw_rad = e.yaw_rad;
  const Vector3d omega_b = f.rate_b();
  if (p.rate_filter > 0 && rate_started_)
    rate_ += (omega_b - rate_) * (1 - std::exp(-2 * std::numbers::pi * p.rate_filter * std::clamp(dt_s_, 0.0, 1.0)));
  else
    rate_ = omega_b;
  rate_started_ = true;
  s.rate_radps = from_eigen<Body>(rate_);
  s.specific_force_mps2 = from_eigen<Body>(f.specific_force_b());
  s.gyro_bias_radps = from_eigen<Body>(x.gyro_bias);
  s.accel_bias_mps2 = from_eigen<Body>(x.accel_bias);
  s.height_m = -x.p_n.z();
  s.climb_rate_mps = -x.v_n.z();
  s.ground_speed_mps = std::sqrt(x.v_n.x() * x.v_n.x() + x.v_n.y() * x.v_n.y());
  // From the nose at rest to the velocity in motion without a step.
  const double moving = smoothly(s.ground_speed_mps, 1, 3);
  s.course_rad = moving > 0 ? wrap_pi(e.yaw_rad + moving * angle_difference(std::atan2(x.v_n.y(), x.v_n.x()), e.yaw_rad)) : e.yaw_rad;
  fill_air(x, f.R_nb());
  if (f.time_s() - deviations_s_ > 0.0099) fill_deviations(p);
}

inline void Ekf::fill_air(const ekf::Nominal& x, const Matrix3d& R_nb) {
  VehicleState& s = state_;
  s.wind_mps = {x.wind.x(), x.wind.y(), 0};
  if (!navigator_.airborne()) {  // rolling or standing: the tube alone knows
    s.airspeed_mps = navigator_.pitot_mps();
    s.alpha_rad = s.beta_rad = 0;
    return;
  }
  const Vector3d u_b = R_nb.transpose() * ekf::air_velocity(x);
  const double Va = u_b.norm();
  s.airspeed_mps = std::max(Va + x.gust_mps, 0.0);
  s.alpha_rad = std::atan2(u_b.z(), u_b.x());
  s.beta_rad = std::asin(std::clamp(u_b.y() / std::max(Va, 1e-3), -1.0, 1.0));
}

inline void Ekf::fill_deviations(const Params& p) {
  const ErrorStateEkf& f = navigator_.filter();
  const Health& h = navigator_.health();
  VehicleState& s = state_;
  const double now = navigator_.time_s();
  deviations_s_ = f.time_s();
  const auto three = [&](int i) { return Vec3<Ned>{f.std(i), f.std(i + 1), f.std(i + 2)}; };
  s.attitude_std_rad = three(ekf::theta);
  s.velocity_std_mps = three(ekf::vel);
  s.position_std_m = three(ekf::pos);
  s.wind_std_mps = {f.std(ekf::wind), f.std(ekf::wind + 1), unknown_std};
  const bool pitot = now - h.pitot_s < 1, tube = !navigator_.airborne() && navigator_.pitot_mps() > 0;
  s.airspeed_std_mps = navigator_.airborne() ? f.expected_std(ekf::true_airspeed(f.state(), 0), 0) : tube ? 2 : unknown_std;
  const auto origin = navigator_.origin();
  s.origin_latitude_deg = origin.lat_deg;
  s.origin_longitude_deg = origin.lon_deg;
  s.origin_altitude_m = origin.alt_m;
  s.origin_valid = navigator_.origin_known();
  s.attitude_valid =
      navigator_.yaw_known() && std::max(s.attitude_std_rad.north, s.attitude_std_rad.east) < 0.25 && s.attitude_std_rad.down < 0.5;
  s.velocity_valid = std::max({s.velocity_std_mps.north, s.velocity_std_mps.east, s.velocity_std_mps.down}) < 3;
  s.position_valid =
      navigator_.position_known() && now - h.position_s < p.gnss_timeout && std::max(s.position_std_m.north, s.position_std_m.east) < 50;
  s.height_valid = navigator_.height_known() && s.position_std_m.down < 20;
  s.wind_valid = std::max(s.wind_std_mps.north, s.wind_std_mps.east) < 3;
  s.airspeed_valid = navigator_.airborne() ? pitot || s.airspeed_std_mps < 3 : tube;
}

inline void Ekf::probes(Outputs& out) const {
  const Health& h = navigator_.health();
  const ekf::Nominal& x = navigator_.filter().state();
  out.horizontal_ratio = h.horizontal_ratio;
  out.height_ratio = h.height_ratio;
  out.velocity_ratio = h.velocity_ratio;
  out.baro_ratio = h.baro_ratio;
  out.pitot_ratio = h.pitot_ratio;
  out.sideslip_ratio = h.sideslip_ratio;
  out.heading_ratio = h.heading_ratio;
  out.refused_ratio = h.refused;
  out.gust_mps = x.gust_mps;
  out.baro_bias_m = x.baro_m;
  out.heading_deviation_rad = x.heading_rad;
}

}  // namespace fulmar::estimator
