// SPDX-License-Identifier: BSD-3-Clause
// Sensor monitor: for each sensor, the arrivals, the results of its updates, its noise level, and the state
// that follows from them. Every shipped measurement has one, and so has one that an author adds. Innovations
// of a consistent filter have mean 0 and mean square 1 in standard deviations (Bar-Shalom, Li & Kirubarajan,
// Estimation with Applications to Tracking and Navigation (2001), section 5.4).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "bench/second_filter/states.hpp"
#include "fulmar/eigen.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/pitot.hpp"

namespace fulmar::second_filter {

inline constexpr double never = -1e9;

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

/// Factors on the variances of a sensor's white noise and of its slow error, from the innovations in standard
/// deviations: mean square 1 and no correlation of neighbours (covariance matching: Mehra, IEEE TAC 15(2)
/// (1970)). A correlation shows a slow error that is larger than its model. An outlier counts for little.
class Level {
 public:
  /// Of axis `i`, 0 to 2.
  void add(std::size_t i, double ratio, double dt_s) {
    const double r = std::clamp(ratio, -most, most), step = std::min(dt_s, 1.0) / time_s;
    const double size = r * r - mean, lasting = r * before_[i];
    white_ = std::clamp(white_ + step * (size - lasting), least, largest);
    slow_ = std::clamp(slow_ + step * (size + lasting), 3 * least, largest);
    before_[i] = r;
  }
  /// A variance that is `share` of that of the innovation: the gradient of the likelihood.
  static double learnt(double log_level, double ratio, double share, double dt_s) {
    const double r = std::clamp(ratio, -most, most);
    return std::clamp(log_level + std::min(dt_s, 1.0) / time_s * share * (r * r - mean), least, 2 * largest);
  }
  double white() const { return std::exp(white_); }  ///< of the variance
  double slow() const { return std::exp(slow_); }

 private:
  static constexpr double time_s = 20, most = 2.5, least = -1.4,
                          largest = 2.8;  // 0.5 to 4 of the standard deviation
  static constexpr double mean = 0.977;   ///< of the bounded square of a normal variate

  double white_ = 0, slow_ = 0;
  std::array<double, 3> before_{};
};

/// Three axes of the inertial unit, sample by sample. White noise beyond that of flight is vibration. An axis
/// that repeats its value exactly is saturated, sooner at the largest value so far.
class Triad {
 public:
  void sampled(const Eigen::Vector3d& values, double noisy_std) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const bool same = values[i] == before_[i];
      changed_[i] = same ? 0 : std::min(changed_[i] + 1, lively_samples);
      lively_[i] = std::max(lively_[i], changed_[i]);
      // An axis without noise may repeat its value: only after varying values a repetition counts.
      repeated_[i] = same && values[i] != 0 && lively_[i] == lively_samples ? repeated_[i] + 1 : 0;
      most_[i] = std::max(most_[i], std::abs(values[i]));
      square += 0.5 * (values[i] - before_[i]) * (values[i] - before_[i]) / 3;
    }
    variance_ = begun_ ? variance_ + (square - variance_) / window : 0;
    const double limit = noisy_ ? calm_share * noisy_std : noisy_std;
    noisy_ = variance_ > limit * limit;
    before_ = values;
    begun_ = true;
    clipped_ = false;
    for (int i = 0; i < 3; ++i)
      clipped_ =
          clipped_ || repeated_[i] >= (std::abs(before_[i]) < most_[i] ? held_samples : clipped_samples);
    since_clipped_ = clipped_ ? 0 : std::min(since_clipped_ + 1, reported_samples);
  }
  bool clipped() const { return clipped_; }
  /// Kept long enough for a periodic reader.
  bool was_clipped() const { return since_clipped_ < reported_samples; }
  bool noisy() const { return noisy_; }

 private:
  static constexpr double window = 100, calm_share = 0.7;  ///< samples
  static constexpr int clipped_samples = 5, held_samples = 25, reported_samples = 100, lively_samples = 25;

  Eigen::Vector3d before_ = Eigen::Vector3d::Zero(), most_ = Eigen::Vector3d::Zero();
  Eigen::Vector3i repeated_ = Eigen::Vector3i::Zero(), changed_ = Eigen::Vector3i::Zero(),
                  lively_ = Eigen::Vector3i::Zero();  ///< samples in a row; the most that changed
  double variance_ = 0;
  int since_clipped_ = reported_samples;
  bool begun_ = false, noisy_ = false, clipped_ = false;
};

