// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/options.hpp"

#include <cmath>

#include "core/graph/quantity.hpp"
#include "tools/fulmar_aero/messages.hpp"

namespace fulmar::aero {
namespace {

constexpr std::size_t max_speeds = 500;

/// A number in `unit`, which is the default unit.
double in_unit(const char* option, const std::string& text, const std::string& unit) {
  try {
    return core::quantity_in(text, unit, core::UnitRule::optional);
  } catch (const core::Error& fault) {
    throw CLI::ValidationError(option, fault.what());
  }
}

/// True when the text has a unit of that dimension; a number without a unit has none.
bool is_in(const char* option, const std::string& text, const std::string& unit) {
  try {
    const core::Quantity quantity = core::parse_quantity(text);
    return !quantity.unit.empty() && core::same_dimension(quantity.unit, unit);
  } catch (const core::Error& fault) {
    throw CLI::ValidationError(option, fault.what());
  }
}

double positive_speed(const std::string& text) {
  const double speed = in_unit("--airspeed", text, "m/s");
  if (!(speed >= 1 && speed <= 200))
    throw CLI::ValidationError("--airspeed", aero_messages::airspeed_out_of_range(text).line());
  return speed;
}

}  // namespace

void FlightOptions::add(CLI::App* command, bool range_of_speeds) {
  command->add_option("AIRFRAME", airframe, "airframe file, or fulmar:airframes/anaconda.yaml")->required();
  command->add_option("--airspeed", airspeed,
                      range_of_speeds
                          ? "set true airspeed, or a range as in \"12..27 m/s\"; default: cruise airspeed"
                          : "set true airspeed, as in \"17 m/s\"; default: cruise airspeed");
  command->add_option("--climb", climb,
                      "set climb angle or rate, as in \"5 deg\" or \"2 m/s\"; default: level flight");
  command->add_option(
      "--turn", turn,
      "set bank angle or radius of a right turn, as in \"30 deg\" or \"80 m\"; default: straight");
  command->add_option("--altitude", altitude,
                      "set the altitude above mean sea level in the standard atmosphere; default 0 m");
  command->add_flag("--json", json, "print one JSON object");
}

double FlightOptions::altitude_m() const {
  const double metres = altitude.empty() ? 0 : in_unit("--altitude", altitude, "m");
  if (!(metres >= -1000 && metres <= 20000))
    throw CLI::ValidationError("--altitude", aero_messages::altitude_out_of_range(altitude).line());
  return metres;
}

SteadyCondition FlightOptions::condition(const Airframe& a) const {
  SteadyCondition c;
  c.airspeed_mps = airspeed.empty() ? a.limits.airspeed_cruise_mps : positive_speed(airspeed);
  set_climb_and_turn(c);
  return c;
}

void FlightOptions::set_climb_and_turn(SteadyCondition& c) const {
  if (!climb.empty()) {
    const bool angle = is_in("--climb", climb, "rad");
    if (!angle && !is_in("--climb", climb, "m/s"))
      throw CLI::ValidationError("--climb", aero_messages::climb_unit_invalid(climb).line());
    const double value = in_unit("--climb", climb, angle ? "rad" : "m/s");
    c.climb_rad = angle ? value : std::asin(std::clamp(value / c.airspeed_mps, -1.0, 1.0));
    if (std::abs(c.climb_rad) > 1.4)
      throw CLI::ValidationError("--climb", aero_messages::climb_too_steep(climb).line());
  }
  if (turn.empty()) return;
  const bool bank = is_in("--turn", turn, "rad");
  if (!bank && !is_in("--turn", turn, "m"))
    throw CLI::ValidationError("--turn", aero_messages::turn_unit_invalid(turn).line());
  c.turn_by = in_unit("--turn", turn, bank ? "rad" : "m");
  c.turn = bank ? Turn::bank : Turn::radius;
  if (bank ? std::abs(c.turn_by) > 1.4 : std::abs(c.turn_by) < 1)
    throw CLI::ValidationError("--turn", aero_messages::turn_out_of_range(turn).line());
  if (bank && c.turn_by == 0) c.turn = Turn::none;
}

std::vector<double> FlightOptions::airspeeds(const Airframe& a, const std::string& step) const {
  const std::size_t dots = airspeed.find("..");
  if (dots == std::string::npos) return {condition(a).airspeed_mps};
  const std::string last = airspeed.substr(dots + 2), first = airspeed.substr(0, dots);
  // "12..27 m/s": the unit follows both numbers
  std::string unit;
  try {
    unit = core::parse_quantity(last).unit;
  } catch (const core::Error& fault) {
    throw CLI::ValidationError("--airspeed", fault.what());
  }
  const bool bare = first.find_first_not_of("0123456789.+- ") == std::string::npos;
  const double from = positive_speed(bare && !unit.empty() ? first + " " + unit : first);
  const double to = positive_speed(last), by = step.empty() ? 1 : in_unit("--step", step, "m/s");
  if (from > to)
    throw CLI::ValidationError("--airspeed", aero_messages::airspeed_range_reversed(airspeed).line());
  if (!(by > 0) || (to - from) / by > double(max_speeds))
    throw CLI::ValidationError("--step", aero_messages::speed_step_invalid(max_speeds).line());
  std::vector<double> speeds;
  for (int i = 0; from + i * by <= to + 1e-9 * by; ++i) speeds.push_back(from + i * by);
  return speeds;
}

}  // namespace fulmar::aero
