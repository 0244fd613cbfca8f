// SPDX-License-Identifier: BSD-3-Clause
// Regularity of the inertial samples, and the figures of the link.
#pragma once
#include <algorithm>
#include <cstdint>

#include "link/link.hpp"
#include "reports.hpp"
#include "state.hpp"

namespace fulmar::fcu {

class LinkReport {
 public:
  std::uint64_t unusable = 0, commands = 0, unsent = 0;

  void imu(std::int64_t valid_at_ns) {
    if (last_imu_ns_ != never_ns) {
      const std::int64_t gap = valid_at_ns - last_imu_ns_;
      if (gap > gap_ns) ++gaps_;
      worst_ns_ = std::max(worst_ns_, gap);
    }
    last_imu_ns_ = valid_at_ns;
    ++samples_;
  }
  void turnaround(std::int64_t ns) { turnaround_ns_ = std::max(turnaround_ns_, ns); }

  bool due(std::int64_t now_ns) const { return now_ns - reported_ns_ >= 100'000'000; }
  LinkStatus take(const LinkState& link, std::int64_t host_ns, std::int64_t now_ns) {
    count_rate(now_ns);
    LinkStatus s;
    s.open = link.open;
    s.synchronised = link.synchronised;
    s.heard_age_s = link.heard_ns == 0 ? 1e9 : seconds(std::max<std::int64_t>(host_ns - link.heard_ns, 0));
    s.frames = link.frames;
    s.bad = link.bad;
    s.missing = link.missing;
    s.dropped = link.lost_in_queue;
    s.unusable = unusable;
    s.commands = commands;
    s.unsent = unsent;
    s.connections = link.connections;
    s.reboots = link.reboots;
    s.imu_gaps = gaps_;
    s.worst_gap_s = seconds(worst_ns_);
    s.imu_rate_hz = rate_hz_;
    s.round_trip_s = seconds(link.round_trip_ns);
    s.offset_ns = link.offset_ns;
    s.drift_ratio = 1e-6 * link.drift_ppm;
    s.turnaround_s = seconds(turnaround_ns_);
    turnaround_ns_ = 0;
    reported_ns_ = now_ns;
    return s;
  }

 private:
  static constexpr std::int64_t gap_ns = 6'000'000;  ///< two and a half samples at 400 Hz
  static double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

  void count_rate(std::int64_t now_ns) {
    if (counted_ns_ == never_ns) counted_ns_ = now_ns;
    const std::int64_t since = now_ns - counted_ns_;
    if (since < 1'000'000'000) return;
    rate_hz_ = static_cast<double>(samples_) / seconds(since);
    samples_ = 0;
    counted_ns_ = now_ns;
  }

  std::int64_t last_imu_ns_ = never_ns, worst_ns_ = 0, turnaround_ns_ = 0, reported_ns_ = never_ns,
               counted_ns_ = never_ns;
  std::uint32_t gaps_ = 0;
  std::uint64_t samples_ = 0;
  double rate_hz_ = 0;
};

}  // namespace fulmar::fcu
