// SPDX-License-Identifier: BSD-3-Clause
// See report.hpp.
#include "tools/fulmar_report/report.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.hpp"
#include "tools/fulmar_report/hardware.hpp"
#include "tools/fulmar_report/messages.hpp"

namespace fulmar::report {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::string_view place = "LOG_OF_THE_FLIGHT";
constexpr std::size_t max_rows = 2000, min_rows = 300;  // of an error curve
constexpr std::size_t max_reported = 100;               // events
constexpr std::size_t thinnest = 64;

double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

json metadata_of(const core::McapFile& log) {
  json all = json::object();
  for (const auto& m : log.metadata)
    for (const auto& [key, value] : m.pairs) all[m.name][key] = value;
  return all;
}

/// Parameter records of places on the ground: geofence, landing places, runway, and their origin.
json ground_records(const json& parameters) {
  json records = json::array();
  if (!parameters.is_object()) return records;
  for (const auto& [component, params] : parameters.items())
    for (const auto& [name, value] : params.items()) {
      if (value.contains("runway"))
        records.push_back({{"runway", value["runway"]}});
      else if (value.contains("corners") || value.contains("places") || value.contains("length_m") ||
               value.contains("given"))
        records.push_back(value);
    }
  return records;
}

/// Guards, failsafe, swaps, parameters, and events of severity warning or higher.
bool is_reported(const core::LogInfo::Event& e) {
  static const std::set<std::string> kinds{"guard", "failsafe", "swap", "parameter", "resume"};
  return kinds.contains(e.kind) || (!e.severity.empty() && e.severity != "info");
}

json reported_events(const core::LogInfo& info) {
  json rows = json::array();
  std::size_t all = 0;
  for (const core::LogInfo::Event& e : info.events) {
    if (!is_reported(e)) continue;
    if (++all <= max_reported)
      rows.push_back({{"t", seconds(e.time_ns)},
                      {"kind", e.kind},
                      {"component", e.component},
                      {"severity", e.severity},
                      {"words", e.text}});
  }
  return {{"rows", std::move(rows)}, {"all", all}};
}

json phases_of(const core::LogInfo& info) {
  json rows = json::array();
  for (const core::LogInfo::Phase& p : info.phases)
    rows.push_back({{"name", p.name},
                    {"from_s", seconds(p.begin_ns)},
                    {"to_s", seconds(p.end_ns)},
                    {"because", p.because}});
  return rows;
}

json verdict_of(const core::LogInfo& info) {
  return {{"words", info.verdict.words}, {"severity", info.verdict.severity}};
}

json log_json(const ReportedLog& log, std::size_t every_nth) {
  const std::size_t rows = std::max(min_rows, max_rows / every_nth);
  json topics = json::array(), estimates = json::array(), sensors = json::array();
  for (const ShownTopic& t : log.topics) topics.push_back(topic_json(t, every_nth));
  for (const JudgedEstimate& e : log.estimates) estimates.push_back(judged_json(e, rows));
  for (const JudgedSeries& s : log.innovations) sensors.push_back(judged_json(s, rows));
  const json metadata = metadata_of(log.info.file);
  return {{"name", log.name},
          {"mission", log.info.value("fulmar", "mission")},
          {"begin_s", seconds(log.info.begin_ns)},
          {"end_s", seconds(log.info.end_ns)},
          {"bytes", log.info.bytes},
          {"messages", log.info.messages},
          {"fault", log.info.file.fault},
          {"verdict", verdict_of(log.info)},
          {"metadata", metadata},
          {"figures", log.figures.figures},
          {"phases", phases_of(log.info)},
          {"told", reported_events(log.info)},
          {"estimates", std::move(estimates)},
          {"innovations", std::move(sensors)},
          {"hardware", log.hardware},
          {"ticks", log.ticks},
          {"steps", log.steps},
          {"ground", ground_records(log.parameters)},
          {"topics", std::move(topics)}};
}

/// Rows of a name and a value per log; null for a log without it. Empty for one log.
json parameters_that_differ(const std::vector<ReportedLog>& logs) {
  std::map<std::string, std::vector<json>> all;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (!logs[i].parameters.is_object()) continue;
    for (const auto& [component, params] : logs[i].parameters.items()) {
      if (!params.is_object()) continue;
      for (const auto& [name, value] : params.items()) {
        std::vector<json>& row = all[component + "." + name];
        row.resize(logs.size());
        row[i] = value;
      }
    }
  }
  json rows = json::array();
  for (const auto& row : all) {
    const std::vector<json>& values = row.second;
    const bool equal =
        std::all_of(values.begin(), values.end(), [&](const json& v) { return v == values.front(); });
    if (!equal) rows.push_back({{"name", row.first}, {"values", values}});
  }
  return rows;
}

}  // namespace

ReportedLog read_log(const fs::path& file, const std::string& name, double rate_hz) {
  ReportedLog log;
  log.name = name;
  log.info = core::read_info(file);
  log.figures = core::log_figures(file);
  const states::StateLog states = states::look_for_states(file);
  std::vector<std::string> truths;
  for (const auto& truth : states.truths) truths.push_back(truth.name);
  log.topics = shown_topics(file, states.epoch_ns, rate_hz, truths);
  log.estimates = judged_estimates(states);
  log.innovations = innovations(states);
  log.hardware = hardware_of(file);
  log.ticks = tick_times(file);
  const core::McapFile::Attachment* const parameters = log.info.file.attachment("parameters.json");
  if (parameters) log.parameters = json::parse(parameters->content, nullptr, false);
  return log;
}

std::vector<std::string> short_names(const std::vector<std::string>& logs) {
  const auto differ = [](const std::vector<std::string>& names) {
    return std::set<std::string>(names.begin(), names.end()).size() == names.size();
  };
  std::vector<std::string> names, longer;
  for (const std::string& log : logs) {
    const fs::path file(log);
    names.push_back(file.filename().string());
    longer.push_back((file.parent_path().filename() / file.filename()).string());
  }
  return differ(names) ? names : differ(longer) ? longer : logs;
}

std::string report_json(const std::vector<ReportedLog>& logs, std::size_t every_nth) {
  json all = json::array();
  for (const ReportedLog& log : logs) all.push_back(log_json(log, every_nth));
  const json whole{{"logs", std::move(all)}, {"parameters", parameters_that_differ(logs)}};
  return whole.dump(-1, ' ', false, json::error_handler_t::replace);
}

Fitted fitted_json(const std::vector<ReportedLog>& logs, std::size_t most_bytes) {
  for (std::size_t n = 1;; n *= 2)
    if (Fitted f{report_json(logs, n), n}; f.json.size() <= most_bytes || n >= thinnest) return f;
}

/// Escapes `<`, so that no text of the log ends its element.
std::string with_logs(const std::string& page, const std::string& json_text) {
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw core::Error(report_messages::page_version_mismatch());
  std::string safe;
  safe.reserve(json_text.size());
  for (const char c : json_text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return page.substr(0, at) + safe + page.substr(at + place.size());
}

}  // namespace fulmar::report
