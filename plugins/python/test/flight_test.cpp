// SPDX-License-Identifier: BSD-3-Clause
// Missions with a component in Python, flown by the program.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace flight_test {

namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-python-flight-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};
const fs::path& folder() {
  static const Folder one;
  return one.path;
}

struct Result {
  int code = -1;
  std::string out, err;
  bool says(const std::string& words) const { return out.find(words) != std::string::npos; }
};

Result fulmar(const std::string& arguments) {
  const std::string err = (folder() / "stderr.txt").string();
  Result r;
  FILE* pipe = ::popen((std::string(FULMAR_BIN_DIR "/fulmar ") + arguments + " 2>" + err).c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  for (std::size_t n = 0; (n = ::fread(buffer, 1, sizeof buffer, pipe)) > 0;) r.out.append(buffer, n);
  const int status = ::pclose(pipe);
  r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::ifstream file(err);
  r.err.assign(std::istreambuf_iterator<char>(file), {});
  return r;
}

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The example's mission with `script` as its law.
std::string mission(const std::string& script, const std::string& more = "") {
  std::ofstream(folder() / "law.py") << script;
  std::ofstream(folder() / "mission.yaml")
      << "mission: trial\nextends: " FULMAR_SOURCE_DIR "/configs/missions/common.yaml\n"
      << "airframe: " FULMAR_SOURCE_DIR "/configs/airframes/anaconda.yaml\n"
      << "origin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\nseed: 7\ndone: "
         "\"manage.progress.circuits >= 1\"\n"
      << "components:\n  plan: {params: {plan: " FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml}}\n"
      << "  mine: {fills: outer, use: law.py, rate: 100 Hz" << more
      << "}\nphases:\n  cruise: {outer: {use: mine, fallback: slc}}\n";
  return (folder() / "mission.yaml").string();
}

/// The example's law with a line before its first one in `step`.
std::string law(const std::string& line = "") {
  std::string text = read(FULMAR_SOURCE_DIR "/examples/python/my_law.py");
  const std::string first = "        state, command = inp.state, inp.command\n";
  const std::size_t at = text.find(first);
  REQUIRE(at != std::string::npos);
  return text.insert(at, line.empty() ? "" : "        " + line + "\n");
}

}  // namespace

TEST_CASE("the hourglass is flown to its end by a law in Python") {
  const Result r = fulmar("run " FULMAR_SOURCE_DIR "/examples/python/my_law.yaml --json --no-log");
  CAPTURE(r.err);
  CHECK(r.code == 0);
  CHECK(r.says("\"result\": \"flown\""));
  CHECK(r.says("\"guards\": []"));
  CHECK(r.says("\"mine\""));
}

TEST_CASE("the same flight gives the same bytes, and what a script prints does not get into the JSON") {
  const std::string file = mission(law("print('a line', {'b', 'a', 'c'})"));
  std::string logs[2];
  for (std::string& log : logs) {
    const fs::path name = folder() / "flight.mcap";
    fs::remove(name);
    const Result r = fulmar("run " + file + " --duration 30 --json --log " + name.string());
    REQUIRE(r.code == 0);
    CHECK(r.out.front() == '{');
    CHECK(r.err.find("a line") != std::string::npos);
    log = read(name);
  }
  CHECK(!logs[0].empty());
  CHECK(logs[0] == logs[1]);
}

TEST_CASE("a law that raises in flight is replaced by the fallback, and its traceback is told") {
  const std::string script = law("if tick.now_s > 40: self.no_such_gain"),
                    before = script.substr(0, script.find("if tick.now_s"));
  const Result r = fulmar("run " + mission(script) + " --json --no-log");
  CHECK(r.code == 0);
  CHECK(r.says("\"result\": \"flown with guards\""));
  const std::string reason = "AttributeError: 'MyLaw' object has no attribute 'no_such_gain'";  // of Python
  CHECK(r.says(reason));
  CHECK(r.says("\"component\": \"mine\""));
  CHECK(r.says("law.py:" + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
               " in step: AttributeError: "));
  const std::string traceback = "Traceback (most recent call last)";  // of Python
  CHECK(r.err.find(traceback) != std::string::npos);
}

TEST_CASE(
    "in a process of its own a law flies as in the loop, and one that ends the interpreter costs nothing but "
    "its role") {
  const Result good = fulmar("run " + mission(law(), ", run: process") + " --json --no-log");
  CAPTURE(good.err);
  CHECK(good.code == 0);
  CHECK(good.says("\"guards\": []"));
  const Result bad =
      fulmar("run " + mission(law("if tick.now_s > 40: __import__('os').abort()"), ", run: process") +
             " --json --no-log");
  CHECK(bad.code == 0);
  CHECK(bad.says("\"result\": \"flown with guards\""));
  CHECK(bad.says("\"component\": \"mine\""));
}

TEST_CASE("a script that cannot be opened is a fault of the mission, with its line and that of the script") {
  const Result missing = fulmar("check " + mission("import nosuchthing\n"));
  CHECK(missing.code == 4);
  CHECK(missing.err.find("mission.yaml:9: components.mine: law.py:1: python.module_missing(nosuchthing)") !=
        std::string::npos);
  const Result syntax = fulmar("check " + mission("class Law\n"));
  CHECK(syntax.err.find("law.py:1: expected ':'") != std::string::npos);
  mission(law());
  const Result name = fulmar("check " + (folder() / "mission.yaml").string() + " --role outer=mine");
  CHECK(name.code == 0);
  std::string text = read(folder() / "mission.yaml");
  text.replace(text.find("use: law.py"), 11, "use: law.py/MyLow");
  std::ofstream(folder() / "mission.yaml") << text;
  const Result low = fulmar("check " + (folder() / "mission.yaml").string());
  CHECK(low.err.find("types.name_unknown_in(the plugin law.py, component, MyLow,  [MyLaw] MyLaw)") !=
        std::string::npos);
  text.replace(text.find("law.py"), 6, "lww.py");
  std::ofstream(folder() / "mission.yaml") << text;
  CHECK(fulmar("check " + (folder() / "mission.yaml").string()).err.find("graph.plugin_unknown(lww.py") !=
        std::string::npos);
}

TEST_CASE(
    "a script that never ends, crashes or leaves while it is imported is stopped by the probing child") {
  ::setenv("FULMAR_PROBE_SECONDS", "2", 1);
  const Result loop = fulmar("check " + mission("while True: pass\n"));
  ::unsetenv("FULMAR_PROBE_SECONDS");
  CHECK(loop.code == 4);
  // 2 s of the CPU, or on a busy machine 8 s by the clock on the wall
  CHECK(loop.err.find("loader.probe_timed_out(law.py, loading, ") != std::string::npos);
  CHECK(fulmar("check " + mission("import os\nos._exit(3)\n"))
            .err.find("loader.plugin_ended_process(law.py, loaded, 3, )") != std::string::npos);
  CHECK(fulmar("check " + mission("import os\nos.abort()\n"))
            .err.find("loader.plugin_crashed(law.py, loaded, 6, )") != std::string::npos);
}

}  // namespace flight_test
