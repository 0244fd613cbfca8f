// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/last_act.hpp"

#include <link.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "core/app/messages.hpp"
#include "core/app/words.hpp"
#include "core/loader/in_hand.hpp"
#include "core/run/component/last_frame.hpp"
#include "core/run/component/process_state.hpp"
#include "core/sanitized.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {

std::atomic<bool> in_flight{false};

namespace {

std::atomic<pid_t> at_work{0};   // process at work; a fork of it does not count
std::atomic<pid_t> the_host{0};  // process with installed handlers, permanently
std::atomic<pid_t> ends_it{0};   // thread that ends the host
std::atomic<bool> after_flight{false};
char log_name[4200], log_part[4200];  // names of a flight's log: complete, and until then

struct PluginCode {
  std::uintptr_t begin = 0, end = 0;
  std::array<char, 64> file{};
};
std::array<PluginCode, 64> codes;
std::atomic<std::size_t> code_count{0};

}  // namespace

void note_code(const std::string& file, const void* function) {
  const std::size_t n = code_count;
  if (n == codes.size()) return;
  PluginCode code;
  code.begin = reinterpret_cast<std::uintptr_t>(function);
  std::snprintf(code.file.data(), code.file.size(), "%s", file.c_str());
  const auto look = [](dl_phdr_info* object, std::size_t, void* to) {
    PluginCode& c = *static_cast<PluginCode*>(to);
    std::uintptr_t begin = ~std::uintptr_t{0}, end = 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
      const auto& part = object->dlpi_phdr[i];
      if (part.p_type != PT_LOAD) continue;
      begin = std::min<std::uintptr_t>(begin, object->dlpi_addr + part.p_vaddr);
      end = std::max<std::uintptr_t>(end, object->dlpi_addr + part.p_vaddr + part.p_memsz);
    }
    if (c.begin < begin || c.begin >= end) return 0;
    c.begin = begin;
    c.end = end;
    return 1;
  };
  if (dl_iterate_phdr(look, &code) == 0) return;
  codes[n] = code;
  code_count = n + 1;
}

void forget_code() { code_count = 0; }

void prepare_end(const std::string& log, bool flight_over) {
  log_name[0] = log_part[0] = 0;
  after_flight = flight_over;
  if (log.empty()) return;
  std::snprintf(log_part, sizeof log_part, "%s.part", log.c_str());
  std::snprintf(log_name, sizeof log_name, "%s", log.c_str());
}

// ---- async-signal-safe from here on: the program is ending

void report(std::initializer_list<const char*> words) {
  for (const char* word : words) write_last_words(word);
}

/// The log may have been moved or removed, or may not have begun.
void report_end() {
  if (log_name[0] == 0 && !after_flight) return report({".\n"});
  report({". "});
  if (log_name[0] == 0)
    report(app_messages::flight_over);
  else if (access(log_part, F_OK) == 0)
    report(app_messages::log_until_end, log_part);
  else if (access(log_name, F_OK) == 0)
    report(app_messages::log_until_end, log_name);
  else
    report(app_messages::log_not_found, log_part);
  report({"\n"});
}

void leave(int code) {
  for (;;) syscall(SYS_exit_group, code);
}

bool is_the_host() { return getpid() == the_host; }

void end_by_default(int signal) {
  refuses_calls = false;  // the signal may have interrupted a component's step
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  sigaction(signal, &usual, nullptr);
  raise(signal);
}

void send_last_frame() {
  if (!is_the_host()) return;
  const fulmar_last_frame* frame = last_frame.exchange(nullptr, std::memory_order_acq_rel);
  if (!frame || frame->fd < 0 || write(frame->fd, frame->data, frame->size) >= 0) return;
  report({"\nfulmar: "});
  report(app_messages::last_frame_not_sent);
}

