// SPDX-License-Identifier: BSD-3-Clause
// From sensors to the filter: alignment, choice and noise of each sample, recovery. It has no ports; time is
// in seconds. The filter and its equations: fulmar/flight/navigation/ekf.hpp and ekf_models.hpp. Users
// include navigator_updates.hpp, or estimator.hpp for the component. Needs GeographicLib, as geodesy.hpp.
#pragma once
#include <initializer_list>
#include <optional>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/earth/magnetic_model.hpp"
#include "fulmar/flight/navigation/aid.hpp"
#include "fulmar/flight/navigation/alignment.hpp"
#include "fulmar/flight/navigation/ekf_models.hpp"
#include "fulmar/flight/navigation/gusts.hpp"
#include "fulmar/flight/navigation/heading.hpp"
#include "fulmar/flight/navigation/noise.hpp"
#include "fulmar/flight/navigation/params.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"

namespace fulmar::navigation {

inline constexpr double bridge_tilt_std = 0.01, bridge_tilt_rate = 0.01;  ///< rad, rad/s: of another's turn
inline constexpr double bridge_accel_std = 1;  ///< m/s2: unmeasured changes of the speed
inline constexpr double height_off_s = 3;      ///< over which a contradiction of the height is averaged
inline constexpr double climb_off_s = 0.5;     ///< the same of the climb
inline constexpr double height_step_m = 0.7;   ///< by which one fix moves the height at most
inline constexpr double baro_step_m = 0.05,
                        baro_back_for_s = 3;   ///< by which a barometer that is back moves the height at most
inline constexpr double height_set_m = 50;     ///< beyond which nothing is resolved by degrees
inline constexpr double outage_after_s = 1.5;  ///< without a velocity: no late fix of a slow receiver
inline constexpr double heading_lost_s = 10;   ///< without an accepted magnetic heading
inline constexpr double fix_stamp_std_s =
    0.004;  ///< from fix to fix: a receiver solves its epochs in some ms
inline constexpr double clipped_for_s =
    10;  ///< so long after a saturated sample a unit has its configured noise
inline constexpr double min_gust_mps = 1.2,
                        max_gust_mps = 2;  ///< largest error of a pitot over a second
inline constexpr double coasted_s =
    0.02;  ///< so long without an inertial sample is a gap: slower units do not fly

/// State of the attitude:
///   waiting -> aligning -> running -> lost -> regained -> lost ...; lost -> running at rest;
///   lost -> running when another unit has measured the turn; any -> running when it takes over from an
///   active estimate; in flight aligning -> trying -> running, or back when the fixes contradict.
enum class Mode : std::uint8_t {
  waiting,   ///< for the first inertial sample
  aligning,  ///< for the first attitude: at rest or in flight
  trying,    ///< has one in flight, and waits for fixes that confirm it
  running,   ///< aligned, with a full prior
  lost,      ///< a gap was too long to be bridged: aligns again, keeps slow states
  regained   ///< aligned again in flight
};

/// Available data; each flag is set and cleared on its own.
struct Seen {
  bool yaw = false, position = false, height = false;
  bool origin = false;     ///< of the local frame
  bool altitude = false;   ///< by pressure, as long as there is no origin
  bool field = false;      ///< the Earth's magnetic field, by the model
  bool year = false;       ///< from a receiver, for that model
  bool baro_zero = false;  ///< the barometer's offset has begun
};

/// How often the state was set, and not moved by degrees, and by how much the last time: after minus before.
struct Resets {
  std::uint32_t count = 0;
  Vector3d position_m = Vector3d::Zero(), velocity_mps = Vector3d::Zero();
  double yaw_rad = 0, at_s = never;
};

class Navigator {  ///< from samples of sensors to the state of the filter; SI units, NED and body axes
 public:
  /// Set-up and live changes: noises only.
  void tune(const Params& p) {
    ekf::Noise& n = filter_.noise;
    n.gyro = p.gyro_noise;
    n.gyro_scale = p.gyro_scale_error;
    n.accel = p.accel_noise;
    n.accel_scale = p.accel_scale_error;
    n.gyro_bias_walk = p.gyro_bias_walk;
    n.accel_bias_walk = p.accel_bias_walk;
    n.wind_walk = p.wind_walk;
    n.wind_shear = p.wind_shear;
    n.gust_std = p.gust_std;
    n.gust_time = p.gust_time;
    n.baro_walk = p.baro_walk;
    n.port_walk = p.static_port_walk;
    n.heading_std = p.mag_deviation;
    n.heading_time = p.mag_deviation_time;
    n.gnss_time = p.gnss_position_time;
    if (n.gnss_std == 0) n.gnss_std = p.gnss_horizontal_std;  // until a receiver reports its own
    filter_.gravity_mps2 = p.gravity;
  }

