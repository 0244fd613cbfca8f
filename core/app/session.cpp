// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/session.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/app/compare.hpp"
#include "core/app/ends.hpp"
#include "core/app/messages.hpp"
#include "core/app/program.hpp"
#include "core/app/progress.hpp"
#include "core/app/report.hpp"
#include "core/app/words.hpp"
#include "core/log/out_file.hpp"
#include "core/run/command/swap_checks.hpp"
#include "core/run/component/realtime.hpp"
#include "core/run/state/published.hpp"
#include "core/say.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

fs::path working_directory() {
  std::error_code gone;
  return fs::current_path(gone);
}

std::string short_result(const nlohmann::json& result) {
  return "seed " + std::to_string(result.at("seed").get<std::uint64_t>()) + ": " +
         result.value("verdict", result.at("result").get<std::string>()) + " (" + result.value("reason", "") +
         ")";
}

}  // namespace

Session::Session(const RunOptions& options) : options_(options), start_(working_directory()), graph_(load()) {
  if (!graph_.record && !options.log_file.empty())
    throw Error(app_messages::log_not_recorded(options.log_file));
  if (options.report) check_report(*options.report, graph_);
  for (const std::string& warning : graph_.source.warnings)
    if (warning.starts_with("--")) warn(warning);  // an option of the command line without effect
}

/// Flies with the changed files; when that cannot begin, the previous mission stays.
std::optional<int> Session::try_fly() {
  if (!before_) return fly();
  try {
    return fly();
  } catch (const Error& fault) {
    last_.reset();
    if (!before_) throw;
    graph_ = std::move(*std::exchange(before_, nullptr));
    warn(fault.what());
    warn(app_messages::former_mission_kept());
    return std::nullopt;
  }
}

void Session::take_changes() {
  if (const auto changed = stamps_->changed(); !changed.empty()) reload(changed);
}

void Session::set_seed(std::uint64_t seed) {
  graph_.seed = seed;
  graph_.source.overrides.seed = seed;
}

std::optional<int> Session::fly_again() {
  if (restart_->seed) seed_ = restart_->seed;
  graph_.live.port = port_ = last_->live_port();
  take_changes();
  std::optional<int> code;
  for (int attempt = 0; attempt < 2 && !code; ++attempt) {  // the second with the previous files
    if (seed_) set_seed(*seed_);
    code = try_fly();
  }
  return code;
}

Graph Session::load() const {
  Graph graph = load_mission(options_.mission, options_.overrides);
  if (!options_.live.empty()) {
    const LiveOptions asked = parse_live(options_.live);
    graph.live.on = asked.on;
    graph.live.host = asked.host;
    graph.live.port = asked.port;
    graph.live.where = asked.where;
  }
  if (const char* token = std::getenv("FULMAR_TOKEN"); token && *token) graph.live.token = token;
  if (port_ != 0) graph.live.port = port_;
  return graph;
}

/// The name must not change when a plugin changes the working directory.
LogName Session::log_name() const {
  if (options_.no_log || !graph_.record) return {};
  if (options_.log_file.empty()) return default_log(graph_, start_, restarts());
  const fs::path file = (start_ / options_.log_file).lexically_normal();
  if (restarts()) return free_name(file);
  if (results_.empty()) return graph_.io == Io::fcu ? free_name(file) : LogName{file};
  return {numbered(file, results_.size() + 1)};
}

/// Place to resume from: as requested. On hardware the flight also resumes after a host that ended in the air
/// a short time ago, when the vehicle confirms it.
std::optional<Resume> Session::resume() const {
  constexpr double short_time_s = 600;
  const bool asked = options_.resume.has_value();
  if (!results_.empty() || options_.no_resume || (!asked && graph_.io != Io::fcu)) return std::nullopt;
  const fs::path log = asked && !options_.resume->empty() ? fs::path(*options_.resume)
                                                          : newest_log(graph_, asked ? 0 : short_time_s);
  if (log.empty() && !asked) return std::nullopt;
  if (log.empty()) throw Error(app_messages::resume_log_missing(graph_.mission));
  try {
    Resume resume = read_resume(graph_, log);
    if (asked && !resume.missing.empty()) throw Error(located(log.string(), resume.missing[0]));
    if (!asked && !resume.armed) return std::nullopt;
    resume.if_armed = !asked;
    for (const std::string& missing : resume.missing) warn(log.string() + ": " + missing);
    if (!options_.json)
      say_aloud((resume.if_armed ? "if the aircraft is armed, resumes from " : "resumes from ") +
                log.string() + ": " + resume.text());
    return resume;
  } catch (const Error& fault) {
    if (asked) throw;
    warn(std::string("not resumed: ") + fault.what());
    return std::nullopt;
  }
}

