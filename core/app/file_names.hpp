// SPDX-License-Identifier: BSD-3-Clause
// Names of the files of a flight: its log and its report.
#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// "flight.mcap", 2 -> "flight-2.mcap".
std::filesystem::path numbered(const std::filesystem::path& file, std::size_t n);

/// Name of the log. `held`: this process chose the name and reserved it.
struct LogName {
  std::filesystem::path file;
  bool held = false;
};

/// Throws Error.
void make_folder_of(const std::filesystem::path& file);

/// Adds a number when the name is taken. Twenty flights that begin in the same second all get a name.
LogName free_name(const std::filesystem::path& wanted);

/// logs/<mission>-<UTC>.mcap. A host that restarts in the air must not stop because the previous log exists.
/// `another`: a name from the mission gets a number when it is taken, as on hardware.
LogName default_log(const Graph& graph, const std::filesystem::path& folder, bool another);

/// Throws Error when `fulmar run --report=wanted` cannot write a report. `wanted`: "" is beside the log.
void check_report(const std::string& wanted, const Graph& graph);

/// Name of the report of the nth flight of a host: the log's name with .html, or `wanted` relative to the
/// folder `start`. Throws Error when the file exists. With `another` the name gets a number instead: on
/// hardware, where the aircraft flies in any case, and for a flight that follows another in its host.
std::filesystem::path report_name(const std::string& wanted, const std::filesystem::path& start,
                                  const std::filesystem::path& log, std::size_t nth, bool another);

/// Writes the report and prints its name unless `quiet`. Returns false after a failure, which is reported;
/// the flight itself has succeeded.
bool report_flight(const std::filesystem::path& file, const std::filesystem::path& log,
                   const nlohmann::json& result, bool quiet);

}  // namespace fulmar::core
