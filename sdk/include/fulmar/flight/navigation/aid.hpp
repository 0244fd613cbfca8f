// SPDX-License-Identifier: BSD-3-Clause
// Sensor monitor: for each sensor, the arrivals, the results of its updates, and the state that follows from
// them. Every shipped measurement has one, and so has one that an author adds (estimator.hpp). Innovations of
// a consistent filter have mean 0 and mean square 1 in standard deviations (Bar-Shalom, Li & Kirubarajan,
// Estimation with Applications to Tracking and Navigation (2001), section 5.4).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/navigation/ekf.hpp"
#include "fulmar/flight/navigation/witness.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/pitot.hpp"

namespace fulmar::navigation {

/// Whether samples come, and whether they change. Times are in seconds on one clock.
class Arrivals {
 public:
  /// A sample, used or not: up to three of its numbers, the ones with noise in them.
  void sampled(const std::array<double, 3>& values, double time_s) {
    const double dt = time_s - sampled_s_;
    if (interval_s_ == 0 && sampled_s_ != never)
      interval_s_ = std::min(dt, max_s);
    else if (interval_s_ > 0)  // a gap does not change the rate, a slower sensor does
      interval_s_ += 0.1 * (std::min(dt, 3 * interval_s_) - interval_s_);
    repeated_ = sampled_s_ != never && values == values_ ? repeated_ + 1 : 0;
    if (repeated_ == 0) changed_s_ = time_s;
    values_ = values;
    sampled_s_ = time_s;
  }
  bool any() const { return sampled_s_ != never; }
  bool silent(double now_s) const {
    return now_s - sampled_s_ > std::max(silent_intervals * interval_s_, shortest_s);
  }
  /// Samples in a row, up to the last, that read exactly as the one before: noise does not repeat itself.
  std::int64_t repeated() const { return repeated_; }
  bool stuck() const { return repeated_ >= stuck_samples && sampled_s_ - changed_s_ > stuck_s; }
  /// A sample whose stamp lies before that of the last one: it was left out.
  void early(double now_s) {
    early_ = early_in(now_s) + 1;
    early_s_ = now_s;
  }
  /// Stamps go back again and again: the clock or the link is in disorder.
  bool disordered(double now_s) const { return early_in(now_s) > early_most; }

 private:
  static constexpr double silent_intervals = 5, shortest_s = 0.2, max_s = 1, stuck_s = 0.45;
  static constexpr std::int64_t stuck_samples = 4;
  static constexpr double early_time_s = 2,
                          early_most = 2.2;  ///< the third in a row within 1.4 s

  double early_in(double now_s) const { return early_ * std::exp(-(now_s - early_s_) / early_time_s); }

  double sampled_s_ = never, interval_s_ = 0, changed_s_ = never;
  std::array<double, 3> values_{};
  std::int64_t repeated_ = 0;
  double early_ = 0, early_s_ = 0;
};

/// Mean and standard deviation of the innovations of the last seconds, in standard deviations. Each counts
/// for the time since the previous one, and for little more than a gate accepts: one outlier is no noise. The
/// standard deviation is that of successive differences (von Neumann, Annals of Mathematical Statistics 12
/// (1941)), without slow errors.
class Innovations {
 public:
  void add(std::initializer_list<double> ratios, double time_s) {
    const bool begins = last_s_ == never;
    const double dt = std::clamp(time_s - last_s_, 0.0, 0.5);
    const double of_mean = dt / (mean_s + dt), of_variance = dt / (variance_s + dt);
    last_s_ = time_s;
    double square = 0, off = 0;
    std::size_t i = 0;
    for (const double ratio : ratios) {
      const double r = std::isfinite(ratio) ? std::clamp(ratio, -most, most) : most;
      mean_[i] += of_mean * (r - mean_[i]);
      off = std::max(off, std::abs(mean_[i]));
      square += 0.5 * (r - before_[i]) * (r - before_[i]);
      before_[i++] = r;
    }
    if (!begins) variance_ += of_variance * (square / static_cast<double>(i) - variance_);
    noisy_ = variance_ > (noisy_ ? calm_std * calm_std : noisy_std * noisy_std);
    biased_ = off > (biased_ ? centred_mean : biased_mean);
  }
  void centre() {
    mean_ = {};
    biased_ = false;
  }
  /// Of the axis that is farthest off.
  double mean() const {
    return *std::max_element(mean_.begin(), mean_.end(),
                             [](double a, double b) { return std::abs(a) < std::abs(b); });
  }
  double std() const { return std::sqrt(variance_); }
  bool noisy() const { return noisy_; }
  bool biased() const { return biased_; }

