// SPDX-License-Identifier: BSD-3-Clause
// Outcome of a flight, its active components, and the exit code: in a laboratory (core/run/test/lab.cpp).
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace fs = std::filesystem;
using nlohmann::json;

namespace result_test {

struct Ended {
  int code = -1;
  std::string out;
};

Ended shell(const std::string& command) {
  Ended r;
  FILE* const pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) r.out.append(buffer, n);
  const int status = pclose(pipe);
  r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return r;
}

/// cart -> filter -> law; `filter` is the behaviour of the filter, `law` that of the first of two laws.
Ended fly(const std::string& options, const std::string& law = "{id: 1}", const std::string& filter = "{}",
          const std::string& flies = "{law: {use: one, fallback: two}}") {
  const fs::path file =
      fs::temp_directory_path() / ("fulmar-result-test-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "mission: lab\narm: auto\nfailsafe: {u_frac: -0.25, for: 0.5 s}\nroles:\n"
                         "  vehicle: {in: {command: law.command}, out: {signal: Signal, status: Arm}}\n"
                         "  sense:   {in: {signal: vehicle.signal}, out: {signal: Signal}}\n"
                         "  law:     {in: {signal: sense.signal}, out: {command: Command}}\n"
                         "components:\n  sim: {fills: vehicle, use: lab/Cart}\n"
                         "  filter: {fills: sense, use: lab/Filter, params: "
                      << filter << "}\n  one: {fills: law, use: lab/Law, params: " << law
                      << "}\n  two: {fills: law, use: lab/Law, params: {id: 2}}\nphases:\n  fly: " << flies
                      << "\n";
  const Ended r = shell("FULMAR_PLUGIN_PATH=" FULMAR_TEST_PLUGIN_DIR " " FULMAR_BIN_DIR "/fulmar run " +
                        file.string() + " --no-log --duration 2 " + options + " 2>/dev/null");
  fs::remove(file);
  return r;
}

const std::string broken = "{id: 1, fault: nan, fault_at: 1}";

TEST_CASE("--seeds flies once with each seed, each flight equal to a single one") {
  const Ended r = fly("--seeds 3,11..12 --json");
  CHECK(r.code == 0);
  const json j = json::parse(r.out);
  REQUIRE(j["flights"].size() == 3);
  const json alone = json::parse(fly("--seed 11 --json").out);
  for (const char* key : {"seed", "result", "flight_time_s", "phases", "who_flew"})
    CHECK(j["flights"][1][key] == alone[key]);
  CHECK(j["flights"][2]["seed"] == 12);
  CHECK(j["flown"] == 3);
  CHECK(j["mean"]["flight_time_s"] == alone["flight_time_s"]);
  const Ended table = fly("--seeds 1..2");
  CHECK(
      table.out.starts_with("seed 1: flown (duration reached)\nseed 2: flown (duration reached)\n\n2 of 2 "));
  CHECK(fly("--seeds 1..2 --seed 3").code == 2);
  CHECK(fly("--seeds 4..1").code == 2);
}

TEST_CASE("a flight without a guard event is flown, and one component was active in each role") {
  const Ended r = fly("--json --strict");
  CHECK(r.code == 0);
  const json j = json::parse(r.out);
  CHECK(j["result"] == "flown");
  CHECK(j["who_flew"]["law"].size() == 1);
  CHECK(j["who_flew"]["law"][0] == json{{"component", "one"}, {"from_s", -1.0}, {"to_s", 2.0}});
  CHECK(fly("").out.find("who flew") == std::string::npos);
}

TEST_CASE("a flight with a guard event reports it and each active component; --strict has its own code") {
  const Ended r = fly("--json", broken);
  CHECK(r.code == 0);
  const json j = json::parse(r.out);
  CHECK(j["result"] == "flown with guards");
  CHECK(j["reason"] == "duration reached");
  REQUIRE(j["who_flew"]["law"].size() == 2);
  CHECK(j["who_flew"]["law"][0] == json{{"component", "one"}, {"from_s", -1.0}, {"to_s", 1.0}});
  CHECK(j["who_flew"]["law"][1] == json{{"component", "two"}, {"from_s", 1.0}, {"to_s", 2.0}});
  CHECK(fly("--json --strict", broken).code == 3);
  const std::string table = fly("", broken).out;
  const std::string conclusion = j["result"].get<std::string>() + " (" + j["reason"].get<std::string>() + ")";
  CHECK(table.find("lab: " + conclusion) != std::string::npos);
  const std::string first = "  law: one                     -1.0 s to 1.0 s\n";
  const std::string second = "  law: two                      1.0 s to 2.0 s\n";
  CHECK(table.find("who flew\n" + first + second) != std::string::npos);
}

TEST_CASE("a component that was stopped stays inactive until the failsafe is over") {
  const Ended r = fly("--json", broken, "{}", "{law: one}");
  const json flew = json::parse(r.out)["who_flew"];
  REQUIRE(flew["law"].size() == 1);
  CHECK(flew["law"][0] == json{{"component", "one"}, {"from_s", -1.0}, {"to_s", 1.0}});
  CHECK(flew["sense"][0]["to_s"].get<double>() > 1);  // the flight continues
}

TEST_CASE("a flight that failed is failed, strict or not") {
  const Ended r = fly("--json --strict", broken, "{}", "{law: one}");
  CHECK(r.code == 1);
  CHECK(json::parse(r.out)["result"] == "failed");
}

TEST_CASE("when no role had an output and the vehicle did not lift off, the flight has not begun") {
  const Ended r = fly("--json", "{id: 1}", "{mute_at: -10}");
  CHECK(r.code == 1);
  const json j = json::parse(r.out);
  CHECK(j["result"] == "not begun");
  CHECK(j["reason"] == "run.role_output_absent(sense, duration reached)");
  CHECK(fly("", "{id: 1}", "{mute_at: -10}").out.find("lab: not begun (run.role_output_absent(sense, ") !=
        std::string::npos);
}

TEST_CASE("input that is rejected before the flight has its own exit code, wrong usage another") {
  CHECK(fly("--set one.gain=1").code == 4);
  CHECK(fly("--sepeed 3").code == 2);
  CHECK(shell(FULMAR_BIN_DIR "/fulmar check nowhere.yaml 2>/dev/null").code == 4);
  CHECK(shell(FULMAR_BIN_DIR "/fulmar graph nowhere.yaml 2>/dev/null").code == 4);
  CHECK(shell(FULMAR_BIN_DIR "/fulmar inspect nowhere.so 2>/dev/null").code == 4);
  CHECK(shell(FULMAR_BIN_DIR "/fulmar replay nowhere.mcap 2>/dev/null").code == 4);
}

}  // namespace result_test
