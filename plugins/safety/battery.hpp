// SPDX-License-Identifier: BSD-3-Clause
// Remaining charge of the battery, by charge and voltage.
#pragma once
#include <algorithm>
#include <stdexcept>

#include "alarm.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "limits.hpp"
#include "messages.hpp"
#include "motor.hpp"

namespace fulmar::safety {

/// Throws if the limit of an empty battery is above that of a low one.
inline void refuse_crossed(const BatteryLimits& b) {
  const auto check = [](const char* name, double empty, const char* low_name, double low) {
    if (empty > low)
      throw std::runtime_error(
          located(name, safety_messages::battery_limits_crossed(empty, low_name, low)).line());
  };
  check("battery_empty", b.battery_empty, "battery_low", b.battery_low);
  check("volt_empty", b.volt_empty, "volt_low", b.volt_low);
}

class Battery {
 public:
  bool low() const { return low_.raised(); }
  bool empty() const { return empty_.raised(); }

  void step(const VehicleStatus& s, double full_volt, const BatteryLimits& b, double dt) {
    const bool measured = s.battery_volt > there_volt || low_.raised();
    const double volt = measured ? s.battery_volt / std::max(full_volt, there_volt) : 1;
    const auto below = [&](double share, double of_volt) { return s.battery_frac < share || volt < of_volt; };
    const auto watch = [&](Alarm& a, double share, double of_volt) {
      a.step(below(share, of_volt), !below(share + 0.1, of_volt + 0.1), b.battery_raise, b.battery_clear, dt);
    };
    watch(low_, b.battery_low, b.volt_low);
    watch(empty_, b.battery_empty, b.volt_empty);
  }

 private:
  Alarm low_, empty_;
};

}  // namespace fulmar::safety
