// SPDX-License-Identifier: BSD-3-Clause
// Plugins that pass their probe and end the program when it uses them: every subcommand that loads one
// reports the file, and the exit code is not success.
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/run/test/lab.hpp"

namespace sly_test {

using namespace lab;

namespace {

struct Result {
  int code = -1;
  std::string out, err;
};

std::string text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The exit code, or 128 plus the signal, as in a shell.
Result fulmar(const std::string& words) {
  const fs::path out = folder().path / "out", err = folder().path / "err";
  const int status = std::system(
      ("ulimit -c 0; exec " FULMAR_BIN_DIR "/fulmar " + words + " >" + out.string() + " 2>" + err.string())
          .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text(out), text(err)};
}

std::string plugin(const std::string& name) { return FULMAR_TEST_PLUGIN_DIR "/" + name + ".so"; }

/// The laboratory's mission with such a component, which this process does not load itself.
std::string sly_mission(const std::string& name) {
  mission("  sly: {use: " + plugin("sly_setsid") + "}\n" + one_phase);
  std::string with = text(folder().path / "lab.yaml");
  with.replace(with.find("sly_setsid"), 10, name);
  const fs::path file = folder().path / "sly.yaml";
  std::ofstream(file) << with;
  return file.string();
}

struct Sly {
  const char *name, *reported;
  int code;
};
const Sly all[] = {
    {"sly_exit", "app.file_ended_program(sly_exit.so, loaded).", 4},
    {"sly_quit", "app.file_ended_program(sly_quit.so, loaded).", 4},
    {"sly_last", "app.file_ended_program(sly_last.so, unloaded)", 4},
    {"sly_crash", "app.file_crashed(sly_crash.so, loaded, segmentation fault).", 128 + SIGSEGV}};

bool tried(const Sly& sly) {  // a sanitized build handles crashes by itself
  return FULMAR_CRASH_TESTS || sly.code == 4;
}

}  // namespace

TEST_CASE("a plugin that ends the program is reported by every subcommand that loads it") {
  for (const Sly& sly : all) {
    if (!tried(sly)) continue;
    CAPTURE(sly.name);
    const std::string flown = sly_mission(sly.name);
    for (const std::string& words :
         {"inspect " + plugin(sly.name), "check " + flown, "graph " + flown, "run " + flown + " --no-log"}) {
      if (words.starts_with("run") && sly.name == "sly_last"s) continue;  // flies first
      CAPTURE(words);
      const Result r = fulmar(words);
      CHECK(r.code == sly.code);
      CHECK_MESSAGE(r.err.find("fulmar: "s + sly.reported) != std::string::npos, r.err);
    }
  }
}

TEST_CASE("a signal during the set-up of a flight ends it as in flight") {
  const Result r = fulmar("run " + sly_mission("sly_hup") + " --no-log --json");
  CHECK(r.code == 130);
  CHECK(r.out.find("\"result\": \"interrupted\"") != std::string::npos);
}

TEST_CASE("a destructor that hangs at the exit ends with the program, and the flight's code stays") {
  if (!FULMAR_CRASH_TESTS) return;
  const Result r = fulmar("run " + sly_mission("sly_stay") + " --no-log --duration 0.2");
  CHECK(r.code == 0);
  CHECK(r.err.find("fulmar: app.file_hangs(sly_stay.so, unloaded)\n") != std::string::npos);
  CHECK(r.out.find("flown (duration reached)") != std::string::npos);
}

TEST_CASE("a plugin that ends a running host in a swap is named, with the place of the log") {
  const std::string log = (folder().path / "swap.mcap").string();
  for (const Sly& sly : all) {
    if (!tried(sly) || sly.name == "sly_last"s) continue;
    CAPTURE(sly.name);
    const fs::path printed = folder().path / "said";
    for (const std::string& old : {log + ".part", printed.string()}) fs::remove(old);
    const std::string flown = sly_mission("sly_setsid");
    const std::string host = FULMAR_BIN_DIR "/fulmar run " + flown +
                             " --speed real --arm off --live 127.0.0.1:0 --log " + log + " 2>" +
                             printed.string() + " & echo $!; wait $!; echo $?";
    FILE* const pipe = popen(("ulimit -c 0; " + host).c_str(), "r");
    REQUIRE(pipe != nullptr);
    int process = 0, code = 0;
    REQUIRE(std::fscanf(pipe, "%d", &process) == 1);
    const std::string at = "live view: ws://";
    std::size_t begin = std::string::npos;
    for (int i = 0; i < 6000 && (begin = text(printed).find(at)) == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::string port = begin == std::string::npos ? "" : text(printed).substr(begin + at.size());
    port.resize(std::min(port.size(), port.find('\n')));
    setenv("FULMAR_LIVE", port.c_str(), 1);
    fulmar("swap sly " + plugin(sly.name));
    unsetenv("FULMAR_LIVE");
    if (text(printed).find(sly.name) == std::string::npos) kill(process, SIGKILL);
    CHECK(std::fscanf(pipe, "%d", &code) == 1);
    pclose(pipe);
    // in a flight: it had begun, and failed
    CHECK(code == (sly.code == 4 ? 1 : sly.code));
    CHECK_MESSAGE(text(printed).find(std::string(sly.reported) + " app.log_until_end(" + log + ".part)") !=
                      std::string::npos,
                  text(printed));
  }
}

}  // namespace sly_test
