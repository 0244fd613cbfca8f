// SPDX-License-Identifier: BSD-3-Clause
// The second formulation of the estimator as a component, in work; benches fly it in place of the shipped one
// (--with bench_second_filter.so). Every slow sensor error is a state (states.hpp), one rule finds the fault
// of any sensor (faults.hpp), each sensor adapts its noise to its innovations (monitor.hpp), and each
// published standard deviation is the root of a diagonal of the covariance. Needs GeographicLib, as
// geodesy.hpp.
#pragma once
#include "bench/second_filter/thrust.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/flight/math/single.hpp"
#include "fulmar/flight/navigation/ports.hpp"

namespace fulmar::second_filter {

struct Ekf {  ///< a component; or a member of one, with the same calls
  static constexpr const char* doc =
      "Attitude, velocity, position, wind and sensor biases by an error-state extended Kalman filter.";
  using Inputs = navigation::Inputs;
  using Outputs = navigation::Outputs;
  using Params = second_filter::Params;

  void configure(const Params& p) { navigator_.start(p); }
  void retune(const Params& p) { navigator_.tune(p); }

  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    const VehicleState& s = last->state.value;
    const bool running = navigator_.aligned() && tick.now_ns - stepped_ns_ < 100'000'000;
    const bool known = last.has(last->state) && s.attitude_valid && s.velocity_valid;
    if (running || in.imu.sequence() == 0 || !known) return Status::ok;
    navigator_.resume(s, p, 1e-9 * static_cast<double>(in.imu.valid_at_ns()));
    imu_ns_ = in.imu.valid_at_ns();
    shown_ = Shown::nothing;
    return Status::ok;
  }

  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    return step(tick, in, p, out, [](Navigator&) {});
  }
  /// `fuse_more(Navigator&)` is called with each inertial sample while there is an attitude, after the
  /// shipped measurements and before the state is published.
  template <class FuseMore>
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out, FuseMore&& fuse_more) {
    const Status status = navigate(tick, in, p, out, fuse_more);
    if (tick.now_ns - reported_ns_ < reported_every_ns) return status;
    reported_ns_ = tick.now_ns;
    out.health.publish(navigator_.health().message(tick.now_s(), navigator_.airborne()));
    return status;
  }

 private:
  template <class FuseMore>
  Status navigate(const Tick& tick, const Inputs& in, const Params& p, Outputs& out, FuseMore& fuse_more) {
    stepped_ns_ = tick.now_ns;
    if (in.status && in.status.fresh()) navigator_.status(*in.status);
    if (!newer(in.imu, imu_ns_, tick) || !inertial(in, tick, p)) {
      report_early(in.imu, imu_ns_, tick);
      missed(in, tick);
      return coast(tick, in.imu.fresh(), p, out);
    }
    sensors(in, tick, p);
    turned(in, tick, p);
    if (!navigator_.aligned()) {
      const bool had_one = navigator_.regaining() || shown_ != Shown::nothing;
      return had_one ? blind(in.imu.valid_at_ns(), p, out) : Status::degraded;
    }
    if (in.commands) thrust(in, p);
    fuse_more(navigator_);
    fill(navigator_.filter().state(), navigator_.filter().R_nb(), navigator_.filter().rate_b(), p);
    if (navigator_.filter().time_s() - deviations_s_ > deviations_after_s) fill_deviations(p);
    publish(in.imu.valid_at_ns(), Shown::measured, out);
    if (navigator_.health().horizontal.accepted_s > checked_s_) publish_check(out);
    probes(out);
    return healthy() ? Status::ok : Status::degraded;
  }
  enum class Shown : std::uint8_t {
    nothing,
    measured,  ///< the filter's state, or that there is none
    coasted    ///< the state carried on through a gap
  };
  // Deviations beyond which a part of the state is not called valid.
  static constexpr double tilt_valid_rad = 0.25, yaw_valid_rad = 0.5, speed_valid_mps = 3;
  static constexpr double position_valid_m = 50, height_valid_m = 20;
  static constexpr double tube_std_mps = 2;             ///< of the pitot alone, rolling or standing
  static constexpr double pitot_lost_s = 1;             ///< without an accepted sample
  static constexpr double commands_age_s = 0.5;         ///< older commands do not describe the motor
  static constexpr double deviations_after_s = 0.0099;  ///< renewed at 100 Hz; a sample may be a little early

  /// A sample whose time is later than that of the one before, and not in the future.
  template <class Port>
  static bool newer(const Port& port, std::int64_t last_ns, const Tick& tick) {
    return port.fresh() && port.valid_at_ns() > last_ns && port.valid_at_ns() <= tick.now_ns + ahead_ns;
  }
  template <class Port>
  void report_early(const Port& port, std::int64_t last_ns, const Tick& tick) {
    if (port.sequence() == 0 || !port.fresh() || port.valid_at_ns() >= last_ns) return;
    if constexpr (requires { navigator_.health().early(*port, 0.0); })
      navigator_.health().early(*port, tick.now_s());
  }
  template <class Port>
  bool take(const Port& port, std::int64_t& last_ns, const Tick& tick) {
    if (!port || !newer(port, last_ns, tick)) {
      report_early(port, last_ns, tick);
      return false;
    }
    last_ns = port.valid_at_ns();
    if constexpr (requires { navigator_.health().came(*port, 0.0); })
      navigator_.health().came(*port, tick.now_s());
    return true;
  }
  bool inertial(const Inputs& in, const Tick& tick, const Params& p) {
    const Vector3d omega_b = eigen(in.imu->rate_radps), f_b = eigen(in.imu->specific_force_mps2);
    if (!omega_b.allFinite() || !f_b.allFinite()) return false;
    if (tick.now_ns - felt_ns_ >= felt_every_ns) {
      felt_ns_ = tick.now_ns;
      navigator_.health().came(*in.imu, tick.now_s());
    }
    const std::int64_t before_ns = imu_ns_;
    imu_ns_ = in.imu.valid_at_ns();
    dt_s_ = 1e-9 * static_cast<double>(imu_ns_ - before_ns);
    return navigator_.imu(omega_b, f_b, 1e-9 * static_cast<double>(imu_ns_), p);
  }
  /// Samples without an inertial sample in the same tick count as received and are not used.
  void missed(const Inputs& in, const Tick& tick) {
    take(in.mag, mag_ns_, tick);
    take(in.baro, baro_ns_, tick);
    take(in.gnss, gnss_ns_, tick);
    take(in.pitot, pitot_ns_, tick);
  }
  void sensors(const Inputs& in, const Tick& tick, const Params& p) {
    if (take(in.mag, mag_ns_, tick)) navigator_.mag(eigen(in.mag->field_tesla), p);
    if (take(in.baro, baro_ns_, tick)) navigator_.baro(in.baro->pressure_pa, p);
    if (take(in.gnss, gnss_ns_, tick))
      navigator_.gnss(*in.gnss, 1e-9 * static_cast<double>(in.gnss.valid_at_ns()), p);
    if (take(in.pitot, pitot_ns_, tick)) navigator_.pitot(in.pitot->pressure_pa, p);
  }
  /// Throttle that reaches the motor: not where a pilot or the vehicle itself flies.
  void thrust(const Inputs& in, const Params& p) {
    const bool commanded = !in.commands.stale() && in.commands.age_s() < commands_age_s &&
                           (!in.status || !(in.status->override || in.status->failsafe));
    thrust_.step(navigator_, in.commands->throttle_frac, commanded, dt_s_, p);
  }
  /// Rotation of the controller's own attitude since the last inertial sample before the gap. Its heading may
  /// have any offset that is constant.
  void turned(const Inputs& in, const Tick& tick, const Params& p) {
    if (!take(in.attitude, attitude_ns_, tick)) return;
    const Quaterniond q = eigen(in.attitude->attitude);
    const double before_s = turn_s_;
    const Quaterniond before = turn_q_;
    const bool beside = std::abs(1e-9 * static_cast<double>(attitude_ns_ - imu_ns_)) < Navigator::coasted_s;
    if (navigator_.regaining() && beside && shown_ != Shown::nothing) {
      const double gap_s = 1e-9 * static_cast<double>(imu_ns_) - navigator_.filter().time_s();
      if (gap_s <= p.max_bridge && std::abs(before_s - navigator_.filter().time_s()) < Navigator::coasted_s)
        navigator_.bridge(before.conjugate() * q);
    }
    if (!navigator_.aligned() || !beside) return;
    turn_s_ = 1e-9 * static_cast<double>(attitude_ns_);
    turn_q_ = q;
  }
  void publish(std::int64_t valid_at_ns, Shown what, Outputs& out) {
    out.state.publish(state_, valid_at_ns);
    published_ns_ = valid_at_ns;
    shown_ = what;
  }
  Status coast(const Tick& tick, bool sample, const Params& p, Outputs& out);
  Status blind(std::int64_t valid_at_ns, const Params& p, Outputs& out);
  bool healthy() const {
    return state_.attitude_valid && state_.velocity_valid && state_.position_valid && state_.height_valid;
  }

  Vector3d coasted_rate(const Nominal& x, double gap_s, const Params& p) const;
  void fill(const Nominal& x, const Matrix3d& R_nb, const Vector3d& omega_b, const Params& p);
  void fill_reset(const Nominal& x, const Euler& e);
  void fill_air(const Nominal& x, const Matrix3d& R_nb);
  void fill_deviations(const Params& p);
  void widen(double gap_s, const Params& p);
  void publish_check(Outputs& out);
  void probes(Outputs& out) const;

  Navigator navigator_;
  Thrust thrust_;
  VehicleState state_;
  Vector3d rate_ = Vector3d::Zero();
  double dt_s_ = 0, deviations_s_ = never, checked_s_ = never;
  static constexpr std::int64_t ahead_ns = 10'000'000, long_ago = -(std::int64_t{1} << 62);
  std::int64_t imu_ns_ = long_ago, mag_ns_ = long_ago, baro_ns_ = long_ago, gnss_ns_ = long_ago,
               pitot_ns_ = long_ago, attitude_ns_ = long_ago;
  Quaterniond turn_q_ = Quaterniond::Identity();  ///< the controller's attitude at `turn_s_`
  double turn_s_ = never;
  static constexpr std::int64_t reported_every_ns = 199'000'000;  ///< 5 Hz; a tick may be a little early
  static constexpr std::int64_t felt_every_ns = 19'900'000;       ///< the inertial unit: 50 Hz are enough
  std::int64_t stepped_ns_ = 0, published_ns_ = 0, reported_ns_ = long_ago, felt_ns_ = long_ago;
  Shown shown_ = Shown::nothing;
  bool rate_started_ = false;  ///< the smoothed rate has begun
  bool stood_in_ = false;      ///< the state published last was that of before a gap
  Nominal coasted_;            ///< the state carried on through a gap
};

