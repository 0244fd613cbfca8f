// SPDX-License-Identifier: BSD-3-Clause
// A battery: its open-circuit voltage falls with the charge taken, by a line or a curve. The loss under load
// is in propulsion.hpp, in the balance of motor and battery.
#pragma once
#include <algorithm>
#include <cstdint>

#include "fulmar/msg/airframe.hpp"

namespace fulmar::sim {

/// Charge taken from a battery, and its open-circuit voltage. Without a capacity it never drains.
class BatteryState {
 public:
  explicit BatteryState(const Propulsion& p) : full_volt_(p.battery_volt), battery_(p.pack) {}

  /// True if the capacity is limited.
  bool drains() const { return battery_.capacity_ah > 0; }
  void drain(double amp, double dt) { used_as_ += amp * dt; }
  double used_ah() const { return used_as_ / 3600; }
  bool empty() const { return drains() && used_ah() >= battery_.capacity_ah; }

  /// Open-circuit voltage, V.
  double open_volt() const {
    if (!drains()) return full_volt_;
    const double used = std::min(1.0, used_ah() / battery_.capacity_ah);
    const BatteryCurve& c = battery_.curve;
    if (!c.used_frac.empty()) return on_curve(c, used);
    const double empty = battery_.empty_volt > 0 ? battery_.empty_volt : full_volt_;
    return full_volt_ + used * (empty - full_volt_);
  }

 private:
  static double on_curve(const BatteryCurve& c, double used) {
    const std::uint32_t n = c.used_frac.count;
    if (used <= c.used_frac[0]) return c.open_volt[0];
    for (std::uint32_t i = 1; i < n; ++i)
      if (used < c.used_frac[i]) {
        const double part = (used - c.used_frac[i - 1]) / (c.used_frac[i] - c.used_frac[i - 1]);
        return c.open_volt[i - 1] + part * (c.open_volt[i] - c.open_volt[i - 1]);
      }
    return c.open_volt[n - 1];
  }

  double full_volt_;
  Battery battery_;
  double used_as_ = 0;  ///< A s
};

}  // namespace fulmar::sim
