// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/flight_model.hpp"

namespace fulmar::aero {

SteadyFlight fly(const AircraftModel& model, const SteadyCondition& condition) {
  return steady_flight(model, condition);
}

LinearModel linearised(const AircraftModel& model, const SteadyFlight& flight) {
  return linear_model(model, flight.x, flight.input);
}

std::vector<Mode> modes_in(const AircraftModel& model, const SteadyFlight& flight) {
  return modes_of(linearised(model, flight));
}

std::vector<Mode> modes_in(const LinearModel& linear) { return modes_of(linear); }

}  // namespace fulmar::aero
