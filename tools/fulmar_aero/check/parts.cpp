// SPDX-License-Identifier: BSD-3-Clause
// Servos, propellers, battery and gear: doubtful units, and parts that do not fit together.
#include <cmath>

#include "fulmar/flight/model/mixer.hpp"
#include "fulmar/flight/model/propellers.hpp"
#include "fulmar/sim/gear_legs.hpp"
#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

void check_servo(Findings& f, const std::string& name, const Surface& s) {
  f.looked_at(4);
  const double frequency = s.natural_frequency_radps;
  if (frequency > 0 && (frequency < 15 || frequency > 600))
    f.warn(name + ".natural_frequency_radps", frequency,
           aero_messages::servo_frequency_unusual(
               figures(frequency),
               frequency < 15 ? aero_messages::servo_frequency_in_hertz(figures(frequency * 360 * degree))
                              : aero_messages::servo_frequency_in_degrees()));
  if (frequency > 0 && (s.damping_ratio < 0.3 || s.damping_ratio > 3))
    f.warn(name + ".damping_ratio", s.damping_ratio,
           aero_messages::servo_damping_unusual(figures(s.damping_ratio)));
  if (s.dead_band_rad > 0.1)
    f.warn(name + ".dead_band_rad", s.dead_band_rad,
           aero_messages::dead_band_unusual(degrees(s.dead_band_rad, 1)));
  const Stops at = stops(s);
  if (at.max < s.limit_rad - 1e-9 || at.min > 1e-9 - s.limit_rad)
    f.warn(name + (at.max < s.limit_rad - 1e-9 ? ".max_rad" : ".min_rad"),
           at.max < s.limit_rad - 1e-9 ? at.max : at.min,
           aero_messages::servo_range_small(degrees(at.min, 1), degrees(at.max, 1), degrees(s.limit_rad, 1)));
}

bool alike(const Surface& a, const Surface& b) {
  return stops(a).min == stops(b).min && stops(a).max == stops(b).max &&
         a.rate_limit_radps == b.rate_limit_radps && a.time_constant_s == b.time_constant_s &&
         a.natural_frequency_radps == b.natural_frequency_radps && a.damping_ratio == b.damping_ratio;
}

void check_mixer(Findings& f) {
  const Airframe& a = f.file().airframe;
  if (a.mixer == Mixer::conventional) return;
  f.looked_at();
  const bool elevons = a.mixer == Mixer::elevons;
  const Surface &left = elevons ? a.aileron : a.elevator, &right = elevons ? a.elevator : a.rudder;
  if (alike(left, right)) return;
  f.warn("mixer", 0,
         elevons ? aero_messages::paired_servos_differ("aileron", "elevator", "elevon")
                 : aero_messages::paired_servos_differ("elevator", "rudder", "ruddervator"));
}

void check_propellers(Findings& f) {
  const Airframe& a = f.file().airframe;
  if (a.propulsion.propellers.empty()) return;
  f.looked_at(2);
  Load load;
  Propellers(a).add<double>(1.0, 0.0, load);
  const double arm = load.moment_b.z();
  if (load.force_b.x() <= 0)
    f.fault("propulsion.propellers", load.force_b.x(), aero_messages::forward_thrust_missing());
  if (std::abs(arm) > 0.01 * a.wing.span_m)
    f.warn("propulsion.propellers", arm,
           aero_messages::thrust_off_centre(arm > 0 ? "right" : "left",
                                            figures(std::abs(arm) / load.force_b.x())));
}

void check_battery(Findings& f) {
  const Propulsion& p = f.file().airframe.propulsion;
  if (p.pack.resistance_ohm <= 0) return;
  f.looked_at();
  const double motors = std::max<double>(1, static_cast<double>(p.propellers.size()));
  const double part = motors * p.pack.resistance_ohm / p.resistance_ohm;
  if (part > 2)
    f.warn("propulsion.pack.resistance_ohm", p.pack.resistance_ohm,
           aero_messages::pack_resistance_unusual(figures(part)));
}

void check_contacts(Findings& f) {
  const Airframe& a = f.file().airframe;
  if (a.gear.contacts.empty()) return;
  f.looked_at(2);
  const sim::Standing at = sim::Legs(a).standing();
  const Eigen::Vector3d nose = at.tilt * Eigen::Vector3d::UnitX(), wing = at.tilt * Eigen::Vector3d::UnitY();
  const double pitch = std::asin(-nose.z()), roll = std::asin(wing.z());
  f.figure("standing_height_m", at.height_m, "stands",
           fixed(at.height_m, 3) + " m high, pitch " + degrees(pitch, 1));
  f.figure("standing_pitch_rad", pitch, "", "");
  double on_skids = 0;
  for (const GearContact& c : a.gear.contacts)
    if (c.kind == ContactKind::skid) on_skids += std::max(c.carries_ratio, 0.0);
  if (on_skids > 0.99)
    f.figure(
        "on_skids_ratio", on_skids, "take-off",
        "it has no wheels: by hand or off a catapult, `launch` of the simulator and `launch_acceleration` of "
        "the outer law");
  if (std::abs(roll) > 0.02)
    f.warn("gear.contacts", roll, aero_messages::standing_bank_unusual(degrees(roll, 1)));
  if (std::abs(pitch) > 0.3)
    f.warn("gear.contacts", pitch, aero_messages::standing_pitch_unusual(degrees(pitch, 1)));
}

}  // namespace

void check_parts(Findings& f) {
  const Airframe& a = f.file().airframe;
  check_servo(f, "aileron", a.aileron);
  check_servo(f, "elevator", a.elevator);
  check_servo(f, "rudder", a.rudder);
  check_mixer(f);
  check_propellers(f);
  check_battery(f);
  check_contacts(f);
}

}  // namespace fulmar::aero
