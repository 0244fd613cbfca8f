// SPDX-License-Identifier: BSD-3-Clause
// Rules of an airframe beyond the range of a single field.
#pragma once
#include <cmath>
#include <cstdio>
#include <string>

#include "fulmar/flight/model/mixer.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/sim/gear_legs.hpp"
#include "fulmar/sim/messages.hpp"

namespace fulmar::sim {

/// Field of the airframe, "gear.contacts", and a sentence; both empty without a fault.
struct AirframeFault {
  std::string field, sentence;
  explicit operator bool() const { return !sentence.empty(); }
};

namespace rules {

/// A number in a message, four digits.
inline std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Path of a field of a list: "list[i].field".
inline std::string item(const char* list, std::size_t i, const char* field) {
  return std::string(list) + "[" + std::to_string(i) + "]." + field;
}

/// True if the centre of gravity is outside the contacts. It is inside if some weights of at least 0 that sum
/// to 1 balance it; outside, a line through it has all contacts on one side.
inline bool beside_contacts(const Gear& gear) {
  for (const GearContact& edge : gear.contacts) {
    bool left = false, right = false;
    for (const GearContact& c : gear.contacts) {
      const double side = edge.at_m.x * c.at_m.y - edge.at_m.y * c.at_m.x;
      const double ahead = edge.at_m.x * c.at_m.x + edge.at_m.y * c.at_m.y;
      left = left || side > 1e-12 || (std::abs(side) <= 1e-12 && ahead < 0);
      right = right || side < -1e-12 || (std::abs(side) <= 1e-12 && ahead < 0);
    }
    if (!left || !right) return true;
  }
  return false;
}

/// Twice the largest horizontal area between three contacts.
inline double spanned(const Gear& gear) {
  double most = 0;
  for (const GearContact& a : gear.contacts)
    for (const GearContact& b : gear.contacts)
      for (const GearContact& c : gear.contacts)
        most = std::max(most, (b.at_m.x - a.at_m.x) * (c.at_m.y - a.at_m.y) -
                                  (b.at_m.y - a.at_m.y) * (c.at_m.x - a.at_m.x));
  return most;
}

/// Position of all contacts relative to the centre of gravity, for a message.
inline std::string where_contacts_are(const Gear& gear) {
  const auto all = [&](auto&& is) { return std::all_of(gear.contacts.begin(), gear.contacts.end(), is); };
  if (all([](const GearContact& c) { return c.at_m.x < 0; })) return "behind";
  if (all([](const GearContact& c) { return c.at_m.x > 0; })) return "ahead of";
  if (all([](const GearContact& c) { return c.at_m.y > 0; })) return "right of";
  if (all([](const GearContact& c) { return c.at_m.y < 0; })) return "left of";
  return "on one side of";
}

/// Contacts, if any: at least three, not on one line, around the centre of gravity, with shares that sum to
/// 1.
inline AirframeFault gear_fault(const Airframe& a) {
  const Gear& gear = a.gear;
  const std::size_t n = gear.contacts.size();
  if (n == 0) return {};
  const auto fault = [](const Diagnostic& message) { return AirframeFault{"gear.contacts", message}; };
  if (n < 3) return fault(sim_messages::contacts_few(n));
  double sum = 0;
  for (const GearContact& c : gear.contacts) sum += c.carries_ratio;
  if (std::abs(sum - 1) > 1e-3) return fault(sim_messages::contacts_shares_wrong(short_number(sum)));
  if (spanned(gear) < 1e-6) return fault(sim_messages::contacts_on_line());
  if (beside_contacts(gear)) return fault(sim_messages::contacts_beside(where_contacts_are(gear)));
  if (!Legs(a).standing().found) return fault(sim_messages::contacts_without_rest());
  return {};
}

/// Stops of a servo: the lower one below the upper one. `name` is the field of the surface.
inline AirframeFault surface_fault(const char* name, const Surface& s) {
  const Stops at = stops(s);
  if (at.min < at.max || s.limit_rad == 0) return {};
  return {std::string(name) + ".min_rad",
          sim_messages::servo_fixed(short_number(at.min), short_number(at.max))};
}

/// Propellers with a share of the rudder: away from the plane of symmetry, with a rudder that has a throw.
inline AirframeFault propeller_fault(const Airframe& a) {
  for (std::size_t i = 0; i < a.propulsion.propellers.size(); ++i) {
    const PropellerPlace& p = a.propulsion.propellers[i];
    if (p.differential_frac <= 0) continue;
    const std::string field = item("propulsion.propellers", i, "differential_frac");
    if (p.at_m.y == 0) return {field, sim_messages::propeller_in_middle()};
    if (a.rudder.limit_rad <= 0) return {field, sim_messages::propeller_without_rudder()};
  }
  return {};
}

/// Voltages and discharge curve: lists of equal size, rising, from the full battery.
inline AirframeFault battery_fault(const Propulsion& p) {
  const Battery& b = p.pack;
  const BatteryCurve& c = b.curve;
  const std::string field = "propulsion.pack";
  if (b.empty_volt > p.battery_volt)
    return {field + ".empty_volt",
            sim_messages::battery_empty_high(short_number(b.empty_volt), short_number(p.battery_volt))};
  if (c.used_frac.size() != c.open_volt.size())
    return {field + ".curve", sim_messages::battery_curve_mismatched(c.used_frac.size(), c.open_volt.size())};
  if (c.used_frac.empty()) return {};
  if (b.capacity_ah <= 0) return {field + ".curve", sim_messages::battery_capacity_missing()};
  for (std::size_t i = 1; i < c.used_frac.size(); ++i)
    if (!(c.used_frac[i] > c.used_frac[i - 1]))
      return {field + ".curve.used_frac",
              sim_messages::battery_curve_not_rising(short_number(c.used_frac[i]),
                                                     short_number(c.used_frac[i - 1]))};
  if (c.used_frac[0] != 0 || std::abs(c.open_volt[0] - p.battery_volt) > 1e-6 * p.battery_volt)
    return {field + ".curve", sim_messages::battery_curve_start_wrong(short_number(p.battery_volt))};
  return {};
}

}  // namespace rules

/// The first fault of an airframe by all rules above.
inline AirframeFault airframe_fault(const Airframe& a) {
  if (AirframeFault f = rules::surface_fault("aileron", a.aileron)) return f;
  if (AirframeFault f = rules::surface_fault("elevator", a.elevator)) return f;
  if (AirframeFault f = rules::surface_fault("rudder", a.rudder)) return f;
  if (AirframeFault f = rules::propeller_fault(a)) return f;
  if (AirframeFault f = rules::battery_fault(a.propulsion)) return f;
  return rules::gear_fault(a);
}

}  // namespace fulmar::sim
