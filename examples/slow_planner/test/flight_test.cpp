// SPDX-License-Identifier: BSD-3-Clause
// The shipped mission, flown twice by the program: it keeps out of the zone on its plan, and both logs are
// equal.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace flight_test {

using nlohmann::json;

namespace {

json fly(const std::string& arguments) {
  const std::string command =
      FULMAR_BIN_DIR "/fulmar run " FULMAR_BIN_DIR "/../examples/slow_planner/mission.yaml --json ";
  FILE* pipe = popen((command + arguments + " 2>/dev/null").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string out;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
  CHECK(WEXITSTATUS(pclose(pipe)) == 0);
  return json::parse(out, nullptr, false);
}

}  // namespace

TEST_CASE("the mission is flown round the zone to its end, and two flights leave equal logs") {
  const auto folder = std::filesystem::temp_directory_path();
  json flights[2];
  for (int i = 0; i < 2; ++i) {
    const auto log =
        folder / ("fulmar-slow-planner-" + std::to_string(getpid()) + "-" + std::to_string(i) + ".mcap");
    flights[i] = fly("--set detour.iterations=1500 --log " + log.string());
    std::filesystem::remove(log);
    REQUIRE(flights[i].is_object());
    CHECK(flights[i]["result"] == "flown");
    CHECK(flights[i]["guards"].empty());
    CHECK(flights[i]["zone_clearance"]["least_m"].get<double>() > 15);  // true position; the plan keeps 20 m
    CHECK(flights[i]["zone_clearance"]["least_m"].get<double>() < 60);  // the flight passed the zone
  }
  REQUIRE(flights[0]["log_sha256"].is_string());
  CHECK(flights[0]["log_sha256"] == flights[1]["log_sha256"]);
}

}  // namespace flight_test
