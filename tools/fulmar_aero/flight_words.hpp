// SPDX-License-Identifier: BSD-3-Clause
// Texts of a steady flight: its description, and the reason when there is none.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "fulmar/flight/model/steady_flight.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"

namespace fulmar::aero {

/// "steady level flight at 17 m/s, 0 m above the sea"
std::string condition_words(const SteadyCondition& c, double altitude_m);

/// "the wing would have to carry ...", with the place of the limit.
std::string limit_words(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& flight);

/// "anaconda: no steady level flight at 8 m/s, 0 m above the sea: ..."
std::string no_flight(const AirframeFile& file, const AircraftModel& model, const SteadyFlight& flight);

/// Forces of a steady flight, in the axes of the airflow.
struct FlightForces {
  double lift_newton = 0, drag_newton = 0, side_newton = 0, thrust_newton = 0, torque_nm = 0;
  double lift_ratio = 0, drag_ratio = 0;  ///< CL, CD
  double load_factor = 0;
};
FlightForces forces_of(const AircraftModel& model, const SteadyFlight& flight);

nlohmann::json flight_json(const AircraftModel& model, const SteadyFlight& flight);

}  // namespace fulmar::aero
