// SPDX-License-Identifier: BSD-3-Clause
// See log_command.hpp.
#include "tools/fulmar_log/log_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "tools/fulmar_log/compare_command.hpp"
#include "tools/fulmar_log/diff_command.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/info.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/recover.hpp"
#include "tools/fulmar_log/terminal.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t shown = 20;  // lines of a list, unless all are requested

double rate_hz(const LogInfo::Topic& t) {
  return t.messages > 1 && t.last_ns > t.first_ns
             ? static_cast<double>(t.messages - 1) / seconds(t.last_ns - t.first_ns)
             : 0;
}
/// 0 for a log that is too short.
double per_minute(const LogInfo& info, double bytes) {
  return info.minutes() > 0 ? bytes / 1e6 / info.minutes() : 0;
}

std::string ending(const McapFile& file) { return file.complete ? "complete" : "cut off: " + file.fault; }

std::string counted(std::uint64_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// "2026-01-01T00:00:00Z" of nanoseconds since 1970, as the log's metadata have them.
std::string utc_text(const std::string& words) {
  std::int64_t ns = 0;
  if (std::from_chars(words.data(), words.data() + words.size(), ns).ec != std::errc{} || ns < 0)
    return words;
  const std::time_t whole = ns / 1'000'000'000;
  std::tm utc{};
  char text[32];
  if (gmtime_r(&whole, &utc) == nullptr || std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc) == 0)
    return words;
  const std::string fraction = ns % 1'000'000'000 == 0 ? "" : seconds_text(ns % 1'000'000'000).substr(1);
  return text + fraction + "Z";
}

// ---- info

json topics_json(const LogInfo& info) {
  json topics = json::array();
  for (const LogInfo::Topic& t : info.topics) {
    topics.push_back({{"topic", t.topic},
                      {"type", t.type},
                      {"messages", t.messages},
                      {"rate_hz", rate_hz(t)},
                      {"bytes", t.bytes},
                      {"stored_bytes_estimate", static_cast<std::uint64_t>(t.stored_bytes)},
                      {"stored_mb_per_minute_estimate", per_minute(info, t.stored_bytes)}});
  }
  return topics;
}

json info_json(const LogInfo& info) {
  json o{{"profile", info.file.profile},
         {"library", info.file.library},
         {"bytes", info.bytes},
         {"mb_per_minute", per_minute(info, static_cast<double>(info.bytes))},
         {"messages", info.messages},
         {"chunks", info.file.chunks},
         {"complete", info.file.complete},
         {"fault", info.file.fault.empty() ? json(nullptr) : json(info.file.fault)},
         {"verdict", info.verdict.words.empty() ? json(nullptr) : json(info.verdict.words)},
         {"begin_s", seconds(info.begin_ns)},
         {"end_s", seconds(info.end_ns)},
         {"duration_s", seconds(info.end_ns - info.begin_ns)},
         {"topics", topics_json(info)}};
  o["metadata"] = json::object();
  for (const McapFile::Metadata& m : info.file.metadata)
    for (const auto& [key, value] : m.pairs) o["metadata"][m.name][key] = value;
  o["attachments"] = json::array();
  for (const McapFile::Attachment& a : info.file.attachments)
    o["attachments"].push_back({{"name", a.name}, {"media_type", a.media_type}, {"bytes", a.content.size()}});
  o["phases"] = json::array();
  for (const LogInfo::Phase& p : info.phases)
    o["phases"].push_back({{"name", p.name}, {"begin_s", seconds(p.begin_ns)}, {"end_s", seconds(p.end_ns)}});
  o["events"] = json::array();
  for (const LogInfo::Event& e : info.events)
    o["events"].push_back(
        {{"time_s", seconds(e.time_ns)}, {"kind", e.kind}, {"component", e.component}, {"text", e.text}});
  return o;
}

/// The plugins of the flight, one line each, from the pairs "slc.file", "slc.version", ...
std::vector<std::pair<std::string, std::string>> shown_pairs(const McapFile::Metadata& m) {
  if (m.name != "plugins") return m.pairs;
  std::vector<std::pair<std::string, std::string>> list;
  for (const auto& [key, value] : m.pairs) {
    const std::string component = key.substr(0, key.rfind('.'));
    if (list.empty() || list.back().first != component) list.emplace_back(component, "");
    list.back().second += (list.back().second.empty() ? "" : " ") +
                          std::string(key.ends_with(".build_id") ? "build " : "") + value;
  }
  return list;
}

