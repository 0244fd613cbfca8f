// SPDX-License-Identifier: BSD-3-Clause
// Flights are replayed from their logs, to equal bytes.
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/run/component/allocation.hpp"
#include "core/run/test/commands.hpp"
#include "core/sanitized.hpp"
#include "tools/fulmar_log/recover.hpp"
#include "tools/fulmar_replay/test/replays.hpp"

namespace replay_test {

using namespace lab;

TEST_CASE("what phases do to the vehicle at given times is flown again, byte for byte") {
  const fs::path log = fresh("gap.mcap"), again = fresh("gap-again.mcap"), file = folder().path / "gap.yaml";
  std::ofstream(file) << "mission: gap\nextends: fulmar:missions/hourglass.yaml\nphases:\n"
                         "  cruise: {next: [{to: lost, when: \"time > 15 s\"}]}\n"
                         "  lost: {vehicle: {use: sim, set: {gnss_works: false}}, next: [{to: found, when: "
                         "\"time > 18 s\"}]}\n  found: {}\n";
  Flight(load_mission(file.string(), {}), logged(log, 20)).run();
  std::vector<double> fixes_s;
  const WholeLog flown = read_mcap(log);
  for (const McapFile::Message& m : flown.messages)
    if (flown.channels.at(m.channel).topic == "/vehicle/gnss")
      fixes_s.push_back(1e-9 * static_cast<double>(m.log_ns - flown.messages.front().log_ns));
  double max_s = 0;
  for (std::size_t i = 1; i < fixes_s.size(); ++i) max_s = std::max(max_s, fixes_s[i] - fixes_s[i - 1]);
  CHECK(max_s == doctest::Approx(3).epsilon(0.1));
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE("a record is fixed when the flight begins: nobody changes it or a field of it in flight") {
  const CommandTable commands(load_mission(hourglass, {}));
  const std::size_t sim = commands.component("sim");
  CHECK_THROWS_WITH_AS(commands.param(sim, "airframe.mass"), "run.parameter_not_live(sim, airframe)", Error);
  Command whole = command_of(CommandKind::parameter, "sim", "airframe");
  CHECK_THROWS_WITH_AS(commands.prepare(whole), doctest::Contains("run.parameter_not_live("), Error);
}

TEST_CASE("a flight is flown again from its log alone, to the same file") {
  const fs::path log = fresh("hourglass.mcap"), again = fresh("hourglass-again.mcap"),
                 mission = folder().path / "mine.yaml";
  std::ofstream(mission)
      << "mission: mine\nextends: " << FULMAR_SOURCE_DIR "/configs/missions/common.yaml\nairframe: "
      << FULMAR_SOURCE_DIR
      "/configs/airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
      << "components: {sim: {params: {sensors: rosflight, turbulence: light}}, plan: {params: {plan: "
      << FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml}}}\n";
  const std::string options =
      " --duration 10 --seed 3 --set \"slc.roll_limit=30 deg\" --set \"sim.airframe.mass=5 kg\""
      " --record nav.state@200Hz --record outer.* --log ";
  CHECK(run_fulmar("run " + mission.string() + options + log.string()).code == 0);
  fs::remove(mission);
  const auto [code, out] = run_fulmar("replay " + log.string() + " --json --log " + again.string());
  CHECK(code == 0);
  const nlohmann::json j = nlohmann::json::parse(out);
  CHECK(j.at("equal") == true);
  CHECK(j.at("differing_bytes") == 0);
  CHECK(j.at("ticks") == 400 * 15);  // from -5 s to 10 s
  CHECK(j.at("mission") == "mine");
  CHECK(j.at("notes").empty());
  CHECK(contents(log) == contents(again));
  CHECK(contents(log).size() > 100'000);
}

TEST_CASE("a replay's log that is in the way is refused before anything flies") {
  const fs::path log = fresh("way.mcap"), other = fresh("in-the-way.mcap");
  CHECK(run_fulmar("run " + hourglass + " --duration 2 --log " + log.string()).code == 0);
  std::ofstream(other) << "mine";
  const auto [code, out] = run_fulmar("replay " + log.string() + " --log " + other.string());
  CHECK(code == 4);
  CHECK(out.find("equal") == std::string::npos);
  CHECK(contents(other) == "mine");
}

