// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/run_command.hpp"

#include <fcntl.h>
#include <spdlog/fmt/chrono.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/app/compare.hpp"
#include "core/app/ends.hpp"
#include "core/app/file_names.hpp"
#include "core/app/many.hpp"
#include "core/app/program.hpp"
#include "core/app/report.hpp"
#include "core/app/watch.hpp"
#include "core/app/words.hpp"
#include "core/log/out_file.hpp"
#include "core/run/command/swap_checks.hpp"
#include "core/run/component/realtime.hpp"
#include "core/run/flight.hpp"
#include "core/run/state/published.hpp"
#include "core/sanitized.hpp"
#include "core/say.hpp"
#include "core/tap/pace.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

fs::path working_directory() {
  std::error_code gone;
  return fs::current_path(gone);
}

/// One line that is rewritten on a terminal; whole lines, now and then, when piped.
class Progress {
 public:
  explicit Progress(const Graph& graph) : graph_(graph), terminal_(words_on_terminal()) {}
  void show(const Flight& flight) {
    if (!terminal_ && ++calls_ % 10 != 1) return;
    std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n",
                 for_terminal(progress_line(graph_, flight)).c_str());
    drawn_ = terminal_;
  }
  void say(const std::string& text, bool warning) {
    clear();
    say_aloud(text, warning ? Tone::warning : Tone::info);
  }
  void clear() {
    if (drawn_) std::fprintf(stderr, "\r\033[K");
    drawn_ = false;
  }

 private:
  const Graph& graph_;
  bool terminal_, drawn_ = false;
  int calls_ = 0;
};

/// Flights of one mission in one host: the graph that flies now, and how the last flight went.
class Session {
 public:
  explicit Session(const RunOptions& options)
      : options_(options), start_(working_directory()), graph_(load()) {
    if (!graph_.record && !options.log_file.empty())
      throw Error("--log " + options.log_file + ": the mission says record: off; there is no log to write");
    if (options.report) check_report(*options.report, graph_);
    for (const std::string& warning : graph_.warnings)
      if (warning.starts_with("--")) warn(warning);  // asked on the command line, and without effect
  }

  /// A flight with what has changed; when that cannot even begin, the mission of before stays.
  std::optional<int> try_fly() {
    if (!before_) return fly();
    try {
      return fly();
    } catch (const Error& fault) {
      last_.reset();
      if (!before_) throw;
      graph_ = std::move(*std::exchange(before_, nullptr));
      warn(fault.what());
      warn("what flew before stays as it is");
      return std::nullopt;
    }
  }

