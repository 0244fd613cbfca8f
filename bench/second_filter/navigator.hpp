// SPDX-License-Identifier: BSD-3-Clause
// From sensors to the filter: alignment, choice and noise of each sample, gaps, resets. It has no ports; time
// is in seconds. Users include sensors.hpp, or estimator.hpp for the component. Needs GeographicLib, as
// geodesy.hpp.
#pragma once
#include <initializer_list>
#include <optional>
#include <tuple>
#include <utility>

#include "bench/second_filter/measurements.hpp"
#include "bench/second_filter/monitor.hpp"
#include "bench/second_filter/params.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/flight/earth/magnetic_model.hpp"
#include "fulmar/flight/navigation/alignment.hpp"
#include "fulmar/flight/navigation/heading.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"

namespace fulmar::second_filter {

using navigation::attitude_at_rest;
using navigation::FieldDrift;
using navigation::FlightAlignment;
using navigation::HeadingTest;
using navigation::Stillness;

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
  static constexpr double coasted_s = 0.02;  ///< so long without an inertial sample is a gap

  Navigator() {
    for (const int first : {theta, vel, pos, gyro_bias, accel_bias}) filter_.add_block({first, 3, 1});
    for (const int first : {wind, gust, fix_pos, fix_vel}) filter_.add_block({first, 2, 1});
    for (const int first : {fix_pos + 2, fix_vel + 2, +delay, +baro_bias, +port, +strength, +tube_scale,
                            +tube_bias, +slip, +mount, +model})
      filter_.add_block({first, 1, 1});
    filter_.add_block({iron, 3, 1});
    // In steep turns the sideslip is no measure of the climb.
    for (const int i :
         {0, 1, 2, +vel + 2, +pos + 2, 9, 10, 11, 12, 13, 14, 19, 20, 21, 22, 23, 24, +baro_bias})
      by_air_(i) = 0;
    all_(tube_scale) = by_air_(tube_scale) = 0;
    by_field_.setZero();
    for (const int i :
         {+theta + 2, +gyro_bias, gyro_bias + 1, gyro_bias + 2, +iron, iron + 1, iron + 2, +strength, +mount})
      by_field_(i) = 1;
  }

  /// Set-up and live changes: models of the slow errors only.
  void tune(const Params& p) {
    const auto set = [&](int first, double std, double walk, double time_s = 0) {
      Block& b = filter_.block(first);
      b.std = std;
      b.walk = walk;
      b.time_s = time_s;
    };
    filter_.unit.gyro_scale = p.gyro_scale_error;
    filter_.unit.accel_scale = p.accel_scale_error;
    filter_.gravity_mps2 = p.gravity;
    filter_.wind_shear = p.wind_shear;
    filter_.sideslip_gust = p.sideslip_gust;
    // An error may go on changing for a time after its fault.
    const auto walk = [&](const Aid& aid, double usual, double faulty) {
      return std::hypot(usual, faulty * aid.changing(time_s_));
    };
    set(gyro_bias, p.gyro_bias_std, walk(health_.gyro, p.gyro_bias_walk, 1e-3));
    set(accel_bias, p.accel_bias_std, walk(health_.accel, p.accel_bias_walk, 0.05));
    set(wind, p.wind_std, p.wind_walk);
    const auto slow = [](const Aid& aid, double least) {
      return std::sqrt(std::max(aid.level.slow(), least));
    };
    // A receiver's position is never better than it reports.
    const double position = slow(health_.horizontal, 1), height = slow(health_.height, 1),
                 speed = slow(health_.velocity, 0);
    set(gust, p.gust_std * slow(health_.pitot, 0), 0, p.gust_time);
    set(slip, p.sideslip_ratio * p.gust_std * slow(health_.pitot, 0), 0, p.sideslip_time);
    set(strength, p.mag_scale_std, 0);
    set(mount, p.mag_mount_std, walk(health_.heading, 0, 0.05));
    set(fix_pos, position * fix_std_.x(), walk(health_.horizontal, 0, 2), p.gnss_position_time);
    set(fix_pos + 2, height * fix_std_.y(), walk(health_.height, 0, 2), p.gnss_position_time);
    set(fix_vel, speed * fix_std_.z(), walk(health_.velocity, 0, 0.5), p.gnss_speed_time);
    set(fix_vel + 2, speed * climb_ratio * fix_std_.z(), walk(health_.velocity, 0, 0.5), p.gnss_speed_time);
    set(delay, p.gnss_delay_std, 1e-4);
    set(baro_bias, 100, walk(health_.baro, p.baro_walk * slow(health_.baro, 0), 1));
    set(port, p.static_port_std, p.static_port_walk * slow(health_.baro, 0.25));
    set(iron, p.hard_iron_std, p.hard_iron_walk * slow(health_.heading, 0));
    set(tube_scale, p.pitot_scale_std, 0);
    set(tube_bias, 0, walk(health_.pitot, 0, 20));
    set(model, 0, 0.03);
    filter_.renew();
  }

