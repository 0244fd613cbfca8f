// SPDX-License-Identifier: BSD-3-Clause
// The rows of docs/safety.md in flight: faults of a component, in the loop and in a child, and the action of
// the host.
#include <unistd.h>

#include <cfenv>
#include <csignal>

#include "core/run/component/allocation.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"

namespace safety_test {

namespace {

struct Row {
  const char* fault;
  const char* reported;  // text of the guard event
  bool in_loop;          // the loop survives it without a child
  bool paced = false;
  bool own_affair = false;  // of a child
};

const Row rows[] = {
    {"nan", "types.value_not_finite(u_frac, nan)", true},
    {"range", "types.value_out_of_range(u_frac, 1.5, ", true},
    {"probe_nan", "run.probe_not_finite(error_m)", true},
    {"throws", "the law is broken  ?\xc3\xa9  2J", true},
    {"fails", "says that it failed", true},
    {"crashes", "isolate.segmentation_fault", false},
    {"aborts", "isolate.aborted", false},
    {"exits", "isolate.child_exited(3)", false},
    {"overflows", "isolate.stack_overflowed", false},
    {"hangs", "isolate.child_hung(500)", false},
    {"rounds", "loader.float_mode_changed", true},
    {"masks", "run.call_refused(pthread_sigmask, what that changes is everybody's)", true, false, true},
    {"deafens", "run.call_refused(signal, what that changes is everybody's)", true, false, true},
    {"listens", "run.call_refused(sigaction, what that changes is everybody's)", true, false, true},
    {"spawns", "run.call_refused(posix_spawnp, run.loop_would_wait)", true, false, true},
};

std::string law(const Row& row, bool isolated) {
  return "  one: {fills: law, use: lab/Law, "s + (isolated ? "run: process, hang: 500 ms, " : "") +
         "params: {id: 1, u: 0.1, fault: " + row.fault + ", fault_at: 0.1 s}}\n" + with_fallback;
}

/// At the tick after the fault the cart has a command of the fallback, and the flight continues to its end.
void check_fallback(const Row& row, bool isolated) {
  CAPTURE(row.fault);
  CAPTURE(isolated);
  const Graph g = mission(law(row, isolated));
  FlightOptions o = options(0.3);
  if (row.paced || std::string(row.fault) == "hangs") o.speed = 20;
  Flight flight(g, o);
  const int first = static_cast<int>(1.1 * 400);  // the tick of the law's fault
  for (int i = 0; i <= first; ++i) REQUIRE(flight.step());
  REQUIRE(flight.step());
  CHECK(value(g, flight, "sim", "applied", "present") == 1);
  CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.2);
  CHECK(value(g, flight, "sim", "applied", "seen_m") == first);  // of that tick: none was missed
  while (flight.step()) {
  }
  const FlightResult r = flight.finish();
  CHECK(r.outcome == Outcome::flown);
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "one");
  CAPTURE(r.guards[0].what);
  CHECK(r.guards[0].what.find(row.reported) != std::string::npos);
  CHECK(r.guards[0].action == "two takes over");
  CHECK(r.guards[0].at_ns == 100'000'000);
}

auto handler_of(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

}  // namespace

TEST_CASE("in the loop: after any fault of a step the fallback flies in the same tick") {
  for (const Row& row : rows)
    if (row.in_loop) check_fallback(row, false);
}

TEST_CASE(
    "in a child: a crash, an exit, a hang costs nothing but the component; the fallback flies in the same "
    "tick") {
  for (const Row& row : rows)
    if ((FULMAR_CRASH_TESTS || row.in_loop) && !row.own_affair) check_fallback(row, true);
}

TEST_CASE("process-wide state that a component tries to change stays as it was") {
  sigset_t before, after;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  for (const char* const fault : {"rounds", "narrows", "masks", "deafens", "listens"}) {
    CAPTURE(fault);
    const auto interrupt = handler_of(SIGINT), crash = handler_of(SIGSEGV);
    const Graph g = mission(law({fault, "", true}, false));
    Flight flight(g, options(0.3));
    CHECK(flight.run().guards.size() == 1);
    CHECK(std::fegetround() == FE_TONEAREST);
    volatile long double one = 1, little = std::numeric_limits<long double>::epsilon();
    const volatile long double sum = one + little;
    CHECK(sum > 1);
    pthread_sigmask(SIG_SETMASK, nullptr, &after);
    CHECK(sigismember(&before, SIGUSR1) == sigismember(&after, SIGUSR1));
    CHECK((handler_of(SIGINT) == interrupt));
    CHECK((handler_of(SIGSEGV) == crash));
  }
}

TEST_CASE("a process that a component has forked is not the host, and is unrestricted") {
  const Graph g = mission(law({"fosters", "", true}, false));
  CHECK(Flight(g, options(0.11)).run().guards.empty());
}

TEST_CASE("an output with a stamp in the future, or before any flight, is an invalid output") {
  struct Stamp {
    const char* ahead;
    bool good;
  };
  for (const Stamp& stamp : {Stamp{"1e10 s", false}, Stamp{"2 s", false}, Stamp{"0.5 s", true},
                             Stamp{"0 s", true}, Stamp{"-7000 s", true}, Stamp{"-7300 s", false}})
    for (const char* const mode : {"", "run: async, latency: 10 ms, ", "run: process, "}) {
      CAPTURE(stamp.ahead);
      CAPTURE(mode);
      const Graph g = mission("  one: {fills: law, use: lab/Mute, "s + mode +
                              "params: {dated_at: 0.05 s, ahead: " + stamp.ahead + "}}\n" + with_fallback);
      const FlightResult result = Flight(g, options(0.1)).run();
      CHECK(result.guards.size() == (stamp.good ? 0 : 1));
      if (!stamp.good) CHECK(result.guards.at(0).at_ns <= 60'000'000);
    }
}

