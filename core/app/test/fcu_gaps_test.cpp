// SPDX-License-Identifier: BSD-3-Clause
// The shipped autopilot through a flight controller's port whose link is interrupted in a turn, or whose
// receiver loses its fix, in virtual time: some cases of bench_link_gaps.
#include <doctest/doctest.h>

#include "core/app/test/unlogged.hpp"
#include "core/app/test/virtual_controller.hpp"
#include "core/run/component/allocation.hpp"
#include "tools/fulmar_replay/replay.hpp"

using namespace fulmar::core;
using namespace fulmar::core::through_controller;
namespace fs = std::filesystem;

namespace fcu_gaps_test {

/// Under the sanitizers a flight takes twenty times as long.
bool quick() { return counts_allocations(); }

void check(const Gap& gap, const fs::path& folder) {
  CAPTURE(gap.length_s);
  CAPTURE(gap.gnss);
  CAPTURE(gap.height_m);
  const AfterGap a = fly(gap, folder, test::unlogged());
  CHECK(missed(gap, a) == "");
  CHECK(a.reported_blind == (gap.length_s > 0.3));  // the estimator bridges this time
}

TEST_CASE(
    "the link is silent in a turn: no command without a valid attitude, the pilot has it, then Fulmar") {
  const test::OwnStore folder;
  check({1, false, 30, 1}, folder.path);
  if (!quick()) return;
  check({0.2, true, 30, 2}, folder.path);
  check({0.5, true, 70, 3}, folder.path);
  check({2, false, 70, 4}, folder.path);
  check({3, true, 30, 5}, folder.path);
}

TEST_CASE(
    "the link was silent for more than 2 s, and there is no fix: the pilot keeps the aircraft, and is told") {
  const test::OwnStore folder;
  check({5, false, 70, 1}, folder.path);
  if (quick()) check({3, false, 30, 2}, folder.path);
}

TEST_CASE(
    "no fix in cruise: reported, dead reckoning follows the plan, and after 120 s the aircraft circles") {
  const test::OwnStore folder;
  for (const Outage outage : {Outage{100, 1, 500}, Outage{150, 2, 500}}) {
    if (!quick() && outage.length_s > 100) return;
    CAPTURE(outage.length_s);
    const AfterOutage a = fly(outage, folder.path, test::unlogged());
    CHECK(missed(outage, a) == "");
    CHECK(a.plan_m < 150);
    CHECK(a.reckoned_m < 3 * a.std_m);
    CHECK((a.circle_s >= 0) == (outage.length_s > 120));
  }
}

TEST_CASE("no fix in cruise: the limit of the standard deviation starts the circle before 120 s") {
  if (!quick()) return;
  const test::OwnStore folder;
  const Outage outage{90, 1, 15};
  const AfterOutage a = fly(outage, folder.path, test::unlogged());
  CHECK(missed(outage, a) == "");
  CHECK(a.circle_s > 20);
  CHECK(a.circle_s < 80);
}

double gyro_bias(const Flown& f) { return f.state() ? f.state()->gyro_bias_radps.x : 0; }

TEST_CASE(
    "the inertial unit's calibration moves in cruise: the estimator learns it, and the flight goes on") {
  if (!quick()) return;
  const test::OwnStore folder;
  constexpr double moved = 0.01;
  const Graph graph = mission(folder.path, 70, 1, {{"sim.moved_gyro", "[0.01, 0, 0]"}});
  Flown f(graph, test::unlogged());
  const auto until = [&f](double t_s) {
    return f.fly_while([t_s](const Row& r) { return r.script_s < t_s; });
  };
  REQUIRE(until(30));
  const double before = gyro_bias(f);
  f.set("moved_at", 30);
  REQUIRE(until(90));
  CHECK(gyro_bias(f) - before > 0.5 * moved);
  CHECK(gyro_bias(f) - before < 1.5 * moved);
  CHECK(f.row().host);
  CHECK(f.row().height_m > 60);
}

TEST_CASE("a missing sensor is reported before arming; without a heading no command is sent") {
  const test::OwnStore folder;
  struct Missing {
    const char *param, *reported;
    bool commands;
  };
  for (const Missing& m :
       {Missing{"sim.mag", "missing.magnetometer", false}, Missing{"sim.baro", "missing.barometer", true},
        Missing{"sim.pitot", "missing.pitot", true}}) {
    CAPTURE(std::string(m.param));
    const Graph graph = mission(folder.path, 70, 1, {{m.param, "no"}, {"sim.arm_at", "1000 s"}});
    Flown f(graph, test::unlogged());
    REQUIRE(f.fly_while([](const Row& r) { return r.t_s < 8; }));
    CHECK(f.reported_s(m.reported, 0) >= 0);
    CHECK((f.row().script_s >= 0) == m.commands);  // the script begins with the first command
  }
}

/// A flight with all disturbances up to `until_s`.
FlightResult trouble(const fs::path& folder, const fs::path& log, double until_s) {
  const Graph graph = mission(folder, 70, 1);
  FlightOptions o;
  o.log_file = log;
  Flown f(graph, o);
  const auto at = [&](double t_s, const char* param, double value) {
    REQUIRE(f.fly_while([t_s](const Row& r) { return r.script_s < t_s; }));
    f.set(param, value);
  };
  at(28, "gap_from", 30);
  at(28, "gap_until", 31);
  at(33, "no_fix_from", 34);
  at(33, "no_fix_until", 41);
  at(43, "gnss_silent_from", 44);
  at(43, "gnss_silent_until", 50);
  at(44, "pilot_from", 45);
  at(44, "pilot_until", 46);
  REQUIRE(f.fly_while([until_s](const Row& r) { return r.script_s < until_s; }));
  return f.finish();
}

TEST_CASE("a flight with a gap, without a fix and with a pilot is reproducible, and its log replays") {
  const test::OwnStore folder;
  const fs::path first = folder.path / "1.mcap", second = folder.path / "2.mcap";
  const FlightResult result = trouble(folder.path, first, 55);
  CHECK(result.guards.empty());
  const Recording recording(first);
  const Graph graph = recording.mission({}, [](const std::string&, bool) {});
  const auto [again, replayed] = replay(recording, graph, {});
  CHECK(replayed.equal());
  CHECK(replayed.notes.empty());
  CHECK(replayed.messages > 10000);
  if (!quick()) return;
  trouble(folder.path, second, 55);
  const auto bytes = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  CHECK(bytes(first) == bytes(second));
}

}  // namespace fcu_gaps_test
