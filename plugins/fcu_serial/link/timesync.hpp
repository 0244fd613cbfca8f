// SPDX-License-Identifier: BSD-3-Clause
// The controller's clock in host time. A response was stamped after its request left and before it arrived.
// So offset = host - controller is in [asked - stamp, came - stamp]. The fastest messages of each direction
// give the tightest bounds. One line for each direction goes through the bounds of the last seconds, with a
// common slope, each bound weighted by its distance from the tightest. The offset is in the middle, as for
// equal delays in both directions; an asymmetry cannot be measured from one end. Sources: RFC 5905 (NTP),
// section 10, clock filter; Paxson, On Calibrating Measurements of Packet Transit Times (1998).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace fulmar::fcu {

class ClockSync {
 public:
  static constexpr std::int64_t window_ns = 10'000'000'000;
  static constexpr std::int64_t jump_ns = 10'000'000;         ///< a larger jump is another clock
  static constexpr std::int64_t patience_ns = 1'000'000'000;  ///< a later answer is ignored
  static constexpr double drift_limit = 500e-6;
  static constexpr std::int64_t max_ns = 300'000'000'000'000'000;  ///< stamps beyond ten years are invalid

  enum class Verdict : std::uint8_t { ignored, taken, jumped };

  /// Records the time of a request, which identifies it.
  void asked(std::int64_t now_ns) { questions_[question_count_++ % questions_.size()] = now_ns; }

  /// A TIMESYNC response. `jumped`: the clock has changed, and all samples before this one are dropped.
  Verdict answered(std::int64_t ts1, std::int64_t tc1, std::int64_t now_ns) {
    if (tc1 <= 0 || tc1 > max_ns || ts1 > now_ns || now_ns - ts1 > patience_ns || !was_asked(ts1))
      return Verdict::ignored;
    const Sample sample{now_ns, now_ns - ts1, ts1 + (now_ns - ts1) / 2 - tc1};
    const std::int64_t apart_ns = synchronised() ? beyond_bounds(sample) : 0;
    if (apart_ns > step_limit_ns) {
      if (!confirms(sample)) {  // a single stamp may be invalid; two that agree are a new clock
        suspect_ = sample;
        return Verdict::ignored;
      }
      restart_line();
    }
    suspect_.reset();
    add(sample);
    return apart_ns > jump_ns ? Verdict::jumped : Verdict::taken;
  }

  /// The controller has rebooted: drops all state.
  void restart() {
    restart_line();
    suspect_.reset();
    forget_questions();
  }
  /// Requests from before the loss of the device get no answer.
  void forget_questions() { question_count_ = 0; }

  bool synchronised() const { return count_ > 0; }
  std::int64_t round_trip_ns() const { return min_ns_; }
  double drift_ppm() const { return slope_ * 1e6; }
  /// Host time = controller's time + offset, for a recent event.
  std::int64_t offset_ns(std::int64_t now_ns) const {
    const double t = static_cast<double>(now_ns - line_at_ns_);
    const double fading =
        std::clamp(1 - static_cast<double>(now_ns - bent_at_ns_) / static_cast<double>(blend_ns), 0.0, 1.0);
    return line_ns_ + std::llround(slope_ * t + step_ns_ * fading);
  }

 private:
  static constexpr std::int64_t blend_ns =
      1'000'000'000;  // a new line takes over gradually: intervals between stamps stay smooth
  static constexpr double snap_ns = 2e6;  // a larger error is corrected at once
  static constexpr std::int64_t step_limit_ns =
      2'000'000;                                 // bounds that are further apart belong to two clocks
  static constexpr double resolution_ns = 20e3;  // of the best message: scheduling delay on an idle system
  // typical drift of two crystals; prior of the line while its base is short
  static constexpr double usual_drift = 100e-6;

  static constexpr std::size_t most = 128;  // length of the window at 10 Hz

  struct Sample {
    std::int64_t at_ns = 0, round_trip_ns = 0;
    std::int64_t offset_ns = 0;  ///< middle of its bounds
  };

  bool was_asked(std::int64_t ts1) {
    const std::size_t kept =
        static_cast<std::size_t>(std::min<std::uint64_t>(question_count_, questions_.size()));
    for (std::size_t i = 0; i < kept; ++i) {
      if (questions_[i] != ts1) continue;
      questions_[i] = -1;  // an answer counts only once
      return true;
    }
    return false;
  }

  /// Distance of this answer's bounds from those of the line, beyond the possible drift since the last one.
  std::int64_t beyond_bounds(const Sample& s) const {
    const std::int64_t distance =
        std::llabs(s.offset_ns - offset_ns(s.at_ns)) - s.round_trip_ns / 2 - min_ns_ / 2;
    return distance - std::llround(drift_limit * static_cast<double>(s.at_ns - newest().at_ns));
  }
  bool confirms(const Sample& s) const {
    return suspect_ && std::llabs(s.offset_ns - suspect_->offset_ns) <=
                           step_limit_ns + s.round_trip_ns / 2 + suspect_->round_trip_ns / 2;
  }