void print_head(const LogInfo& info, const std::string& file) {
  std::printf("%s: %s, %.1f MB, %s\n", file.c_str(), printable(info.file.library).c_str(),
              static_cast<double>(info.bytes) / 1e6, printable(ending(info.file)).c_str());
  std::printf("%s in %s, flight time %.3f s to %.3f s", counted(info.messages, "message").c_str(),
              counted(info.file.chunks, "chunk").c_str(), seconds(info.begin_ns), seconds(info.end_ns));
  if (info.minutes() > 0)
    std::printf(", %.2f MB per flight minute", per_minute(info, static_cast<double>(info.bytes)));
  std::printf("\n");
  for (const McapFile::Metadata& m : info.file.metadata) {
    if (!m.pairs.empty()) std::printf("\n%s\n", printable(m.name).c_str());
    for (const auto& [key, value] : shown_pairs(m)) {
      const bool epoch = key == "epoch_ns";
      std::printf("  %-20s %s\n", epoch ? "epoch" : printable(key).c_str(),
                  epoch ? utc_text(value).c_str() : printable(value).c_str());
    }
  }
}

void print_events(const LogInfo& info) {
  if (!info.phases.empty()) std::printf("\nphases\n");
  for (const LogInfo::Phase& p : info.phases)
    std::printf("  %-20s %9.1f s to %.1f s\n", printable(p.name).c_str(), seconds(p.begin_ns),
                seconds(p.end_ns));
  std::size_t count = 0;
  for (const LogInfo::Event& e : info.events) {
    if (e.kind == "phase") continue;
    if (count == 0) std::printf("\nevents\n");
    if (++count <= shown)
      std::printf("  %9.3f s  %-8s %-12s %s\n", seconds(e.time_ns), printable(e.kind).c_str(),
                  printable(e.component).c_str(), printable(e.text).c_str());
  }
  if (count > shown) std::printf("  and %zu more: --json tells all\n", count - shown);
}

void print_topics(const LogInfo& info) {
  std::printf("\n%-28s %9s %8s %9s  %s\n", "topic", "messages", "Hz", "raw MB",
              "MB per flight minute in the file");
  for (const LogInfo::Topic& t : info.topics) {
    std::printf("%-28s %9llu %8.1f %9.2f  %.3f\n", printable(t.topic).c_str(),
                static_cast<unsigned long long>(t.messages), rate_hz(t), static_cast<double>(t.bytes) / 1e6,
                per_minute(info, t.stored_bytes));
  }
  if (!info.file.attachments.empty()) std::printf("\nattachments\n");
  for (const McapFile::Attachment& a : info.file.attachments)
    std::printf("  %-28s %zu bytes\n", printable(a.name).c_str(), a.content.size());
}

int info_command(const std::string& file, bool as_json) {
  const LogInfo info = read_info(file);
  if (as_json) {
    print_json(info_json(info));
    return 0;
  }
  print_head(info, file);
  print_events(info);
  print_topics(info);
  return 0;
}

// ---- recover

/// "a.mcap.part" -> "a.mcap"; "a.mcap" -> "a-recovered.mcap"
std::string recovered_name(const fs::path& file) {
  if (file.extension() == ".part") return (file.parent_path() / file.stem()).string();
  return (file.parent_path() / (file.stem().string() + "-recovered" + file.extension().string())).string();
}

int recover_command(const std::string& file, std::string out) {
  if (out.empty()) out = recovered_name(file);
  // OUT.part is also the writer's temporary name: the result then gets another name first.
  const bool own_part = fs::path(out + ".part") == fs::path(file);
  if (own_part && fs::exists(out)) throw Error(log_tool_messages::log_exists(out));
  const std::string first = own_part ? out + ".recovered" : out;
  const Recovery r = recover_log(file, first);
  if (!r.written.error.empty()) throw Error(r.written.error);
  std::string name = r.written.file.string();
  if (own_part) {
    fs::rename(name, out);
    name = out;
  }
  std::printf("%s: %s in %.1f MB.", name.c_str(), counted(r.written.messages, "message").c_str(),
              static_cast<double>(r.written.bytes) / 1e6);
  if (r.was_whole) std::printf(" '%s' is complete; nothing was lost.", file.c_str());
  if (const std::string left_out = r.left_out_text(); !left_out.empty())
    std::printf(" Left out: %s.", left_out.c_str());
  if (!r.fault.empty()) std::printf(" Reading ended at %s.", printable(r.fault).c_str());
  std::printf("\n");
  return 0;
}

// ---- export

int export_command(const std::string& file, const std::string& to, const std::string& out,
                   const std::vector<std::string>& topics) {
  const ExportForm form = to == "csv" ? ExportForm::csv : to == "npz" ? ExportForm::npz : ExportForm::mat;
  const ExportResult result = export_log(file, form, out, topics);
  std::uint64_t rows = 0;
  for (const ExportResult::Topic& t : result.topics) rows += t.rows;
  std::printf("%s: %s, %s.\n", result.out.string().c_str(), counted(result.topics.size(), "topic").c_str(),
              counted(rows, "message").c_str());
  for (const std::string& why : result.left_out)
    std::fprintf(stderr, "left out: %s\n", printable(why).c_str());
  if (!result.fault.empty())
    std::fprintf(stderr, "the log is cut off: %s\n", printable(result.fault).c_str());
  return 0;
}

}  // namespace

