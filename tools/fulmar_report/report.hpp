// SPDX-License-Identifier: BSD-3-Clause
// Logs as one self-contained HTML file: figures and thinned messages inside the page of web/src/report.ts.
#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_log/figures.hpp"
#include "tools/fulmar_log/info.hpp"
#include "tools/fulmar_report/judged.hpp"
#include "tools/fulmar_report/topics.hpp"

namespace fulmar::report {

inline constexpr std::size_t max_logs = 6;  ///< number of distinct colours

/// All data of one log in a report.
struct ReportedLog {
  std::string name;
  core::LogInfo info;
  core::LogFigures figures;
  std::vector<ShownTopic> topics;
  std::vector<JudgedEstimate> estimates;
  std::vector<JudgedSeries> innovations;
  nlohmann::json ticks, parameters;  // null where the log has none
  nlohmann::json hardware;           // hardware.hpp; null in simulation
  nlohmann::json steps;              // of `fulmar run --json`, microseconds by component; or null
};

/// Throws core::Error for a file that is not a log.
ReportedLog read_log(const std::filesystem::path& log, const std::string& name, double rate_hz);

/// File names of the logs; with their folders where two are equal; else the paths as given.
std::vector<std::string> short_names(const std::vector<std::string>& logs);

/// JSON for the page (web/src/report/model.ts), with every n-th message of the streams.
std::string report_json(const std::vector<ReportedLog>& logs, std::size_t every_nth);

struct Fitted {
  std::string json;
  std::size_t every_nth = 1;
};
/// The least thinned JSON of at most `most_bytes`; at the limit every 64th message, of any size.
Fitted fitted_json(const std::vector<ReportedLog>& logs, std::size_t most_bytes);

/// `page` with the JSON in it. Throws Error for a page without a place for it.
std::string with_logs(const std::string& page, const std::string& json);

}  // namespace fulmar::report
