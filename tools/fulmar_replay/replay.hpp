// SPDX-License-Identifier: BSD-3-Clause
// Replays a log with its mission, plugins and inputs, and compares the outputs.
#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/run/flight.hpp"
#include "tools/fulmar_replay/flown_plugins.hpp"
#include "tools/fulmar_replay/survey.hpp"

namespace fulmar::core {

/// A log that can be replayed.
class Recording {
 public:
  using Say = std::function<void(const std::string&, bool warning)>;

  /// Throws Error for a file that cannot be read or is no log of a flight.
  explicit Recording(const std::filesystem::path& log);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const Survey& survey() const { return survey_; }
  /// Options of the flight's command line that changed the mission.
  const Overrides& overrides() const { return overrides_; }

  /// The mission of the log with its plugin files: those of the installation when the content is the same,
  /// else the copies in the store. A missing file is replaced by the present one, with a warning.
  /// `changes`: --with and --set of an experiment, and --record. Throws Error.
  Graph mission(const Overrides& changes, const Say& say) const;
  /// Converts `changes` that name components to the role that has another file. Throws Error.
  Overrides by_component(const Overrides& changes) const;
  /// A file with that content and its own name. Throws Error when there is none.
  std::filesystem::path plugin(const FlownPlugin& flown) const;

 private:
  void read_overrides();
  void use_copies(Overrides& overrides, const std::vector<const FlownPlugin*>& wanted,
                  const Overrides& changes, const Say& say) const;

  std::filesystem::path path_;
  Survey survey_;
  Overrides overrides_;
  std::string mission_file_;
  std::vector<FlownPlugin> flown_;
  mutable std::filesystem::path folder_;  // of links to the store
};

struct ReplayOptions {
  Overrides changes;          // --with, --set
  std::filesystem::path out;  // the replay's own log
  bool compare = true;        // false: the replay is only for its log
  std::function<void(const Flight&)> progress;
  // called with the log of the replay before it is deleted
  std::function<void(const std::filesystem::path& log)> look;
  const std::atomic<bool>* stop = nullptr;  // requests the end: Error "interrupted"
};

struct Difference {
  std::string topic, field, was, is;
  std::int64_t at_ns = 0;
};

struct ReplayResult {
  FlightResult flight;
  std::uint64_t ticks = 0, recorded_ticks = 0;
  std::int64_t first_ns = 0, last_ns = 0;              // of the log
  std::uint64_t messages = 0, differing_messages = 0;  // of those that the log holds
  std::uint64_t differing_bytes = 0;
  std::optional<std::uint64_t> first_tick;  // first tick with different outputs
  std::int64_t first_tick_ns = 0;
  std::optional<Difference> first;  // first difference that the log shows
  bool same_file = false;           // both logs are equal byte by byte
  bool cut_off = false;             // the log has no end: compared up to its last complete tick
  std::vector<std::string> notes;   // reasons why the replay cannot be equal
  bool equal() const { return !first_tick && differing_messages == 0 && ticks == recorded_ticks; }
};

/// Runs the replay. `graph` is recording.mission(...). The flight is returned for its figures.
std::pair<std::unique_ptr<Flight>, ReplayResult> replay(const Recording& recording, const Graph& graph,
                                                        const ReplayOptions& options);

}  // namespace fulmar::core
