// SPDX-License-Identifier: BSD-3-Clause
// Logs as one HTML file that a browser shows without anything else: their figures, and their messages,
// thinned out, inside the page that is built for it (web/src/report.ts).
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

inline constexpr std::size_t max_logs = 6;  ///< so many colours can be told apart

/// All that a report says of one log.
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

/// Throws core::Error for what is no log.
ReportedLog read_log(const std::filesystem::path& log, const std::string& name, double rate_hz);

/// What each is called: the names of the files; with their folders where two would be alike; else as given.
std::vector<std::string> short_names(const std::vector<std::string>& logs);

/// What the page reads, JSON (web/src/report/model.ts). Of the streams only every n-th message.
std::string report_json(const std::vector<ReportedLog>& logs, std::size_t every_nth);

struct Fitted {
  std::string json;
  std::size_t every_nth = 1;
};
/// The least thinned that has at most `most_bytes`; when nothing helps, what is left at every 64th message.
Fitted fitted_json(const std::vector<ReportedLog>& logs, std::size_t most_bytes);

/// `page` with the JSON in it. Throws Error when the page has no place for it.
std::string with_logs(const std::string& page, const std::string& json);

}  // namespace fulmar::report