  void restart_line() {
    count_ = 0;
    slope_ = step_ns_ = 0;
    line_ns_ = line_at_ns_ = bent_at_ns_ = min_ns_ = 0;
  }

  const Sample& newest() const { return samples_[(count_ - 1) % samples_.size()]; }

  void add(const Sample& sample) {
    const bool first = count_ == 0;
    const std::int64_t before = first ? 0 : offset_ns(sample.at_ns);
    samples_[count_++ % samples_.size()] = sample;
    fit(sample.at_ns);
    step_ns_ = 0;
    const auto step = static_cast<double>(before - offset_ns(sample.at_ns));
    step_ns_ = first || std::abs(step) > snap_ns ? 0 : step;
    bent_at_ns_ = sample.at_ns;
  }

  /// One side of the bounds: a line of known slope through the tightest one, x in ns before now.
  struct Side {
    double sign = 1;  // +1: the tightest is the smallest (answers), -1: the largest (requests)
    double w = 0, t = 0, y = 0, tightest = 0, resolution = 0;
  };
  double bound(const Sample& s, double sign) const {
    return static_cast<double>(s.offset_ns - newest().offset_ns) +
           sign * 0.5 * static_cast<double>(s.round_trip_ns);
  }
  double age(const Sample& s) const { return static_cast<double>(s.at_ns - newest().at_ns); }
  double weight(const Sample& s, const Side& side) const {
    const double looseness =
        side.sign * (bound(s, side.sign) - slope_ * age(s)) - side.tightest + side.resolution;
    return 1 / (looseness * looseness);
  }
  template <class Take>
  void each(Take&& take) const {
    const std::uint64_t kept = std::min<std::uint64_t>(count_, samples_.size());
    for (std::uint64_t i = count_ - kept; i < count_; ++i) {
      if (const Sample& s = samples_[i % samples_.size()]; newest().at_ns - s.at_ns <= window_ns) take(s);
    }
  }

  /// The tightest bound, its confidence, and the weighted mean, for the present slope.
  Side look_at(double sign) const {
    Side side{sign};
    std::array<double, most> delays{};
    std::size_t n = 0;
    each([&](const Sample& s) { delays[n++] = sign * (bound(s, sign) - slope_ * age(s)); });
    const auto begin = delays.begin(), end = begin + static_cast<std::ptrdiff_t>(n),
               middle = begin + static_cast<std::ptrdiff_t>((n - 1) / 2);
    std::nth_element(begin, middle, end);
    side.tightest = *std::min_element(begin, middle + 1);
    side.resolution =
        resolution_ns + 1.4 * (*middle - side.tightest) /
                            static_cast<double>(n);  // expected excess of the smallest of n delays
    each([&](const Sample& s) {
      const double w = weight(s, side);
      side.w += w;
      side.t += w * age(s);
      side.y += w * bound(s, sign);
    });
    side.t /= side.w;
    side.y /= side.w;
    return side;
  }

  /// Least squares over both sides with a common slope and a prior on it. The weights depend on the slope, so
  /// there are two passes.
  void fit(std::int64_t now_ns) {
    min_ns_ = newest().round_trip_ns;
    each([&](const Sample& s) { min_ns_ = std::min(min_ns_, s.round_trip_ns); });
    std::array<Side, 2> sides;
    for (int pass = 0; pass < 3; ++pass) {
      sides = {look_at(-1), look_at(1)};
      if (pass == 2) break;
      double tt = 1 / (usual_drift * usual_drift), ty = 0;
      for (const Side& side : sides) {
        each([&](const Sample& s) {
          const double w = weight(s, side), t = age(s) - side.t;
          tt += w * t * t;
          ty += w * t * (bound(s, side.sign) - side.y);
        });
      }
      slope_ = std::clamp(ty / tt, -drift_limit, drift_limit);
    }
    line_at_ns_ = now_ns;
    line_ns_ = newest().offset_ns +
               std::llround(0.5 * (sides[0].y - slope_ * sides[0].t + sides[1].y - slope_ * sides[1].t));
  }

  std::array<Sample, most> samples_{};
  std::uint64_t count_ = 0;
  std::array<std::int64_t, 16> questions_{};
  std::uint64_t question_count_ = 0;
  std::optional<Sample> suspect_;
  std::int64_t line_ns_ = 0, line_at_ns_ = 0, bent_at_ns_ = 0, min_ns_ = 0;
  double slope_ = 0, step_ns_ = 0;
};

/// Converts stamps of packets, of several resolutions, to host time.
class Dater {
 public:
  ClockSync clock;

  /// A TIMESYNC response. `jumped`: the controller's clock was set back, as by a reboot. A forward jump is
  /// followed.
  ClockSync::Verdict answered(std::int64_t ts1, std::int64_t tc1, std::int64_t now_ns) {
    // An inertial sample was stamped before its arrival. An older clock was read too early: a paused
    // controller in simulation has not rebooted.
    if (imu_bound_.known(now_ns) && ts1 - tc1 > imu_bound_.ns() + ClockSync::jump_ns)
      return ClockSync::Verdict::ignored;
    const std::int64_t before_ns = clock.synchronised() ? clock.offset_ns(now_ns) : 0;
    const ClockSync::Verdict verdict = clock.answered(ts1, tc1, now_ns);
    if (verdict != ClockSync::Verdict::jumped) return verdict;
    forget_stamps();
    return clock.offset_ns(now_ns) > before_ns ? verdict : ClockSync::Verdict::taken;
  }