 private:
  // GNSS errors of two standard deviations last for minutes (README.md of estimator_ekf) and are no fault.
  static constexpr double mean_s = 4, variance_s = 2, most = 6;
  static constexpr double noisy_std = 2, calm_std = 1.5, biased_mean = 3, centred_mean = 2;

  std::array<double, 3> mean_{}, before_{};
  double variance_ = 1, last_s_ = never;
  bool noisy_ = false, biased_ = false;
};

/// Common part of successive innovations of a horizontal velocity: an error of the estimate, or of the
/// receiver over more than one fix. A covariance with white errors has neither, and they cannot be separated,
/// so it adds to the reported standard deviation. For a first-order process with mean square c and
/// correlation r of neighbours, the mean products are c r and c r^2: c is the square of the first over the
/// second.
class SharedError {
 public:
  void add(const Eigen::Vector2d& innovation_mps, double time_s) {
    const double dt = std::clamp(time_s - last_s_, 0.0, 1.0), of_mean = dt / (seen_s_ + dt);
    last_s_ = time_s;
    seen_s_ = std::min(seen_s_ + dt, window_s);
    for (std::size_t i = 0; i < 2; ++i)
      mean_[i] += of_mean * (0.5 * innovation_mps.dot(before_[i]) - mean_[i]);
    before_[1] = before_[0];
    before_[0] = innovation_mps;
  }
  /// m/s, of one axis.
  double std_mps() const {
    if (mean_[0] <= 0) return 0;
    return std::sqrt(mean_[0] * std::clamp(mean_[0] / std::max(mean_[1], 1e-9), 1.0, most));
  }

 private:
  static constexpr double window_s = 30, min_s = 2, most = 1.5;

  std::array<Eigen::Vector2d, 2> before_{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<double, 2> mean_{};  ///< m2/s2: with the one before, and with the one before that
  double last_s_ = never, seen_s_ = min_s;
};

/// Of one sensor. Times are those of the inertial samples, in seconds.
struct Aid {
  double ratio = 0;               ///< last innovation, in standard deviations
  double accepted_s = never;      ///< time of the last accepted measurement
  double refused_from_s = never;  ///< since then all were rejected; never: the last one was accepted
  double believed_s = never;      ///< when a rejected sensor was last accepted after a time-out
  bool contradicts = false;       ///< it contradicts itself or physics: biased, whatever the innovations are
  std::uint32_t accepted = 0, refused = 0;
  Arrivals arrivals;
  Innovations innovations;

  void record(const ekf::Fused& fused, double time_s) { record(fused, time_s, {fused.ratio}); }
  /// `ratios`: of each axis, where they come in together.
  void record(const ekf::Fused& fused, double time_s, std::initializer_list<double> ratios) {
    ratio = fused.ratio;
    innovations.add(ratios, time_s);
    if (fused.accepted) {
      ++accepted;
      // Accepted again: innovations of the rejected time say nothing about the present.
      if (refused_from_s != never && time_s - refused_from_s > refused_s) innovations.centre();
      accepted_s = time_s;
      refused_from_s = never;
    } else {
      ++refused;
      if (refused_from_s == never) refused_from_s = time_s;
    }
  }

  SensorState state(double now_s, bool flying) const {
    if (!arrivals.any()) return SensorState::never;
    if (arrivals.silent(now_s)) return SensorState::silent;
    if (flying && arrivals.stuck()) return SensorState::stuck;
    if (innovations.noisy()) return SensorState::noisy;  // noise is then also the reason of a rejection
    if (refused_from_s != never && now_s - refused_from_s > refused_s) return SensorState::refused;
    if (arrivals.disordered(now_s)) return SensorState::refused;
    return contradicts || innovations.biased() ? SensorState::biased : SensorState::ok;
  }
  SensorHealth health(double now_s, bool flying) const {
    return {state(now_s, flying), accepted, refused, ratio, innovations.mean(), innovations.std()};
  }

