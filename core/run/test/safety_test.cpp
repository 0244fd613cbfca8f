// SPDX-License-Identifier: BSD-3-Clause
// The rows of docs/safety.md, made to happen in flight: what a component does wrong, in the loop and in a
// child, and what the host does.
#include <sys/wait.h>

#include <csignal>

#include "core/run/allocation.hpp"
#include "core/run/test/lab.hpp"

namespace safety_test {

namespace {

struct Row {
  const char* fault;
  const char* told;  // in the guard's words
  bool in_loop;      // the loop survives it without a child
  bool paced = false;
};

const Row rows[] = {
    {"nan", "u_frac is nan", true},
    {"range", "u_frac is 1.5", true},
    {"probe_nan", "probe 'error_m' is not finite", true},
    {"throws", "the law is broken  ?\xc3\xa9", true},
    {"fails", "says that it failed", true},
    {"crashes", "crashed (segmentation fault)", false},
    {"aborts", "abort", false},
    {"exits", "exit code 3", false},
    {"overflows", "crashed", false},
    {"hangs", "hung", false},
};

std::string law(const Row& row, bool isolated) {
  return "  one: {fills: law, use: lab/Law, "s + (isolated ? "run: process, hang: 500 ms, " : "") +
         "params: {id: 1, u: 0.1, fault: " + row.fault + ", fault_at: 0.1 s}}\n" + with_fallback;
}

/// At the tick after the fault the cart has got a command of the fallback, and the flight goes on to its end.
void check_fallback(const Row& row, bool isolated) {
  CAPTURE(row.fault);
  CAPTURE(isolated);
  const Graph g = mission(law(row, isolated));
  FlightOptions o = options(0.3);
  if (row.paced || std::string(row.fault) == "hangs") o.speed = 20;
  Flight flight(g, o);
  const int first = static_cast<int>(1.1 * 400);  // the tick at which the law misbehaves
  for (int i = 0; i <= first; ++i) REQUIRE(flight.step());
  REQUIRE(flight.step());
  CHECK(value(g, flight, "sim", "applied", "present") == 1);
  CHECK(value(g, flight, "sim", "applied", "u_frac") == 0.2);
  CHECK(value(g, flight, "sim", "applied", "seen_m") == first);  // of that very tick: nothing was missed
  while (flight.step()) {
  }
  const FlightResult r = flight.finish();
  CHECK(r.outcome == Outcome::flown);
  REQUIRE(r.guards.size() == 1);
  CHECK(r.guards[0].component == "one");
  CHECK(r.guards[0].what.find(row.told) != std::string::npos);
  CHECK(r.guards[0].action == "two takes over");
  CHECK(r.guards[0].at_ns == 100'000'000);
}

}  // namespace

TEST_CASE("in the loop: whatever a step says or throws, the fallback flies in the same tick") {
  for (const Row& row : rows)
    if (row.in_loop) check_fallback(row, false);
}

TEST_CASE(
    "in a child: a crash, an exit, a hang costs nothing but the component; the fallback flies in the same "
    "tick") {
  for (const Row& row : rows)
    if (FULMAR_CRASH_TESTS || row.in_loop) check_fallback(row, true);
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
    CHECK(r.guards[0].what.find("its heap has grown by") != std::string::npos);
    CHECK(r.guards[0].action == "two takes over");
    CHECK(r.guards[0].at_ns == 9 * 2'500'000);  // 1 MB and a little per tick, the first at 0
  }
}

TEST_CASE("a step over its budget five times in a row, paced: the fallback takes over; in a child too") {
  for (const bool isolated : {false, true}) {
    CAPTURE(isolated);
    const Graph g = mission("  one: {fills: law, use: lab/Law, budget: 500 us, "s +
                            (isolated ? "run: process, hang: 10 s, " : "") +  // a loaded machine is no hang
                            "params: {fault: slow, fault_at: 0.1 s}}\n" + with_fallback);
    FlightOptions o = options(0.3);
    o.speed = 4;
    Flight flight(g, o);
    const FlightResult r = flight.run();
    CHECK(r.outcome == Outcome::flown);
    REQUIRE(r.guards.size() >= 1);
    CHECK(r.guards[0].what.find("time budget") != std::string::npos);
    CHECK(r.guards[0].action == "two takes over");
  }
}

TEST_CASE("a component that crashes in a thread of its own is named, whatever the loop is in") {
  if (!FULMAR_CRASH_TESTS) return;
  const fs::path log = folder().path / "crash-async.mcap", said = folder().path / "said-async";
  struct End {
    const char *fault, *told;
  };
  for (const End& end : {End{"crashes", "one crashed in its step (segmentation fault)"},
                         End{"aborts", "one crashed in its step (abort)"}}) {
    CAPTURE(end.fault);
    fs::remove(log.string() + ".part");
    mission("  one: {fills: law, use: lab/Law, run: async, latency: 10 ms, params: {fault: "s + end.fault +
            ", fault_at: 0.1 s}}\n" + one_phase);
    std::ignore =
        std::system((std::string(FULMAR_BIN_DIR) + "/fulmar run " + (folder().path / "lab.yaml").string() +
                     " --log " + log.string() + " >/dev/null 2>" + said.string())
                        .c_str());
    std::ifstream in(said);
    const std::string words((std::istreambuf_iterator<char>(in)), {});
    CHECK_MESSAGE(words.find(end.told) != std::string::npos, words);
  }
}

TEST_CASE(
    "when a component takes the host with it, the device gets the last frame that the vehicle encoded") {
  if (!FULMAR_CRASH_TESTS) {
    MESSAGE("skipped: a sanitized build handles crashes by itself");
    return;
  }
  struct End {
    const char *fault, *told;
    int code;
  };
  for (const End& end : {End{"crashes", "one crashed in its step (segmentation fault)", 128 + SIGSEGV},
                         End{"aborts", "one crashed in its step (abort)", 128 + SIGABRT},
                         End{"overflows", "one crashed in its step", 128 + SIGSEGV},
                         End{"exits", "one ended the program in its step", 1}}) {
    CAPTURE(end.fault);
    // the program itself, since its handlers are what is tested
    const fs::path device = folder().path / "device", log = folder().path / "crash.mcap",
                   said = folder().path / "said";
    fs::remove(device);
    fs::remove(log.string() + ".part");
    mission("  sim: {fills: vehicle, use: lab/Cart, params: {device: " + device.string() +
            "}}\n  one: {fills: law, use: lab/Law, params: {fault: " + end.fault + ", fault_at: 0.1 s}}\n" +
            with_fallback);
    const int status =
        std::system((std::string(FULMAR_BIN_DIR) + "/fulmar run " + (folder().path / "lab.yaml").string() +
                     " --log " + log.string() + " >/dev/null 2>" + said.string())
                        .c_str());
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == end.code);
    double u = 0;
    std::ifstream(device, std::ios::binary).read(reinterpret_cast<char*>(&u), sizeof u);
    CHECK(u == -0.25);  // the mission's failsafe
    std::stringstream words;
    words << std::ifstream(said).rdbuf();
    CHECK(words.str().find(end.told) != std::string::npos);
    CHECK(fs::exists(log.string() + ".part"));
  }
}

}  // namespace safety_test
