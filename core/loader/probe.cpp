// SPDX-License-Identifier: BSD-3-Clause
// Spawns fulmar-probe (never forks: the host has threads), reads its report through a pipe and keeps the time
// limit.
#include "core/loader/probe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/probe_report.hpp"
#include "core/types/text.hpp"

extern char** environ;

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Beside this program; when that is a test or a tool elsewhere, FULMAR_PROBE says where.
fs::path probe_program() {
  if (const char* chosen = std::getenv("FULMAR_PROBE"); chosen != nullptr && *chosen != '\0') return chosen;
  if (const fs::path program = own_program("fulmar-probe"); !program.empty()) return program;
  std::error_code fault;
  throw Error("the program fulmar-probe is missing beside " +
              fs::read_symlink("/proc/self/exe", fault).filename().string() +
              ": plugins cannot be tried before they are loaded.");
}

double time_limit_s() {
  const char* text = std::getenv("FULMAR_PROBE_SECONDS");
  const double chosen = text == nullptr ? 0 : std::strtod(text, nullptr);
  return chosen > 0 && chosen <= 600 ? chosen : 5;
}

struct Child {
  pid_t pid = -1;
  int report = -1;  // reading end of the pipe
};

Child spawn(const fs::path& program, std::vector<std::string> words) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error("cannot make a pipe: " + std::string(std::strerror(errno)) + ".");
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
#if __GLIBC_PREREQ(2, 34)
  posix_spawn_file_actions_addclosefrom_np(
      &files, STDERR_FILENO + 1);  // serial ports and sockets are none of its business
#endif
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);  // its own group, so that its children can be stopped with it
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  Child child;
  const int fault =
      ::posix_spawn(&child.pid, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  ::close(ends[1]);
  child.report = ends[0];
  if (fault != 0) {
    ::close(ends[0]);
    throw Error("cannot start " + program.string() + ": " + std::strerror(fault) + ".");
  }
  return child;
}

struct Outcome {
  std::string report;
  int status = 0;
  bool in_time = false;
};

// False at the end of the report.
bool read_some(int pipe, std::string& report) {
  constexpr std::size_t longest = 16384;  // a plugin may have found the pipe and write to it
  char piece[1024];
  const ssize_t n = ::read(pipe, piece, sizeof piece);
  if (n > 0 && report.size() < longest) report.append(piece, static_cast<std::size_t>(n));
  return n > 0 || (n < 0 && (errno == EAGAIN || errno == EINTR));
}

Outcome watch(const Child& child, double limit_s) {
  Outcome outcome;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s));
  ::fcntl(child.report, F_SETFL, O_NONBLOCK);
  bool open = true;
  while (Clock::now() < deadline) {
    const pid_t ended = ::waitpid(child.pid, &outcome.status, WNOHANG);
    if (ended == child.pid || (ended < 0 && errno != EINTR)) {
      outcome.in_time = true;
      break;
    }
    // the pipe closes when the child ends: no need to wait long after that, and none to sleep before
    pollfd waiting{child.report, POLLIN, 0};
    if (::poll(&waiting, open ? 1u : 0u, open ? 10 : 1) > 0) open = read_some(child.report, outcome.report);
  }
  ::kill(-child.pid, SIGKILL);  // the whole group, whoever is left
  if (!outcome.in_time) ::waitpid(child.pid, &outcome.status, 0);
  std::size_t before = 0;
  do {
    before = outcome.report.size();
  } while (read_some(child.report, outcome.report) && outcome.report.size() > before);
  ::close(child.report);
  return outcome;
}

}  // namespace

std::string probe(const fs::path& copy, const std::string& name, const ProbedScript& script) {
  const double limit_s = time_limit_s();
  const fs::path program = probe_program();
  std::vector<std::string> words{program.string(), copy.string(), name};
  if (!script.copy.empty()) words.insert(words.end(), {script.copy.string(), script.file.string()});
  const Outcome outcome = watch(spawn(program, std::move(words)), limit_s);
  const std::string& report = outcome.report;
  const auto said = [&](std::string_view word) { return report.find(word) != std::string::npos; };
  const std::string stage = !said(report_loaded) ? "loaded" : !said(report_read) ? "read" : "unloaded";
  if (!outcome.in_time) {
    const std::string doing = stage == "loaded" ? "loading" : stage == "read" ? "reading" : "unloading";
    return name + " did not finish " + doing + " within " + number_text(limit_s) + " s";
  }
  if (WIFSIGNALED(outcome.status))
    return name + " crashed while being " + stage + " (signal " + std::to_string(WTERMSIG(outcome.status)) +
           ")";
  if (const std::size_t at = report.find(report_fault); at != std::string::npos) {
    const std::size_t begin = at + report_fault.size();
    return report.substr(begin, report.find('\n', begin) - begin);
  }
  if (said(report_good) && WEXITSTATUS(outcome.status) == 0) return "";
  return name + " ended the process while being " + stage + " (exit code " +
         std::to_string(WEXITSTATUS(outcome.status)) + ")";
}

bool stays_mapped(const fs::path& copy) {
  const fs::path program = probe_program();
  const Outcome outcome =
      watch(spawn(program, {program.string(), copy.string(), copy.filename().string()}), time_limit_s());
  return outcome.report.find(report_stays) != std::string::npos;
}

}  // namespace fulmar::core
