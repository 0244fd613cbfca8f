// SPDX-License-Identifier: BSD-3-Clause
// Replays with a change, and two logs compared: the first tick and field that differ.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/fulmar_replay/test/replays.hpp"

namespace experiment_test {

using namespace lab;

TEST_CASE("another parameter is an experiment: the figures of both are told, and where they part") {
  const fs::path log = fresh("experiment.mcap");
  CHECK(run_fulmar("run " + hourglass + " --duration 20 --log " + log.string()).code == 0);
  const auto [code, out] = run_fulmar("replay " + log.string() + " --json --set attitude.roll_kp=0.1");
  CHECK(code == 0);
  const nlohmann::json j = nlohmann::json::parse(out);
  CHECK(j.at("before_equals_log") == true);
  CHECK(j.at("equal") == false);
  CHECK(j.at("first_difference").at("topic") == "/inner/actuators");
  CHECK(j.at("after").at("estimation_rmse") ==
        j.at("before").at("estimation_rmse"));  // independent of the law
}

TEST_CASE("an experiment with what comes out of the log is refused, as it would change nothing") {
  const fs::path log = fresh("vehicle.mcap"), said = folder().path / "said";
  CHECK(run_fulmar("run " + hourglass + " --duration 1 --log " + log.string()).code == 0);
  const auto refused = [&](const std::string& words, const fs::path& file) {
    const int status = std::system(
        (FULMAR_BIN_DIR "/fulmar replay " + file.string() + " " + words + " 2>" + said.string()).c_str());
    CHECK(WEXITSTATUS(status) == 4);
    return contents(said);
  };
  CHECK(refused("--set sim.turbulence=none", log) ==
        "replay.change_without_effect(--set sim.turbulence, sim, the vehicle)\n");
  CHECK(refused("--with sim=" FULMAR_BIN_DIR "/../lib/fulmar/sim_aero.so", log) ==
        "replay.change_without_effect(--with sim, sim, the vehicle)\n");
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
  CHECK(refused("--set gauge.samples=3", driven) ==
        "replay.change_without_effect(--set gauge.samples, gauge, a driver)\n");
}

TEST_CASE("a law that does something else is found at its first tick and field") {
  const fs::path log = fresh("changed.mcap");
  Flight flight(mission(one_phase), logged(log, 0.5));
  flight.run();
  Overrides changes;
  changes.with = {{"one", variant("_better")}};  // halves its input
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
  CHECK(out.find("tracking_rmse.course_deg") < out.find("log_tool.first_difference("));
  const std::string owner = ", of slc, ", field = " roll_rad is, ";
  CHECK(out.find(owner + "/outer/attitude," + field) != std::string::npos);
  CHECK(out.find("ticks hash") == std::string::npos);
  const nlohmann::json o =
      nlohmann::json::parse(run_fulmar("log diff --json " + a.string() + " " + b.string()).out);
  CHECK(o.at("first_difference").at("component") == "slc");
  const nlohmann::json& course = o.at("figures").at("tracking_rmse.course_deg");
  const double recorded = course.at("first"), flown = was.at("tracking_rmse").at("course_deg");
  CHECK(recorded / flown == doctest::Approx(1).epsilon(0.05));  // of the score's last message
  CHECK(course.at("second") != course.at("first"));

  const auto [code_json, table] = run_fulmar("log diff " + json_a.string() + " " + json_b.string());
  CHECK(code_json == 1);
  CHECK(table.starts_with("figures "));
  CHECK(table.find("first_difference") == std::string::npos);
  const nlohmann::json results =
      nlohmann::json::parse(run_fulmar("log diff --json " + json_a.string() + " " + json_b.string()).out);
  const nlohmann::json& exact = results.at("figures").at("tracking_rmse.course_deg");
  CHECK(exact.at("first") == was.at("tracking_rmse").at("course_deg"));
  CHECK(exact.at("second") == is.at("tracking_rmse").at("course_deg"));
  CHECK(run_fulmar("log diff " + json_a.string() + " " + json_a.string()).code == 0);
  CHECK(run_fulmar("log diff " + json_a.string() + " " + b.string()).code == 1);
  std::ofstream(json_b) << "{ damaged";
  CHECK(run_fulmar("log diff " + json_a.string() + " " + json_b.string()).code == 1);
}

TEST_CASE("the first difference is told of who flew then: the law of the phase, of --role, or the fallback") {
  const fs::path a = fresh("by-slc.mcap"), b = fresh("by-tecs.mcap");
  const std::string run = "run " + hourglass + " --duration 10 --json --log ";
  CHECK(run_fulmar(run + a.string()).code == 0);
  CHECK(run_fulmar(run + b.string() + " --role outer=tecs").code == 0);
  const std::string said = run_fulmar("log diff " + a.string() + " " + b.string()).out;
  const std::size_t slc = said.find(", of slc, ");
  REQUIRE(slc != std::string::npos);
  CHECK(said.find(" tecs, /outer/attitude,", slc) < said.find('\n', slc));
}

TEST_CASE("a replay records more than the flight did: all of it, or some ports at a rate") {
  const fs::path log = fresh("few.mcap"), all = fresh("all.mcap"), some = fresh("some.mcap"),
                 again = fresh("some-again.mcap");
  CHECK(run_fulmar("run " + hourglass + " --duration 10 --log " + log.string()).code == 0);
  const auto messages = [](const fs::path& file, const std::string& topic) {
    const WholeLog f = read_mcap(file);
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
  CHECK(run_fulmar("replay " + log.string() + few + some.string()).code == 0);
  CHECK(messages(some, "/nav/state") == 50 * 14);
  CHECK(messages(some, "/outer/attitude") == 50 * 14);
  CHECK(messages(some, "/inner/actuators") == messages(log, "/inner/actuators"));
  CHECK(run_fulmar("replay " + some.string() + " --log " + again.string()).code == 0);
  CHECK(contents(some) == contents(again));
  CHECK(run_fulmar("replay " + log.string() + " --record nowhere.* --log " + again.string() + "x").code == 4);
  CHECK(run_fulmar("replay " + log.string() + " --record all").code == 4);
  CHECK(run_fulmar("replay " + log.string() + " --record nav.*@fast --log " + again.string() + "x").code ==
        4);
  const nlohmann::json j = nlohmann::json::parse(
      run_fulmar("replay " + log.string() + " --json --set slc.course_kp=1.9 --record all --log " +
                 fresh("experiment-all.mcap").string())
          .out);
  CHECK(j.at("before_equals_log") == true);
  CHECK(messages(folder().path / "experiment-all.mcap", "/nav/state") == 400 * 14);
}

}  // namespace experiment_test