  void start(const Params& p) {
    *this = Navigator{};
    fix_std_ = {p.gnss_horizontal_std, p.gnss_vertical_std, p.gnss_speed_std};
    tune(p);
    if (p.origin.given()) set_origin(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
  }

  void resume(const VehicleState& s, const Params& p, double time_s);

  bool aligned() const { return mode_ == Mode::running || mode_ == Mode::regained || mode_ == Mode::trying; }
  bool regaining() const { return mode_ == Mode::lost; }  ///< not aligned since a gap
  /// Found in flight, and the next fixes still move it: commands that follow it would step.
  bool settling() const {
    if (mode_ == Mode::trying) return true;
    constexpr double tilt_std = 0.025, max_s = 0.5;
    return mode_ == Mode::regained && time_s_ - aligned_s_ < max_s &&
           std::max(filter_.std(theta), filter_.std(theta + 1)) > tilt_std;
  }
  const Seen& seen() const { return seen_; }
  const Resets& resets() const { return resets_; }
  bool airborne() const { return airborne_; }
  const Filter& filter() const { return filter_; }
  Filter& filter() { return filter_; }
  const Health& health() const { return health_; }
  Health& health() { return health_; }
  LocalFrame::Geodetic origin() const { return frame_.origin(); }
  const Air& air() const { return air_; }
  double pitot_mps() const { return pitot_mps_; }  ///< smoothed true airspeed of the pitot alone
  double time_s() const { return time_s_; }
  void status(const VehicleStatus& s) { status_ = s; }

  /// Fuses a scalar of the sensor with the monitor `aid`. Its noise level is that of its innovations.
  Fused fuse(const Scalar& z, double variance, const Params& p, Aid& aid) {
    const Fused fused = filter_.fuse(z, aid.level.white() * variance, p.gate, all_, aid.insists(time_s_));
    aid.record(fused, time_s_, airborne_);
    health_.refused += !fused.accepted;
    return fused;
  }

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
      flight_.imu(omega_b - filter_.state().at<3>(gyro_bias), f_b - filter_.state().at<3>(accel_bias), dt);
      if (resting_) align_at_rest(p);
      return true;
    }
    const Vector3d v = filter_.state().v_n();
    filter_.predict(omega_b, f_b, dt);
    heading_.felt(filter_.R_nb() * filter_.specific_force_b(), dt, time_s_);
    const Vector3d ahead = filter_.state().through_air_n().normalized();
    late_mps_ = (late_mps_ + (filter_.state().v_n() - v).dot(ahead)) * std::exp(-dt / late_s);
    if (dt > coasted_s) {  // between two samples far apart the rates were not on a straight line
      filter_.inflate(theta, 3, 0.3 * p.gap_rate_std * dt * dt);
      filter_.inflate(vel, 3, 0.3 * p.gap_accel_std * dt * dt);
    }
    // A saturated unit reports less than the motion.
    if (airborne_ && health_.rates.clipped()) filter_.inflate(theta, 3, 2 * p.gap_rate_std * std::sqrt(dt));
    if (airborne_ && health_.forces.clipped()) filter_.inflate(vel, 3, p.gap_accel_std * std::sqrt(dt));
    if (resting_ && time_s_ - rest_fused_s_ > 0.05) rest();
    update_airborne(p);
    if (airborne_ && seen_.yaw && time_s_ - sideslip_s_ > 0.1 - 1e-4) sideslip(p);
    // Before the wind is found, and after saturation or a gap, the estimate is off for other reasons.
    if (time_s_ - std::max({airborne_since_s_, clipped_s_, aligned_s_}) < settled_s) {
      filter_.begin_jumps();
      if (time_s_ - clipped_s_ < settled_s) heading_.clear();
    }
    if (airborne_ && time_s_ - judged_s_ > 0.1) {
      judged_s_ = time_s_;
      found(filter_.find_fault(fault_ratio, !health_.rates.noisy() && !health_.forces.noisy()), p);
    }
    if (time_s_ - tuned_s_ > 1) {
      tuned_s_ = time_s_;
      tune(p);
    }
    return true;
  }

  void bridge(const Quaterniond& turn_b);

  void gnss(const Gnss& g, double valid_s, const Params& p);
  void mag(const Vector3d& field_b, const Params& p);
  void baro(double pressure_pa, const Params& p);
  void pitot(double pressure_pa, const Params& p);

 private:
  static constexpr double fault_ratio = 60;  ///< twice the logarithm of a likelihood: 7.7 standard deviations
  static constexpr double settled_s = 25;    ///< after a take-off the wind is found
  static constexpr double climb_ratio = 2;   ///< vertical over horizontal error of a velocity
  static constexpr double unplaced_m = 1e3;  ///< standard deviation of an unknown position
  static constexpr double late_s = 0.1;      ///< by which an airspeed may be late

  /// The accuracy that a receiver reports, or a default where it reports none.
  static double known(double reported, double otherwise, double floor) {
    return std::max(reported > 0 && reported < 1e6 ? reported : otherwise, floor);
  }

  /// A saturated sample has no noise of its own, and the part that was cut off is still missing afterwards.
  void learn_noise(const Vector3d& omega_b, const Vector3d& f_b, double dt, const Params& p) {
    constexpr double clipped_for_s = 10;
    if (health_.rates.was_clipped() || health_.forces.was_clipped()) clipped_s_ = time_s_;
    const bool reported = time_s_ - clipped_s_ < clipped_for_s;
    if (!reported) {
      gyro_noise_.sampled(omega_b, dt);
      accel_noise_.sampled(f_b, dt);
    }
    filter_.unit.gyro = reported ? p.gyro_noise.value : gyro_noise_.density(p.gyro_noise);
    filter_.unit.accel = reported ? p.accel_noise.value : accel_noise_.density(p.accel_noise);
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

  void begin(const Nominal& n, const Params& p, double time_s, double tilt_std, double yaw_std) {
    Eigen::Matrix<double, 15, 1> std;
    std << tilt_std, tilt_std, yaw_std, Vector3d::Ones(), unplaced_m * Vector3d::Ones(),
        p.gyro_bias_std * Vector3d::Ones(), p.accel_bias_std * Vector3d::Ones();
    time_s_ = time_s;
    filter_.reset(n, std, time_s);
    mode_ = Mode::running;
    aligned_s_ = time_s;
    seen_.yaw = yaw_std < 0.5;
  }

  void lose();
  void try_again();
  void begin_again(const Quaterniond& q_nb, const Vector3d& v_n, const Params& p, double tilt_std,
                   double yaw_std);

  void align_at_rest(const Params& p);

  void align_in_flight(const Gnss& g, double time_s, const Params& p);

  void rest() {
    rest_fused_s_ = time_s_;
    for (int i = 0; i < 3; ++i) filter_.fuse(zero_velocity(filter_, i), 0.05 * 0.05, 1e3, all_);
    for (int i = 0; i < 3; ++i)
      filter_.fuse(zero_rate(filter_, i, still_.omega()(i)), 2e-3 * 2e-3, 1e3, all_);
  }

  void update_airborne(const Params& p) {
    const double limit = airborne_ ? 0.7 * p.min_airspeed : p.min_airspeed;
    const double Va = filter_.state().through_air_n().norm();
    const bool fast = Va > limit || (time_s_ - pitot_s_ < 1 && pitot_mps_ > limit &&
                                     filter_.state().v_n().norm() > 0.5 * limit);
    const bool before = airborne_;
    airborne_ = fast && !resting_ && !(status_ && !status_->armed && status_->on_ground);
    if (airborne_ != before) airborne_since_s_ = time_s_;
  }

  /// The sensor of a fault is named for as long as its error exceeds what its model expects.
  void found(const Fault& fault, const Params& p) {
    if (fault.first < 0) return;
    if (fault.first == theta + 2) filter_.inflate(mount, 1, 2 * fault.size);
    for (const auto& [first, count, aid] : {std::tuple{+fix_pos, 2, &health_.horizontal},
                                            {fix_pos + 2, 1, &health_.height},
                                            {+fix_vel, 3, &health_.velocity},
                                            {+baro_bias, 1, &health_.baro},
                                            {+tube_bias, 1, &health_.pitot},
                                            {+gyro_bias, 3, &health_.gyro},
                                            {+accel_bias, 3, &health_.accel},
                                            {theta + 2, 1, &health_.heading}})
      if (fault.first >= first && fault.first < first + count) aid->fault(time_s_, fault.ramp);
    tune(p);
  }

  void sideslip(const Params& p);
  void count_reset(const Nominal& before);
  void place(const Gnss& g, double time_s, const Params& p);
  void forget_level();
  void begin_in_flight(const Gnss& g, const FlightAlignment::Found& found, double time_s, const Params& p);
  void try_attitude(const Params& p);
  void regain(const Gnss& g, const FlightAlignment::Found& found, bool has_mag, double time_s,
              const Params& p);
  void collect_origin(const Gnss& g, const Params& p);
  void accuracy(const Gnss& g, const Params& p);
  Past at_fix(double valid_s, const Params& p) const;
  Vector3d acceleration_at(double time_s) const;
  void bound_delay(const Params& p);
  bool within(std::initializer_list<double> ratios, const Params& p, Aid& aid);
  void gnss_velocity(const Gnss& g, double valid_s, const Params& p);
  void gnss_position(const Gnss& g, double valid_s, const Params& p);
  void test_heading(const Vector3d& v_n, double std_mps, double valid_s, const Params& p);
  void yaw_from_course(const Vector3d& v_n);
  void yaw_from_field(const Vector3d& field_b);

  Filter filter_;
  Vector all_ = Vector::Ones(), by_air_ = Vector::Ones(),
         by_field_;  ///< gains: 0 where a measurement does not correct
  LocalFrame frame_;
  Stillness still_;
  FlightAlignment flight_;
  HeadingTest heading_;
  Health health_;
  Vector3d fix_std_ = Vector3d::Ones();  ///< horizontal, vertical, speed: as the receiver reports them
  Vector3d field_n_{2e-5, 0, 4e-5}, mag_b_ = Vector3d::Zero();
  double strength_ = 0;  ///< of the field as the magnetometer measures it, in its unit
  Vector3d origin_sum_ = Vector3d::Zero();
  Air air_;
  UnitNoise gyro_noise_, accel_noise_;
  double motion_level_ = 0, fix_s_ = never;
  double clipped_s_ = never, tuned_s_ = never, judged_s_ = never, airborne_since_s_ = never;
  double year_ = 2026.0, altitude_m_ = 0;  ///< of the origin; without one: by pressure
  double time_s_ = 0, aligned_s_ = 0, rest_since_s_ = never, rest_fused_s_ = never, sideslip_s_ = never;
  double gnss_s_ = never, gnss_speed_ = 0, mag_s_ = never, mag_fused_s_ = never, pitot_s_ = never,
         pitot_mps_ = 0, baro_s_ = never, baro_pa_ = 0;
  double late_mps_ = 0;  ///< change of the airspeed within `late_s`
  std::int64_t origin_count_ = 0;
  Mode mode_ = Mode::waiting;
  Resets resets_;
  Seen seen_;
  std::optional<VehicleStatus> status_;  ///< the last one of the vehicle
  bool located_ = false;                 ///< has had a position: the next that is set is a reset
  bool resting_ = false;                 ///< at rest by the inertial unit and another sensor
  bool airborne_ = false;                ///< in flight: alpha, beta and the pitot are valid
};

}  // namespace fulmar::second_filter