  /// Converts a stamp in us of the controller's clock. The result is not after the arrival and not 1 s before
  /// it: else the arrival is used and `undated` is set.
  std::int64_t date_us(std::uint64_t stamp_us, std::int64_t arrived_ns) {
    return date(stamp_us, 1000, 0, arrived_ns);
  }

  /// Converts a stamp cut to whole ms, perhaps to its lowest 32 bits, which wrap after 49.7 days. The result
  /// is the middle of that ms.
  std::int64_t date_ms32(std::uint32_t stamp_ms, std::int64_t arrived_ns) {
    if (!clock.synchronised()) return arrived_ns;
    const std::int64_t about_ms = (arrived_ns - clock.offset_ns(arrived_ns)) / 1'000'000;
    const auto ahead = static_cast<std::int32_t>(stamp_ms - static_cast<std::uint32_t>(about_ms));
    return date_ms(static_cast<std::uint64_t>(about_ms + ahead), arrived_ns);
  }
  std::int64_t date_ms(std::uint64_t stamp_ms, std::int64_t arrived_ns) {
    return date(stamp_ms, 1'000'000, 500'000, arrived_ns);
  }

  /// Converts the stamp of an inertial sample: strictly increasing, as arrivals must be.
  std::int64_t date_imu(std::uint64_t stamp_us, std::int64_t arrived_ns) {
    if (stamp_us < static_cast<std::uint64_t>(ClockSync::max_ns / 1000))
      imu_bound_.take(arrived_ns - static_cast<std::int64_t>(stamp_us) * 1000, arrived_ns);
    last_imu_ns_ = std::min(arrived_ns, std::max(date_us(stamp_us, arrived_ns), last_imu_ns_ + 1));
    return last_imu_ns_;
  }

  /// Checks each stamp of an inertial sample. Returns true when the controller's clock has restarted: two
  /// stamps in a row are before the newest.
  bool started_anew(std::uint64_t stamp_us) {
    const bool back = stamp_us + static_cast<std::uint64_t>(ClockSync::jump_ns) / 1000 < newest_us_;
    const bool twice = back && earlier_us_ && stamp_us >= *earlier_us_;
    if (!back || twice) {
      earlier_us_.reset();
      newest_us_ = twice ? stamp_us : std::max(stamp_us, newest_us_);
      if (twice) imu_bound_ = {};
    } else {
      earlier_us_ = stamp_us;
    }
    return twice;
  }

  /// For a reboot that was not detected by these stamps.
  void forget_stamps() {
    newest_us_ = 0;
    earlier_us_.reset();
  }

  std::uint64_t undated() const { return undated_; }

 private:
  static constexpr std::int64_t oldest_ns = 1'000'000'000, tolerance_ns = 2'000'000;

  /// Upper bound of host time - controller's time, from the samples of the last second.
  class Bound {
   public:
    void take(std::int64_t bound_ns, std::int64_t arrived_ns) {
      if (arrived_ns - begun_ns_ < part_ns) {
        now_ns_ = std::min(now_ns_, bound_ns);
      } else {
        before_ns_ = arrived_ns - begun_ns_ < 2 * part_ns ? now_ns_ : bound_ns;
        now_ns_ = bound_ns;
        begun_ns_ = arrived_ns;
      }
    }
    /// False after a time without samples: then only the responses are used.
    bool known(std::int64_t at_ns) const { return at_ns - begun_ns_ < patience_ns; }
    std::int64_t ns() const { return std::min(now_ns_, before_ns_); }

   private:
    static constexpr std::int64_t part_ns = 500'000'000, patience_ns = 5'000'000'000;
    std::int64_t begun_ns_ = -patience_ns, now_ns_ = 0, before_ns_ = 0;
  };

  std::int64_t date(std::uint64_t stamp, std::int64_t unit_ns, std::int64_t middle_ns,
                    std::int64_t arrived_ns) {
    if (!clock.synchronised()) return arrived_ns;
    const bool possible = stamp < static_cast<std::uint64_t>(ClockSync::max_ns / unit_ns);
    const std::int64_t at =
        possible ? static_cast<std::int64_t>(stamp) * unit_ns + middle_ns + clock.offset_ns(arrived_ns) : 0;
    if (!possible || at > arrived_ns + tolerance_ns || at < arrived_ns - oldest_ns) {
      ++undated_;
      return arrived_ns;
    }
    return std::min(at, arrived_ns);
  }

  Bound imu_bound_;
  std::int64_t last_imu_ns_ = 0;
  std::uint64_t newest_us_ = 0, undated_ = 0;
  std::optional<std::uint64_t> earlier_us_;
};

}  // namespace fulmar::fcu
