// SPDX-License-Identifier: BSD-3-Clause
// Flights are flown again from their logs: equal bytes, or the first tick and field that differ.
#include "core/replay/replay.hpp"

#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/log/reader.hpp"
#include "core/run/allocation.hpp"
#include "core/run/test/commands.hpp"
#include "core/run/test/lab.hpp"
#include "core/sanitized.hpp"
#include "tools/fulmar_log/recover.hpp"

namespace {

const std::string hourglass = FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml";

std::pair<int, std::string> run_fulmar(const std::string& words) {
  FILE* pipe = popen((std::string(FULMAR_BIN_DIR "/fulmar ") + words + " 2>/dev/null").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string out;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out};
}

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path fresh(const std::string& name) {
  const fs::path file = folder().path / name;
  fs::remove(file);
  fs::remove(file.string() + ".part");
  return file;
}

FlightOptions logged(const fs::path& file, double duration_s) {
  FlightOptions o = options(duration_s);
  o.log = true;
  o.log_file = file;
  return o;
}

ReplayResult replay_of(const fs::path& log, const Overrides& changes = {}, const fs::path& out = {}) {
  const Recording recording(log);
  const Graph graph = recording.mission(changes, {});
  ReplayOptions o;
  o.changes = changes;
  o.out = out;
  return replay(recording, graph, o).second;
}

std::string variant(const std::string& name) {
  return std::string(FULMAR_TEST_PLUGIN_DIR) + "/lab" + name + ".so";
}

/// Both from end to end.
void check_equal(const ReplayResult& r, const fs::path& log, const fs::path& again) {
  CHECK(r.notes == std::vector<std::string>{});
  if (r.first_tick) MESSAGE("first tick " << *r.first_tick);
  if (r.first)
    MESSAGE(r.first->topic << " " << r.first->at_ns << " ns, " << r.first->field << ": " << r.first->was
                           << ", now " << r.first->is);
  CHECK(r.equal());
  CHECK(r.differing_bytes == 0);
  CHECK(contents(log) == contents(again));
  CHECK(fs::file_size(log) > 10'000);
}

}  // namespace

TEST_CASE("what phases do to the vehicle at given times is flown again, byte for byte") {
  const fs::path log = fresh("gap.mcap"), again = fresh("gap-again.mcap"), file = folder().path / "gap.yaml";
  std::ofstream(file) << "mission: gap\nextends: fulmar:missions/hourglass.yaml\nphases:\n"
                         "  cruise: {next: [{to: lost, when: \"time > 15 s\"}]}\n"
                         "  lost: {vehicle: {use: sim, set: {gnss_works: false}}, next: [{to: found, when: "
                         "\"time > 18 s\"}]}\n  found: {}\n";
  Flight(load_mission(file.string(), {}), logged(log, 20)).run();
  std::vector<double> fixes_s;
  const McapFile flown = read_mcap(log);
  for (const McapFile::Message& m : flown.messages)
    if (flown.channels.at(m.channel).topic == "/vehicle/gnss")
      fixes_s.push_back(1e-9 * static_cast<double>(m.log_ns - flown.messages.front().log_ns));
  double longest_s = 0;
  for (std::size_t i = 1; i < fixes_s.size(); ++i)
    longest_s = std::max(longest_s, fixes_s[i] - fixes_s[i - 1]);
  CHECK(longest_s == doctest::Approx(3).epsilon(0.1));
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE("a record is fixed when the flight begins: nobody changes it or a field of it in flight") {
  const CommandTable commands(load_mission(hourglass, {}));
  const std::size_t sim = commands.component("sim");
  CHECK_THROWS_WITH_AS(commands.param(sim, "airframe.mass"),
                       "sim.airframe is a set-up parameter: it cannot change in flight", Error);
  Command whole = command_of(CommandKind::parameter, "sim", "airframe");
  CHECK_THROWS_WITH_AS(commands.prepare(whole), doctest::Contains("it cannot change in flight"), Error);
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
  CHECK(run_fulmar("run " + mission.string() +
                   " --duration 10 --seed 3 --set \"slc.roll_limit=30 deg\" --set \"sim.airframe.mass=5 kg\""
                   " --record nav.state@200Hz --record outer.* --log " +
                   log.string())
            .first == 0);
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
  CHECK(run_fulmar("run " + hourglass + " --duration 2 --log " + log.string()).first == 0);
  std::ofstream(other) << "mine";
  const auto [code, out] = run_fulmar("replay " + log.string() + " --log " + other.string());
  CHECK(code == 4);
  CHECK(out.find("equal") == std::string::npos);
  CHECK(contents(other) == "mine");
}

TEST_CASE("a flight that nobody armed is flown again so") {
  const fs::path log = fresh("unarmed.mcap");
  CHECK(run_fulmar("run " + hourglass + " --arm off --duration 2 --log " + log.string()).first == 0);
  CHECK(replay_of(log).equal());
}

TEST_CASE("another parameter is an experiment: the figures of both are told, and where they part") {
  const fs::path log = fresh("experiment.mcap");
  CHECK(run_fulmar("run " + hourglass + " --duration 20 --log " + log.string()).first == 0);
  const auto [code, out] = run_fulmar("replay " + log.string() + " --json --set attitude.roll_kp=0.1");
  CHECK(code == 0);
  const nlohmann::json j = nlohmann::json::parse(out);
  CHECK(j.at("before_equals_log") == true);
  CHECK(j.at("equal") == false);
  CHECK(j.at("first_difference").at("topic") == "/inner/actuators");
  CHECK(j.at("after").at("estimation_rmse") ==
        j.at("before").at("estimation_rmse"));  // it has nothing to do with the law
}

TEST_CASE("an experiment with what comes out of the log is refused, as it would change nothing") {
  const fs::path log = fresh("vehicle.mcap"), said = folder().path / "said";
  CHECK(run_fulmar("run " + hourglass + " --duration 1 --log " + log.string()).first == 0);
  const auto refused = [&](const std::string& words, const fs::path& file) {
    const int status = std::system(
        (FULMAR_BIN_DIR "/fulmar replay " + file.string() + " " + words + " 2>" + said.string()).c_str());
    CHECK(WEXITSTATUS(status) == 4);
    return contents(said);
  };
  const std::string why =
      "sim is the vehicle, and in a replay its samples come out of the log. Fly the mission anew with fulmar "
      "run\n";
  CHECK(refused("--set sim.turbulence=none", log) == "--set sim.turbulence would change nothing: " + why);
  CHECK(refused("--with sim=" FULMAR_BIN_DIR "/../lib/fulmar/sim_aero.so", log) ==
        "--with sim would change nothing: " + why);
  const fs::path driven = fresh("driven.mcap");
  Flight flight(mission("  fcu: {fills: vehicle, use: lab/Cart}\n  one: {fills: law, use: lab/Law, run: "
                        "tick, params: {id: 1, u: 0.1}}\n"
                        "  filter: {fills: sense, use: lab/Filter, run: tick}\n"
                        "  watch: {use: lab/Watch, run: tick, in: {burst: gauge.reading}}\n"
                        "  gauge: {use: lab/Ticker, run: driver, params: {samples: 30}}\nio: fcu\n"s +
                        one_phase),
                logged(driven, 1e6));
  for (int i = 0; i < 100; ++i) flight.step();
  flight.finish();
  CHECK(refused("--set gauge.samples=3", driven)
            .starts_with("--set gauge.samples would change nothing: gauge is a driver, and"));
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

TEST_CASE("a law that does something else is found at its first tick and field") {
  const fs::path log = fresh("changed.mcap");
  Flight flight(mission(one_phase), logged(log, 0.5));
  flight.run();
  Overrides changes;
  changes.with = {{"one", variant("_better")}};  // it halves what it is told
  const ReplayResult r = replay_of(log, changes);
  CHECK(!r.equal());
  CHECK(r.first_tick == 0u);
  CHECK(r.first_tick_ns == -1'000'000'000);
  REQUIRE(r.first.has_value());
  CHECK(r.first->topic == "/law/command");
  CHECK(r.first->field == "u_frac");
  CHECK(r.first->was == "0.1");
  CHECK(r.first->is == "0.05");
  CHECK(r.first->at_ns == -1'000'000'000);
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
  CHECK_THROWS_WITH_AS(replay_of(log), doctest::Contains("own.so is not what flew"), Error);
  put("_better");  // what the log says that flew, and who wrote the log?
  CHECK_THROWS_WITH_AS(replay_of(log), doctest::Contains("own.so is what flew, says the log, but is not of"),
                       Error);
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

TEST_CASE("late work in other threads is as late again: drivers, asynchronous steps, on hardware") {
  const fs::path log = fresh("threads.mcap"), again = fresh("threads-again.mcap");
  const Graph g = mission(
      "  fcu: {fills: vehicle, use: lab/Cart}\n  one: {fills: law, use: lab/Law, run: tick, params: {id: 1, "
      "u: 0.1}}\n"
      "  filter: {fills: sense, use: lab/Filter, run: tick}\n"
      "  watch: {use: lab/Watch, run: tick, in: {burst: gauge.reading}}\n"
      "  gauge: {use: lab/Ticker, run: driver, params: {samples: 30, fails: true}}\n"
      "  think: {use: lab/Thinker, run: async, latency: 5 ms, rate: 100 Hz, in: {signal: sense.signal}, "
      "params: {takes: 1 ms}}\n"
      "io: fcu\nrecord: {ports: [\"*\"]}\n"s +
      one_phase);
  FlightOptions o = logged(log, 1e6);
  Flight flight(g, o);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 400; ++i) {
    flight.step();
    std::this_thread::sleep_until(
        begin + (i + 1) * std::chrono::microseconds(250));  // ten times too fast for the thinker
  }
  // no result is overdue when the log ends: of those it cannot tell
  for (int i = 0; i < 40; ++i) {
    flight.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const FlightResult r = flight.finish();
  CHECK(r.log.dropped == 0);
  for (const ComponentStats& c : r.components)
    if (c.name == "think") CHECK(c.misses > 0);
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE(
    "samples of a driver that came in one tick are published one by one again, though its probe stood "
    "still") {
  const fs::path log = fresh("still.mcap"), again = fresh("still-again.mcap");
  const Graph g = mission(
      "  gauge: {use: lab/Ticker, run: driver, params: {samples: 30, counts: false}}\n"
      "  watch: {use: lab/Watch, in: {burst: gauge.reading}}\nrecord: {ports: [\"*\"]}\n"s +
      one_phase);
  Flight flight(g, logged(log, 1e6));
  for (int i = 0; i < 20; ++i) {
    flight.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  flight.finish();
  check_equal(replay_of(log, {}, again), log, again);
}

TEST_CASE(
    "who takes long to take over in another thread, and misses steps meanwhile, misses the same ones again") {
  const fs::path log = fresh("takes-over.mcap"), again = fresh("takes-over-again.mcap");
  const Graph g = mission(
      "  fcu: {fills: vehicle, use: lab/Cart}\n  one: {fills: law, use: lab/Law, run: tick, params: {id: 1, "
      "u: 0.1}}\n"
      "  filter: {fills: sense, use: lab/Filter, run: tick}\n"
      "  think: {use: lab/Thinker, run: async, latency: 5 ms, rate: 100 Hz, in: {signal: sense.signal},"
      " params: {takes: 0 ms, takes_over: 100 ms}}\n"
      "io: fcu\nrecord: {ports: [\"*\"]}\n"s +
      one_phase);
  Flight flight(g, logged(log, 1e6));
  for (int i = 0; i < 100; ++i) flight.step();  // faster than it takes over
  for (int i = 0; i < 40; ++i) {
    flight.step();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const FlightResult r = flight.finish();
  CHECK(r.log.dropped == 0);
  for (const ComponentStats& c : r.components)
    if (c.name == "think") CHECK(c.misses > 0);
  check_equal(replay_of(log, {}, again), log, again);
}

namespace {

const char* const in_a_child =
    "  one: {fills: law, use: lab/Law, run: process, hang: 200 ms, params: {id: 1, u: 0.1}}\n";

/// Sends a signal to the flight's child when its time has come.
FlightResult fly_and_signal(const Graph& graph, const fs::path& log, int signal) {
  Flight flight(graph, logged(log, 0.5));
  bool sent = false;
  while (flight.step())
    if (!sent && flight.now_ns() >= 100'000'000) {
      const std::string words =
          "pkill -" + std::to_string(signal) + " -P " + std::to_string(getpid()) + " fulmar-child";
      REQUIRE(std::system(words.c_str()) == 0);
      sent = true;
    }
  return flight.finish();
}

}  // namespace

TEST_CASE("a child that hung, was stopped or was killed dies in the same tick again, in the same words") {
  struct Row {
    const char* what;
    int signal;
    std::vector<std::pair<std::string, std::string>> set;
    const char* told;
  };
  for (const Row& row :
       {Row{"hung", 0, {{"one.fault", "hangs"}, {"one.fault_at", "0.1"}}, "hung: no answer within 200 ms"},
        Row{"stopped", SIGSTOP, {}, "hung: no answer within 200 ms"},
        Row{"killed", SIGKILL, {}, "was killed (signal 9)"}}) {
    CAPTURE(row.what);
    const Graph graph = mission(in_a_child + std::string(with_fallback), row.set);
    const fs::path log = fresh("child.mcap"), again = fresh("again.mcap");
    const FlightResult r =
        row.signal == 0 ? Flight(graph, logged(log, 0.5)).run() : fly_and_signal(graph, log, row.signal);
    REQUIRE(r.guards.size() == 1);
    CHECK(r.guards[0].what == std::string(row.told));
    CHECK(r.guards[0].action == "two takes over");
    const ReplayResult replayed = replay_of(log, {}, again);
    REQUIRE(replayed.flight.guards.size() == 1);
    CHECK(replayed.flight.guards[0].at_ns == r.guards[0].at_ns);
    check_equal(replayed, log, again);
  }
}

TEST_CASE("in an experiment with another plugin nothing dies that did not do anything wrong") {
  const Graph graph = mission(in_a_child + std::string(with_fallback));
  const fs::path log = fresh("child.mcap");
  REQUIRE(fly_and_signal(graph, log, SIGKILL).guards.size() == 1);
  Overrides other;
  other.with = {{"one", variant("_better")}};
  CHECK(replay_of(log, other).flight.guards.empty());
  const auto [code, out] = run_fulmar("replay " + log.string() + " --json --with one=" + variant("_better"));
  CHECK(code == 0);
  const nlohmann::json j = nlohmann::json::parse(out);
  CHECK(j.at("before").at("guards").size() == 1);
  CHECK(j.at("after").at("guards").empty());
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
  CHECK(refused(text).find("is no MCAP file") != std::string::npos);
  CHECK(refused(folder().path / "nowhere.mcap").find("cannot read") != std::string::npos);
  const fs::path log = fresh("short.mcap"), cut = fresh("stump.mcap");
  Flight flight(mission(one_phase), logged(log, 0.1));
  flight.run();
  std::ofstream(cut, std::ios::binary) << contents(log).substr(0, 40);
  CHECK(refused(cut).find("no mission is attached to it") != std::string::npos);
}

TEST_CASE("diff of two flights tells their figures first, and then who gave the first other field") {
  const fs::path a = fresh("kp.mcap"), b = fresh("other-kp.mcap"), json_a = folder().path / "kp.json",
                 json_b = folder().path / "other-kp.json";
  const auto fly = [&](const fs::path& log, const fs::path& result, const std::string& words) {
    const auto [code, out] =
        run_fulmar("run " + hourglass + " --duration 60 --json --log " + log.string() + words);
    CHECK(code == 0);
    std::ofstream(result) << out;
    return nlohmann::json::parse(out);
  };
  const nlohmann::json was = fly(a, json_a, ""), is = fly(b, json_b, " --set slc.course_kp=1.9");
  const auto [code, out] = run_fulmar("log diff " + a.string() + " " + b.string());
  CHECK(code == 1);
  CHECK(out.starts_with("figures "));
  CHECK(out.find("tracking_rmse.course_deg") < out.find("First difference at "));
  CHECK(out.find(" s, of slc: /outer/attitude roll_rad is ") != std::string::npos);
  CHECK(out.find("ticks hash") == std::string::npos);
  const nlohmann::json o =
      nlohmann::json::parse(run_fulmar("log diff --json " + a.string() + " " + b.string()).second);
  CHECK(o.at("first_difference").at("component") == "slc");
  const nlohmann::json& course = o.at("figures").at("tracking_rmse.course_deg");
  const double recorded = course.at("first"), flown = was.at("tracking_rmse").at("course_deg");
  CHECK(recorded / flown == doctest::Approx(1).epsilon(0.05));  // of the score's last message
  CHECK(course.at("second") != course.at("first"));

  const auto [code_json, table] = run_fulmar("log diff " + json_a.string() + " " + json_b.string());
  CHECK(code_json == 1);
  CHECK(table.starts_with("figures "));
  CHECK(table.find("First difference") == std::string::npos);
  const nlohmann::json results =
      nlohmann::json::parse(run_fulmar("log diff --json " + json_a.string() + " " + json_b.string()).second);
  const nlohmann::json& exact = results.at("figures").at("tracking_rmse.course_deg");
  CHECK(exact.at("first") == was.at("tracking_rmse").at("course_deg"));
  CHECK(exact.at("second") == is.at("tracking_rmse").at("course_deg"));
  CHECK(run_fulmar("log diff " + json_a.string() + " " + json_a.string()).first == 0);
  CHECK(run_fulmar("log diff " + json_a.string() + " " + b.string()).first == 1);
  std::ofstream(json_b) << "{ damaged";
  CHECK(run_fulmar("log diff " + json_a.string() + " " + json_b.string()).first == 1);
}

TEST_CASE("a replay records more than the flight did: all of it, or some ports at a rate") {
  const fs::path log = fresh("few.mcap"), all = fresh("all.mcap"), some = fresh("some.mcap"),
                 again = fresh("some-again.mcap");
  CHECK(run_fulmar("run " + hourglass + " --duration 10 --log " + log.string()).first == 0);
  const auto messages = [](const fs::path& file, const std::string& topic) {
    const McapFile f = read_mcap(file);
    const std::uint16_t channel = f.channel(topic);
    return std::count_if(f.messages.begin(), f.messages.end(),
                         [&](const McapFile::Message& m) { return m.channel == channel; });
  };
  CHECK(messages(log, "/nav/state") == 10 * 14);  // from -5 s to 10 s, and aligned after the first of them
  const auto [code, out] = run_fulmar("replay " + log.string() + " --record all --log " + all.string());
  CHECK(code == 0);
  CHECK(out.find("\nequal: ") != std::string::npos);
  CHECK(messages(all, "/nav/state") == 400 * 14);
  CHECK(messages(all, "/outer/attitude") == 100 * 14);
  const std::string few = " --record nav.state,outer.*@50Hz --log ";
  CHECK(run_fulmar("replay " + log.string() + few + some.string()).first == 0);
  CHECK(messages(some, "/nav/state") == 50 * 14);
  CHECK(messages(some, "/outer/attitude") == 50 * 14);
  CHECK(messages(some, "/inner/actuators") == messages(log, "/inner/actuators"));
  CHECK(run_fulmar("replay " + some.string() + " --log " + again.string()).first == 0);
  CHECK(contents(some) == contents(again));
  CHECK(run_fulmar("replay " + log.string() + " --record nowhere.* --log " + again.string() + "x").first ==
        4);
  CHECK(run_fulmar("replay " + log.string() + " --record all").first == 4);
  CHECK(run_fulmar("replay " + log.string() + " --record nav.*@fast --log " + again.string() + "x").first ==
        4);
  const nlohmann::json j = nlohmann::json::parse(
      run_fulmar("replay " + log.string() + " --json --set slc.course_kp=1.9 --record all --log " +
                 fresh("experiment-all.mcap").string())
          .second);
  CHECK(j.at("before_equals_log") == true);
  CHECK(messages(folder().path / "experiment-all.mcap", "/nav/state") == 400 * 14);
}

TEST_CASE("the first difference is told of who flew then: the law of the phase, of --role, or the fallback") {
  const fs::path a = fresh("by-slc.mcap"), b = fresh("by-tecs.mcap");
  const std::string run = "run " + hourglass + " --duration 10 --json --log ";
  CHECK(run_fulmar(run + a.string()).first == 0);
  CHECK(run_fulmar(run + b.string() + " --role outer=tecs").first == 0);
  CHECK(run_fulmar("log diff " + a.string() + " " + b.string())
            .second.find(", of slc, in the second log of tecs: /outer/attitude ") != std::string::npos);
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
            .first == 0);
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
  const McapFile file = read_mcap(log);
  const auto count =
      std::count_if(file.messages.begin(), file.messages.end(),
                    [&](const McapFile::Message& m) { return m.channel == file.channel("/ear/signal"); });
  CHECK(count == 114);  // of 800 ticks
  check_equal(replay_of(log, {}, again), log, again);
}
