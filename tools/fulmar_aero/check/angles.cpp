// SPDX-License-Identifier: BSD-3-Clause
// Throws, rates and limits: degrees where radians are meant, and limits that contradict each other.
#include <cmath>

#include "fulmar/flight/model/trim.hpp"
#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// An angle of at most `most` rad; a larger one is likely in degrees.
void check_angle(Findings& f, const std::string& field, double rad, double most) {
  f.looked_at();
  if (std::abs(rad) <= most) return;
  const std::string hint =
      std::abs(rad) * degree <= most ? aero_messages::angle_in_degrees(figures(rad)).line() : "";
  f.fault(field, rad, aero_messages::angle_too_large(figures(rad), degrees(rad, 0), degrees(most, 0), hint));
}

void check_surface(Findings& f, const std::string& name, const Surface& s) {
  check_angle(f, name + ".limit_rad", s.limit_rad, 1.4);
  check_angle(f, name + ".trim_rad", s.trim_rad, 1.4);
  f.looked_at(4);
  if (s.limit_rad < 0.05)
    f.warn(name + ".limit_rad", s.limit_rad, aero_messages::throw_too_small(degrees(s.limit_rad)));
  if (std::abs(s.trim_rad) > s.limit_rad && std::abs(s.trim_rad) <= 1.4)
    f.fault(name + ".trim_rad", s.trim_rad,
            aero_messages::trim_beyond_throw(degrees(s.trim_rad, 1), degrees(s.limit_rad, 1)));
  if (s.rate_limit_radps > 40)
    f.warn(name + ".rate_limit_radps", s.rate_limit_radps,
           aero_messages::servo_rate_unusual(figures(s.rate_limit_radps)));
  if (s.rate_limit_radps <= 0)
    f.fault(name + ".rate_limit_radps", s.rate_limit_radps, aero_messages::servo_rate_not_positive());
  if (s.time_constant_s < 0 || s.time_constant_s > 0.5)
    f.warn(name + ".time_constant_s", s.time_constant_s,
           aero_messages::time_constant_unusual(figures(s.time_constant_s)));
}

void check_limits(Findings& f, const FlightLimits& l) {
  check_angle(f, "limits.roll_max_rad", l.roll_max_rad, 1.5);
  check_angle(f, "limits.pitch_max_rad", l.pitch_max_rad, 1.5);
  check_angle(f, "limits.pitch_min_rad", l.pitch_min_rad, 1.5);
  f.looked_at(3);
  if (!(l.airspeed_min_mps > 0 && l.airspeed_min_mps < l.airspeed_cruise_mps &&
        l.airspeed_cruise_mps < l.airspeed_max_mps))
    f.fault("limits.airspeed_cruise_mps", l.airspeed_cruise_mps,
            aero_messages::airspeeds_not_increasing(
                figures(l.airspeed_min_mps), figures(l.airspeed_cruise_mps), figures(l.airspeed_max_mps)));
  if (l.pitch_min_rad >= l.pitch_max_rad)
    f.fault("limits.pitch_min_rad", l.pitch_min_rad,
            aero_messages::pitch_limits_reversed(degrees(l.pitch_min_rad, 1), degrees(l.pitch_max_rad, 1)));
  if (l.throttle_cruise_frac < 0 || l.throttle_cruise_frac > 1)
    f.fault("limits.throttle_cruise_frac", l.throttle_cruise_frac,
            aero_messages::cruise_throttle_invalid(figures(l.throttle_cruise_frac)));
}

}  // namespace

void check_angles(Findings& f) {
  const Airframe& a = f.file().airframe;
  check_angle(f, "wing.stall_alpha_rad", a.wing.stall_alpha_rad, 0.8);
  f.looked_at();
  if (a.wing.stall_alpha_rad < 0.1)
    f.warn("wing.stall_alpha_rad", a.wing.stall_alpha_rad,
           aero_messages::stall_angle_low(degrees(a.wing.stall_alpha_rad, 1)));
  check_surface(f, "aileron", a.aileron);
  check_surface(f, "elevator", a.elevator);
  if (rudder_acts(a) || a.rudder.limit_rad > 0) check_surface(f, "rudder", a.rudder);
  if (has_flaps(a.aero)) check_surface(f, "flap", a.flap);
  check_limits(f, a.limits);
}

}  // namespace fulmar::aero
