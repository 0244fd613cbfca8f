// SPDX-License-Identifier: BSD-3-Clause
// The book that the navigator keeps of each sensor: what came, what became of
// it, and what that says of the sensor. Every shipped measurement has one, and
// so does one that an author adds (estimator.hpp). Innovations of a filter
// whose deviations are true have mean 0 and mean square 1 (Bar-Shalom, Li &
// Kirubarajan, Estimation with Applications to Tracking and Navigation (2001),
// section 5.4).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/ekf.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/pitot.hpp"

namespace fulmar::navigation {

inline constexpr double never = -1e9;

/// Whether samples come, and whether they change. Times are in seconds on one
/// clock.
class Arrivals {
 public:
  /// A sample, used or not: up to three of its numbers, the ones with noise in
  /// them.
  void sampled(const std::array<double, 3>& values, double time_s) {
    const double dt = time_s - sampled_s_;
    if (interval_s_ == 0 && sampled_s_ != never)
      interval_s_ = std::min(dt, longest_s);
    else if (interval_s_ > 0)  // a gap says nothing of the rate, a slower sensor does
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
  /// Samples in a row, up to the last, that read exactly as the one before:
  /// noise does not repeat itself.
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
  static constexpr double silent_intervals = 5, shortest_s = 0.2, longest_s = 1, stuck_s = 0.45;
  static constexpr std::int64_t stuck_samples = 4;
  static constexpr double early_time_s = 2,
                          early_most = 2.2;  ///< the third within a second

  double early_in(double now_s) const { return early_ * std::exp(-(now_s - early_s_) / early_time_s); }

  double sampled_s_ = never, interval_s_ = 0, changed_s_ = never;
  std::array<double, 3> values_{};
  std::int64_t repeated_ = 0;
  double early_ = 0, early_s_ = 0;
};

/// Three axes of the inertial unit, sample by sample. Nothing is expected of them, but
/// white noise that no flight makes is vibration, and an axis that stays
/// exactly where it is, the sooner at the largest that it has ever said, is at
/// its stop.
class Triad {
 public:
  void sampled(const Eigen::Vector3d& values, double noisy_std) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      repeated_[i] = values[i] == before_[i] && values[i] != 0 ? repeated_[i] + 1 : 0;
      most_[i] = std::max(most_[i], std::abs(values[i]));
      square += 0.5 * (values[i] - before_[i]) * (values[i] - before_[i]) / 3;
    }
    variance_ = begun_ ? variance_ + (square - variance_) / window : 0;
    const double limit = noisy_ ? calm_share * noisy_std : noisy_std;
    noisy_ = variance_ > limit * limit;
    before_ = values;
    begun_ = true;
  }
  bool clipped() const {
    for (int i = 0; i < 3; ++i)
      if (repeated_[i] >= (std::abs(before_[i]) < most_[i] ? held_samples : clipped_samples)) return true;
    return false;
  }
  bool noisy() const { return noisy_; }

 private:
  static constexpr double window = 25,
                          calm_share = 0.7;  ///< samples: half a second
  static constexpr int clipped_samples = 5, held_samples = 25;

  Eigen::Vector3d before_ = Eigen::Vector3d::Zero(), most_ = Eigen::Vector3d::Zero();
  Eigen::Vector3i repeated_ = Eigen::Vector3i::Zero();
  double variance_ = 0;
  bool begun_ = false, noisy_ = false;
};

/// Whether a receiver's position goes where its velocity says. The two come
/// from different measurements, so a position that is pulled away by something
/// the velocity does not know shows here long before it is as wrong as the
/// receiver may be. A jump is no wander: the gate sees it.
class Wander {
 public:
  /// A fix, north and east; `std_m`: what it claims of its position.
  void fix(const Eigen::Vector2d& p_n, const Eigen::Vector2d& v_n, double std_m, double time_s) {
    const double dt = time_s - time_s_;
    const Eigen::Vector2d step = p_n - p_n_ - 0.5 * dt * (v_n + v_n_);
    time_s_ = time_s, p_n_ = p_n, v_n_ = v_n;
    if (!(dt > 0 && dt < longest_s && step.norm() < jump * std_m)) {
      off_.setZero();
      wanders_ = false;
      return;
    }
    off_ = std::exp(-dt / memory_s) * off_ + step;
    // What this receiver's positions and velocities differ by all the time, of
    // which a fault teaches little.
    const double least = least_share * std_m, seen = std::min(off_.norm(), 2 * std::max(usual_, least));
    usual_ = std::sqrt(usual_ * usual_ + (seen * seen - usual_ * usual_) * std::min(dt / usual_s, 1.0));
    const double limit = std::max(limit_share * std_m, times * usual_);
    wanders_ = off_.norm() > (wanders_ ? 0.5 : 1) * limit;
  }
  bool wanders() const { return wanders_; }