namespace {

const char* whose_code(std::uintptr_t address) {
  for (std::size_t i = 0; i < code_count; ++i)
    if (address >= codes[i].begin && address < codes[i].end) return codes[i].file.data();
  return nullptr;
}

const char* crash_name(int signal) {
  switch (signal) {
    case SIGSEGV: return "segmentation fault";
    case SIGABRT: return "abort";
    case SIGFPE: return "arithmetic fault";
    case SIGBUS: return "bus error";
    case SIGILL: return "illegal instruction";
    case SIGTRAP: return "trap";
    case SIGSYS: return "bad system call";
    default: return "signal";
  }
}

std::uintptr_t program_counter([[maybe_unused]] const void* context) {
#if defined(__x86_64__)
  return static_cast<std::uintptr_t>(static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
  return static_cast<const ucontext_t*>(context)->uc_mcontext.pc;
#else
  return 0;
#endif
}

/// A flight may have left an incomplete line on the terminal.
const char* beginning() { return in_flight ? "\nfulmar: " : "fulmar: "; }

/// When several threads end the host at the same time, the first reports the reason and the others wait for
/// its end. Returns false when the same thread comes again.
bool is_first_to_end() {
  const pid_t me = static_cast<pid_t>(syscall(SYS_gettid));
  pid_t first = 0;
  if (ends_it.compare_exchange_strong(first, me)) return true;
  if (first == me) return false;
  for (;;) pause();
}

/// A component that crashes ends the host; the handler at least reports its name.
void on_crash(int signal, siginfo_t*, void* context) {
  if (!is_the_host() || !is_first_to_end()) return end_by_default(signal);
  send_last_frame();
  const char* component = in_step.load(std::memory_order_relaxed);
  const char* loading = file_in_hand.load(std::memory_order_relaxed);
  const char* code = whose_code(program_counter(context));
  const char* cause = crash_name(signal);
  report({beginning()});
  if (component)
    report(app_messages::component_crashed, component, in_call.load(std::memory_order_relaxed), cause);
  else if (loading)
    report(app_messages::file_crashed, loading, file_is_being.load(std::memory_order_relaxed), cause);
  else if (code)
    report(app_messages::host_crashed_in, code, cause);
  else
    report(app_messages::host_crashed, cause);
  report_end();
  end_by_default(signal);
}

/// Handles an exit by a plugin's code or by a thread that it has started, in the same way as a crash.
void on_exit() {
  if (at_work != getpid() && ends_it == 0) return;
  if (!is_the_host() || !is_first_to_end()) return;
  at_work = 0;
  send_last_frame();
  const char* component = in_step.load(std::memory_order_relaxed);
  const char* loading = file_in_hand.load(std::memory_order_relaxed);
  report({beginning()});
  if (component)
    report(app_messages::component_ended_program, component, in_call.load(std::memory_order_relaxed));
  else if (loading)
    report(app_messages::file_ended_program, loading, file_is_being.load(std::memory_order_relaxed));
  else
    report(in_flight ? app_messages::thread_ended_program : app_messages::plugin_ended_program);
  report_end();
  leave(in_flight ? ExitCode::failed : ExitCode::refused);  // independent of the exit code of the plugin
}

}  // namespace

void handle_crashes() {
  the_host = getpid();
#ifndef FULMAR_SANITIZED                            // such a build reports crashes by itself
  static const auto* const stack = new CrashStack;  // the last destructor of a plugin may crash, too
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK | SA_NODEFER);
  for (const int signal : crash_signals) sigaction(signal, &action, nullptr);
  static_cast<void>(stack);
#else
  static_cast<void>(on_crash);
#endif
}

AtWork::AtWork() {
  static const int registered = std::atexit(on_exit) | std::at_quick_exit(on_exit);
  if (registered != 0) report({"fulmar: ", app_messages::exit_handler_not_set.c_str(), "\n"});
  handle_crashes();
  at_work = getpid();
}

AtWork::~AtWork() { at_work = 0; }

}  // namespace fulmar::core

// Replace the functions of the C library for plugins: these run no exit handler. A fork of the host may end
// with them.
extern "C" {
void _exit(int code) {  // NOLINT(bugprone-reserved-identifier): POSIX's name
  fulmar::core::on_exit();
  fulmar::core::leave(code);
}
void _Exit(int code) noexcept {  // NOLINT(bugprone-reserved-identifier): C's name
  fulmar::core::on_exit();
  fulmar::core::leave(code);
}
}