struct LogCommand::Impl {
  CLI::App *log, *info, *recover, *to_files, *diff, *compare;
  std::string file, other, out, form;
  std::vector<std::string> topics;
  bool as_json = false, messages_only = false;
  states::CompareArguments comparison;

  explicit Impl(CLI::App& app) {
    log = app.add_subcommand("log", "inspect, repair, export and compare logs");
    log->require_subcommand(1);
    log->footer("Example: fulmar log export logs/hourglass.mcap --to npz --topic /nav/state");
    info = log->add_subcommand("info", "print contents and size per topic");
    info->add_option("FILE", file, "log")->required();
    info->add_flag("--json", as_json, "print one JSON object");
    info->footer("Example: fulmar log info logs/hourglass.mcap");
    recover = log->add_subcommand("recover", "recover a truncated or damaged log");
    recover->add_option("FILE", file, "truncated or damaged log")->required();
    recover->add_option("--out", out, "write the log to FILE; default: the name without .part")
        ->type_name("FILE");
    recover->footer("Example: fulmar log recover logs/hourglass.mcap.part");
    to_files = log->add_subcommand("export", "export a log as CSV, NPZ or MAT");
    to_files->add_option("FILE", file, "log")->required();
    to_files
        ->add_option("--to", form,
                     "set the format: csv, one file per topic; npz for NumPy; mat for MATLAB and Octave")
        ->required()
        ->check(CLI::IsMember({"csv", "npz", "mat"}));
    to_files
        ->add_option("--out", out,
                     "write to FILE, or to FOLDER for CSV; default: the log's name in the current directory")
        ->type_name("FILE");
    to_files->add_option("--topic", topics, "export only TOPIC, as in /nav/state; repeatable")
        ->type_name("TOPIC")
        ->allow_extra_args(false);
    to_files->footer("Example: fulmar log export logs/hourglass.mcap --to npz --topic /nav/state");
    diff = log->add_subcommand("diff",
                               "compare two logs: results, first different tick and field; exit code 1 on "
                               "differences");
    diff->add_option("A", file, "log, or result of fulmar run --json")->required();
    diff->add_option("B", other, "log or result of the other flight")->required();
    diff->add_flag("--json", as_json, "print one JSON object");
    diff->add_flag("--messages", messages_only, "ignore metadata and attachments in the exit code");
    diff->footer("Example: fulmar log diff before.mcap after.mcap");
    add_compare();
  }

  void add_compare() {
    compare =
        log->add_subcommand("compare", "compare two state estimates: differences, errors and consistency");
    compare->add_option("LOG", file, "log with both estimates, or with the first")->required();
    compare
        ->add_option("STATES", comparison.rest,
                     "two estimates, as in nav.state second.state; or a second log and the estimate in "
                     "both")
        ->type_name("[LOG2] [STATE [STATE]]");
    compare->add_option("--truth", comparison.truth, "set the true state; default: truth of the vehicle");
    compare
        ->add_option("--fixes", comparison.fixes,
                     "use a GNSS receiver as reference; default without a true state: the vehicle's, or "
                     "another one in the log")
        ->excludes("--truth");
    compare
        ->add_option("--names", comparison.names, "set the names of the two estimates, as in --names old,new")
        ->type_name("NAMES");
    const auto seconds = CLI::Range(-1e7, 1e7);
    compare->add_option("--from", comparison.from_s, "start at SECONDS of flight time")
        ->type_name("SECONDS")
        ->check(seconds);
    compare->add_option("--to", comparison.to_s, "end at SECONDS of flight time")
        ->type_name("SECONDS")
        ->check(seconds);
    compare->add_flag("--changed", comparison.changed, "omit estimates that are equal in both logs");
    compare->add_flag("--json", comparison.json, "print one JSON object");
    compare->footer("Example: fulmar log compare flight.mcap nav.state second.state");
  }
};

LogCommand::LogCommand(CLI::App& app) : impl_(std::make_unique<Impl>(app)) {}
LogCommand::~LogCommand() = default;

bool LogCommand::parsed() const { return impl_->log->parsed(); }

int LogCommand::run() const {
  const Impl& c = *impl_;
  check_log_file(c.file);
  if (c.diff->parsed()) check_log_file(c.other);
  if (c.info->parsed()) return info_command(c.file, c.as_json);
  if (c.recover->parsed()) return recover_command(c.file, c.out);
  if (c.to_files->parsed()) return export_command(c.file, c.form, c.out, c.topics);
  if (c.diff->parsed()) return diff_command(c.file, c.other, c.as_json, c.messages_only);
  states::CompareArguments words = c.comparison;
  words.log = c.file;
  return states::compare_command(words);
}

}  // namespace fulmar::core