TEST_CASE("a component that forks in flight is stopped, in the loop, beside it and in a child") {
  for (const char* const mode : {"", "run: async, latency: 10 ms, ", "run: process, "})
    for (const char* const fault : {"forks_on", "vforks_on"}) {
      CAPTURE(mode);
      CAPTURE(fault);
      const Graph g =
          mission("  one: {fills: law, use: lab/Law, "s + mode + "params: {id: 1, u: 0.1, fault: " + fault +
                  ", fault_at: 0.1 s}}\n" + with_fallback);
      Flight flight(g, options(0.15));
      const FlightResult result = flight.run();
      REQUIRE(result.guards.size() == 1);
      CHECK(result.guards[0].component == "one");
      CHECK(result.guards[0].at_ns < 120'000'000);
      CHECK(value(g, flight, "sim", "applied", "by") == 2);
    }
}

TEST_CASE("a component beside the loop may start a process, because it may take longer") {
  const Graph g = mission(
      "  one: {fills: law, use: lab/Law, run: async, latency: 10 ms, params: {id: 1, u: 0.1, fault: spawns, "
      "fault_at: 0.1 s}}\n"s +
      with_fallback);
  Flight flight(g, options(0.15));
  CHECK(flight.run().guards.empty());
}

TEST_CASE("a component that changes the floating-point mode in its own thread is judged alike") {
  const Graph g = mission(
      "  one: {fills: law, use: lab/Law, run: async, latency: 10 ms, params: {id: 1, u: 0.1, fault: rounds, "
      "fault_at: 0.1 s}}\n"s +
      with_fallback);
  Flight flight(g, options(0.3));
  const FlightResult r = flight.run();
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "one");
  CHECK(r.guards[0].what.find("loader.float_mode_changed") != std::string::npos);
}

TEST_CASE("a component whose heap grows is stopped at its limit, in the loop and in a child") {
  if (!counts_allocations()) {
    MESSAGE("skipped: a sanitized build does not count the heap");
    return;
  }
  for (const bool isolated : {false, true}) {
    CAPTURE(isolated);
    const Graph g =
        mission("  one: {fills: law, use: lab/Law, memory: 10 MB, "s + (isolated ? "run: process, " : "") +
                "params: {fault: leaks, fault_at: 0 s}}\n" + with_fallback);
    Flight flight(g, options(0.2));
    const FlightResult r = flight.run();
    CHECK(r.outcome == Outcome::flown);
    REQUIRE(r.guards.size() == 1);
    CHECK(r.guards[0].what.find("run.heap_too_large(") != std::string::npos);
    CHECK(r.guards[0].action == "two takes over");
    CHECK(r.guards[0].at_ns == 9 * 2'500'000);  // 1 MB and a little per tick, the first at 0
  }
}

TEST_CASE("a step over its budget five times in a row, paced: the fallback takes over; in a child too") {
  for (const bool isolated : {false, true}) {
    CAPTURE(isolated);
    const Graph g = mission("  one: {fills: law, use: lab/Law, budget: 500 us, "s +
                            (isolated ? "run: process, hang: 10 s, " : "") +  // a loaded machine must not
                                                                              // count as a hang
                            "params: {fault: slow, fault_at: 0.1 s}}\n" + with_fallback);
    FlightOptions o = options(0.3);
    o.speed = 4;
    Flight flight(g, o);
    const FlightResult r = flight.run();
    CHECK(r.outcome == Outcome::flown);
    REQUIRE(r.guards.size() >= 1);
    CHECK(r.guards[0].what.find("run.time_budget_exceeded") != std::string::npos);
    CHECK(r.guards[0].action == "two takes over");
  }
}

TEST_CASE("a step over its budget now and then is counted, and stops no component") {
  const Graph g = mission(
      "  one: {fills: law, use: lab/Law, budget: 500 us, params: {fault: stutters}}\n"s + with_fallback,
      {{"one.fault_at", "0"}});
  FlightOptions o = options(0.3);
  o.speed = 4;
  Flight flight(g, o);
  const FlightResult r = flight.run();
  CHECK(r.outcome == Outcome::flown);
  CHECK(r.guards.empty());
  for (const ComponentStats& c : r.components)
    if (c.name == "one") CHECK(c.overruns > 10);
}

TEST_CASE("a component that rejects a parameter keeps the previous value") {
  const Graph g = mission(one_phase);
  Flight flight(g, options(0.2));
  for (int i = 0; i < 10; ++i) REQUIRE(flight.step());
  ParamValue loud;
  loud.number[0] = 1;
  CHECK_THROWS_WITH(set_parameter(flight, "watch", "noise", loud), "watch: too loud");
  const double before = value(g, flight, "watch", "tally", "sum_m");
  REQUIRE(flight.step());
  const double burst = 3 * value(g, flight, "sim", "signal", "x_m") + 0.1 + 0.2;
  CHECK(value(g, flight, "watch", "tally", "sum_m") - before == doctest::Approx(burst));  // and no noise
}

}  // namespace safety_test
