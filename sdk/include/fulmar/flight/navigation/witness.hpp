// SPDX-License-Identifier: BSD-3-Clause
// Fault detectors beside the innovations of the filter: from the sensor alone, and from limits of aircraft
// and air. In hourglasses without fault (both sets of sensors, light and moderate turbulence, eight seeds
// each) all values stay below 0.85 of their thresholds.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace fulmar::navigation {

inline constexpr double never = -1e9;

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

/// Whether a receiver's position follows its velocity. The two come from different measurements, so a
/// position that is pulled away shows here long before it exceeds the error of the receiver. A jump is left
/// to the gate.
class Wander {
 public:
  /// A fix, north and east; `std_m`: the reported standard deviation of its position.
  void fix(const Eigen::Vector2d& p_n, const Eigen::Vector2d& v_n, double std_m, double time_s) {
    const double dt = time_s - time_s_;
    const bool known = !std::exchange(missed_, false);
    const Eigen::Vector2d step = known ? p_n - p_n_ - 0.5 * dt * (v_n + v_n_) : Eigen::Vector2d(0, 0);
    time_s_ = time_s;
    p_n_ = p_n;
    v_n_ = v_n;
    if (!(dt > 0 && dt < max_s && step.norm() < jump * std_m)) {
      off_.setZero();
      wanders_ = false;
      return;
    }
    off_ = std::exp(-dt / memory_s) * off_ + step;
    // Usual difference between positions and velocities of this receiver; a fault changes it little.
    const double least = min_share * std_m, seen = std::min(off_.norm(), 2 * std::max(usual_, least));
    usual_ = std::sqrt(usual_ * usual_ + (seen * seen - usual_ * usual_) * std::min(dt / usual_s, 1.0));
    const double limit = std::max(limit_share * std_m, times * usual_);
    if (!wanders_) since_s_ = time_s;
    wanders_ = off_.norm() > (wanders_ ? 0.5 : 1) * limit;
  }
  /// One that does not count: of the way to the next one that does nothing is known.
  void missed() { missed_ = true; }
  bool wanders() const { return wanders_; }
  /// For so long the velocity is taken to be right; then it may be the one that is wrong.
  bool doubted() const { return wanders_ && time_s_ - since_s_ < doubted_s; }

 private:
  static constexpr double memory_s = 3, usual_s = 60, max_s = 1.5, jump = 5, min_share = 0.2,
                          limit_share = 1.6, times = 4.5, doubted_s = 30;

  Eigen::Vector2d p_n_ = Eigen::Vector2d::Zero(), v_n_ = Eigen::Vector2d::Zero(),
                  off_ = Eigen::Vector2d::Zero();
  double time_s_ = never, since_s_ = never, usual_ = 0;
  bool wanders_ = false, missed_ = false;
};

/// Whether a barometer has stepped: from one sample to the next, and stays there. No aircraft does that, so
/// all of it is the sensor's.
class BaroStep {
 public:
  /// Innovation of a sample, m, its standard deviation, and whether the gate accepted it. Returns the step,
  /// m, once it has lasted.
  std::optional<double> sampled(double innovation_m, double std_m, bool accepted, double time_s) {
    const bool at_once =
        took_ && time_s - time_s_ < max_s && std::abs(innovation_m - before_m_) > most * std_m;
    took_ = accepted;
    time_s_ = time_s;
    before_m_ = innovation_m;
    if (at_once) {
      since_s_ = time_s;
      count_ = 0;
    }
    if (accepted) since_s_ = never;
    if (!may_be()) return std::nullopt;
    mean_m_ += (innovation_m - mean_m_) / ++count_;
    if (std::abs(innovation_m - mean_m_) > most * std_m) since_s_ = never;  // it goes on
    if (!may_be() || time_s - since_s_ < lasts_s) return std::nullopt;
    since_s_ = never;
    return mean_m_;
  }
  bool may_be() const { return since_s_ != never; }

 private:
  static constexpr double max_s = 0.2, lasts_s = 2, most = 5;

  bool took_ = false;
  double time_s_ = never, since_s_ = never, before_m_ = 0, mean_m_ = 0;
  int count_ = 0;
};

