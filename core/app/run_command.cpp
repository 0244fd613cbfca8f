// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/run_command.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/app/report.hpp"
#include "core/run/allocation.hpp"
#include "core/run/flight.hpp"
#include "core/run/unit.hpp"

namespace fulmar::core {
namespace {

std::atomic<int> interrupted{0};
char last_words[512];  // where the log lies, prepared beforehand

void write_text(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

/// The first signal ends the flight between two ticks. Another one, half a second later or more (timeout(1) sends two at once), ends the
/// program: a component may be hanging.
void on_signal(int signal) {
  static timespec first{};
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupted.exchange(signal) == 0) first = now;
  if (static_cast<double>(now.tv_sec - first.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - first.tv_nsec) < 0.5) return;
  const char* component = in_step.load(std::memory_order_relaxed);
  write_text("\nfulmar: ended by the second signal");
  if (component) write_text(" in the step of "), write_text(component);
  write_text(last_words);
  _exit(130);
}

/// A component that crashes takes the host with it; at least it is named.
void on_crash(int signal) {
  const char* component = in_step.load(std::memory_order_relaxed);
  const char* what = signal == SIGSEGV   ? " (segmentation fault)"
                     : signal == SIGABRT ? " (abort)"
                     : signal == SIGFPE  ? " (arithmetic fault)"
                                         : "";
  write_text("\nfulmar: ");
  write_text(component ? component : "the host");
  write_text(" crashed");
  write_text(component ? " in its step" : "");
  write_text(what);
  write_text(last_words);
  raise(signal);  // the default action, restored by SA_RESETHAND
}

void install_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  if (!counts_allocations()) return;  // a sanitized build reports crashes by itself
  static char stack[64 * 1024];
  const stack_t alternate{stack, 0, sizeof stack};
  sigaltstack(&alternate, nullptr);
  action.sa_handler = on_crash;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &action, nullptr);
}

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
  double speed = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), speed);
  if (code != std::errc{} || end != text.data() + text.size() || !(speed > 0) || !(speed <= 1e6))
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
  const std::string log = flight_options.log_file.string();
  std::snprintf(last_words, sizeof last_words, "%s%s%s\n", log.empty() ? "." : ". What was logged until then is in ", log.c_str(),
                log.empty() ? "" : ".part");
  install_handlers();

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
