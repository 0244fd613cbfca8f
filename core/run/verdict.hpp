// SPDX-License-Identifier: BSD-3-Clause
// The outcome of a flight in words.
#pragma once
#include <string>

#include "core/run/flight.hpp"

namespace fulmar::core {

/// Not begun: one of the roles has had no output, and the aircraft has never left the ground.
bool has_begun(const FlightResult& result);
/// flown, flown with guards, aborted, not begun, failed, interrupted
const char* result_word(const FlightResult& result);
/// Cause of the end; when it has not begun, the role without an output.
std::string reason_of(const FlightResult& result);
/// One line: "crashed: left wing tip touched ...". The text of the mission's `verdict:` follows the result's
/// word, and its own word replaces "failed".
std::string verdict_line(const Graph& graph, const Flight& flight, const std::string& result_word);
std::string verdict_of(const Graph& graph, const Flight& flight, const FlightResult& result);

}  // namespace fulmar::core
