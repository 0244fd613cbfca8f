// SPDX-License-Identifier: BSD-3-Clause
// Where the files of a flight go: its log, and the report of it.
#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// "flight.mcap", 2 -> "flight-2.mcap".
std::filesystem::path numbered(const std::filesystem::path& file, std::size_t n);

/// Where the log goes. `held`: the name was chosen here, and no other run can take it.
struct LogName {
  std::filesystem::path file;
  bool held = false;
};

/// Throws Error.
void make_folder_of(const std::filesystem::path& file);

/// With a number when that is taken. Twenty flights that begin in one second all find a name.
LogName free_name(const std::filesystem::path& wanted);

/// logs/<mission>-<UTC>.mcap. A host that is started again in the air must not stand still before the log of
/// its predecessor. `another`: a file that the mission names gets a number when it is taken, as on hardware.
LogName default_log(const Graph& graph, const std::filesystem::path& folder, bool another);

/// Throws Error where `fulmar run --report=wanted` cannot make one. `wanted`: "" is beside the log.
void check_report(const std::string& wanted, const Graph& graph);

/// The report of the nth flight of a host: the log's name with .html, or as wanted from the folder `start`. A
/// file that is there is refused (Error), but with `another` it gets a neighbour: on hardware, where nothing
/// keeps the aircraft on the ground, and of a flight that follows another in its host.
std::filesystem::path report_name(const std::string& wanted, const std::filesystem::path& start,
                                  const std::filesystem::path& log, std::size_t nth, bool another);

/// Makes it, and names it unless `quiet`. False: it was not made, which is told; what flew has flown.
bool report_flight(const std::filesystem::path& file, const std::filesystem::path& log,
                   const nlohmann::json& result, bool quiet);

}  // namespace fulmar::core
