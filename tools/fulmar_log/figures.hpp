// SPDX-License-Identifier: BSD-3-Clause
// How a flight was flown, out of its log: the figures of its mission's `summary:`, and who flew when.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fulmar::core {

struct LogFigures {
  /// Under the names that `fulmar run --json` has; of each port what was recorded last. Empty for a log
  /// without a mission.
  nlohmann::json figures = nlohmann::json::object();

  /// The component whose output a topic is; "" when it is nobody's. `at_ns`: flight time.
  std::string owner(const std::string& topic, std::int64_t at_ns) const;

  struct Change {  // of who flies
    std::int64_t at_ns = 0;
    bool phase = false;
    std::string name, after;  // the phase; or the component that was stopped, and its fallback
  };
  std::vector<Change> changes;
  std::map<std::string, std::map<std::string, std::string>> assigned;  // phase, role -> component
  std::map<std::string, std::string> first;                            // role -> who fills it unless said
  std::vector<std::string> components;
};

/// Throws Error for what is no log.
LogFigures log_figures(const std::filesystem::path& log);

/// The results of `fulmar run --json`, or none when the file does not begin as one does. Throws Error for one
/// that is damaged.
nlohmann::json result_file(const std::filesystem::path& file);

}  // namespace fulmar::core
