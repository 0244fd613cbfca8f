// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/ends.hpp"

#include <link.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <initializer_list>

#include "core/app/words.hpp"
#include "core/run/allocation.hpp"
#include "core/run/last_words.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {

std::atomic<int> signal_seen{0};

namespace {

char last_words[512];                  // where the log lies, prepared beforehand
std::atomic<pid_t> flying{0};          // the process in which a flight is under way: a fork of it is none
std::atomic<unsigned> patience_s{10};  // between a signal and the end of the flight

/// Where a plugin's code lies, for a crash in a thread that is nobody's.
struct Code {
  std::uintptr_t begin = 0, end = 0;
  std::array<char, 64> file{};
};
std::array<Code, 64> codes;
std::atomic<std::size_t> code_count{0};

void note_code(const std::string& file, const void* function) {
  const std::size_t n = code_count;
  if (n == codes.size()) return;
  Code code;
  code.begin = reinterpret_cast<std::uintptr_t>(function);
  std::snprintf(code.file.data(), code.file.size(), "%s", file.c_str());
  const auto look = [](dl_phdr_info* object, std::size_t, void* to) {
    Code& c = *static_cast<Code*>(to);
    std::uintptr_t begin = ~std::uintptr_t{0}, end = 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
      const auto& part = object->dlpi_phdr[i];
      if (part.p_type != PT_LOAD) continue;
      begin = std::min<std::uintptr_t>(begin, object->dlpi_addr + part.p_vaddr);
      end = std::max<std::uintptr_t>(end, object->dlpi_addr + part.p_vaddr + part.p_memsz);
    }
    if (c.begin < begin || c.begin >= end) return 0;
    c.begin = begin, c.end = end;
    return 1;
  };
  if (dl_iterate_phdr(look, &code) == 0) return;
  codes[n] = code;
  code_count = n + 1;
}

// ---- async-signal-safe from here on, as all that is done by a program that ends

const char* whose_code(std::uintptr_t address) {
  for (std::size_t i = 0; i < code_count; ++i)
    if (address >= codes[i].begin && address < codes[i].end) return codes[i].file.data();
  return nullptr;
}

void tell(std::initializer_list<const char*> words) {
  for (const char* word : words) write_last_words(word);
}

[[noreturn]] void leave(int code) {
  for (;;) syscall(SYS_exit_group, code);
}

/// What the vehicle's device is to hear when the host goes.
void send_last_frame() {
  const fulmar_last_frame* frame = last_frame.exchange(nullptr, std::memory_order_acq_rel);
  if (frame && frame->fd >= 0 && write(frame->fd, frame->data, frame->size) < 0)
    tell({"\nfulmar: the last frame could not be sent"});
}

/// The first signal ends the flight between two ticks; when the flight refuses it, the next one is the first
/// again. One that follows an unanswered one, half a second later or more (timeout(1) sends two at once), or
/// ten seconds without an end, ends the program: a component may be hanging.
void note_signal(int signal) {
  static timespec latest{};
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const bool patience_over = signal == SIGALRM;
  if (patience_over && signal_seen.load() == 0) return;
  const double since_s = static_cast<double>(now.tv_sec - latest.tv_sec) +
                         1e-9 * static_cast<double>(now.tv_nsec - latest.tv_nsec);
  if (!patience_over && since_s < 0.5 && latest.tv_sec > 0) return;
  latest = now;
  if (!patience_over && signal_seen.exchange(signal) == 0) {
    alarm(patience_s);
    return;
  }
  send_last_frame();
  const char* component = in_step.load(std::memory_order_relaxed);
  tell(
      {patience_over ? "\nfulmar: ended, since the flight did not" : "\nfulmar: ended by the second signal"});
  if (component) tell({" in the ", in_call.load(std::memory_order_relaxed), " of ", component});
  tell({last_words});
  leave(130);
}

struct Name {
  int signal;
  const char* text;
};
constexpr Name crashes[] = {{SIGSEGV, " (segmentation fault)"}, {SIGABRT, " (abort)"},
                            {SIGFPE, " (arithmetic fault)"},    {SIGBUS, " (bus error)"},
                            {SIGILL, " (illegal instruction)"}, {SIGTRAP, " (trap)"},
                            {SIGSYS, " (bad system call)"}};