 private:
  static constexpr double memory_s = 3, usual_s = 60, longest_s = 1.5, jump = 5, least_share = 0.2,
                          limit_share = 1.6, times = 4.5;

  Eigen::Vector2d p_n_ = Eigen::Vector2d::Zero(), v_n_ = Eigen::Vector2d::Zero(),
                  off_ = Eigen::Vector2d::Zero();
  double time_s_ = never, usual_ = 0;
  bool wanders_ = false;
};

/// Whether the tube's airspeed steps: within a few samples no gust changes by a metre per second, but a tube
/// that is plugged, kicked or zeroed does. The sum of all steps tells whether it has stepped back. And
/// whether it is off for a second by more than gusts are.
class TubeSteps {
 public:
  /// The tube's true airspeed, and the one without it; `noise`: of a sample of their difference, `std`: of
  /// the difference with gusts. m/s.
  void sampled(double tube, double otherwise, double noise, double std, double time_s) {
    const double dt = std::clamp(time_s - time_s_, 0.0, 1.0);
    time_s_ = time_s;
    if (dt > longest_s) count_ = 0;
    std::rotate(past_.begin(), past_.end() - 1, past_.end());
    past_[0] = {tube, tube - otherwise};
    count_ = std::min(count_ + 1, past_.size());
    mean_ += (past_[0].excess - mean_) * (1 - std::exp(-dt / mean_s));
    off_ = std::abs(mean_) > (off_ ? back_std : off_std) * std;
    if (time_s - stepped_s_ > forgotten_s) sum_ = 0;
    const double limit = std::max(least_mps, noise_times * noise);
    if (count_ == past_.size()) step(limit, std);
  }
  bool stepped() const { return sum_ != 0; }
  bool off() const { return off_; }

 private:
  struct Said {
    double tube = 0, excess = 0;
  };
  static constexpr double least_mps = 1.2, noise_times = 8, forgotten_s = 30, longest_s = 0.15;
  static constexpr double mean_s = 1, off_std = 5, back_std = 2.5;

  /// The last three samples, each, from the mean of the three before the one in between. Both must have
  /// stepped: the airspeed without the tube steps when the receiver is believed after all.
  void step(double limit, double std) {
    double step = 0;
    for (const auto which : {&Said::tube, &Said::excess}) {
      const double before = (past_[4].*which + past_[5].*which + past_[6].*which) / 3;
      const double a = past_[0].*which - before, b = past_[1].*which - before, c = past_[2].*which - before;
      if (std::min({std::abs(a), std::abs(b), std::abs(c)}) < limit || a * b < 0 || a * c < 0) return;
      step = (a + b + c) / 3;
    }
    count_ = 0;
    sum_ += step;
    stepped_s_ = time_s_;
    // Back where it was; or crept off, and now it agrees.
    const bool agrees = off_ && std::abs(past_[0].excess) < back_std * std;
    if (agrees) mean_ = past_[0].excess;
    if (agrees || std::abs(sum_) < 0.5 * std::max(limit, std::abs(step))) sum_ = 0;
  }

  std::array<Said, 7> past_{};
  std::size_t count_ = 0;
  double time_s_ = never, stepped_s_ = never, sum_ = 0, mean_ = 0;
  bool off_ = false;
};

