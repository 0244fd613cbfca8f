// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/ends.hpp"

#include <unistd.h>

#include <csignal>
#include <ctime>

#include "core/app/last_act.hpp"
#include "core/app/messages.hpp"
#include "core/loader/in_hand.hpp"
#include "core/run/component/running_code.hpp"

namespace fulmar::core {

std::atomic<int> signal_seen{0};

namespace {

constexpr unsigned exit_patience_s = 3;
std::atomic<int> exit_code{-1};  // of a program that has only its exit handlers left

/// An exit handler or a destructor of a plugin hangs.
void end_hanging_exit() {
  const char* const file = file_in_hand.load(std::memory_order_relaxed);
  report({"fulmar: "});
  if (file)
    report(app_messages::file_hangs, file, file_is_being.load(std::memory_order_relaxed));
  else
    report(app_messages::exit_hangs);
  report({"\n"});
  leave(exit_code);
}

std::atomic<unsigned> patience_s{10};  // between a signal and the end of the flight

/// The first signal ends the flight between two ticks. When the flight rejects it, the next one counts as the
/// first again. The program ends when ten seconds pass without an end of the flight, because a component may
/// hang. A second signal ends it too, if it comes at least half a second later: timeout(1) sends two at once.
void note_signal(int signal) {
  static timespec latest{};
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!is_the_host()) return end_by_default(signal);
  const bool patience_over = signal == SIGALRM;
  if (patience_over && exit_code >= 0) end_hanging_exit();
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
  const char* call = in_call.load(std::memory_order_relaxed);
  report({"\nfulmar: "});
  if (component)
    report(patience_over ? app_messages::end_timed_out_in : app_messages::ended_by_second_signal_in, call,
           component);
  else
    report(patience_over ? app_messages::end_timed_out : app_messages::ended_by_second_signal);
  report_end();
  leave(130);
}

struct Name {
  int signal;
  const char* text;
};
constexpr Name endings[] = {{SIGQUIT, "SIGQUIT"}, {SIGUSR1, "SIGUSR1"},     {SIGUSR2, "SIGUSR2"},
                            {SIGXCPU, "SIGXCPU"}, {SIGVTALRM, "SIGVTALRM"}, {SIGPROF, "SIGPROF"},
                            {SIGIO, "SIGIO"},     {SIGPWR, "SIGPWR"},       {SIGSTKFLT, "SIGSTKFLT"}};

/// Real-time signals have numbers: SIGRTMIN+5.
void report_ending(int signal) {
  for (const Name& end : endings)
    if (end.signal == signal) return report(app_messages::ended_by_signal, end.text);
  const int n = signal - SIGRTMIN;
  char name[] = "SIGRTMIN\0\0\0";
  char* end = name + sizeof "SIGRTMIN" - 1;
  if (n > 0) *end++ = '+';
  if (n >= 10) *end++ = static_cast<char>('0' + n / 10);
  if (n > 0) *end = static_cast<char>('0' + n % 10);
  report(app_messages::ended_by_signal, name);
}

/// Handles a signal that ends the program at once. A further signal does not cut the report short.
void on_end(int signal) {
  if (!is_the_host()) return end_by_default(signal);
  static std::atomic<bool> ending{false};
  if (ending.exchange(true)) return;
  send_last_frame();
  report({"\nfulmar: "});
  report_ending(signal);
  report_end();
  end_by_default(signal);
}

}  // namespace

void handle_signals(bool hardware, unsigned patience) {
  patience_s = patience;
  struct sigaction action {};
  action.sa_handler = note_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) sigaction(signal, &action, nullptr);
  if (!hardware) sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = SIG_IGN;
  if (hardware) sigaction(SIGHUP, &action, nullptr);  // the aircraft flies on without the terminal
  sigaction(SIGPIPE, &action, nullptr);               // no reader of the output
  sigaction(SIGXFSZ, &action, nullptr);               // write returns an error instead
  action.sa_handler = on_end;
  action.sa_flags = SA_NODEFER;
  for (const Name& end : endings) sigaction(end.signal, &action, nullptr);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) sigaction(signal, &action, nullptr);
  handle_crashes();
}

void expect_exit(int code) {
  exit_code = code;
  alarm(exit_patience_s);
}

UnderWay::UnderWay(const Graph& graph, const std::string& log) {
  prepare_end(log);
  forget_code();
  for (const Component& c : graph.components)
    if (c.library)
      note_code(c.plugin->file,
                reinterpret_cast<const void*>(c.library->functions(c.index_in_plugin).create));
  in_flight = true;
}

UnderWay::~UnderWay() {
  in_flight = false;
  prepare_end("", true);
}

}  // namespace fulmar::core
