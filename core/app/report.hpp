// SPDX-License-Identifier: BSD-3-Clause
// Output of a flight for users and scripts: the progress line, the table, the JSON object.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/graph/graph.hpp"
#include "core/run/flight.hpp"
#include "core/run/verdict.hpp"

namespace fulmar::core {

std::string progress_line(const Graph& graph, const Flight& flight);
nlohmann::json result_json(const Graph& graph, const Flight& flight, const FlightResult& result);
std::string result_table(const Graph& graph, const Flight& flight, const FlightResult& result);

}  // namespace fulmar::core
