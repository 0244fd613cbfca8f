// SPDX-License-Identifier: BSD-3-Clause
// Flights of one mission in one host: the current graph and the results of the previous flights.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/app/file_names.hpp"
#include "core/app/file_stamps.hpp"
#include "core/app/run_options.hpp"
#include "core/graph/graph.hpp"
#include "core/run/flight.hpp"

namespace fulmar::core {

class Progress;

class Session {
 public:
  /// Loads the mission. Throws Error. `options` must outlive the object.
  explicit Session(const RunOptions& options);

  /// Runs a flight and returns its exit code. Keeps the previous mission and returns nothing when the changed
  /// files cannot fly. Throws Error.
  std::optional<int> try_fly();
  /// Whether the last flight ended with a request for another one.
  bool restarts() const { return restart_.has_value(); }
  /// Runs the requested flight, with the mission as its files are now, on the same port.
  std::optional<int> fly_again();

  void set_seed(std::uint64_t seed);
  /// Files of the mission and its plugins, from the first flight on.
  FileStamps& stamps() { return *stamps_; }
  /// Loads the mission again. Returns false when it is rejected; the previous mission stays.
  bool reload(const std::vector<std::filesystem::path>& changed);
  /// Applies the changes since the last flight, if any.
  void take_changes();

  const Graph& graph() const { return graph_; }
  const std::vector<nlohmann::json>& results() const { return results_; }  ///< as result_json makes them

 private:
  Graph load() const;
  LogName log_name() const;
  std::filesystem::path report_file(const std::filesystem::path& log) const;
  std::optional<Resume> resume() const;
  bool unpaced() const { return graph_.io == Io::sim && options_.speed == 0; }
  void take_priority() const;
  void report_log(const std::filesystem::path& log) const;
  void report_clients() const;
  FlightOptions flight_options() const;
  void add_output(FlightOptions& options, Progress& progress) const;
  FlightResult fly_with(const FlightOptions& options);
  int fly();
  void print(const FlightResult& result, bool alone) const;
  int code_of(const FlightResult& result) const;
  bool guarded(const FlightResult& result) const { return options_.strict && !result.guards.empty(); }
  std::vector<std::filesystem::path> files() const;
  void rehearse_changes(const Graph& next) const;
  void forget_before();

  const RunOptions& options_;
  const std::filesystem::path start_;  // the working directory in which the program was started
  std::uint16_t port_ = 0;             // port of the previous flight for its restart; 0: none
  Graph graph_;
  std::unique_ptr<Graph> before_;  // until a flight with the changed files has begun
  std::unique_ptr<Flight> last_;   // its recorded inputs are the rehearsal of a changed plugin
  std::vector<nlohmann::json> results_;
  std::optional<Restart> restart_;     // requested by the last flight
  std::optional<std::uint64_t> seed_;  // seed of a flight, if requested
  std::unique_ptr<FileStamps> stamps_;
};

/// The worse of two exit codes of several flights: a failed flight outweighs one whose guards stopped a
/// component.
int worse(int a, int b);

}  // namespace fulmar::core
