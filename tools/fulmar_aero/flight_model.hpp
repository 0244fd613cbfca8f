// SPDX-License-Identifier: BSD-3-Clause
// The SDK's flight mechanics, compiled once: its derivatives and eigenvectors take long to compile.
#pragma once
#include <vector>

#include "fulmar/flight/model/linear_model.hpp"
#include "fulmar/flight/model/modes.hpp"
#include "fulmar/flight/model/steady_flight.hpp"

namespace fulmar::aero {

SteadyFlight fly(const AircraftModel& model, const SteadyCondition& condition);
LinearModel linearised(const AircraftModel& model, const SteadyFlight& flight);
std::vector<Mode> modes_in(const AircraftModel& model, const SteadyFlight& flight);
std::vector<Mode> modes_in(const LinearModel& linear);

}  // namespace fulmar::aero
