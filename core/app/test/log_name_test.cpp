// SPDX-License-Identifier: BSD-3-Clause
// Names of logs that the host chooses.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace fs = std::filesystem;

namespace {

/// A folder in which flights of the hourglass mission begin; removed afterwards.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-log-name-test-" + std::to_string(getpid()));
  const std::string run = FULMAR_BIN_DIR "/fulmar run " FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml ";
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  bool shell(const std::string& command) const {
    return std::system(("cd " + path.string() + " && " + command).c_str()) == 0;
  }
  int files(const std::string& ending) const {
    int n = 0;
    if (!fs::exists(path / "logs")) return 0;
    for (const auto& entry : fs::directory_iterator(path / "logs"))
      n += entry.path().extension() == ending ? 1 : 0;
    return n;
  }
};

}  // namespace

TEST_CASE_FIXTURE(Folder, "flights that begin at once in one folder all fly, each with a separate log") {
  const std::string twenty =
      "for i in $(seq 20); do " + run +
      "--duration 1 --seed $i >out.txt 2>&1 || touch refused & done; wait; [ ! -e refused ]";
  CHECK(shell(twenty));
  CHECK(files(".mcap") == 20);
  CHECK(files(".part") == 0);
}

TEST_CASE_FIXTURE(Folder, "a flight that cannot begin leaves no file") {
  const std::string bad_plan = "--set 'plan.plan={waypoints: [{airspeed: 17 m/s}]}' 2>out.txt";
  CHECK_FALSE(shell(run + bad_plan));
  CHECK(files(".mcap") + files(".part") == 0);
}

TEST_CASE_FIXTURE(Folder, "a report that cannot be made is rejected before the flight, in one sentence") {
  const auto refused = [&](const std::string& options, const std::string& words) {
    INFO(options);
    CHECK_FALSE(shell(run + "--duration 1 " + options + " >out.txt 2>&1"));
    CHECK(shell("grep -q -- '" + words + "' out.txt"));
    CHECK(files(".mcap") == 0);
  };
  refused("--no-log --report", "app.report_excludes_no_log");
  refused("--report x.yaml", "app.report_name_invalid(x.yaml)");
  CHECK(shell("printf 'mission: silent\\nextends: " FULMAR_SOURCE_DIR
              "/configs/missions/hourglass.yaml\\nrecord: off\\n' >silent.yaml"));
  CHECK_FALSE(shell(FULMAR_BIN_DIR "/fulmar run silent.yaml --duration 1 --report >out.txt 2>&1"));
  CHECK(shell("grep -q app.report_without_log out.txt"));
  if (!fs::exists(FULMAR_BIN_DIR "/../share/fulmar/web/report.html")) return;  // built without Node.js
  CHECK(shell("echo mine >there.html"));
  refused("--report there.html", "app.report_exists(.*/there.html)");
  CHECK(shell("grep -q mine there.html"));
}