/// No inertial sample. Up to the limit the aircraft is taken to turn and to be carried as it was: the state
/// goes on, flagged. After that it stays where it was, and nothing of it is called valid.
inline Status Ekf::coast(const Tick& tick, bool sample, const Params& p, Outputs& out) {
  const double gap_s = 1e-9 * static_cast<double>(tick.now_ns - imu_ns_);
  if (shown_ == Shown::nothing || gap_s <= Navigator::coasted_s)
    return sample || gap_s > Navigator::coasted_s ? Status::degraded : Status::ok;
  if (!navigator_.aligned() || gap_s > p.max_coast) return blind(tick.now_ns, p, out);
  const Filter& f = navigator_.filter();
  const bool coasting = shown_ == Shown::coasted;
  if (!coasting) coasted_ = f.state();
  const double dt = 1e-9 * static_cast<double>(tick.now_ns - (coasting ? published_ns_ : imu_ns_));
  Nominal& x = coasted_;
  const Vector3d v_before = x.v_n(), omega_b = coasted_rate(x, gap_s, p);
  x.x.segment<3>(vel) +=
      dt * (x.q_nb * exp_map(0.5 * dt * omega_b) * f.specific_force_b() + Vector3d(0, 0, p.gravity));
  x.x.segment<3>(pos) += 0.5 * dt * (v_before + x.v_n());
  x.q_nb = (x.q_nb * exp_map(dt * omega_b)).normalized();
  fill(x, x.q_nb.toRotationMatrix(), omega_b, p);
  fill_deviations(p);
  widen(gap_s, p);
  publish(tick.now_ns, Shown::coasted, out);
  return Status::degraded;
}