TEST_CASE("a flight that nobody armed is flown again so") {
  const fs::path log = fresh("unarmed.mcap");
  CHECK(run_fulmar("run " + hourglass + " --arm off --duration 2 --log " + log.string()).code == 0);
  CHECK(replay_of(log).equal());
}

TEST_CASE(
    "what was asked of a flight is asked again in the same tick: parameters, requests, a swap, the reset of "
    "a guard") {
  const fs::path log = fresh("asked.mcap"), again = fresh("asked-again.mcap");
  const Graph g = mission(with_fallback);
  Flight flight(g, logged(log, 1));
  const auto steps = [&](int n) {
    for (int i = 0; i < n; ++i) flight.step();
  };
  ParamValue v;
  steps(100);
  swap(flight, "one", variant("_better"));
  steps(100);
  v.number[0] = 0.1234567890123;
  set_parameter(flight, "one", "u", v);
  steps(300);
  const double to_m = 7.25;
  request(flight, "watch", "ask", to_m);
  steps(7);
  reset_guards(flight);
  while (flight.step()) {
  }
  const FlightResult r = flight.finish();
  CHECK(r.outcome == Outcome::flown);
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE("a log is data: a plugin that lies where one flew runs only when it is asked for") {
  const fs::path log = fresh("own.mcap"), own = folder().path / "own.so",
                 empty = folder().path / "empty-store";
  const auto put = [&](const std::string& name) {
    fs::copy_file(variant(name), own, fs::copy_options::overwrite_existing);
  };
  put("_better");
  Flight(mission("  one: {fills: law, use: " + own.string() + "/Law, params: {id: 1, u: 0.1}}\n" +
                 std::string(one_phase)),
         logged(log, 0.5))
      .run();
  CHECK(replay_of(log).equal());
  put("_throwing");
  CHECK(replay_of(log).equal());  // the copy that was kept
  fs::create_directory(empty);
  fs::permissions(empty, fs::perms::owner_all);
  const char* const before = std::getenv("FULMAR_STORE");
  const std::string store = before ? before : "";
  setenv("FULMAR_STORE", empty.c_str(), 1);
  const std::string refused = "graph.plugin_not_admitted(" + own.string();
  const std::string other = refused + ",  is not what flew", foreign = refused + ",  is what flew";
  CHECK_THROWS_WITH_AS(replay_of(log), doctest::Contains(other.c_str()), Error);
  put("_better");  // the plugin that the log names; its author is unknown
  CHECK_THROWS_WITH_AS(replay_of(log), doctest::Contains(foreign.c_str()), Error);
  Overrides changes;
  changes.with = {{"one", own.string() + "/Law"}};
  CHECK_NOTHROW(replay_of(log, changes));
  put("_throwing");
  changes.with = {{"one", own.string()}};
  CHECK_THROWS_AS(replay_of(log, changes), Error);  // it is loaded, and has no law today
  before ? setenv("FULMAR_STORE", store.c_str(), 1) : unsetenv("FULMAR_STORE");
}

TEST_CASE("a log that was cut off is flown again as far as it is whole, as is what was recovered of it") {
  const fs::path log = fresh("whole.mcap"), cut = fresh("cut.mcap"), recovered = fresh("recovered.mcap");
  Flight flight(mission(with_fallback), logged(log, 3));
  flight.run();
  const std::string bytes = contents(log);
  std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() * 3 / 5);
  recover_mcap(cut, recovered);
  for (const fs::path& file : {cut, recovered}) {
    const ReplayResult r = replay_of(file);
    CHECK(r.equal());
    CHECK(!r.same_file);
    CHECK(r.cut_off == (file == cut));
    CHECK(r.ticks > 400);
    CHECK(r.ticks < 1601);
    CHECK(r.messages > 1000);
    CHECK(r.differing_messages == 0);
  }
  const fs::path damaged = fresh("damaged.mcap"), holed = fresh("holed.mcap");
  std::ofstream(damaged, std::ios::binary)
      << std::string(bytes).replace(bytes.size() / 2, 200, std::string(200, '?'));
  recover_mcap(damaged, holed);
  const std::string gap = holed.string() + ": replay.ticks_lost(";
  CHECK_THROWS_WITH_AS(replay_of(holed), doctest::Contains(gap.c_str()), Error);
}