/// Whether the pitot's airspeed steps: within a few samples gusts change by less than a metre per second; a
/// plugged, bent or zeroed pitot changes by more. The sum of all steps shows a step back. Also whether it is
/// off for a second by more than gusts are, or became so within one.
class TubeSteps {
 public:
  /// True airspeed of the pitot, and the one without it; `noise`: of a sample of their difference, `std`: of
  /// the difference with gusts. m/s.
  void sampled(double tube, double otherwise, double noise, double std, double time_s) {
    const double dt = std::clamp(time_s - time_s_, 0.0, 1.0);
    time_s_ = time_s;
    if (dt > max_s) count_ = 0;
    std::rotate(past_.begin(), past_.end() - 1, past_.end());
    past_[0] = {tube, tube - otherwise, time_s};
    count_ = std::min(count_ + 1, past_.size());
    mean_ += (past_[0].excess - mean_) * (1 - std::exp(-dt / mean_s));
    if (time_s - seconds_s_ >= 0.1) {
      std::rotate(second_.begin(), second_.end() - 1, second_.end());
      second_[0] = mean_;
      seconds_ = dt > max_s ? 0 : std::min(seconds_ + 1, second_.size());
      seconds_s_ = time_s;
    }
    // Within a second a first-order Gauss-Markov gust changes by a share of its standard deviation.
    const double gust = std::max(std, strong_mps), change_1 = gust * std::sqrt(2 / gust_time_s);
    const bool falls = seconds_ == second_.size() && std::abs(mean_) > std::abs(second_.back()) &&
                       std::abs(mean_ - second_.back()) > change_times * change_1;
    agrees_s_ = std::abs(mean_) < agreed(std) ? agrees_s_ + dt : 0;
    off_ = falls || std::abs(mean_) > off_std * gust || (off_ && agrees_s_ < agreed_s);
    if (time_s - stepped_s_ > forgotten_s && agrees_s_ >= agreed_s) sum_ = 0;
    if (count_ < past_.size()) return;
    // By how much a first-order Gauss-Markov gust changes from the one group of samples to the other.
    const double change = std * std::sqrt(2 * (past_[1].time_s - past_[5].time_s) / gust_time_s);
    step(std::max({min_mps, noise_times * noise, change_times * change}), std);
  }
  bool stepped() const { return sum_ != 0; }
  bool off() const { return off_; }

 private:
  struct Said {
    double tube = 0, excess = 0, time_s = 0;
  };
  static constexpr double min_mps = 1.2, noise_times = 8, change_times = 6, gust_time_s = 10,
                          forgotten_s = 30, max_s = 0.15;
  static constexpr double mean_s = 0.6, off_std = 5, back_std = 2.5, strong_mps = 2;
  static constexpr double bearable_mps = 3.5;  ///< an aircraft at its least airspeed does not stall by it
  static constexpr double agreed_s = 6;  ///< the wind estimated without the pitot may drift past agreement

  static double agreed(double std) { return std::min(back_std * std, bearable_mps); }

  /// The last three samples, each relative to the median of the three before the one in between: one odd
  /// sample is no step. Both must have stepped: the airspeed without the pitot steps when a rejected receiver
  /// is accepted.
  void step(double limit, double std) {
    double step = 0;
    for (const auto which : {&Said::tube, &Said::excess}) {
      const auto [low, high] = std::minmax(past_[4].*which, past_[5].*which);
      const double before = std::clamp(past_[6].*which, low, high);
      const double a = past_[0].*which - before, b = past_[1].*which - before, c = past_[2].*which - before;
      if (std::min({std::abs(a), std::abs(b), std::abs(c)}) < limit || a * b < 0 || a * c < 0) return;
      step = (a + b + c) / 3;
    }
    count_ = 0;
    sum_ += step;
    stepped_s_ = time_s_;
    // Back where it was; or crept off, and now it steps to where it agrees: no drift of the wind does that.
    const bool agrees = off_ && std::abs(past_[0].excess) < agreed(std);
    if (agrees) {
      mean_ = past_[0].excess;
      agrees_s_ = agreed_s;
    }
    if (agrees || std::abs(sum_) < 0.5 * std::max(limit, std::abs(step))) sum_ = 0;
  }

  std::array<Said, 7> past_{};
  std::size_t count_ = 0;
  std::array<double, 11> second_{};  ///< the mean excess, every tenth of a second
  std::size_t seconds_ = 0;
  double seconds_s_ = never;
  double time_s_ = never, stepped_s_ = never, sum_ = 0, mean_ = 0, agrees_s_ = 0;
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

}  // namespace fulmar::navigation
