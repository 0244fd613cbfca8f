// SPDX-License-Identifier: BSD-3-Clause
// Flights of one mission in one host: the graph that flies now, and the results of the flights before.
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
  /// Loads the mission. Throws Error. `options` outlive it.
  explicit Session(const RunOptions& options);

  /// A flight; the exit code. With changed files that cannot fly, the mission of before stays, and the result
  /// is empty. Throws Error.
  std::optional<int> try_fly();
  /// Whether the last flight has ended so that another one begins.
  bool restarts() const { return restart_.has_value(); }
  /// That other one, with the mission as its files are now, on the same port.
  std::optional<int> fly_again();

  void set_seed(std::uint64_t seed);
  /// Files of the mission and its plugins, from the first flight on.
  FileStamps& stamps() { return *stamps_; }
  /// Loads the mission again. False: it is refused, and the mission of before stays.
  bool reload(const std::vector<std::filesystem::path>& changed);
  /// Uses what has changed since the last flight, if anything has.
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
  void report_onlookers() const;
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
  std::uint16_t port_ = 0;             // where a flight listened that has made room for another; 0: none has
  Graph graph_;
  std::unique_ptr<Graph> before_;  // until a flight with the newcomers has begun
  std::unique_ptr<Flight> last_;   // what its components saw is what a newcomer is rehearsed on
  std::vector<nlohmann::json> results_;
  std::optional<Restart> restart_;     // asked of the last flight
  std::optional<std::uint64_t> seed_;  // asked for with one
  std::unique_ptr<FileStamps> stamps_;
};

/// Of the exit codes of several flights: one that failed outweighs one whose guards fired.
int worse(int a, int b);

}  // namespace fulmar::core