  /// Waits until a file has changed that the mission uses and the mission can be flown with it. False:
  /// interrupted.
  bool wait_for_change() {
    say_aloud("\nwaiting for a change; Ctrl-C ends");
    std::string gone;
    while (signal_seen.load() == 0) {
      if (sources_)
        if (const auto changed = sources_->changed(); !changed.empty()) {
          say_aloud("changed: " + changed[0].filename().string() + "; building");
          if (!run_build(options_.build, signal_seen) && signal_seen.load() == 0)
            warn("the build failed; what flew before stays as it is");
        }
      if (const auto changed = stamps_->changed(); !changed.empty() && reload(changed)) return true;
      const std::string missing = stamps_->missing().string();
      if (!missing.empty() && missing != gone) warn(missing + " is gone; waiting for it");
      gone = missing;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  /// Uses whatever has changed since the last flight, if anything has.
  void take_changes() {
    if (const auto changed = stamps_->changed(); !changed.empty()) reload(changed);
  }

  /// The next flight's.
  void set_seed(std::uint64_t seed) {
    graph_.seed = seed;
    graph_.overrides.seed = seed;
  }

  /// Whether the last flight has made room for another one.
  bool restarts() const { return restart_.has_value(); }
  /// That other one: the mission as its files are now, on the same port.
  std::optional<int> fly_anew() {
    if (restart_->seed) seed_ = restart_->seed;
    graph_.live.port = port_ = last_->live_port();
    take_changes();
    std::optional<int> code;
    for (int attempt = 0; attempt < 2 && !code; ++attempt) {  // the second with what flew before
      if (seed_) set_seed(*seed_);
      code = try_fly();
    }
    return code;
  }

  void print_spread() const { std::printf("%s", spread_table(results_).c_str()); }

  nlohmann::json results() const {
    if (!options_.seeds.empty()) {
      nlohmann::json all = spread(results_);
      all["flights"] = results_;
      return all;
    }
    return results_.size() == 1 ? results_[0] : nlohmann::json{{"flights", results_}};
  }
  bool on_hardware() const { return graph_.io == Io::fcu; }
  bool has_flown() const { return !results_.empty(); }

 private:
  Graph load() const {
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

  /// A name that stays what it is, whatever folder a plugin goes to.
  LogName log_name() const {
    if (options_.no_log || !graph_.record) return {};
    if (options_.log_file.empty()) return default_log(graph_, start_, restarts());
    const fs::path file = (start_ / options_.log_file).lexically_normal();
    if (restarts()) return free_name(file);
    if (results_.empty()) return graph_.io == Io::fcu ? free_name(file) : LogName{file};
    return {numbered(file, results_.size() + 1)};
  }

  /// Where to go on: as asked; on hardware also after a host that ended in the air a short time ago, when the
  /// vehicle confirms it.
  std::optional<Resume> resume() const {
    constexpr double short_time_s = 600;
    const bool asked = options_.resume.has_value();
    if (!results_.empty() || options_.no_resume || (!asked && graph_.io != Io::fcu)) return std::nullopt;
    const fs::path log = asked && !options_.resume->empty() ? fs::path(*options_.resume)
                                                            : newest_log(graph_, asked ? 0 : short_time_s);
    if (log.empty() && !asked) return std::nullopt;
    if (log.empty())
      throw Error("--resume: there is no log of the mission " + graph_.mission +
                  "; name one, as in --resume FILE.mcap");
    try {
      Resume resume = read_resume(graph_, log);
      if (asked && !resume.missing.empty()) throw Error(log.string() + ": " + resume.missing[0]);
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

  bool unpaced() const { return graph_.io == Io::sim && options_.speed == 0; }

  void take_priority() const {
    if (options_.realtime > 0 && unpaced())
      throw CLI::ValidationError(
          "--realtime would give a CPU to this flight alone: it belongs to --io fcu, or to a simulation with "
          "--speed real");
    if (options_.realtime > 0) return take_real_time(options_.realtime);
    if (graph_.io == Io::fcu) warn("the loop runs without real-time priority; --realtime gives it one");
  }

  /// Beside what the vehicle says of itself before it is armed.
  void tell_log(const fs::path& log) const {
    if (graph_.io != Io::fcu) return;
    if (log.empty()) return warn("no log is written");
    if (!options_.json) say_aloud("log: " + log.string());
  }

  void tell_onlookers() const {
    if (graph_.dds.on && unpaced())
      warn("dds: nothing is exported or imported as fast as the machine allows; fly with --speed real");
    if (!options_.live.empty() && graph_.live.on && unpaced())
      warn("--live: nobody can follow as fast as the machine allows; fly with --speed real");
    if (last_->live_port() == 0 || options_.json) return;
    const bool v6 = graph_.live.host.find(':') != std::string::npos;
    say_aloud("live view: ws://" + (v6 ? "[" + graph_.live.host + "]" : graph_.live.host) + ":" +
              std::to_string(last_->live_port()));
  }

  int fly() {
    if (!stamps_) stamps_ = std::make_unique<FileStamps>(files());
    if (!options_.build.empty() && !sources_)
      sources_ = std::make_unique<FileStamps>(source_files(fs::absolute(graph_.file).parent_path()));
    last_.reset();
    Progress progress(graph_);
    FlightOptions o;
    o.speed = options_.speed;
    o.duration_s = options_.duration_s;
    o.drivers_from = options_.drivers_from;
    o.resume = resume();
    o.no_restart = options_.repeat > 0       ? "this is one of the flights of --repeat"
                   : !options_.seeds.empty() ? "this is one of the flights of --seeds"
                                             : "";
    o.keep_inputs = options_.watch || graph_.io == Io::fcu;
    const LogName log = log_name();
    const std::shared_ptr<void> name(nullptr, [&](void*) {  // a flight that cannot begin leaves no file
      if (log.held) OutFile::let_go(log.file);
    });
    o.log_file = log.file;
    o.log_held = log.held;
    o.log = !o.log_file.empty();
    fs::path report;
    if (options_.report && o.log)
      report = report_name(*options_.report, start_, o.log_file, results_.size() + 1,
                           graph_.io == Io::fcu || restarts());
    make_folder_of(o.log_file);
    if (graph_.io == Io::fcu && o.log) note_newest_log(graph_, o.log_file);
    o.interrupt = &signal_seen;
    const bool many = !options_.seeds.empty();  // of those only what is worth a warning
    if (!many) o.progress = [&](const Flight& flight) { progress.show(flight); };
    o.say = [&, many](const std::string& text, bool warning) {
      if (!many) return progress.say(text, warning);
      if (warning) progress.say("seed " + std::to_string(graph_.seed) + ": " + text, true);
    };
    if (graph_.io == Io::fcu || options_.speed > 0) print_without_waiting();
    if (options_.json) dup2(STDERR_FILENO, STDOUT_FILENO);  // what components print
    handle_signals(graph_.io != Io::sim, 10);
    if (!options_.json && options_.seeds.empty())
      say_aloud(graph_.mission + (graph_.io == Io::sim ? ": simulation" : ": flight controller") + ", seed " +
                std::to_string(graph_.seed));
    take_priority();
    std::optional<UnderWay> under_way(std::in_place, graph_, o.log_file.string());
    last_ = std::make_unique<Flight>(graph_, o);
    forget_before();
    tell_log(o.log_file);
    tell_onlookers();
    const FlightResult result = last_->run();
    const bool alone = restarts() || last_->restart();  // a flight cut short compares with none
    restart_ = last_->restart();
    under_way.reset();
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

  /// The last flight, in a line when there are many.
  void print(const FlightResult& result, bool alone) const {
    std::string text =
        options_.seeds.empty() ? result_table(graph_, *last_, result) : short_result(results_.back()) + "\n";
    if (options_.seeds.empty() && results_.size() > 1 && !alone)
      text += comparison(results_[results_.size() - 2], results_.back());
    std::printf("%s", text.c_str());
    std::fflush(stdout);
  }

  int code_of(const FlightResult& result) const {
    const bool whole = result.log.error.empty();
    if (!whole)
      warn("the log is not whole: " + result.log.error + "; " + std::to_string(result.log.dropped) +
           " messages were lost" +
           (result.log.file.empty() ? "" : ", and what there is is in " + result.log.file.string()));
    else if (result.log.dropped > 0)
      warn("the log has gaps: the disk was too slow for " + std::to_string(result.log.dropped) + " messages");
    if (!whole) return ExitCode::failed;  // however the flight ended
    if (restarts()) return guarded(result) ? ExitCode::guarded : ExitCode::done;
    if (result.outcome == Outcome::interrupted) return ExitCode::interrupted;
    if (result.outcome == Outcome::failed || result.outcome == Outcome::aborted || !has_begun(result))
      return ExitCode::failed;
    return guarded(result) ? ExitCode::guarded : ExitCode::done;
  }

  bool guarded(const FlightResult& result) const { return options_.strict && !result.guards.empty(); }

  std::vector<fs::path> files() const {
    std::vector<fs::path> all = graph_.files;
    for (const Component& c : graph_.components)
      if (std::find(all.begin(), all.end(), c.plugin->path) == all.end()) all.emplace_back(c.plugin->path);
    return all;
  }

  /// The newcomers among the components are tried in a child on what their predecessors saw last.
  void rehearse_changes(const Graph& next) const {
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
        throw Error(c.name + ": " + version_words(*c.plugin) + " fails its rehearsal: " + fault.what());
      }
      say_aloud(c.name + ": " + version_words(*was->plugin) + " -> " + version_words(*c.plugin) +
                (tape ? ", rehearsed on " + std::to_string(tape->size()) + " steps" : ""));
    }
  }

  bool reload(const std::vector<fs::path>& changed) {
    for (const auto& file : changed) say_aloud("changed: " + file.filename().string());
    try {
      Graph next = load();
      rehearse_changes(next);
      before_ = std::make_unique<Graph>(std::exchange(graph_, std::move(next)));
      stamps_ = std::make_unique<FileStamps>(files());
      return true;
    } catch (const Error& fault) {
      warn(fault.what());
      warn("what flew before stays as it is");
      return false;
    }
  }

  /// The newcomers fly: what they replace is unloaded, for certain.
  void forget_before() {
    if (!before_) return;
    std::vector<std::shared_ptr<Library>> libraries;
    for (Component& c : before_->components) libraries.push_back(std::move(c.library));
    before_.reset();
    for (auto& library : libraries)
      if (library && library.use_count() == 1) Library::unload(std::move(library));
  }

  const RunOptions& options_;
  const fs::path start_;    // the working directory in which the program was started
  std::uint16_t port_ = 0;  // where a flight listened that has made room for another; 0: none has
  Graph graph_;
  std::unique_ptr<Graph> before_;  // until a flight with the newcomers has begun
  std::unique_ptr<Flight> last_;   // what its components saw is what a newcomer is rehearsed on
  std::vector<nlohmann::json> results_;
  std::optional<Restart> restart_;     // asked of the last flight
  std::optional<std::uint64_t> seed_;  // asked for with one
  std::unique_ptr<FileStamps> stamps_, sources_;
};

/// With --json standard output belongs to the result alone: what components print goes to standard error.
class ResultFile {
 public:
  explicit ResultFile(bool as_json) {
    if (!as_json) return;
    const int own = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (own < 0) return;  // there is no standard output
    file_.reset(fdopen(own, "w"));
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  void write(const nlohmann::json& result) {
    if (!file_) return;
    std::fprintf(file_.get(), "%s\n",
                 result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    const bool written = std::fflush(file_.get()) == 0 && std::ferror(file_.get()) == 0;
    if (!written) throw Error(std::string("the result cannot be written: ") + std::strerror(errno));
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

}  // namespace

double parse_speed(const std::string& text) {
  const std::optional<double> speed = speed_of(text);
  if (!speed)
    throw CLI::ValidationError("--speed '" + text +
                               "': give real, max, or a multiple of real time, for example 10");
  return *speed;
}

/// Of several flights in one host: one that failed says more than one whose guards fired.
int worse(int a, int b) {
  if (std::max(a, b) == ExitCode::guarded && std::min(a, b) == ExitCode::failed) return ExitCode::failed;
  return std::max(a, b);
}

int run_command(const RunOptions& options) {
  if (!options.build.empty() && !options.watch) throw CLI::ValidationError("--build belongs to --watch");
  if (options.report && options.no_log)
    throw CLI::ValidationError(
        "--report makes a page of the log, and --no-log leaves that out: give one of them");
  ResultFile output(options.json);
  handle_signals(false, 10);  // also while it is set up
  Session session(options);
  if (!options.seeds.empty() && session.on_hardware())
    throw CLI::ValidationError("--seeds belongs to a simulation: on hardware nothing is drawn by chance");
  int worst = 0;
  const int flights = options.seeds.empty() ? options.repeat : static_cast<int>(options.seeds.size());
  for (int flight = 1;; ++flight) {
    if (!options.seeds.empty()) session.set_seed(options.seeds[static_cast<std::size_t>(flight - 1)]);
    const std::optional<int> code = session.restarts() ? session.fly_anew() : session.try_fly();
    worst = worse(worst, code.value_or(ExitCode::failed));
    if (session.restarts()) continue;
    if (code == ExitCode::interrupted || (flights > 0 ? flight >= flights : !options.watch)) break;
    if (flights > 0) {
      if (options.watch) session.take_changes();
    } else if (!session.wait_for_change()) {
      break;
    }
    alarm(0);
  }
  try {
    if (!options.seeds.empty() && !options.json) session.print_spread();
    if (session.has_flown()) output.write(session.results());
  } catch (const Error& fault) {
    warn(fault.what());
    return ExitCode::failed;
  }
#ifndef FULMAR_SANITIZED  // which looks for leaks at its exit, and takes its time
  expect_exit(worst);
#endif
  return worst;
}

}  // namespace fulmar::core
