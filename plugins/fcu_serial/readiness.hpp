// SPDX-License-Identifier: BSD-3-Clause
// Decision whether commands may be sent: state of the aircraft, missing conditions, and reports to the pilot.
#pragma once
#include <algorithm>
#include <cstdint>

#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "missing_messages.hpp"
#include "state.hpp"

namespace fulmar::fcu {

inline constexpr std::int64_t repeat_ns = 10'000'000'000;          ///< interval of repeated reports
inline constexpr std::int64_t estimate_patience_ns = 500'000'000;  ///< an older estimate counts as missing

/// The controller zeroes its airspeed in the first seconds after a boot.
enum class PitotZero : std::uint8_t { good, pending, wrong };
inline constexpr std::uint64_t zeroing_us = 12'000'000;

/// Flight time of the last sample of each sensor; of the receiver: the last three-dimensional fix.
struct Spoken {
  std::int64_t fix_ns = never_ns, mag_ns = never_ns, baro_ns = never_ns, pitot_ns = never_ns;
};

inline bool solved(FixType fix) {
  return fix == FixType::fix_3d || fix == FixType::combined || fix == FixType::rtk_float ||
         fix == FixType::rtk_fixed;
}

/// An intermittent report is made less and less often: 1 s after the last time, then 2 s, up to 10 s.
class Hold {
 public:
  bool open(std::int64_t now_ns) const { return now_ns - reported_ns_ >= hold_ns_; }
  void reported(std::int64_t now_ns) {
    hold_ns_ = now_ns - reported_ns_ < 2 * repeat_ns ? std::min(2 * hold_ns_, repeat_ns) : min_ns;
    reported_ns_ = now_ns;
  }
  /// The next report is made at once.
  void release() { reported_ns_ = never_ns; }