 private:
  static constexpr double refused_s = 1;
};

/// Solved, and with finite numbers.
inline bool good(const Gnss& g) {
  const bool solved = g.fix == FixType::fix_3d || g.fix == FixType::combined || g.fix == FixType::rtk_float ||
                      g.fix == FixType::rtk_fixed;
  return solved && std::abs(g.latitude_deg) <= 90 && std::abs(g.longitude_deg) <= 360 &&
         std::isfinite(g.altitude_m) && eigen(g.velocity_mps).allFinite();
}

/// Of the inertial unit, from one sample to the next: beyond, it is shaken.
inline constexpr double vibration_radps = 0.3, vibration_mps2 = 3;

/// All sensor monitors, and the innovations of the last fix in standard deviations.
struct Health {
  Aid gyro, accel, horizontal, height, velocity, baro, pitot, sideslip, heading;
  Eigen::Vector3d position_innovation = Eigen::Vector3d::Zero(),
                  velocity_innovation = Eigen::Vector3d::Zero();  ///< of a fix
  SharedError level;                                              ///< of the horizontal velocity
  Triad rates, forces;
  Wander wander;
  BaroStep baro_step;
  TubeSteps tube;
  Strength field;
  double mag_turn_rad = 0;    ///< NavigationHealth::mag_turn_rad
  std::uint32_t refused = 0;  ///< by all gates but that of the sideslip, which no sensor measures

  /// A sample came, whether it is used or not.
  void came(const Imu& s, double now_s) {
    gyro.arrivals.sampled({s.rate_radps.x, s.rate_radps.y, s.rate_radps.z}, now_s);
    const Vec3<Body>& f = s.specific_force_mps2;
    accel.arrivals.sampled({f.x, f.y, f.z}, now_s);
  }
  void felt(const Eigen::Vector3d& omega_b, const Eigen::Vector3d& f_b) {
    rates.sampled(omega_b, vibration_radps);
    forces.sampled(f_b, vibration_mps2);
  }
  void came(const Mag& s, double now_s) {
    heading.arrivals.sampled({s.field_tesla.x, s.field_tesla.y, s.field_tesla.z}, now_s);
  }
  void came(const Baro& s, double now_s) { baro.arrivals.sampled({s.pressure_pa}, now_s); }
  void came(const Pitot& s, double now_s) { pitot.arrivals.sampled({s.pressure_pa}, now_s); }
  void came(const Gnss& s, double now_s) {
    if (!good(s)) return;
    horizontal.arrivals.sampled({s.latitude_deg, s.longitude_deg}, now_s);
    height.arrivals.sampled({s.altitude_m}, now_s);
    velocity.arrivals.sampled({s.velocity_mps.north, s.velocity_mps.east}, now_s);
  }

  /// A sample was left out, as its stamp lies before that of the last one.
  void early(const Imu&, double now_s) {
    gyro.arrivals.early(now_s);
    accel.arrivals.early(now_s);
  }
  void early(const Mag&, double now_s) { heading.arrivals.early(now_s); }
  void early(const Baro&, double now_s) { baro.arrivals.early(now_s); }
  void early(const Pitot&, double now_s) { pitot.arrivals.early(now_s); }
  void early(const Gnss&, double now_s) {
    for (Aid* aid : {&horizontal, &height, &velocity}) aid->arrivals.early(now_s);
  }

  NavigationHealth message(double now_s, bool flying) const {
    const auto of = [&](const Aid& aid) { return aid.health(now_s, flying); };
    const auto felt = [&](const Aid& aid, const Triad& triad) {
      SensorHealth h = of(aid);
      if (triad.noisy()) h.state = std::max(h.state, SensorState::noisy);
      if (flying && triad.was_clipped()) h.state = std::max(h.state, SensorState::stuck);
      return h;
    };
    return {felt(gyro, rates), felt(accel, forces), of(horizontal), of(height), of(velocity), of(heading),
            of(baro),          of(pitot),           mag_turn_rad};
  }
};

}  // namespace fulmar::navigation
