// SPDX-License-Identifier: BSD-3-Clause
// Static margin and control power.
#include <algorithm>
#include <cmath>

#include "fulmar/flight/model/steady_flight.hpp"
#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

void check_margin(Findings& f) {
  f.looked_at();
  const Aerodynamics& aero = f.aero();
  if (aero.lift.alpha_ratio <= 0) return;
  const double margin = -aero.pitch.alpha_ratio / aero.lift.alpha_ratio;
  f.figure("static_margin_ratio", margin, "static margin", figures(margin) + " of the chord");
  if (margin > 0.3)
    f.warn("aero.pitch.alpha_ratio", aero.pitch.alpha_ratio,
           aero_messages::static_margin_high(figures(margin)));
  else if (margin > 0 && margin < 0.05)
    f.warn("aero.pitch.alpha_ratio", aero.pitch.alpha_ratio,
           aero_messages::static_margin_low(figures(margin)));
}

/// The helix angle p b/2V at full aileron; MIL-F-8785 required 0.07 of light aircraft.
void check_roll_power(Findings& f) {
  f.looked_at();
  const Airframe& a = f.file().airframe;
  const Derivatives& l = f.aero().roll;
  if (l.p_ratio >= 0 || l.aileron_ratio <= 0) return;
  const double helix = -l.aileron_ratio * a.aileron.limit_rad / l.p_ratio;
  const double rate = helix * 2 * a.limits.airspeed_cruise_mps / a.wing.span_m;
  f.figure("roll_helix_ratio", helix, "full aileron",
           "p b/2V " + figures(helix) + ", " + fixed(rate / degree, 0) + " deg/s at cruise");
  if (helix < 0.05)
    f.warn("aero.roll.aileron_ratio", l.aileron_ratio,
           aero_messages::roll_power_low(figures(helix), fixed(rate / degree, 0)));
}

/// Checks that the elevator reaches the angle of attack of maximum lift.
void check_pitch_power(Findings& f) {
  f.looked_at();
  const Airframe& a = f.file().airframe;
  const Derivatives& m = f.aero().pitch;
  if (m.elevator_ratio == 0 || m.alpha_ratio == 0) return;
  const double reach = std::abs(m.elevator_ratio * a.elevator.limit_rad / m.alpha_ratio);
  f.figure("elevator_reach_deg", reach / degree, "full elevator",
           degrees(reach, 1) + " of angle of attack either way");
  const double alpha = max_lift(a).alpha_rad,
               elevator = -(m.zero_ratio + m.alpha_ratio * alpha) / m.elevator_ratio;
  if (std::abs(elevator) > a.elevator.limit_rad)
    f.warn("aero.pitch.elevator_ratio", m.elevator_ratio,
           aero_messages::pitch_power_low(degrees(alpha, 1), degrees(elevator, 1),
                                          degrees(a.elevator.limit_rad, 1)));
}

void check_yaw_power(Findings& f) {
  f.looked_at();
  const Airframe& a = f.file().airframe;
  const Derivatives& n = f.aero().yaw;
  if (n.rudder_ratio >= 0 || n.beta_ratio <= 0) return;
  const double sideslip = -n.rudder_ratio * a.rudder.limit_rad / n.beta_ratio;
  f.figure("rudder_reach_deg", sideslip / degree, "full rudder", degrees(sideslip, 1) + " of sideslip");
  if (sideslip < 3 * degree)
    f.warn("aero.yaw.rudder_ratio", n.rudder_ratio, aero_messages::yaw_power_low(degrees(sideslip, 1)));
}

}  // namespace

void check_stability(Findings& f) {
  check_margin(f);
  check_roll_power(f);
  check_pitch_power(f);
  check_yaw_power(f);
}

}  // namespace fulmar::aero