/// Whether a magnetometer still feels a field as strong as before, whatever its unit and its iron: a current
/// beside it changes the strength, in most directions.
class Strength {
 public:
  void sampled(double strength, double time_s) {
    const double dt = std::clamp(time_s - time_s_, 0.0, 1.0);
    time_s_ = time_s;
    if (usual_ == 0) now_ = usual_ = strength;
    now_ += (strength - now_) * (1 - std::exp(-dt / now_s));
    const double off = std::abs(now_ / usual_ - 1);
    changed_ = off > (changed_ ? back_share : changed_share);
    usual_ += (now_ - usual_) * (1 - std::exp(-dt / (changed_ ? adopted_s : usual_s)));
  }
  bool changed() const { return changed_; }

 private:
  static constexpr double now_s = 0.3, usual_s = 30, adopted_s = 120, changed_share = 0.15, back_share = 0.08;

  double time_s_ = never, now_ = 0, usual_ = 0;
  bool changed_ = false;
};

/// Mean and deviation of the last seconds' innovations, in deviations. Each
/// counts for the time since the one before, and for little more than a gate
/// lets through: one outlier is no noise. The deviation is that of successive
/// differences (von Neumann, Annals of Mathematical Statistics 12 (1941)): what
/// lasts is no noise.
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
  // Receivers are off by two of their deviations for minutes (README.md of
  // estimator_ekf): that is no fault.
  static constexpr double mean_s = 4, variance_s = 2, most = 6;
  static constexpr double noisy_std = 2, calm_std = 1.5, biased_mean = 3, centred_mean = 2;

  std::array<double, 3> mean_{}, before_{};
  double variance_ = 1, last_s_ = never;
  bool noisy_ = false, biased_ = false;
};

/// Of one sensor. Times are those of the inertial samples, in seconds.
struct Aid {
  double ratio = 0;               ///< last innovation, in deviations
  double accepted_s = never;      ///< when the gate let one through last
  double refused_from_s = never;  ///< since then it has refused all of them;
                                  ///< never: it took the last one
  double believed_s = never;      ///< when it was believed after all, last
  bool contradicts = false;       ///< itself or what cannot be: called biased,
                                  ///< whatever the innovations say
  std::uint32_t accepted = 0, refused = 0;
  Arrivals arrivals;
  Innovations innovations;

  void told(const ekf::Fused& fused, double time_s) { told(fused, time_s, {fused.ratio}); }
  /// `ratios`: of each axis, where they come in together.
  void told(const ekf::Fused& fused, double time_s, std::initializer_list<double> ratios) {
    ratio = fused.ratio;
    innovations.add(ratios, time_s);
    if (fused.accepted) {
      ++accepted;
      // Believed after all, or back: by how much it was off while nobody
      // listened says nothing of it now.
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
    if (innovations.noisy())
      return SensorState::noisy;  // which tells why, when the gate refuses it as
                                  // well
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

/// What came of each sensor, what its updates said, and the innovations of the
/// last fix in deviations.
struct Health {
  Aid gyro, accel, horizontal, height, velocity, baro, pitot, sideslip, heading;
  Eigen::Vector3d position_innovation = Eigen::Vector3d::Zero(),
                  velocity_innovation = Eigen::Vector3d::Zero();  ///< of a fix
  Triad rates, forces;
  Wander wander;
  TubeSteps tube;
  Strength field;
  std::uint32_t refused = 0;  ///< by all gates but that of the sideslip, which no sensor measures

  /// A sample came, whether it is used or not.
  void came(const Imu& s, double now_s) {
    const Vec3<Body>&w = s.rate_radps, &f = s.specific_force_mps2;
    gyro.arrivals.sampled({w.x, w.y, w.z}, now_s);
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
  void early(const Imu&, double now_s) { gyro.arrivals.early(now_s), accel.arrivals.early(now_s); }
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
      if (flying && triad.clipped()) h.state = std::max(h.state, SensorState::stuck);
      return h;
    };
    return {felt(gyro, rates), felt(accel, forces), of(horizontal), of(height),
            of(velocity),      of(heading),         of(baro),       of(pitot)};
  }

 private:
  static constexpr double vibration_radps = 0.3,
                          vibration_mps2 = 3;  ///< from one sample to the next
};

}  // namespace fulmar::navigation
