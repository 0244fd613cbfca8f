// SPDX-License-Identifier: BSD-3-Clause
// Command-line options of a flight condition.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "fulmar/flight/model/steady_flight.hpp"

namespace fulmar::aero {

/// --airspeed, --climb, --turn, --altitude, --json and the airframe. Values have units; an invalid one is a
/// CLI::ValidationError.
struct FlightOptions {
  std::string airframe, airspeed, climb, turn, altitude;
  bool json = false;

  void add(CLI::App* command, bool range_of_speeds = false);
  double altitude_m() const;
  SteadyCondition condition(const Airframe& a) const;
  /// "12..27 m/s" in steps of `step`, or one speed; the default is the airframe's cruise speed.
  std::vector<double> airspeeds(const Airframe& a, const std::string& step) const;

 private:
  void set_climb_and_turn(SteadyCondition& c) const;
};

}  // namespace fulmar::aero
