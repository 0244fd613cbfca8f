// SPDX-License-Identifier: BSD-3-Clause
// Flight of the aircraft: trim from the stall to the top speed, its limits, and its modes in cruise.
#include <algorithm>
#include <cmath>

#include "tools/fulmar_aero/check/messages.hpp"
#include "tools/fulmar_aero/envelope.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/mode_words.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

bool flies(const AircraftModel& m, double airspeed) { return fly(m, {airspeed}).found(); }

void check_speeds(Findings& f, const AircraftModel& m) {
  const Airframe& a = f.file().airframe;
  const FlightLimits& l = a.limits;
  const double stall = stall_speed(m);
  f.looked_at(4);
  if (stall > 0) f.figure("stall_airspeed_mps", stall, "stall", fixed(stall, 1) + " m/s");
  if (stall > 0 && l.airspeed_min_mps < 1.05 * stall)
    f.warn("limits.airspeed_min_mps", l.airspeed_min_mps,
           aero_messages::minimum_airspeed_low(figures(l.airspeed_min_mps), fixed(stall, 1)));
  if (!flies(m, l.airspeed_cruise_mps)) return;
  const LevelSpeeds level = level_speeds(m, l.airspeed_cruise_mps);
  f.figure("slowest_airspeed_mps", level.slowest_mps, "slowest level flight",
           fixed(level.slowest_mps, 1) + " m/s");
  f.figure("fastest_airspeed_mps", level.fastest_mps, "fastest level flight",
           fixed(level.fastest_mps, 1) + " m/s");
}

/// Default of a limit that the file leaves out; "" for one in the file.
std::string defaulted(const Findings& f, const char* field, const std::string& value) {
  return f.file().says(field) ? "" : aero_messages::limit_defaulted(value).line();
}

void check_trim(Findings& f, const AircraftModel& m) {
  const FlightLimits& l = f.file().airframe.limits;
  const auto one = [&](const char* field, double airspeed) {
    f.looked_at();
    if (airspeed < 1) return;
    const SteadyFlight flight = fly(m, {airspeed});
    if (!flight.found())
      f.fault(field, airspeed,
              aero_messages::level_flight_impossible(figures(airspeed), limit_words(f.file(), m, flight),
                                                     defaulted(f, field, figures(airspeed) + " m/s")));
  };
  one("limits.airspeed_min_mps", l.airspeed_min_mps);
  one("limits.airspeed_cruise_mps", l.airspeed_cruise_mps);
  one("limits.airspeed_max_mps", l.airspeed_max_mps);
}

void check_cruise(Findings& f, const AircraftModel& m, const SteadyFlight& cruise) {
  const Airframe& a = f.file().airframe;
  const FlightForces forces = forces_of(m, cruise);
  f.looked_at(3);
  f.figure("cruise_lift_coefficient_ratio", forces.lift_ratio, "CL in cruise", figures(forces.lift_ratio));
  f.figure("cruise_lift_to_drag_ratio", forces.lift_newton / forces.drag_newton, "L/D in cruise",
           figures(forces.lift_newton / forces.drag_newton));
  if (forces.lift_ratio < 0.1 || forces.lift_ratio > 1.4)
    f.fault("limits.airspeed_cruise_mps", a.limits.airspeed_cruise_mps,
            aero_messages::cruise_lift_unusual(figures(forces.lift_ratio)));
  const double elevator = cruise.input(model::elevator), throttle = cruise.input(model::throttle);
  if (std::abs(elevator - a.elevator.trim_rad) > 0.1)
    f.warn("elevator.trim_rad", a.elevator.trim_rad,
           aero_messages::elevator_trim_unusual(degrees(a.elevator.trim_rad, 1), degrees(elevator, 1)));
  if (std::abs(throttle - a.limits.throttle_cruise_frac) > 0.15)
    f.warn("limits.throttle_cruise_frac", a.limits.throttle_cruise_frac,
           aero_messages::elevator_trim_unusual(figures(a.limits.throttle_cruise_frac), fixed(throttle, 2)));
}

