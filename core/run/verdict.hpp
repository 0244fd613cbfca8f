// SPDX-License-Identifier: BSD-3-Clause
// What a flight is called at its end.
#pragma once
#include <string>

#include "core/run/flight.hpp"

namespace fulmar::core {

/// Not begun: nothing has come from one of the roles, and the aircraft has never left the ground.
bool has_begun(const FlightResult& result);
/// flown, flown with guards, aborted, not begun, failed, interrupted
const char* result_word(const FlightResult& result);
/// What ended it, and which role stayed silent where it has not begun.
std::string reason_of(const FlightResult& result);
/// One line: "crashed: left wing tip touched ...". What the mission's `verdict:` says follows the result's
/// word, and its own word takes the place of "failed".
std::string verdict_line(const Graph& graph, const Flight& flight, const std::string& result_word);
std::string verdict_of(const Graph& graph, const Flight& flight, const FlightResult& result);

}  // namespace fulmar::core