/// White noise of three axes of an inertial unit, as a spectral density, from third differences: for white
/// noise of standard deviation s their mean square is (1 + 9 + 9 + 1) s^2, while a motion of w rad/s adds (w
/// dt)^3 of itself: 0.002 at 100 Hz and 2 Hz. Below 80 Hz the motion dominates, and nothing is learnt.
class UnitNoise {
 public:
  void sampled(const Eigen::Vector3d& values, double dt) {
    if (!(dt < max_s)) count_ = 0;
    const Eigen::Vector3d third = values - past_[2] - 3 * (past_[0] - past_[1]);
    past_ = {values, past_[0], past_[1]};
    if (count_ < 3) {
      ++count_;
      return;
    }
    seen_s_ = std::min(seen_s_ + dt, window_s);
    const double variance = third.squaredNorm() / (3 * 20);
    mean_ += dt / seen_s_ * (variance * dt - mean_);
  }
  /// In unit/sqrt(Hz); `reported`: the value before learning. Bounded both ways, so that other errors of a
  /// quiet unit count, and other sensors beside a shaken one.
  double density(double reported) const {
    if (seen_s_ < min_s) return reported;
    return std::min(std::sqrt(mean_ + min_share * reported * min_share * reported), max_share * reported);
  }

 private:
  static constexpr double max_s = 0.05, window_s = 1.5, min_s = 0.5, min_share = 0.2, max_share = 20;

  std::array<Eigen::Vector3d, 3> past_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero()};  ///< the last one first
  double mean_ = 0, seen_s_ = 0;
  int count_ = 0;
};

/// Of one sensor. Times are those of the inertial samples, in seconds.
struct Aid {
  double ratio = 0;               ///< last innovation, in standard deviations
  double accepted_s = never;      ///< time of the last accepted measurement
  double refused_from_s = never;  ///< since then all were rejected; never: the last one was accepted
  double faulty_s = never;        ///< when a fault was found
  std::uint32_t accepted = 0, refused = 0;
  Arrivals arrivals;
  Innovations innovations;
  Level level;

  void record(const Fused& fused, double time_s, bool learns) {
    record(fused, time_s, {fused.ratio}, learns);
  }
  /// `ratios`: of each axis, where they come in together.
  void record(const Fused& fused, double time_s, std::initializer_list<double> ratios, bool learns) {
    ratio = fused.ratio;
    innovations.add(ratios, time_s);
    std::size_t i = 0;
    if (learns)
      for (const double one : ratios)
        level.add(i++, one, (time_s - recorded_s_) / static_cast<double>(ratios.size()));
    recorded_s_ = time_s;
    if (fused.accepted) {
      ++accepted;
      // Accepted again: innovations of the rejected time are no measure of the present.
      if (refused_from_s != never && time_s - refused_from_s > refused_s) innovations.centre();
      accepted_s = time_s;
      refused_from_s = never;
    } else {
      ++refused;
      if (refused_from_s == never) refused_from_s = time_s;
    }
  }
  /// A fault was found a short time ago: its error is being learnt.
  bool faulty(double now_s) const { return now_s - faulty_s < faulty_for_s; }
  void fault(double now_s, bool ramp) {
    faulty_s = now_s;
    changing_s_ = ramp ? drifts_for_s : settles_s;
  }
  /// 1 at a fault, fading to 0.
  double changing(double now_s) const { return std::exp(-(now_s - faulty_s) / changing_s_); }
  bool stuck(bool flying) const { return flying && arrivals.stuck(); }
  /// Rejected for so long that the estimate may be the one that is wrong.
  bool insists(double now_s) const { return refused_from_s != never && now_s - refused_from_s > insists_s; }

  SensorState state(double now_s, bool flying) const {
    if (!arrivals.any()) return SensorState::never;
    if (arrivals.silent(now_s)) return SensorState::silent;
    if (flying && arrivals.stuck()) return SensorState::stuck;
    if (innovations.noisy()) return SensorState::noisy;  // noise is then also the reason of a rejection
    if (refused_from_s != never && now_s - refused_from_s > refused_s) return SensorState::refused;
    if (arrivals.disordered(now_s)) return SensorState::refused;
    return faulty(now_s) || innovations.biased() ? SensorState::biased : SensorState::ok;
  }
  SensorHealth health(double now_s, bool flying) const {
    return {state(now_s, flying), accepted, refused, ratio, innovations.mean(), innovations.std()};
  }

 private:
  static constexpr double refused_s = 1, faulty_for_s = 30, settles_s = 5, drifts_for_s = 30, insists_s = 4;
  double changing_s_ = settles_s;
  double recorded_s_ = never;
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

/// All sensor monitors.
struct Health {
  Aid gyro, accel, horizontal, height, velocity, baro, pitot, sideslip, heading, model;
  Vector3d position_innovation = Vector3d::Zero(),
           velocity_innovation = Vector3d::Zero();  ///< ratios of a fix
  Triad rates, forces;
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
    return {felt(gyro, rates), felt(accel, forces), of(horizontal), of(height),
            of(velocity),      of(heading),         of(baro),       of(pitot)};
  }
};

}  // namespace fulmar::second_filter