void Session::take_priority() const {
  if (options_.realtime > 0 && unpaced())
    throw CLI::ValidationError(app_messages::realtime_without_pace().line());
  if (options_.realtime > 0) return take_real_time(options_.realtime);
  if (graph_.io == Io::fcu) warn(app_messages::realtime_priority_missing());
}

/// Printed before the vehicle is armed, with the vehicle's own messages.
void Session::report_log(const fs::path& log) const {
  if (graph_.io != Io::fcu) return;
  if (log.empty()) return warn(app_messages::log_off());
  if (!options_.json) say_aloud("log: " + log.string());
}

void Session::report_clients() const {
  if (graph_.dds.on && unpaced()) warn(app_messages::dds_without_pace());
  if (!options_.live.empty() && graph_.live.on && unpaced()) warn(app_messages::live_without_pace());
  if (last_->live_port() == 0 || options_.json) return;
  const bool v6 = graph_.live.host.find(':') != std::string::npos;
  say_aloud("live view: ws://" + (v6 ? "[" + graph_.live.host + "]" : graph_.live.host) + ":" +
            std::to_string(last_->live_port()));
}

FlightOptions Session::flight_options() const {
  FlightOptions o;
  o.speed = options_.speed;
  o.duration_s = options_.duration_s;
  o.drivers_from = options_.drivers_from;
  o.resume = resume();
  o.no_restart = options_.part.no_restart;
  o.keep_inputs = options_.part.keep_inputs || graph_.io == Io::fcu;
  o.interrupt = &signal_seen;
  return o;
}

fs::path Session::report_file(const fs::path& log) const {
  if (!options_.report || log.empty()) return {};
  return report_name(*options_.report, start_, log, results_.size() + 1, graph_.io == Io::fcu || restarts());
}

/// For one of many flights, only warnings are printed.
void Session::add_output(FlightOptions& o, Progress& progress) const {
  const bool brief = options_.part.brief;
  if (!brief) o.progress = [&](const Flight& flight) { progress.show(flight); };
  o.say = [this, &progress, brief](const std::string& text, bool warning) {
    if (!brief) return progress.say(text, warning);
    if (warning) progress.say("seed " + std::to_string(graph_.seed) + ": " + text, true);
  };
  if (graph_.io == Io::fcu || options_.speed > 0) print_without_waiting();
  if (options_.json) dup2(STDERR_FILENO, STDOUT_FILENO);  // output of components
  handle_signals(graph_.io != Io::sim, 10);
  if (!options_.json && !brief)
    say_aloud(graph_.mission + (graph_.io == Io::sim ? ": simulation" : ": flight controller") + ", seed " +
              std::to_string(graph_.seed));
}

FlightResult Session::fly_with(const FlightOptions& o) {
  const UnderWay under_way(graph_, o.log_file.string());
  last_ = std::make_unique<Flight>(graph_, o);
  forget_before();
  report_log(o.log_file);
  report_clients();
  return last_->run();
}

int Session::fly() {
  if (!stamps_) stamps_ = std::make_unique<FileStamps>(files());
  last_.reset();
  Progress progress(graph_);
  FlightOptions o = flight_options();
  const LogName log = log_name();
  const std::shared_ptr<void> name(nullptr, [&](void*) {  // a flight that cannot begin leaves no file
    if (log.held) OutFile::let_go(log.file);
  });
  o.log_file = log.file;
  o.log_held = log.held;
  o.log = !o.log_file.empty();
  const fs::path report = report_file(o.log_file);
  make_folder_of(o.log_file);
  if (graph_.io == Io::fcu && o.log) note_newest_log(graph_, o.log_file);
  add_output(o, progress);
  take_priority();
  const FlightResult result = fly_with(o);
  const bool alone = restarts() || last_->restart();  // an interrupted flight is not compared
  restart_ = last_->restart();
  alarm(0);
  progress.clear();
  pass_on_words();
  results_.push_back(result_json(graph_, *last_, result));
  if (!options_.json) print(result, alone);
  const int code = code_of(result);
  return !report.empty() && !report_flight(report, result.log.file, results_.back(), options_.json)
             ? std::max<int>(code, ExitCode::failed)
             : code;
}

