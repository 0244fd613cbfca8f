// SPDX-License-Identifier: BSD-3-Clause
// Source of the commands in force: the controller's status, its age, and whether the host's commands move the
// aircraft. Each change is reported once.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "fulmar/msg/vehicle_status.hpp"
#include "words.hpp"

namespace fulmar::fcu {

inline constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::min() / 2;
inline constexpr std::int64_t link_patience_ns =
    200'000'000;  ///< time-out of frames: at least 400 arrive each second
inline constexpr std::int64_t gap_patience_ns =
    50'000'000;  ///< time-out of inertial samples: only sets a flag
inline constexpr std::int64_t rc_patience_ns =
    500'000'000;  ///< time-out of frames of the radio: 111 arrive each second
// time-out of the status: 10 arrive each second
inline constexpr std::int64_t status_patience_ns = 500'000'000;
inline constexpr std::int64_t command_patience_ns =
    100'000'000;  ///< OFFBOARD_TIMEOUT: time-out of a command in the controller

/// Time-out of the radio, in frames of other kinds: normally one frame in twelve is the radio's. A line that
/// loses nearly all frames takes longer, and meanwhile gives no evidence about the radio.
inline constexpr std::uint32_t frames_without_rc = 200;

/// Bits of VehicleStatus::errors in addition to the controller's eight.
enum OwnError : std::uint32_t {
  own_error_rc_silent = 0x100,     ///< the radio's frames stopped
  own_error_link_down = 0x200,     ///< no frames from the controller
  own_error_sensors_dead = 0x400,  ///< sensors of the controller did not start
  own_error_imu_silent = 0x800  ///< frames without inertial samples: the controller's own control has stopped
};

/// Times of the last frames, in ns of one clock.
struct Heard {
  RosflightStatus status;
  double volt = 0, amp = 0;
  bool open = true;                    ///< the device is open
  std::int64_t since_ns = 0;           ///< begin of the present series of frames
  std::int64_t resumed_ns = never_ns;  ///< end of a pause of this computer, which does not count as silence
  std::uint32_t frames_since_rc = 0;
  std::int64_t frame_ns = never_ns, imu_ns = never_ns, status_ns = never_ns, rc_ns = never_ns,
               command_ns = never_ns;

  void frame(std::int64_t now_ns) {
    if (now_ns - frame_ns >= link_patience_ns) since_ns = now_ns;
    frame_ns = now_ns;
    ++frames_since_rc;
  }
  void rc(std::int64_t now_ns) {
    rc_ns = now_ns;
    frames_since_rc = 0;
  }
  /// Time without a frame of that kind, without pauses of this computer.
  std::int64_t silence_ns(std::int64_t last_ns, std::int64_t now_ns) const {
    return now_ns - std::max(last_ns, resumed_ns);
  }
};

inline VehicleStatus evaluate(const Heard& h, std::int64_t now_ns) {
  const bool link = h.silence_ns(h.frame_ns, now_ns) < link_patience_ns;
  const bool rc = now_ns - h.rc_ns < rc_patience_ns;
  const bool imu = now_ns - h.imu_ns < link_patience_ns;
  const bool rc_stopped =
      h.silence_ns(h.rc_ns, now_ns) >= rc_patience_ns && (!link || h.frames_since_rc >= frames_without_rc);
  const bool imu_stopped = h.silence_ns(h.imu_ns, now_ns) >= link_patience_ns;
  VehicleStatus s;
  s.armed = h.status.armed != 0;
  s.failsafe = h.status.failsafe != 0;
  s.offboard = h.status.offboard != 0;
  s.override = (h.status.rc_override & override_by_pilot) != 0;
  s.override_reasons = h.status.rc_override;
  s.on_ground = !s.armed;
  s.in_control = s.armed && !s.failsafe && s.offboard &&
                 (h.status.rc_override & (override_by_pilot | override_inactive)) == 0 && rc && imu &&
                 now_ns - h.status_ns < status_patience_ns && now_ns - h.command_ns < command_patience_ns;
  s.errors = h.status.error_code;
  if (rc_stopped && now_ns - h.since_ns > rc_patience_ns) s.errors |= own_error_rc_silent;
  if (!link) s.errors |= own_error_link_down;
  if (h.status.num_errors > 0) s.errors |= own_error_sensors_dead;
  if (link && imu_stopped && now_ns - h.since_ns > link_patience_ns) s.errors |= own_error_imu_silent;
  s.health = !link || !imu                                           ? Health::failed
             : s.errors != 0 || now_ns - h.imu_ns >= gap_patience_ns ? Health::degraded
                                                                     : Health::ok;
  s.battery_volt = h.volt;
  s.battery_amp = h.amp;
  s.rc_age_s = h.rc_ns == never_ns ? 1e9 : 1e-9 * static_cast<double>(now_ns - h.rc_ns);
  return s;
}

/// True for a change that is published at once.
inline bool changed(const VehicleStatus& a, const VehicleStatus& b) {
  return a.armed != b.armed || a.failsafe != b.failsafe || a.offboard != b.offboard ||
         a.override != b.override || a.override_reasons != b.override_reasons ||
         a.in_control != b.in_control || a.errors != b.errors || a.health != b.health;
}

/// Rate of the published state: ten times a second, and at once for a change.
class StatusPace {
 public:
  bool due(const VehicleStatus& s, std::int64_t now_ns) {
    if (!changed(s, last_) && now_ns - last_ns_ < period_ns) return false;
    last_ = s;
    last_ns_ = now_ns;
    return true;
  }
  const VehicleStatus& last() const { return last_; }