constexpr Name endings[] = {{SIGQUIT, "SIGQUIT"}, {SIGUSR1, "SIGUSR1"},     {SIGUSR2, "SIGUSR2"},
                            {SIGXCPU, "SIGXCPU"}, {SIGVTALRM, "SIGVTALRM"}, {SIGPROF, "SIGPROF"},
                            {SIGIO, "SIGIO"},     {SIGPWR, "SIGPWR"},       {SIGSTKFLT, "SIGSTKFLT"}};

template <std::size_t n>
const char* name_of(int signal, const Name (&names)[n]) {
  for (const Name& name : names)
    if (name.signal == signal) return name.text;
  return "";
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

/// A component that crashes takes the host with it; at least it is named.
void on_crash(int signal, siginfo_t*, void* context) {
  send_last_frame();
  const char* component = in_step.load(std::memory_order_relaxed);
  const char* file = whose_code(program_counter(context));
  tell({"\nfulmar: ", component ? component : "the host", " crashed"});
  if (component)
    tell({" in its ", in_call.load(std::memory_order_relaxed)});
  else if (file)
    tell({" in code of ", file});
  tell({name_of(signal, crashes), last_words});
  raise(signal);  // the default action, restored by SA_RESETHAND
}

/// Somebody wants an end at once.
void on_end(int signal) {
  send_last_frame();
  tell({"\nfulmar: ended by ", name_of(signal, endings), last_words});
  raise(signal);
}

/// A component, or a thread that it has started, ends the host as a crash does.
void on_exit() {
  if (flying != getpid()) return;
  flying = 0;
  send_last_frame();
  const char* component = in_step.load(std::memory_order_relaxed);
  const char* call = in_call.load(std::memory_order_relaxed);
  if (component)
    tell({"\nfulmar: ", component, " ended the program in its ", call, last_words});
  else
    tell({"\nfulmar: a thread of a component ended the program", last_words});
  leave(1);  // whatever code it asked for, nothing has been flown to its end
}

}  // namespace

void handle_signals(bool hardware, unsigned patience) {
  patience_s = patience;
  static const int registered = std::atexit(on_exit) | std::at_quick_exit(on_exit);
  if (registered != 0) tell({"fulmar: no room for an exit handler\n"});
  struct sigaction action {};
  action.sa_handler = note_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) sigaction(signal, &action, nullptr);
  if (!hardware) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = SIG_IGN;
  if (hardware) sigaction(SIGHUP, &action, nullptr);  // the terminal is gone, the aircraft is not
  sigaction(SIGPIPE, &action, nullptr);               // nobody reads what is printed
  sigaction(SIGXFSZ, &action, nullptr);               // comes back as an error of write
  action.sa_handler = on_end;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
  for (const Name& end : endings) sigaction(end.signal, &action, nullptr);
  if (!counts_allocations()) return;                // a sanitized build reports crashes by itself
  static const auto* const stack = new CrashStack;  // a plugin's last destructor may crash, too
  action.sa_sigaction = on_crash;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int signal : crash_signals) sigaction(signal, &action, nullptr);
  static_cast<void>(stack);
}

UnderWay::UnderWay(const Graph& graph, const std::string& log) {
  std::snprintf(last_words, sizeof last_words, "%s%s%s\n",
                log.empty() ? "." : ". What was logged until then is in ", log.c_str(),
                log.empty() ? "" : ".part");
  code_count = 0;
  for (const Component& c : graph.components)
    if (c.library)
      note_code(c.plugin->file,
                reinterpret_cast<const void*>(c.library->functions(c.index_in_plugin).create));
  flying = getpid();
}

UnderWay::~UnderWay() {
  flying = 0;
  std::snprintf(last_words, sizeof last_words, " after the flight, whose log is closed.\n");
}

}  // namespace fulmar::core

// Stand in front of the C library's, for components: they run no exit handler. A fork of the host ends as it
// likes.
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