/// In a gap the rates go from the last ones to those of a steady turn: the roll rate, which is controlled,
/// more slowly than those due to gusts.
inline Vector3d Ekf::coasted_rate(const Nominal& x, double gap_s, const Params& p) const {
  const Euler e = euler_from(x.q_nb);
  const double V = x.v_n().head<2>().norm();
  const double psi_dot = V > p.min_airspeed ? p.gravity * std::tan(std::clamp(e.roll_rad, -1.2, 1.2)) / V : 0;
  const Vector3d turn = psi_dot * (x.q_nb.conjugate() * Vector3d::UnitZ());
  const Vector3d seen = navigator_.filter().rate_b();
  const double steered = std::exp(-gap_s / 1.0), gusts = std::exp(-gap_s / 0.15);
  return turn + Vector3d(steered, gusts, gusts).cwiseProduct(seen - turn);
}

/// The motion is unknown: publishes the last state with its flags cleared.
inline Status Ekf::blind(std::int64_t valid_at_ns, const Params& p, Outputs& out) {
  fill_deviations(p);
  widen(1e-9 * static_cast<double>(valid_at_ns) - navigator_.filter().time_s(), p);
  VehicleState& s = state_;
  s.rate_radps = {};
  s.specific_force_mps2 = {};
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = s.wind_valid =
      s.airspeed_from_model = false;
  rate_started_ = false;
  stood_in_ = true;
  deviations_s_ = never;
  publish(valid_at_ns, Shown::measured, out);
  return Status::degraded;
}

