// SPDX-License-Identifier: BSD-3-Clause
// Signals to a program that flies hardware (core/run/test/craft.cpp): a single signal must not end the flight
// of an armed aircraft.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::temp_directory_path() / ("fulmar-armed-test-" + std::to_string(getpid()));

void pause_s(double s) { std::this_thread::sleep_for(std::chrono::duration<double>(s)); }

/// `fulmar run` on a hardware mission; killed at the end of the test.
struct Program {
  pid_t pid = -1;
  fs::path err = folder / "err.txt";

  explicit Program(const std::string& set, const std::string& record = "off") {
    fs::create_directories(folder);
    fs::remove(err);
    const fs::path mission = folder / "craft.yaml";
    std::ofstream(mission)
        << "mission: craft\nio: fcu\nrecord: " << record
        << "\nfailsafe: {u_frac: -0.25, for: 0.5 s}\n"
           "roles:\n  vehicle: {in: {command: law.command}, out: {status: State}}\n"
           "  law: {in: {state: vehicle.status}, out: {command: Command}}\n"
           "components:\n  craft: {fills: vehicle, use: craft/Craft, params: {real_time: true}}\n"
           "  law_a: {fills: law, use: craft/Hoarder, run: tick}\n"
           "phases:\n  first: {next: [{to: second, when: \"vehicle.status.tick_s > 0.1 s\"}]}\n  second: "
           "{}\n";
    setenv("FULMAR_PLUGIN_PATH", FULMAR_TEST_PLUGIN_DIR, 1);
    pid = fork();
    if (pid == 0) {
      dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
      execl(FULMAR_BIN_DIR "/fulmar", "fulmar", "run", mission.c_str(), "--set", set.c_str(),
            static_cast<char*>(nullptr));
      _exit(99);
    }
  }
  ~Program() {
    if (pid > 0) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  std::string text() const {
    std::ifstream file(err);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  bool prints(const std::string& words) const {
    for (int i = 0; i < 200; ++i, pause_s(0.05))
      if (text().find(words) != std::string::npos) return true;
    return false;
  }
  void send(int signal) const { kill(pid, signal); }
  bool runs() const { return waitpid(pid, nullptr, WNOHANG) == 0; }
  /// Exit code; -1 when it does not end, -2 when a signal has ended it.
  int code() {
    int status = 0;
    for (int i = 0; i < 200; ++i, pause_s(0.05)) {
      if (waitpid(pid, &status, WNOHANG) != pid) continue;
      pid = -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
    }
    return -1;
  }
};

TEST_CASE("on hardware the place of the log is reported before arming") {
  {
    Program program("craft.arm_at=100");
    REQUIRE(program.prints("run.phase_entered(second)"));
    CHECK(program.prints("app.log_off"));
    program.send(SIGINT);
    CHECK(program.code() == 130);
  }
  const std::string log = (folder / "written.mcap").string();
  fs::remove(log);
  Program program("craft.arm_at=100", "{file: " + log + "}");
  REQUIRE(program.prints("run.phase_entered(second)"));
  CHECK(program.prints("log: " + log + "\n"));
  CHECK_FALSE(program.text().find("app.log_off") != std::string::npos);
  program.send(SIGINT);
  CHECK(program.code() == 130);
  CHECK(fs::exists(log));
  fs::remove_all(folder);
}

}  // namespace

TEST_CASE(
    "the first signal is refused while armed, the second gives up control in order, and no alarm ends an "
    "armed flight") {
  Program program("craft.arm_at=0");
  REQUIRE(program.prints("run.phase_entered(second)"));
  program.send(SIGTERM);
  REQUIRE(program.prints("run.signal_refused"));
  program.send(SIGINT);  // too early: timeout(1) sends two at once
  program.send(SIGHUP);
  program.send(SIGALRM);
  pause_s(0.6);
  CHECK(program.runs());
  program.send(SIGINT);
  CHECK(program.code() == 130);
  CHECK(program.text().find("run.control_given_up") != std::string::npos);
  CHECK(program.text().find("app.ended_by_") == std::string::npos);
  CHECK(program.text().find("run.ended_by_signal") == std::string::npos);
}

TEST_CASE("a third signal ends an armed flight at once") {
  Program program("craft.arm_at=0");
  REQUIRE(program.prints("run.phase_entered(second)"));
  program.send(SIGINT);
  REQUIRE(program.prints("run.signal_refused"));
  pause_s(0.6);
  program.send(SIGINT);
  REQUIRE(program.prints("run.control_given_up"));
  pause_s(0.6);
  program.send(SIGINT);
  CHECK(program.code() == 130);
  CHECK(program.text().find("fulmar: app.ended_by_second_signal") != std::string::npos);
}

TEST_CASE("a signal ends the flight of a disarmed aircraft at once") {
  Program program("craft.arm_at=1000");
  REQUIRE(program.prints("run.phase_entered(second)"));
  program.send(SIGTERM);
  CHECK(program.code() == 130);
  CHECK(program.text().find("run.signal_refused") == std::string::npos);
}

TEST_CASE(
    "while a component hangs, a second signal ends the program although the aircraft is armed: nobody flies "
    "it "
    "any more") {
  Program program("law_a.hang_at=0.5");
  REQUIRE(program.prints("run.phase_entered(second)"));
  pause_s(0.8);
  program.send(SIGINT);
  pause_s(0.7);
  CHECK(program.runs());
  program.send(SIGINT);
  CHECK(program.code() == 130);
  CHECK(program.text().find("fulmar: app.ended_by_second_signal_in(step, law_a)") != std::string::npos);
}

TEST_CASE(
    "a host that was killed in the air takes up its phase when it is started again, beside the log of its "
    "predecessor") {
  const std::string record = "{file: " + (folder / "run.mcap").string() + "}";
  {
    Program first("craft.arm_at=0", record);
    REQUIRE(first.prints("run.phase_entered(second)"));
    pause_s(2.5);  // the log is complete up to the last second
    first.send(SIGKILL);
    CHECK(first.code() == -2);
  }
  {
    Program again("craft.arm_at=0.5", record);
    CHECK(again.prints("run.resumed(phase second"));
    again.send(SIGKILL);
    CHECK(again.code() == -2);
    CHECK(again.text().find("run.phase_entered(first)") < again.text().find("run.resumed(phase second"));
  }
  CHECK(fs::exists(folder / "run.mcap.part"));
  CHECK(fs::exists(folder / "run-2.mcap.part"));
  fs::remove(folder / "run-2.mcap.part");
  Program ground("craft.arm_at=1000", record);
  CHECK(ground.prints("run.not_resumed_on_ground"));
  ground.send(SIGTERM);
  CHECK(ground.code() == 130);
  CHECK(fs::exists(folder / "run-2.mcap"));
  fs::remove_all(folder);
}
