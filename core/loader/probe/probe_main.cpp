// SPDX-License-Identifier: BSD-3-Clause
// fulmar-probe COPY NAME [SCRIPT FILE]: loads, reads and unloads one plugin, or one script by the plugin at
// COPY, and reports on standard output. The host runs it with a time limit. A child loads the file. This
// process only waits, and ends every process that the file has started.
#include <dirent.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.hpp"
#include "core/loader/crash_signal.hpp"
#include "core/loader/float_mode.hpp"
#include "core/loader/library.hpp"
#include "core/loader/messages.hpp"
#include "core/loader/probe_report.hpp"
#include "core/loader/script.hpp"
#include "core/loader/shared_object.hpp"

using namespace fulmar::core;

namespace {

int report_pipe = -1;

void say(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(report_pipe, text.data(), text.size());
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

int refuse(std::string sentence) {
  for (char& c : sentence)
    if (c == '\n') c = ' ';
  say(std::string(report_fault) + sentence + "\n");
  return 1;
}

// The report uses a descriptor that the plugin does not have; the plugin's output is discarded. No core dump.
void prepare() {
  report_pipe = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 100);
  if (report_pipe < 0)
    report_pipe = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);  // the descriptor may exceed the
                                                               // limit of open files
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::close(nowhere);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
}

// The host has tested the plugin at `host` separately; this child opens a script with it.
int try_script(const char* host, const char* copy, const char* file, const std::string& name) {
  static SharedObject library;  // an interpreter is not closed
  library.load(host, script_host(file));
  const FloatMode before = FloatMode::now();
  const Script script(library.entry(script_host(file)), file, read_script(copy));
  say(report_loaded);
  read_entry(script.entry(), name);
  if (!(FloatMode::now() == before)) return refuse(fulmar::loader_messages::script_changes_float_mode(name));
  say(report_read);
  say(report_good);
  return 0;
}

int try_plugin(const char* copy, const std::string& name) {
  const FloatMode before = FloatMode::now();
  static SharedObject library;  // a rejected plugin is not closed
  library.load(copy, name);
  const bool same_mode = FloatMode::now() == before;
  say(report_loaded);
  read_entry(library.entry(name), name);
  if (!same_mode) return refuse(fulmar::loader_messages::plugin_changes_float_mode(name));
  say(report_read);
  library.unload();
  if (is_mapped(copy)) say(report_stays);
  say(report_good);
  return 0;
}

int try_it(int argc, char** argv) try {
  return argc == 5 ? try_script(argv[1], argv[3], argv[4], argv[2]) : try_plugin(argv[1], argv[2]);
} catch (const Error& fault) {
  return refuse(fault.what());
}

// The child that loads the file.
int try_it_here(int argc, char** argv, pid_t guard) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 0);
  if (::getppid() != guard) return 1;  // the parent died before PR_SET_PDEATHSIG took effect
  say(std::string(report_process) + std::to_string(::getpid()) + "\n");
  return try_it(argc, argv);
}

// ---- the waiting parent: it runs no code of the file

std::atomic<pid_t> trying{0};
std::atomic<bool> over{false};

// Handles the time-out or the end of the host.
void end_it(int) {
  over = true;
  if (const pid_t child = trying; child > 0) ::kill(child, SIGKILL);
}

pid_t parent_of(const char* process) {
  std::FILE* about = std::fopen(("/proc/" + std::string(process) + "/stat").c_str(), "re");
  if (about == nullptr) return 0;
  char text[512];
  const std::size_t n = std::fread(text, 1, sizeof text - 1, about);
  std::fclose(about);
  text[n] = 0;
  const char* after_name = std::strrchr(text, ')');  // a name may contain any text, including ") "
  int parent = 0;
  return after_name && std::sscanf(after_name + 1, " %*c %d", &parent) == 1 ? parent : 0;
}

void kill_children() {
  DIR* all = ::opendir("/proc");
  if (all == nullptr) return;
  while (const dirent* entry = ::readdir(all))
    if (const int process = std::atoi(entry->d_name); process > 0 && parent_of(entry->d_name) == ::getpid())
      ::kill(process, SIGKILL);
  ::closedir(all);
}

// Orphans become children of this process (subreaper): repeated rounds reach all of them.
void end_the_others() {
  int status = 0;
  for (pid_t ended = 0; (ended = ::waitpid(-1, &status, WNOHANG)) >= 0 || errno == EINTR;) {
    if (ended != 0) continue;
    kill_children();
    ::waitpid(-1, &status, 0);
  }
}

// Ends with the child's exit status.
int end_as(int status) {
  if (!WIFSIGNALED(status)) return WEXITSTATUS(status);
  ::prctl(PR_SET_DUMPABLE, 0);
  std::signal(WTERMSIG(status), SIG_DFL);
  ::raise(WTERMSIG(status));
  return 1;
}

int watch_over(pid_t child) {
  trying = child;
  if (over) end_it(SIGTERM);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  trying = 0;
  end_the_others();
  return end_as(status);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 5) {
    std::fputs("usage: fulmar-probe COPY NAME [SCRIPT FILE] (run by the host)\n", stderr);
    return 2;
  }
  prepare();
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::signal(SIGTERM, end_it);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  const pid_t guard = ::getpid(), child = ::fork();
  if (child < 0) return refuse(fulmar::loader_messages::probe_not_started(argv[2], std::strerror(errno)));
  if (child > 0) return watch_over(child);
  std::signal(SIGTERM, SIG_DFL);
  const int code = try_it_here(argc, argv, guard);
  ::_exit(code);  // without the plugin's exit handlers: a resident plugin runs them later in the host
}
