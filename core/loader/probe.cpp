// SPDX-License-Identifier: BSD-3-Clause
// Starts fulmar-probe, reads its report through a pipe and keeps the time limit.
#include "core/loader/probe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <utility>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/messages.hpp"
#include "core/loader/probe_report.hpp"
#include "core/loader/process.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Beside this program, or the path in FULMAR_PROBE when a test or a tool in another folder runs.
fs::path probe_program() {
  if (const fs::path program = own_program("fulmar-probe", "FULMAR_PROBE"); !program.empty()) return program;
  std::error_code fault;
  throw Error(
      loader_messages::probe_program_missing(fs::read_symlink("/proc/self/exe", fault).filename().string()));
}

double time_limit_s() {
  const char* text = std::getenv("FULMAR_PROBE_SECONDS");
  const double chosen = text == nullptr ? 0 : std::strtod(text, nullptr);
  return chosen > 0 && chosen <= 600 ? chosen : 5;
}

/// CPU time of all threads of a process; 0 when it has ended or has not begun.
double cpu_s(pid_t pid) {
  clockid_t clock{};
  timespec used{};
  if (pid <= 0 || ::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// On a busy machine a good plugin gets little CPU time. So CPU time is the limit, and the wall clock only
/// stops a plugin that waits forever.
constexpr double wall_per_cpu = 4;

struct Pipe {
  int ends[2];  // read end, write end
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(loader_messages::pipe_not_created(std::strerror(errno)));
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
};

struct Outcome {
  std::string report, words;  // output of the probe, and the tail of its standard error
  int signal = 0, exit_code = 0;
  bool in_time = false;
  std::string limit;  // the limit that it exceeded
};

/// Text from a pipe: its beginning or its end.
class Stream {
 public:
  enum class Keeps : unsigned char { beginning, end };
  Stream(std::string& text, Keeps keeps) : text_(text), keeps_(keeps) {
    ::fcntl(pipe_.ends[0], F_SETFL, O_NONBLOCK);
  }
  int writing() const { return pipe_.ends[1]; }
  /// -1 after the end.
  int reading() const { return open_ ? pipe_.ends[0] : -1; }
  void leave_writing() { ::close(std::exchange(pipe_.ends[1], -1)); }
  /// Returns false when there was no data.
  bool read_some() {
    constexpr std::size_t longest = 16384;  // a plugin may have found the pipe and may write to it
    char piece[1024];
    const ssize_t n = ::read(pipe_.ends[0], piece, sizeof piece);
    if (n > 0 && (keeps_ == Keeps::end || text_.size() < longest))
      text_.append(piece, static_cast<std::size_t>(n));
    if (keeps_ == Keeps::end && text_.size() > 2 * longest) text_.erase(0, text_.size() - longest);
    open_ = n > 0 || (n < 0 && (errno == EAGAIN || errno == EINTR));
    return n > 0;
  }
  /// Reads the present content, without the output that a running process adds later.
  void read_rest() {
    for (int i = 0; i < 1000 && read_some(); ++i) continue;
  }

 private:
  Pipe pipe_;
  std::string& text_;
  Keeps keeps_;
  bool open_ = true;
};

/// Process that loads the plugin, a child of the probe; 0: not yet reported.
pid_t loading_process(const std::string& report) {
  const std::size_t at = report.find(report_process);
  return at == std::string::npos ? 0 : std::atoi(report.c_str() + at + report_process.size());
}

/// Gives the probe time to end the processes that the plugin has started.
void end_probe(Process& child) {
  ::kill(child.pid(), SIGTERM);
  child.wait(std::chrono::seconds(1));
  child.kill();
}

Outcome run_probe(const std::vector<std::string>& words, double limit_s) {
  Outcome outcome;
  Stream report(outcome.report, Stream::Keeps::beginning), error(outcome.words, Stream::Keeps::end);
  ChildFiles files;
  files.out = report.writing();
  files.error = error.writing();
  Process child(probe_program().string(), words, files);
  for (Stream* const stream : {&report, &error}) stream->leave_writing();
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(wall_per_cpu * limit_s));
  while (!(outcome.in_time = child.ended()) && outcome.limit.empty()) {
    if (cpu_s(loading_process(outcome.report)) > limit_s)
      outcome.limit = number_text(limit_s) + " s of the CPU";
    if (Clock::now() > deadline) outcome.limit = number_text(wall_per_cpu * limit_s) + " s";
    // the pipe closes at the child's end: then a short wait is enough
    pollfd waiting[] = {{report.reading(), POLLIN, 0}, {error.reading(), POLLIN, 0}};
    if (::poll(waiting, 2, report.reading() >= 0 ? 10 : 1) <= 0) continue;
    if (waiting[0].revents != 0) report.read_some();
    if (waiting[1].revents != 0) error.read_some();
  }
  if (!outcome.in_time) end_probe(child);
  report.read_rest();
  error.read_rest();
  outcome.signal = child.signal();
  outcome.exit_code = child.exit_code();
  return outcome;
}

}  // namespace

namespace {

/// ": what(): no licence": the last line with content from the plugin and the system after the failure.
std::string last_line(std::string_view words) {
  constexpr std::size_t longest = 200;
  while (!words.empty()) {
    const std::size_t end = words.find_last_of("\r\n");
    const std::string_view line = trimmed(words.substr(end == std::string_view::npos ? 0 : end + 1));
    words = words.substr(0, end == std::string_view::npos ? 0 : end);
    if (line.empty() || line.ends_with("==ABORTING"))
      continue;  // the sanitizer's summary is the previous
                 // line
    return ": " + for_terminal(std::string(line.substr(0, longest)));
  }
  return "";
}

}  // namespace

std::string probe(const fs::path& copy, const std::string& name, const ProbedScript& script) {
  const double limit_s = time_limit_s();
  std::vector<std::string> words{copy.string(), name};
  if (!script.copy.empty()) words.insert(words.end(), {script.copy.string(), script.file.string()});
  const Outcome outcome = run_probe(words, limit_s);
  const std::string& report = outcome.report;
  const auto has = [&](std::string_view word) { return report.find(word) != std::string::npos; };
  const std::string stage = !has(report_loaded) ? "loaded" : !has(report_read) ? "read" : "unloaded";
  if (!outcome.in_time) {
    const std::string doing = stage == "loaded" ? "loading" : stage == "read" ? "reading" : "unloading";
    return loader_messages::probe_timed_out(name, doing, outcome.limit).line();
  }
  if (outcome.signal != 0)
    return loader_messages::plugin_crashed(name, stage, outcome.signal, last_line(outcome.words)).line();
  if (const std::size_t at = report.find(report_fault); at != std::string::npos) {
    const std::size_t begin = at + report_fault.size();
    return report.substr(begin, report.find('\n', begin) - begin);
  }
  if (has(report_good) && outcome.exit_code == 0) return "";
  return loader_messages::plugin_ended_process(name, stage, outcome.exit_code, last_line(outcome.words))
      .line();
}

bool stays_mapped(const fs::path& copy) {
  const Outcome outcome = run_probe({copy.string(), copy.filename().string()}, time_limit_s());
  return outcome.report.find(report_stays) != std::string::npos;
}

}  // namespace fulmar::core