TEST_CASE("whatever a vehicle never publishes, its flight is flown again from its log, to the same file") {
  for (int silent = 0; silent < 8; ++silent) {
    CAPTURE(silent);
    const fs::path log = fresh("silent.mcap"), again = fresh("silent-again.mcap");
    const Graph g = mission(
        "  sim: {fills: vehicle, use: lab/Cart, params: {mute_at: "s +
        ((silent & 1) != 0 ? "-10 s" : "0.5 s") + ", burst_size: " + ((silent & 2) != 0 ? "0" : "2") +
        ", probes: " + ((silent & 4) != 0 ? "false" : "true") + "}}\nrecord: {ports: [\"*\"]}\n" + one_phase);
    Flight flight(g, logged(log, 1));
    flight.run();
    check_equal(replay_of(log, {}, again), log, again);
  }
}

TEST_CASE("what is no log of a flight is refused in a sentence") {
  const auto refused = [](const fs::path& file) {
    try {
      replay_of(file);
    } catch (const Error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  const fs::path text = folder().path / "text.mcap";
  std::ofstream(text) << "not a log";
  CHECK(refused(text).find("log.log_format_invalid(") != std::string::npos);
  const fs::path nowhere = folder().path / "nowhere.mcap";
  CHECK(refused(nowhere) == "log.log_not_readable(" + nowhere.string() + ", No such file or directory)");
  CHECK(refused(folder().path) == "log.log_not_readable(" + folder().path.string() + ", Is a directory)");
  const fs::path log = fresh("short.mcap"), cut = fresh("stump.mcap");
  Flight flight(mission(one_phase), logged(log, 0.1));
  flight.run();
  std::ofstream(cut, std::ios::binary) << contents(log).substr(0, 40);
  CHECK(refused(cut).find("replay.mission_missing") != std::string::npos);
}

TEST_CASE("ten minutes of flight are replayed with 0 differing bytes") {
  const fs::path log = fresh("long.mcap"), again = fresh("long-again.mcap"),
                 mission = folder().path / "long.yaml";
  std::ofstream(mission) << "extends: "
                         << fs::absolute(FULMAR_SOURCE_DIR "/configs/missions/common.yaml").string()
                         << "\nairframe: " << FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml\n"
                         << "components: {sim: {params: {turbulence: light}}, plan: {params: {plan: "
                         << FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml}}}\n";
  const int seconds = counts_allocations() ? 600 : 30;  // the sanitizers make it slow
  CHECK(run_fulmar("run " + mission.string() + " --duration " + std::to_string(seconds) + " --log " +
                   log.string())
            .code == 0);
  const auto [code, out] = run_fulmar("replay " + log.string() + " --json --log " + again.string());
  CHECK(code == 0);
  const nlohmann::json j = nlohmann::json::parse(out);
  CHECK(j.at("differing_bytes") == 0);
  CHECK(j.at("ticks") == 400 * (5 + seconds));
  CHECK(contents(log) == contents(again));
#ifndef FULMAR_SANITIZED
  rusage of_children{};
  getrusage(RUSAGE_CHILDREN, &of_children);
  CHECK(of_children.ru_maxrss / 1024 < 100);  // the messages alone would be more
#endif
}

TEST_CASE("samples from outside are stored as their input's, with their tick, and come again") {
  const fs::path log = fresh("imported.mcap"), again = fresh("imported-again.mcap");
  const Graph g = mission("  ear: {use: lab/OldReader}\n" + std::string(one_phase) +
                          "dds: {import: {ear.signal: /lab/signal}}\n");
  Flight flight(g, logged(log, 1));
  for (int n = 0; flight.step(); ++n) {
    const double tick_s = n * 0.25;
    if (n % 7 == 3) publish(flight, "ear", "signal", tick_s);
  }
  flight.finish();
  const WholeLog file = read_mcap(log);
  const auto count =
      std::count_if(file.messages.begin(), file.messages.end(),
                    [&](const McapFile::Message& m) { return m.channel == file.channel("/ear/signal"); });
  CHECK(count == 114);  // of 800 ticks
  check_equal(replay_of(log, {}, again), log, again);
}

}  // namespace replay_test
