// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/run_command.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/app/report.hpp"
#include "core/run/flight.hpp"

namespace fulmar::core {
namespace {

std::atomic<int> interrupted{0};
void on_signal(int signal) { interrupted.store(signal, std::memory_order_relaxed); }

/// logs/<mission>-<UTC>.mcap, with a number when that is taken.
std::filesystem::path default_log(const Graph& graph) {
  if (!graph.record_file.empty()) return graph.record_file;
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char stamp[32];
  std::strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%SZ", &utc);
  const std::string stem = "logs/" + graph.mission + "-" + stamp;
  std::filesystem::path file = stem + ".mcap";
  for (int n = 2; std::filesystem::exists(file) || std::filesystem::exists(file.string() + ".part"); ++n)
    file = stem + "-" + std::to_string(n) + ".mcap";
  return file;
}

/// One line that is rewritten on a terminal; whole lines, now and then, when piped.
class Progress {
 public:
  explicit Progress(const Graph& graph) : graph_(graph), terminal_(isatty(STDERR_FILENO) != 0) {}
  void show(const Flight& flight, bool last = false) {
    if (!terminal_ && !last && ++calls_ % 10 != 1) return;
    const std::string line = progress_line(graph_, flight);
    if (terminal_)
      std::fprintf(stderr, "\r\033[K%s%s", line.c_str(), last ? "\n" : "");
    else
      std::fprintf(stderr, "%s\n", line.c_str());
    drawn_ = terminal_ && !last;
  }
  void say(const std::string& text, bool warning) {
    clear();
    spdlog::log(warning ? spdlog::level::warn : spdlog::level::info, text);
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

}  // namespace

double parse_speed(const std::string& text) {
  if (text == "real") return 1;
  if (text == "max") return 0;
  char* end = nullptr;
  const double speed = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !(speed > 0) || !(speed <= 1e6))
    throw CLI::ValidationError("--speed '" + text + "': give real, max, or a multiple of real time, for example 10");
  return speed;
}

int run_command(const RunOptions& options) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("fulmar"));
  spdlog::set_pattern("%^%v%$");
  const Graph graph = load_mission(options.mission, options.overrides);
  if (!graph.record && !options.log_file.empty())
    throw Error("--log " + options.log_file + ": the mission says record: off; there is no log to write");
  Progress progress(graph);
  FlightOptions flight_options;
  flight_options.speed = options.speed;
  flight_options.duration_s = options.duration_s;
  flight_options.log = !options.no_log;
  if (flight_options.log && graph.record)
    flight_options.log_file = options.log_file.empty() ? default_log(graph) : std::filesystem::path(options.log_file);
  if (flight_options.log_file.has_parent_path()) std::filesystem::create_directories(flight_options.log_file.parent_path());
  flight_options.interrupt = &interrupted;
  flight_options.progress = [&](const Flight& flight) { progress.show(flight); };
  flight_options.say = [&](const std::string& text, bool warning) { progress.say(text, warning); };
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);

  if (!options.json) spdlog::info("{}: {}, seed {}", graph.mission, graph.io == "sim" ? "simulation" : "flight controller", graph.seed);
  Flight flight(graph, flight_options);
  const FlightResult result = flight.run();
  progress.clear();
  if (options.json)
    std::printf("%s\n", result_json(graph, flight, result).dump(2).c_str());
  else
    std::printf("%s", result_table(graph, flight, result).c_str());
  if (!result.log.error.empty()) spdlog::warn("log: {}; {} messages were lost", result.log.error, result.log.dropped);
  if (result.outcome == Outcome::interrupted) return 130;
  return result.outcome == Outcome::flown ? 0 : 1;
}

}  // namespace fulmar::core