 private:
  static constexpr std::int64_t min_ns = 1'000'000'000;
  std::int64_t reported_ns_ = never_ns, hold_ns_ = min_ns;
};

/// Reports the loss of the fix and its return. A slow receiver has a time-out of two and a half fixes. A link
/// failure does not count. `link_ns`: time since which the link is up.
class FixWatch {
 public:
  void report(std::int64_t fix_ns, std::int64_t link_ns, bool link, bool armed, std::int64_t now_ns,
              Notices& out) {
    if (fix_ns == never_ns) return;
    if (fix_ns != last_ns_) {
      if (last_ns_ != never_ns && !lost_)
        period_ns_ = std::min(fix_ns - last_ns_, std::int64_t{2'000'000'000});
      if (lost_ && reported_)
        out.add(Severity::warning, fcu_serial_messages::gnss_back, tenths_s(fix_ns - last_ns_));
      last_ns_ = fix_ns;
      lost_ = false;
    }
    const std::int64_t silent_ns = now_ns - std::max(fix_ns, link_ns);
    if (lost_ || !link || silent_ns < std::max(min_ns, period_ns_ * 5 / 2)) return;
    lost_ = true;
    reported_ = hold_.open(now_ns);
    if (!reported_) return;
    hold_.reported(now_ns);
    out.add(armed ? Severity::critical : Severity::warning, fcu_serial_messages::gnss_lost);
  }
  bool lost() const { return lost_; }

 private:
  using Severity = fulmar::Severity;
  static constexpr std::int64_t min_ns = 700'000'000;
  // Until two fixes have shown the interval, it is that of the slowest receiver.
  std::int64_t last_ns_ = never_ns, period_ns_ = 2'000'000'000;
  bool lost_ = false, reported_ = false;
  Hold hold_;
};

/// Reports the loss of attitude while the computer's commands are in force. The control laws can then only
/// hold the surfaces, and the pilot must take over. No other report shows it, because samples continue.
class AttitudeWatch {
 public:
  void report(bool attitude, bool in_control, std::int64_t now_ns, Notices& out) {
    if (attitude) met_ = true;
    if (attitude || !in_control || !met_)
      lost_ns_ = never_ns;
    else if (lost_ns_ == never_ns)
      lost_ns_ = now_ns;
    const bool lost = lost_ns_ != never_ns && now_ns - lost_ns_ >= patience_ns;
    if (lost && !reported_) out.add(Severity::critical, fcu_serial_messages::attitude_lost);
    if (reported_ && attitude) out.add(Severity::warning, fcu_serial_messages::attitude_valid);
    reported_ = lost || (reported_ && !attitude);
  }

 private:
  using Severity = fulmar::Severity;
  static constexpr std::int64_t patience_ns = 300'000'000;
  std::int64_t lost_ns_ = never_ns;
  bool met_ = false, reported_ = false;
};

/// The gate before the commands. It closes
/// - while the attitude is unknown and the commands did not move the aircraft anyway: after a gap of the link
/// the
///   controller has given control to its pilot, who keeps it until the attitude is known again;
/// - when the pilot hands over an aircraft on the ground without a position: it opens at the next hand-over,
/// and
///   not by a fix that arrives while a person may stand near the propeller.
class Readiness {
 public:
  struct Facts {
    const VehicleState* state;  ///< null: none, or one that is too old
    VehicleStatus status;
    Spoken spoken;
    bool inertial;  ///< samples arrive
    PitotZero pitot_zero;
    bool path;      ///< there is a path, or none is required
    bool fix_lost;  ///< there was a fix before
  };

  /// Returns true when a command may be sent now.
  bool update(const Facts& f, std::int64_t now_ns, Notices& out) {
    const bool attitude = f.state && f.state->attitude_valid;
    const std::uint32_t missing = missing_of(f, now_ns);
    complete_ = (missing & needed) == 0;
    met_ = true;
    look_for_flight(f, complete_);
    take_hand_over(f, complete_);
    watch_.report(attitude, f.status.in_control && f.inertial, now_ns, out);
    report_attitude(attitude, f, out);
    report_missing(missing, f, now_ns, out);
    return !blind_ && !refused_;
  }
  /// True when it rejects the hand-over that this status may begin.
  bool refuses(const VehicleStatus& s) const {
    return refused_ || (met_ && handed(s) && !handed_ && met_disarmed_ && !flown_ && !complete_);
  }

 private:
  using Level = fulmar::Severity;
  enum Missing : std::uint32_t {
    no_link = 1,
    no_inertial = 2,
    no_attitude = 4,
    no_fix = 8,
    no_position = 16,
    no_height = 32,
    no_velocity = 64,
    no_path = 128,
    needed = 255,
    no_mag = 256,
    no_baro = 512,
    no_pitot = 1024,
    zero_pending = 2048,
    zero_wrong = 4096
  };
  static constexpr BitMessages<8> needed_messages{{{no_link, missing_messages::link},
                                                   {no_inertial, missing_messages::inertial_samples},
                                                   {no_attitude, missing_messages::attitude},
                                                   {no_fix, missing_messages::gnss_fix},
                                                   {no_position, missing_messages::position},
                                                   {no_height, missing_messages::height},
                                                   {no_velocity, missing_messages::velocity},
                                                   {no_path, missing_messages::path}}};
  static constexpr BitMessages<5> other_messages{{{no_mag, missing_messages::magnetometer},
                                                  {no_baro, missing_messages::barometer},
                                                  {no_pitot, missing_messages::pitot},
                                                  {zero_pending, missing_messages::airspeed_zero},
                                                  {zero_wrong, missing_messages::right_airspeed_zero}}};
  static constexpr std::int64_t first_reported_ns = 3'000'000'000;  ///< the estimator aligns until then
  static constexpr std::int64_t sensor_patience_ns = 2'000'000'000;
  static constexpr double flies_mps = 7;

  std::uint32_t missing_of(const Facts& f, std::int64_t now_ns) const {
    const auto silent = [now_ns](std::int64_t at_ns) { return now_ns - at_ns > sensor_patience_ns; };
    const auto unless = [](bool there, Missing bit) { return there ? 0u : std::uint32_t{bit}; };
    if ((f.status.errors & own_error_link_down) != 0) return no_link;
    const VehicleState none, &s = f.state ? *f.state : none;
    std::uint32_t m = unless(f.inertial, no_inertial);
    // Only the cause is reported: without attitude there is no fix, without a fix no position, without a
    // position no path.
    if (s.attitude_valid && s.position_valid) m |= unless(f.path, no_path);
    if (s.attitude_valid)
      m |= unless(s.height_valid, no_height) | unless(s.velocity_valid, no_velocity);
    else
      m |= no_attitude;
    // On the ground a lost fix counts at once, though the position stays valid for seconds.
    if ((f.fix_lost && !flown_) || (!s.position_valid && silent(f.spoken.fix_ns)))
      m |= no_fix;
    else if (s.attitude_valid && !s.position_valid)
      m |= no_position;
    m |= unless(!silent(f.spoken.mag_ns), no_mag) | unless(!silent(f.spoken.baro_ns), no_baro);
    if (f.pitot_zero == PitotZero::wrong) return m | zero_wrong;  // its samples are withheld
    if (silent(f.spoken.pitot_ns)) return m | no_pitot;
    return m | unless(f.pitot_zero == PitotZero::good, zero_pending);
  }

  static bool handed(const VehicleStatus& s) { return s.armed && !s.override && !s.failsafe; }

  void look_for_flight(const Facts& f, bool complete) {
    if (!f.status.armed) {
      met_disarmed_ = true;
      flown_ = false;
    }
    if (f.status.in_control && complete && f.state->ground_speed_mps > flies_mps) flown_ = true;
  }

  /// An aircraft that is already armed at the first status may be in the air: control is taken as soon as
  /// possible.
  void take_hand_over(const Facts& f, bool complete) {
    const bool now = handed(f.status);
    if (now && !handed_ && met_disarmed_ && !flown_ && !complete) {
      refused_ = true;
      reported_ns_ = never_ns;
      hold_.release();
    }
    if (!now) refused_ = false;
    handed_ = now;
  }

  void report_attitude(bool attitude, const Facts& f, Notices& out) {
    const bool before = blind_;
    if (attitude)
      blind_ = false;
    else if (!f.status.in_control || !f.inertial)
      blind_ = true;
    if (attitude) met_attitude_ = true;
    if (before == blind_ || !met_attitude_ || !f.status.armed) return;
    if (blind_)
      out.add(Level::critical, fcu_serial_messages::attitude_unknown);
    else if (!first_)
      out.add(Level::warning, fcu_serial_messages::attitude_known);
    first_ = false;
  }

  void report_missing(std::uint32_t missing, const Facts& f, std::int64_t now_ns, Notices& out) {
    if (now_ns < first_reported_ns && !f.status.armed) return;
    const bool waits = !f.status.armed || refused_ || (handed_ && blind_);
    const bool due = now_ns - reported_ns_ >= repeat_ns, may_change = hold_.open(now_ns);
    if (!waits) return;
    if ((missing & needed) == 0) {
      if (refused_ ? !due && reported_ready_ : reported_ready_ && missing == reported_) return;
      if (!due && !may_change) return;
      report_ready(missing, out);
      return reported(missing, true, now_ns);
    }
    if (!due && !(reported_ready_ && may_change)) return;
    report_not_ready(missing, out);
    reported(missing, false, now_ns);
  }
  void reported(std::uint32_t missing, bool ready, std::int64_t now_ns) {
    if (ready != reported_ready_) hold_.reported(now_ns);
    reported_ns_ = now_ns;
    reported_ready_ = ready;
    reported_ = missing;
  }
  void report_ready(std::uint32_t missing, Notices& out) const {
    if (missing == 0)
      return out.add(Level::info,
                     refused_ ? fcu_serial_messages::ready_switch_back : fcu_serial_messages::ready);
    Line list;
    list_bits(list, missing, other_messages);
    out.add(Level::warning,
            refused_ ? fcu_serial_messages::ready_switch_back_but : fcu_serial_messages::ready_but,
            list.view());
  }
  void report_not_ready(std::uint32_t missing, Notices& out) const {
    Line list;
    list_bits(list, missing, needed_messages);
    if (!met_disarmed_ && !met_attitude_)
      return out.add(Level::warning, fcu_serial_messages::not_ready_armed_before, list.view());
    list_bits(list, missing, other_messages);
    out.add(Level::warning, fcu_serial_messages::not_ready, list.view());
  }

  bool blind_ = true, refused_ = false, handed_ = false, flown_ = false;
  bool met_disarmed_ = false, met_attitude_ = false, first_ = true;
  bool reported_ready_ = false;
  std::uint32_t reported_ = 0;
  std::int64_t reported_ns_ = never_ns;
  Hold hold_;
  bool complete_ = false, met_ = false;
  AttitudeWatch watch_;
};

}  // namespace fulmar::fcu