  void start(const Params& p) {
    *this = Navigator{};
    tune(p);
    if (p.origin.given()) set_origin(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
  }

  /// Takes over from an estimate that flies already.
  void resume(const VehicleState& s, const Params& p, double time_s) {
    const ErrorStateEkf::More more = filter_.more();
    start(p);
    filter_.more() = more;
    filter_.more().begin_again();
    if (s.origin_valid && !seen_.origin)
      set_origin(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
    ekf::Nominal x;
    x.q_nb = eigen(s.attitude);
    x.v_n = eigen(s.velocity_mps);
    x.p_n = eigen(s.position_m);
    x.gyro_bias = eigen(s.gyro_bias_radps);
    x.accel_bias = eigen(s.accel_bias_mps2);
    x.wind = eigen(s.wind_mps).head<2>();
    begin(x, p, time_s, 0.05, 0.05);
    const auto at_least = [&](int i, double std, double low, double high) {
      filter_.forget(i, 1, std::clamp(std, low, high));
    };
    for (int i = 0; i < 3; ++i) {
      filter_.forget(ekf::vel + i, 1, 1);
      filter_.forget(ekf::gyro_bias + i, 1, 0.02);
    }
    at_least(ekf::wind, s.wind_std_mps.north, 0.5, p.wind_std);
    at_least(ekf::wind + 1, s.wind_std_mps.east, 0.5, p.wind_std);
    seen_.position = located_ = s.position_valid;
    filter_.forget(ekf::pos, 3, s.position_valid ? 5 : 1e3);
    seen_.yaw = true;
    resets_ = {s.reset_count, eigen(s.reset_position_m), eigen(s.reset_velocity_mps), s.reset_yaw_rad, never};
  }

  bool aligned() const { return mode_ == Mode::running || mode_ == Mode::regained || mode_ == Mode::trying; }
  bool regaining() const { return mode_ == Mode::lost; }  ///< not aligned since a gap
  /// Found in flight, and the next fixes still move it: commands that follow it would step.
  bool settling() const {
    if (mode_ == Mode::trying) return true;
    constexpr double tilt_std = 0.025, max_s = 0.5;
    return mode_ == Mode::regained && time_s_ - aligned_s_ < max_s &&
           std::max(filter_.std(ekf::theta), filter_.std(ekf::theta + 1)) > tilt_std;
  }
  const Seen& seen() const { return seen_; }
  const Resets& resets() const { return resets_; }
  bool airborne() const { return airborne_; }
  const ErrorStateEkf& filter() const { return filter_; }
  ErrorStateEkf& filter() { return filter_; }  ///< for uses beyond fuse and doubt
  const Gusts& gusts() const { return gusts_; }
  const MeanWindError& wind_error() const { return wind_error_; }
  /// m/s: common part of the innovations of the horizontal velocity beyond the slow part that is counted.
  double shared_speed_mps() const { return fix_noise_.beyond(health_.level.std_mps()); }
  /// Since the fixes stopped; 0 with fixes.
  double outage_s() const {
    const double silent = time_s_ - std::max(health_.velocity.accepted_s, aligned_s_);
    return silent > outage_after_s ? silent : 0;
  }
  const Health& health() const { return health_; }
  Health& health() { return health_; }
  LocalFrame::Geodetic origin() const { return frame_.origin(); }
  double pitot_mps() const { return pitot_mps_; }  ///< smoothed true airspeed of the pitot alone
  double time_s() const { return time_s_; }

  void status(const VehicleStatus& s) { status_ = s; }

  /// Fuses a scalar of the sensor with the monitor `aid` when it is within `gate` standard deviations. The
  /// shipped measurements use it, and so does a user's sensor.
  ekf::Fused fuse(const ekf::Scalar& z, double variance, double gate, Aid& aid) {
    const ekf::Fused fused = filter_.fuse(z, variance, gate);
    aid.record(fused, time_s_);
    health_.refused += !fused.accepted;
    return fused;
  }
  /// Common gate of several scalars, in standard deviations: true when the worst of them passes.
  bool within(std::initializer_list<double> ratios, double gate, Aid& aid);
  /// Time for which the gate has rejected this sensor; 0 when the last measurement was accepted.
  double refused_for_s(const Aid& aid) const {
    return aid.refused_from_s == never ? 0 : time_s_ - std::max(aid.refused_from_s, aligned_s_);
  }
  /// Two sources contradict: raises these parts of the state to at least `std`, so that a correct sensor is
  /// accepted again, while one that is far off stays rejected.
  void doubt(std::initializer_list<int> parts, double std, Aid& aid);

  bool at_stop() const { return time_s_ - clipped_s_ < clipped_for_s; }  ///< or was a moment ago
  /// A saturated sample has no noise of its own, and the part that was cut off is still missing afterwards.
  void learn_noise(const Vector3d& omega_b, const Vector3d& f_b, double dt, const Params& p);
  /// One inertial sample, valid at `time_s`. False: it is not newer than the last one and was ignored.
  bool imu(const Vector3d& omega_b, const Vector3d& f_b, double time_s, const Params& p) {
    const double dt = time_s - time_s_;
    if (mode_ != Mode::waiting && !(dt > 0)) return false;
    time_s_ = time_s;
    health_.felt(omega_b, f_b);
    learn_noise(omega_b, f_b, dt, p);
    if (mode_ == Mode::waiting) {
      mode_ = Mode::aligning;
      return true;
    }
    if (aligned() && dt > p.max_coast) lose();
    still_.update(omega_b, f_b, dt);
    resting_ = still_.still() && at_rest_by_others(p);
    if (!aligned()) {
      flight_.imu(omega_b - filter_.state().gyro_bias, f_b - filter_.state().accel_bias, dt);
      if (resting_) align_at_rest(p);
      return true;
    }
    const Vector3d v = filter_.state().v_n;
    heading_.corrected(filter_.R_nb());
    filter_.predict(omega_b, f_b, dt);
    heading_.predicted(filter_.R_nb(), filter_.specific_force_b(), dt, time_s_);
    const Vector3d ahead = ekf::air_velocity(filter_.state()).normalized();
    late_mps_ = (late_mps_ + (filter_.state().v_n - v).dot(ahead)) * std::exp(-dt / late_s);
    if (dt > coasted_s) bridged(dt, p);
    // A saturated unit reports less than the motion.
    if (airborne_ && health_.rates.clipped())
      filter_.inflate(ekf::theta, 3, 2 * p.gap_rate_std * std::sqrt(dt));
    if (airborne_ && health_.forces.clipped()) filter_.inflate(ekf::vel, 3, p.gap_accel_std * std::sqrt(dt));
    if (resting_ && time_s_ - rest_fused_s_ > 0.05) rest(p);
    update_airborne(p);
    if (airborne_ && seen_.yaw && time_s_ - sideslip_s_ > 0.1 - 1e-4) sideslip(p);
    return true;
  }

  /// Bridges a gap that is too long to be coasted by `turn_b`, the rotation of the body measured by another
  /// unit. The air-relative velocity in body axes stays.
  void bridge(const Quaterniond& turn_b, const Params& p) {
    const double T = time_s_ - filter_.time_s();
    ekf::Nominal x = filter_.state();
    const Vector3d v_before = x.v_n, wind_n(x.wind.x(), x.wind.y(), 0);
    const Vector3d u_b = x.q_nb.conjugate() * (x.v_n - wind_n);
    x.q_nb = (x.q_nb * turn_b).normalized();
    x.v_n = x.q_nb * u_b + wind_n;
    x.p_n += 0.5 * T * (v_before + x.v_n);
    filter_.inflate(ekf::theta, 3, bridge_tilt_std + bridge_tilt_rate * T);
    filter_.inflate(ekf::vel, 3, bridge_accel_std * T);
    filter_.inflate(ekf::pos, 3, bridge_accel_std * T * T);
    filter_.inflate(ekf::gust, 1, p.gust_std);
    const ekf::Covariance P = filter_.covariance();
    filter_.reset(x, ekf::Vector::Zero(), time_s_);
    filter_.set_covariance(P);
    mode_ = Mode::running;
    aligned_s_ = time_s_;
  }

  void gnss(const Gnss& g, double valid_s, const Params& p);
  void mag(const Vector3d& field_b, const Params& p);
  void baro(double pressure_pa, const Params& p);
  void pitot(double pressure_pa, const Params& p);

 private:
  static double known(double reported, double otherwise, double floor) {
    const double std = reported > 0 && reported < 1e6 ? reported : otherwise;
    return std::max(std, floor);
  }

  /// Reads the same again and again in flight: nothing is learnt from it, however long it goes on.
  bool stuck(const Aid& aid) const { return airborne_ && aid.arrivals.stuck(); }

  /// Time after which a rejected sensor is accepted. It is shorter for a sensor that was accepted in this way
  /// a short time ago: more likely it is right now.
  double patience_s(const Aid& aid, const Params& p) const {
    return time_s_ - aid.believed_s < 60 ? std::min(2.0, p.gnss_reset_after.value) : p.gnss_reset_after.value;
  }

  /// Number of fixes within twice the correlation time of their error, which together have the information of
  /// one: the factor on their variance.
  double samples_in(double correlation_s, double last_s) const {
    return 1 + 2 * correlation_s / std::clamp(time_s_ - last_s, 0.02, 10.0);
  }

  void set_origin(double lat_deg, double lon_deg, double alt_m) {
    frame_ = LocalFrame(lat_deg, lon_deg, alt_m);
    seen_.origin = true;
    altitude_m_ = alt_m;
    magnetic_model(lat_deg, lon_deg, alt_m);
  }
  void magnetic_model(double lat_deg, double lon_deg, double alt_m) {
    field_n_ = magnetic_field_ned(lat_deg, lon_deg, alt_m, year_);
    seen_.field = true;
  }
  Gusts::MeanWind mean_wind() const {
    const ekf::Covariance& P = filter_.covariance();
    return {ekf::air_velocity(filter_.state()), {P(ekf::wind, ekf::wind), P(ekf::wind + 1, ekf::wind + 1)}};
  }
  void forget_gusts(double time_s, const Params& p) {
    gusts_.forget(mean_wind(), time_s, p);
    wind_error_.forget(gusts_, time_s, p);
  }
  /// m/s: mean wind north and east, gust along.
  Vector3d air() const {
    const ekf::Nominal& x = filter_.state();
    return {x.wind.x(), x.wind.y(), x.gust_mps};
  }
  /// The filter has moved that from `before` by this measurement, and gusts were in it.
  void spoil_wind(const Vector3d& before, const ekf::Scalar& z, const Params& p) {
    if (std::abs(z.innovation) < 1e-9) return;  // too small for a gain
    wind_error_.fused((air() - before) / z.innovation, z.H.segment<2>(ekf::wind).transpose(), z.H(ekf::gust),
                      gusts_, time_s_, p);
  }
  double declination() const { return std::atan2(field_n_.y(), field_n_.x()); }

  /// A smooth flight looks like rest to the inertial unit: another sensor has to confirm rest.
  bool at_rest_by_others(const Params& p) const {
    const bool gnss_slow = time_s_ - gnss_s_ < 2 && gnss_speed_ < 1.5,
               gnss_fast = time_s_ - gnss_s_ < 2 && gnss_speed_ >= 1.5;
    const bool pitot_slow = time_s_ - pitot_s_ < 1 && pitot_mps_ < p.min_airspeed;
    const bool stands_again =
        regaining() && gnss_slow && !(time_s_ - pitot_s_ < 1 && pitot_mps_ >= p.min_airspeed);
    if (gnss_fast || (status_ && status_->armed && !stands_again)) return false;
    return status_ || gnss_slow || pitot_slow;
  }

  void begin(const ekf::Nominal& x, const Params& p, double time_s, double tilt_std, double yaw_std) {
    ekf::Vector std;
    std.segment<2>(ekf::theta).setConstant(tilt_std);
    std(ekf::theta + 2) = yaw_std;
    std.segment<3>(ekf::vel).setConstant(1);
    std.segment<3>(ekf::pos).setConstant(1e3);
    std.segment<3>(ekf::gyro_bias).setConstant(p.gyro_bias_std);
    std.segment<3>(ekf::accel_bias).setConstant(p.accel_bias_std);
    std.segment<2>(ekf::wind).setConstant(p.wind_std);
    std(ekf::gust) = p.gust_std;
    std(ekf::baro) = 100;
    std(ekf::port) = p.static_port_std;
    std(ekf::heading) = p.mag_deviation;
    std.segment<2>(ekf::gnss).setConstant(filter_.noise.gnss_std);
    std(ekf::delay) = p.gnss_delay_std;
    time_s_ = time_s;
    filter_.reset(x, std, time_s);
    heading_.clear();
    forget_gusts(time_s, p);
    mode_ = Mode::running;
    aligned_s_ = time_s;
    seen_.yaw = yaw_std < 0.5;
  }

  /// After a gap that was too long to be bridged: attitude lost, alignment begins.
  void lose() {
    if (mode_ == Mode::trying) return try_again();
    mode_ = Mode::lost;
    resting_ = false;
    rest_since_s_ = never;
    flight_.clear();
    heading_.clear();
  }
  /// The first attitude in flight was none: from the beginning.
  void try_again() {
    mode_ = Mode::aligning;
    filter_.reset({}, ekf::Vector::Constant(1e3), time_s_);
    seen_.yaw = seen_.position = seen_.height = seen_.baro_zero = false;
    flight_.clear();
  }
  /// Between two samples far apart the rates were not on a straight line.
  void bridged(double dt, const Params& p) {
    heading_.clear();
    filter_.inflate(ekf::theta, 3, 0.3 * p.gap_rate_std * dt * dt);
    filter_.inflate(ekf::vel, 3, 0.3 * p.gap_accel_std * dt * dt);
  }
  /// Aligned again after a gap: new attitude and velocity. Slow states are kept with larger standard
  /// deviations: biases, wind, the barometer's offset, the magnetometer's error.
  void begin_again(const Quaterniond& q_nb, const Vector3d& v_n, const Params& p, double tilt_std,
                   double yaw_std) {
    const double gap = std::sqrt(std::max(time_s_ - filter_.time_s(), 0.0));
    ekf::Nominal x = filter_.state();
    x.q_nb = q_nb;
    x.v_n = v_n;
    x.gust_mps = 0;
    filter_.forget(ekf::theta, 2, tilt_std);
    filter_.forget(ekf::theta + 2, 1, yaw_std);
    filter_.forget(ekf::vel, 3, 1);
    filter_.forget(ekf::pos, 3, 1e3);
    filter_.forget(ekf::gust, 1, p.gust_std);
    filter_.inflate(ekf::gyro_bias, 3, std::max(p.gyro_bias_walk * gap, 5e-3));
    filter_.inflate(ekf::accel_bias, 3, std::max(p.accel_bias_walk * gap, 0.02));
    filter_.inflate(ekf::wind, 2, std::max(p.wind_walk * gap, 0.3));
    filter_.inflate(ekf::baro, 1, p.baro_walk * gap);
    filter_.inflate(ekf::port, 1, p.static_port_walk * gap);
    const ekf::Covariance P = filter_.covariance();
    filter_.reset(x, ekf::Vector::Zero(), time_s_);
    filter_.set_covariance(P);
    mode_ = Mode::regained;
    aligned_s_ = time_s_;
    seen_.yaw = yaw_std < 0.5;
  }

  void align_at_rest(const Params& p) {
    if (rest_since_s_ == never) rest_since_s_ = time_s_;  // flight time may be negative
    const bool has_mag = time_s_ - mag_s_ < 0.5;
    if (!has_mag && time_s_ - rest_since_s_ < 2) return;  // a magnetometer may still wake up
    const bool again = regaining();
    const ekf::Nominal before = filter_.state();
    ekf::Nominal x;
    const Vector3d f_b = still_.f();
    x.q_nb = has_mag ? attitude_at_rest(f_b, mag_b_, declination()) : attitude_at_rest(f_b);
    x.gyro_bias = still_.omega();
    // At rest only the accelerometers observe the tilt, and tilt gives the yaw by the dip of the field: no
    // priors of their own, the updates at rest tie them to the prior of the accelerometer bias.
    begin(x, p, time_s_, 0.5, has_mag ? 1 : 1.8);
    seen_.yaw = has_mag;
    seen_.position = seen_.height = seen_.baro_zero = false;
    filter_.forget(ekf::gyro_bias, 3, 0.01);
    if (again) count_reset(before);
    rest(p);
    if (has_mag) mag(mag_b_, p);
  }

  void align_in_flight(const Gnss& g, double time_s, const Params& p);

  void rest(const Params&) {
    rest_fused_s_ = time_s_;
    const ErrorStateEkf::Past now = filter_.at(time_s_);
    for (int i = 0; i < 3; ++i) filter_.fuse(ekf::velocity(filter_, now, i, 0), 0.05 * 0.05, 1e3);
    for (int i = 0; i < 3; ++i)
      filter_.fuse(ekf::zero_rate(filter_.state(), i, still_.omega()(i)), 2e-3 * 2e-3, 1e3);
  }

  void update_airborne(const Params& p) {
    const double limit = airborne_ ? 0.7 * p.min_airspeed : p.min_airspeed;
    const double Va = ekf::air_velocity(filter_.state()).norm();
    const bool fast = Va > limit || (time_s_ - pitot_s_ < 1 && pitot_mps_ > limit &&
                                     filter_.state().v_n.norm() > 0.5 * limit);
    const bool before = airborne_;
    airborne_ = fast && !resting_ && !(status_ && !status_->armed && status_->on_ground);
    if (airborne_ == before) return;
    forget_gusts(time_s_, p);
  }

  void sideslip(const Params& p);

  void count_reset(const ekf::Nominal& before);
  void place(const Gnss& g, double time_s, const Params& p);
  void forget_level();
  void begin_in_flight(const Gnss& g, const FlightAlignment::Found& found, double time_s, const Params& p);
  void try_attitude(const Params& p);
  void regain(const Gnss& g, const FlightAlignment::Found& found, bool has_mag, double time_s,
              const Params& p);
  void collect_origin(const Gnss& g, const Params& p);
  ErrorStateEkf::Past at_fix(double valid_s, const Params& p) const;
  Vector3d acceleration_at(double time_s) const;
  void bound_delay(const Params& p);
  void gnss_velocity(const Gnss& g, double valid_s, const Params& p);
  void gnss_position(const Gnss& g, double valid_s, const Params& p);
  void gnss_height(const ekf::Scalar& z, double std, const Params& p);
  double height_variance(const ekf::Scalar& z, double std, const Params& p) const;
  double climb_samples(double innovation_mps, double std, double slow, const Params& p);
  ekf::Scalar pressure_height(double pressure_pa) const;
  bool tube_contradicts(double Va, const Params& p);
  void yaw_from_course(const Vector3d& v_n);
  void yaw_from_field(const Vector3d& field_b);
  bool test_heading(const Gnss& g, double valid_s, const Params& p);
  void turn_heading(const Gnss& g, double valid_s, const Params& p);
  double take_deviation();
  void find_mount(const Vector3d& sample_b, const Params& p);

  ErrorStateEkf filter_;
  LocalFrame frame_;
  Stillness still_;
  FlightAlignment flight_;
  HeadingTest heading_;
  Mount mount_;
  Health health_;
  Vector3d field_n_{2e-5, 0, 4e-5}, mag_b_ = Vector3d::Zero();
  Vector3d origin_sum_ = Vector3d::Zero();
  Air air_;
  Gusts gusts_;
  MeanWindError wind_error_;
  UnitNoise gyro_noise_, accel_noise_;
  double clipped_s_ = never;
  FixNoise fix_noise_;
  double year_ = 2026.0, altitude_m_ = 0;  ///< of the origin; without one: by pressure
  double time_s_ = 0, aligned_s_ = 0, rest_since_s_ = never, rest_fused_s_ = never, sideslip_s_ = never,
         nose_s_ = never,
         nose_until_s_ = never;  ///< after a start in flight the attitude follows the sideslip, now and then
  double gnss_s_ = never, gnss_speed_ = 0, mag_s_ = never, mag_fused_s_ = never, pitot_s_ = never,
         pitot_mps_ = 0, baro_s_ = never, baro_back_s_ = never;
  static constexpr double late_s = 0.1;  ///< by which an airspeed may be late
  double late_mps_ = 0;                  ///< change of the airspeed within that time
  std::int64_t origin_count_ = 0;
  double baro_pa_ = 0, height_seen_s_ = never, height_off_m_ = 0, climb_seen_s_ = never, climb_off_mps_ = 0;
  Mode mode_ = Mode::waiting;
  Resets resets_;
  Seen seen_;
  std::optional<VehicleStatus> status_;  ///< the last one of the vehicle
  bool located_ = false;                 ///< has had a position: the next that is set is a reset
  bool resting_ = false;                 ///< at rest by the inertial unit and another sensor
  bool airborne_ = false;                ///< in flight: alpha, beta and the pitot are valid
};

}  // namespace fulmar::navigation
