// SPDX-License-Identifier: BSD-3-Clause
// Publication of the vehicle's status, and its notices.
#pragma once
#include <cstdint>

#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"
#include "sensors.hpp"

namespace fulmar::sim {

/// Publishes the status ten times a second, and at once for a change.
class StatusReport {
 public:
  StatusReport() = default;
  explicit StatusReport(std::int64_t first_ns) : rate_(10, first_ns) {}

  bool due(const VehicleStatus& s, std::int64_t now_ns) {
    const bool changed = s.armed != last_.armed || s.override != last_.override ||
                         s.failsafe != last_.failsafe || s.on_ground != last_.on_ground ||
                         s.crashed != last_.crashed;
    return rate_(now_ns) || changed;
  }
  template <class Notices>
  void publish(const VehicleStatus& s, std::int64_t now_ns, Out<VehicleStatus>& out, Notices& notices) {
    report_pilot(s, now_ns, notices);
    last_ = s;
    out.publish(s);
  }

 private:
  /// Notices with the texts that fcu_serial has for a flight controller.
  template <class Notices>
  void report_pilot(const VehicleStatus& s, std::int64_t now_ns, Notices& notices) const {
    if (!s.armed || !last_.armed || s.override == last_.override) return;
    Notice notice;
    notice.text = (s.override ? sim_aero_messages::pilot_flies : sim_aero_messages::pilot_hands_over).c_str();
    notices.push(notice, now_ns);
  }

  VehicleStatus last_;
  Due rate_;
};

}  // namespace fulmar::sim