 private:
  static constexpr std::int64_t period_ns = 100'000'000;
  VehicleStatus last_;
  std::int64_t last_ns_ = never_ns;
};

/// Reports each change of the state once.
class Reporter {
 public:
  /// Only after a status of the controller.
  void report(const VehicleStatus& s, const Heard& h, std::int64_t now_ns, Notices& out) {
    report_link(s, h, now_ns, out);
    if (h.status_ns == never_ns || (s.errors & own_error_link_down) != 0) return;  // no new information
    report_arming(s, out);
    report_pilot(s, out);
    report_control(s, now_ns, out);
    report_errors(s, h, out);
    reported_ = s;
    begun_ = true;
  }

 private:
  using Level = fulmar::Severity;

  void report_link(const VehicleStatus& s, const Heard& h, std::int64_t now_ns, Notices& out) {
    const bool down = (s.errors & own_error_link_down) != 0;
    if (down && !down_ && h.frame_ns != never_ns)
      out.add(s.armed ? Level::critical : Level::warning,
              h.open ? fcu_serial_messages::controller_silent : fcu_serial_messages::device_gone);
    if (!down && down_)
      out.add(Level::info, fcu_serial_messages::controller_back, tenths_s(now_ns - down_since_ns_));
    if (down != down_) down_since_ns_ = h.frame_ns;
    down_ = down && h.frame_ns != never_ns;
  }

  void report_arming(const VehicleStatus& s, Notices& out) {
    if (s.armed != reported_.armed)
      out.add(Level::info, s.armed ? fcu_serial_messages::armed : fcu_serial_messages::disarmed);
    if (s.failsafe && !reported_.failsafe) out.add(Level::critical, fcu_serial_messages::failsafe_entered);
    if (!s.failsafe && reported_.failsafe) out.add(Level::warning, fcu_serial_messages::failsafe_over);
  }

  void report_pilot(const VehicleStatus& s, Notices& out) {
    const bool flies = s.armed && s.override, flew = reported_.armed && reported_.override;
    if (flies && !flew) {
      Line reasons;
      list_bits(reasons, s.override_reasons, override_messages);
      out.add(Level::info, fcu_serial_messages::pilot_flies, reasons.view());
    }
    if (s.armed && !flies && flew) out.add(Level::info, fcu_serial_messages::pilot_hands_over);
  }

  /// Reports each change. An intermittent one is reported once as such, and then its end.
  void report_control(const VehicleStatus& s, std::int64_t now_ns, Notices& out) {
    const bool changes = s.in_control != reported_.in_control;
    if (changes) {
      flickers_ = flickers_ || now_ns - changes_ns_[2] < steady_ns;
      std::rotate(changes_ns_.begin(), changes_ns_.end() - 1, changes_ns_.end());
      changes_ns_[0] = now_ns;
      if (flickers_ && !reported_flicker_) out.add(Level::warning, fcu_serial_messages::control_unsteady);
      reported_flicker_ = flickers_;
    }
    const bool steady = flickers_ && now_ns - changes_ns_[0] >= steady_ns;
    if (steady) flickers_ = reported_flicker_ = false;
    if (flickers_ || (!changes && !steady)) return;
    if (s.in_control)
      out.add(Level::info, fcu_serial_messages::in_control);
    else
      out.add(s.armed && !s.override ? Level::warning : Level::info, fcu_serial_messages::not_in_control);
  }

  void report_errors(const VehicleStatus& s, const Heard& h, Notices& out) {
    const std::uint32_t added = s.errors & ~reported_.errors, gone = reported_.errors & ~s.errors;
    for (const auto& [bit, error] : error_messages) {
      if ((added & bit) != 0) out.add(Level::warning, fcu_serial_messages::error_reported, error.c_str());
      if ((gone & bit) != 0) out.add(Level::info, fcu_serial_messages::error_gone, error.c_str());
    }
    if ((added & own_error_sensors_dead) != 0)
      out.add(Level::warning, fcu_serial_messages::sensors_dead, h.status.num_errors);
    if ((added & own_error_imu_silent) != 0)
      out.add(s.armed ? Level::critical : Level::error, fcu_serial_messages::imu_silent);
    if ((gone & own_error_imu_silent) != 0) out.add(Level::info, fcu_serial_messages::imu_back);
    if ((added & own_error_rc_silent) != 0)
      out.add(s.armed ? Level::critical : Level::warning,
              s.armed ? fcu_serial_messages::radio_frozen : fcu_serial_messages::radio_missing);
    if ((gone & own_error_rc_silent) != 0 && begun_) out.add(Level::info, fcu_serial_messages::radio_back);
  }

  static constexpr std::int64_t steady_ns = 2'000'000'000;
  VehicleStatus reported_;
  std::array<std::int64_t, 3> changes_ns_{never_ns, never_ns, never_ns};  ///< of in_control, newest first
  bool flickers_ = false, reported_flicker_ = false;
  std::int64_t down_since_ns_ = never_ns;
  bool down_ = false, begun_ = false;
};

}  // namespace fulmar::fcu