/// Standard deviations grow with the possible motion since the last sample.
inline void Ekf::widen(double gap_s, const Params& p) {
  const auto wider = [](Vec3<Ned>& std, double more) {
    std = {std::hypot(std.north, more), std::hypot(std.east, more), std::hypot(std.down, more)};
  };
  const double t = std::max(gap_s, 0.0), speed = p.gap_accel_std * t;
  wider(state_.attitude_std_rad, std::min(p.gap_rate_std * t, std::numbers::pi));
  wider(state_.velocity_std_mps, speed);
  wider(state_.position_std_m, 0.5 * speed * t);
  state_.airspeed_std_mps = std::hypot(state_.airspeed_std_mps, speed);
}

inline void Ekf::fill(const Nominal& x, const Matrix3d& R_nb, const Vector3d& omega_b, const Params& p) {
  const Filter& f = navigator_.filter();
  VehicleState& s = state_;
  const Euler e = euler_from(R_nb);
  fill_reset(x, e);
  s.position_m = from_eigen<Ned>(x.p_n());
  s.velocity_mps = from_eigen<Ned>(x.v_n());
  s.attitude = from_eigen(x.q_nb);
  s.roll_rad = e.roll_rad;
  s.pitch_rad = e.pitch_rad;
  s.yaw_rad = e.yaw_rad;
  if (p.rate_filter > 0 && rate_started_)
    rate_ += (omega_b - rate_) *
             (1 - std::exp(-2 * std::numbers::pi * p.rate_filter * std::clamp(dt_s_, 0.0, 1.0)));
  else
    rate_ = omega_b;
  rate_started_ = true;
  s.rate_radps = from_eigen<Body>(rate_);
  s.specific_force_mps2 = from_eigen<Body>(f.specific_force_b());
  s.gyro_bias_radps = from_eigen<Body>(Vector3d(x.at<3>(gyro_bias)));
  s.accel_bias_mps2 = from_eigen<Body>(Vector3d(x.at<3>(accel_bias)));
  s.height_m = -x.p_n().z();
  s.climb_rate_mps = -x.v_n().z();
  s.ground_speed_mps = std::sqrt(x.v_n().x() * x.v_n().x() + x.v_n().y() * x.v_n().y());
  // From the nose at rest to the velocity in motion without a step.
  const double moving = smoothly(s.ground_speed_mps, 1, 3);
  s.course_rad =
      moving > 0
          ? wrap_pi(e.yaw_rad + moving * angle_difference(std::atan2(x.v_n().y(), x.v_n().x()), e.yaw_rad))
          : e.yaw_rad;
  fill_air(x, R_nb);
}

/// The state published in a gap is not the filter's: the reset at the end of the gap is the difference to it.
inline void Ekf::fill_reset(const Nominal& x, const Euler& e) {
  const Resets& r = navigator_.resets();
  VehicleState& s = state_;
  if (r.count != s.reset_count) {
    s.reset_position_m = from_eigen<Ned>(stood_in_ ? Vector3d(x.p_n() - eigen(s.position_m)) : r.position_m);
    s.reset_velocity_mps =
        from_eigen<Ned>(stood_in_ ? Vector3d(x.v_n() - eigen(s.velocity_mps)) : r.velocity_mps);
    s.reset_yaw_rad = stood_in_ ? angle_difference(e.yaw_rad, s.yaw_rad) : r.yaw_rad;
    s.reset_count = r.count;
  }
  stood_in_ = false;
}

inline void Ekf::fill_air(const Nominal& x, const Matrix3d& R_nb) {
  VehicleState& s = state_;
  s.wind_mps = from_eigen<Ned>(x.air_n());
  if (!navigator_.airborne()) {  // rolling or standing: the pitot alone measures it
    s.airspeed_mps = navigator_.pitot_mps();
    s.alpha_rad = s.beta_rad = 0;
    return;
  }
  const Vector3d u_b = R_nb.transpose() * x.through_air_n();
  const double Va = u_b.norm();
  s.airspeed_mps = Va;
  s.alpha_rad = std::atan2(u_b.z(), u_b.x());
  s.beta_rad = std::asin(std::clamp(u_b.y() / std::max(Va, 1e-3), -1.0, 1.0));
}

}  // namespace fulmar::second_filter
