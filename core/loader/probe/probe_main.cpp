// SPDX-License-Identifier: BSD-3-Clause
// fulmar-probe COPY NAME [SCRIPT FILE]: loads, reads and unloads one plugin, or one script by the plugin at
// COPY, and reports on standard output. Run by the host with a time limit.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "core/loader/crash_signal.hpp"
#include "core/loader/float_mode.hpp"
#include "core/loader/library.hpp"
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

// The report goes through a descriptor that the plugin does not know; what it prints goes nowhere. No core
// dump, no life after the host.
void prepare() {
  report_pipe = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 100);
  if (report_pipe < 0) report_pipe = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);  // so many may not be open
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::close(nowhere);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
}

// The host has tried the plugin at `host` by itself; here it runs a script.
int try_script(const char* host, const char* copy, const char* file, const std::string& name) {
  static SharedObject library;  // an interpreter is not closed again
  library.load(host, script_host(file));
  const FloatMode before = FloatMode::now();
  const Script script(library.entry(script_host(file)), file, read_script(copy));
  say(report_loaded);
  read_entry(script.entry(), name);
  if (!(FloatMode::now() == before))
    return refuse(name + " changes the floating-point mode when it is loaded");
  say(report_read);
  say(report_good);
  return 0;
}

int try_plugin(const char* copy, const std::string& name) {
  const FloatMode before = FloatMode::now();
  static SharedObject library;  // a plugin that is refused is not closed
  library.load(copy, name);
  const bool same_mode = FloatMode::now() == before;
  say(report_loaded);
  read_entry(library.entry(name), name);
  if (!same_mode)
    return refuse(name + " changes the floating-point mode when it is loaded (built with -ffast-math?)");
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 5) {
    std::fputs("usage: fulmar-probe COPY NAME [SCRIPT FILE] (run by the host)\n", stderr);
    return 2;
  }
  prepare();
  const int code = try_it(argc, argv);
  ::_exit(code);  // without the plugin's exit handlers: one that stays resident has shown nothing wrong yet
}