void check_envelope(Findings& f, const AircraftModel& m) {
  const FlightLimits& l = f.file().airframe.limits;
  const double Va = l.airspeed_cruise_mps;
  const auto one = [&](const char* field, double value, const std::string& shown, const SteadyCondition& c) {
    f.looked_at();
    const SteadyFlight flight = fly(m, c);
    if (!flight.found())
      f.warn(field, value,
             aero_messages::flight_impossible(condition_words(c, m.altitude_m()),
                                              limit_words(f.file(), m, flight), defaulted(f, field, shown)));
  };
  const auto rate = [](double mps) { return figures(mps) + " m/s"; };
  one("limits.climb_rate_max_mps", l.climb_rate_max_mps, rate(l.climb_rate_max_mps),
      {Va, std::asin(std::clamp(l.climb_rate_max_mps / Va, -0.99, 0.99))});
  one("limits.sink_rate_max_mps", l.sink_rate_max_mps, rate(l.sink_rate_max_mps),
      {Va, -std::asin(std::clamp(l.sink_rate_max_mps / Va, -0.99, 0.99))});
  if (std::abs(l.roll_max_rad) < 1.4)
    one("limits.roll_max_rad", l.roll_max_rad, degrees(l.roll_max_rad, 0),
        {Va, 0, Turn::bank, l.roll_max_rad});
}

/// Requirements on a mode: the least damping of a pair, and the least time to double.
struct ModeWanted {
  ModeKind kind;
  const char* field;
  double damping_ratio, double_s;
  const char* else_what;
};
constexpr std::array<ModeWanted, 6> wanted{
    {{ModeKind::short_period, "aero.pitch", 0.3, 1e9, "the nose swings after every gust"},
     {ModeKind::phugoid, "aero.drag", 0, 15, "height and airspeed swing more and more without a control law"},
     {ModeKind::dutch_roll, "aero.yaw", 0.05, 1e9, "the tail wags"},
     {ModeKind::roll, "aero.roll", 0, 1e9, "rolling does not end by itself"},
     {ModeKind::spiral, "aero.roll", 0, 4, "it rolls into a turn by itself faster than a pilot likes"},
     {ModeKind::roll_spiral, "aero.roll", 0.05, 1e9, "roll and spiral swing together"}}};

void check_mode(Findings& f, const Mode& mode) {
  f.looked_at();
  const ModeWanted& want = wanted[std::size_t(mode.kind)];
  const std::string name = mode_name(mode.kind);
  if (!mode.stable() && mode.half_or_double_s() < want.double_s) {
    const auto sentence =
        aero_messages::mode_unstable(name, fixed(mode.half_or_double_s(), 2), want.else_what);
    const bool slow = mode.kind == ModeKind::phugoid || mode.kind == ModeKind::spiral;
    return slow ? f.warn(want.field, mode.eigenvalue.real(), sentence)
                : f.fault(want.field, mode.eigenvalue.real(), sentence);
  }
  if (mode.stable() && mode.oscillates() && mode.damping_ratio() < want.damping_ratio)
    f.warn(want.field, mode.damping_ratio(),
           aero_messages::mode_damping_low(name, fixed(mode.damping_ratio(), 3), figures(want.damping_ratio),
                                           want.else_what));
}

}  // namespace

void check_flight(Findings& f, double altitude_m) {
  const AircraftModel m(f.file().airframe, altitude_m);
  check_speeds(f, m);
  check_trim(f, m);
  const SteadyFlight cruise = fly(m, {f.file().airframe.limits.airspeed_cruise_mps});
  if (!cruise.found()) return;
  check_cruise(f, m, cruise);
  check_envelope(f, m);
  for (const Mode& mode : modes_in(m, cruise)) {
    const std::string number =
        mode.oscillates()
            ? fixed(mode.natural_radps(), 2) + " rad/s, damping " + fixed(mode.damping_ratio(), 3)
            : (mode.stable() ? "half in " : "doubles in ") + fixed(mode.half_or_double_s(), 2) + " s";
    f.figure("", 0, mode_name(mode.kind), number);
    check_mode(f, mode);
  }
}

}  // namespace fulmar::aero