/// Prints the last flight, in one line when there are many.
void Session::print(const FlightResult& result, bool alone) const {
  std::string text =
      !options_.part.brief ? result_table(graph_, *last_, result) : short_result(results_.back()) + "\n";
  if (!options_.part.brief && results_.size() > 1 && !alone)
    text += comparison(results_[results_.size() - 2], results_.back());
  std::printf("%s", text.c_str());
  std::fflush(stdout);
}

int Session::code_of(const FlightResult& result) const {
  const bool whole = result.log.error.empty();
  if (!whole)
    warn(result.log.file.empty()
             ? app_messages::log_lost(result.log.error, result.log.dropped)
             : app_messages::log_incomplete(result.log.error, result.log.dropped, result.log.file.string()));
  else if (result.log.dropped > 0)
    warn(app_messages::log_with_gaps(result.log.dropped));
  if (!whole) return ExitCode::failed;  // for every outcome of the flight
  if (restarts()) return guarded(result) ? ExitCode::guarded : ExitCode::done;
  if (result.outcome == Outcome::interrupted) return ExitCode::interrupted;
  if (result.outcome == Outcome::failed || result.outcome == Outcome::aborted || !has_begun(result))
    return ExitCode::failed;
  return guarded(result) ? ExitCode::guarded : ExitCode::done;
}

std::vector<fs::path> Session::files() const {
  std::vector<fs::path> all = graph_.source.files;
  for (const Component& c : graph_.components)
    if (std::find(all.begin(), all.end(), c.plugin->path) == all.end()) all.emplace_back(c.plugin->path);
  return all;
}

/// Tests the changed components in a child, with the recorded inputs of their predecessors.
void Session::rehearse_changes(const Graph& next) const {
  for (const Component& c : next.components) {
    const auto was = std::find_if(graph_.components.begin(), graph_.components.end(),
                                  [&](const Component& o) { return o.name == c.name; });
    if (was == graph_.components.end() || was->plugin->sha256 == c.plugin->sha256 || c.info().vehicle ||
        c.run == RunMode::driver)
      continue;
    check_unloads(*was->plugin, was->info());
    const Tape* tape = last_ && same_inputs(was->info(), c.info()) ? last_->tape(c.name) : nullptr;
    try {
      rehearse(c, next.tick_ns, component_seed(next.seed, c.name), tape);
    } catch (const Error& fault) {
      throw Error(located(c.name, app_messages::rehearsal_failed(version_words(*c.plugin), fault.what())));
    }
    say_aloud(c.name + ": " + version_words(*was->plugin) + " -> " + version_words(*c.plugin) +
              (tape ? ", rehearsed on " + std::to_string(tape->size()) + " steps" : ""));
  }
}

bool Session::reload(const std::vector<fs::path>& changed) {
  for (const auto& file : changed) say_aloud("changed: " + file.filename().string());
  try {
    Graph next = load();
    rehearse_changes(next);
    before_ = std::make_unique<Graph>(std::exchange(graph_, std::move(next)));
    stamps_ = std::make_unique<FileStamps>(files());
    return true;
  } catch (const Error& fault) {
    warn(fault.what());
    warn(app_messages::former_mission_kept());
    return false;
  }
}

/// The changed components fly. Unloads the plugins that they replace.
void Session::forget_before() {
  if (!before_) return;
  std::vector<std::shared_ptr<Library>> libraries;
  for (Component& c : before_->components) libraries.push_back(std::move(c.library));
  before_.reset();
  for (auto& library : libraries)
    if (library && library.use_count() == 1) Library::unload(std::move(library));
}

int worse(int a, int b) {
  if (std::max(a, b) == ExitCode::guarded && std::min(a, b) == ExitCode::failed) return ExitCode::failed;
  return std::max(a, b);
}

}  // namespace fulmar::core
