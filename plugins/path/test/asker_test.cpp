// SPDX-License-Identifier: BSD-3-Clause
// A component that edits the plan in flight gets its answers, in the loop and in a separate process, and its
// flight replays byte for byte.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace asker_test {

namespace fs = std::filesystem;

namespace {

std::string shell(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string out;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
  CHECK_MESSAGE(WEXITSTATUS(pclose(pipe)) == 0, out);
  return out;
}

}  // namespace

TEST_CASE("who edits the plan learns in its next step what became of it, wherever it runs") {
  const fs::path folder = fs::temp_directory_path() / ("fulmar-asker-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string program = FULMAR_BIN_DIR "/fulmar", log = (folder / "flight.mcap").string();
  for (const std::string how : {"tick", "process"}) {
    CAPTURE(how);
    const fs::path mission = folder / (how + ".yaml");
    std::ofstream(mission)
        << "mission: asker\nextends: " FULMAR_SOURCE_DIR
           "/configs/missions/common.yaml\nio: sim\nairframe: " FULMAR_SOURCE_DIR
           "/configs/airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: "
           "-111.6474138, alt_msl: 1387 m}\nseed: 7\n"
           "summary: {tally: asker.tally}\n"
           "done: \"asker.tally.taken_away > 0\"\n"
           "components:\n"
           "  plan: {params: {plan: " FULMAR_SOURCE_DIR
           "/configs/plans/hourglass.yaml}, in: {edits: {from: asker.edits, delayed: true}}}\n"
           "  asker: {use: " FULMAR_TEST_PLUGINS "/asker.so, rate: 10 Hz, run: " +
               how + ", in: {progress: manage.progress, results: plan.results}}\n";
    const std::string said = shell(program + " run " + mission.string() + " --json --log " + log);
    const auto result = nlohmann::json::parse(said.substr(said.find("\n{") + 1), nullptr, false);
    REQUIRE_MESSAGE(result.is_object(), said);
    CHECK(result["result"] == "flown");
    CHECK(result["guards"].empty());
    CHECK(result["tally"]["in_force"] == 2);  // the group, and the removal
    CHECK(result["tally"]["refused"] == 1);
    CHECK(result["tally"]["reason"] == "path.waypoint_id_unknown(99)");
    CHECK(result["tally"]["taken_away"] == 5);  // the plan came with four
    CHECK(result["allocations"]["plan"] == 0);
    CHECK(said.find("path.edit_refused(4, path.waypoint_id_unknown(99))") != std::string::npos);
    CHECK(shell(program + " replay " + log).find("equal: ") != std::string::npos);
    fs::remove(log);
  }
  fs::remove_all(folder);
}

}  // namespace asker_test
