// SPDX-License-Identifier: BSD-3-Clause
// Results of a flight from its log: the figures of its mission's `summary:`, and the active components over
// time.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fulmar::core {

struct LogFigures {
  /// Figures with the names of `fulmar run --json`, from the last recorded message of each port. Empty for a
  /// log without a mission.
  nlohmann::json figures = nlohmann::json::object();

  /// Component with this output topic; "" for none. `at_ns`: flight time.
  std::string owner(const std::string& topic, std::int64_t at_ns) const;

  struct Change {  // of the active component
    std::int64_t at_ns = 0;
    bool phase = false;
    std::string name, after;  // the phase; or the component that was stopped, and its fallback
  };
  std::vector<Change> changes;
  std::map<std::string, std::map<std::string, std::string>> assigned;  // phase, role -> component
  std::map<std::string, std::string> first;                            // role -> default component
  std::vector<std::string> components;
};

/// Throws Error for a file that is no log.
LogFigures log_figures(const std::filesystem::path& log);

/// The results of `fulmar run --json`; none when the file does not begin like a result. Throws Error for a
/// damaged one.
nlohmann::json result_file(const std::filesystem::path& file);

}  // namespace fulmar::core
