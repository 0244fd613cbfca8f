// SPDX-License-Identifier: BSD-3-Clause
// Permission to write files, and the answer to a client when fulmar-save fails.
#include "links/live/saving.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "links/live/gate.hpp"
#include "links/live/test/hub_fixture.hpp"

namespace saving_test {

namespace fs = std::filesystem;
using namespace fulmar::core;
using namespace fulmar::core::live;
using namespace fulmar::core::live::test;

namespace {

/// Replaces fulmar-save by a script for its lifetime.
struct Program {
  fs::path file = fs::temp_directory_path() / ("fulmar-save-" + std::to_string(::getpid()));
  FlightView view = MockControl().view();
  explicit Program(const std::string& script) {
    std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
    ::setenv("FULMAR_SAVE", file.c_str(), 1);
    view.file = "/nowhere/m.yaml";
  }
  ~Program() {
    ::unsetenv("FULMAR_SAVE");
    fs::remove(file);
  }
  SaveAnswer answer(std::chrono::seconds limit = std::chrono::seconds(60)) const {
    return save(view, "slc", "", limit);
  }
};

}  // namespace

TEST_CASE("the program gets the current parameters in JSON, and a client its answer") {
  const Program program(
      "cat > \"$0.in\"; echo '{\"accepted\":true,\"reason\":\"r\",\"lines\":\"l\",\"mark\":\"m\"}'");
  const SaveAnswer answer = program.answer();
  CHECK(answer.accepted);
  CHECK(answer.reason == "r");
  CHECK(answer.lines == "l");
  CHECK(answer.mark == "m");
  const fs::path copy = program.file.string() + ".in";
  const json request = json::parse(std::ifstream(copy));
  fs::remove(copy);
  CHECK(request["component"] == "slc");
  CHECK(request["mark"] == "");
  CHECK(request["file"] == "/nowhere/m.yaml");
  CHECK(request["mission"] == "mock <1>");
  CHECK(request["components"][0]["use"] == "control_slc/Outer");
  const json& params = request["components"][0]["params"];
  CHECK(params[0]["name"] == "roll_kp");
  CHECK(params[0]["value"] == 0.55);
}

TEST_CASE("a fault of the program is one sentence: it crashes, ends, answers something else, or nothing") {
  const Program killed("kill -SEGV $$");
  CHECK(killed.answer().reason == "live.save_program_killed(" + killed.file.string() + ", 11)");
  const Program failed("exit 3");
  CHECK(failed.answer().reason == "live.save_program_failed(" + failed.file.string() + ", 3)");
  for (const char* const other : {"", "echo no", "echo []", "echo '{\"accepted\": 1}'"}) {
    const SaveAnswer answer = Program(other).answer();
    CHECK_FALSE(answer.accepted);
    CHECK(answer.reason == "live.save_answer_invalid");
  }
  const Program sleeping("exec sleep 100");
  const SaveAnswer late = sleeping.answer(std::chrono::seconds(0));
  CHECK_FALSE(late.accepted);
  CHECK(late.reason == "live.save_timed_out(" + sleeping.file.string() + ", 0)");
  const Program gone("");
  fs::remove(gone.file);
  const std::string fault = std::make_error_code(std::errc::no_such_file_or_directory).message();
  CHECK(gone.answer().reason == "loader.program_not_started(" + gone.file.string() + ", " + fault + ")");
}

TEST_CASE("answers without such a program" * doctest::skip()) {
  FlightView view = MockControl().view();
  view.file = "/nowhere/m.yaml";
  CHECK(save(view, "", "").reason == "live.save_program_missing");
}

TEST_CASE("a host without fulmar-save beside it reports the missing program and the way to build it") {
  const fs::path home = fs::path(FULMAR_BIN_DIR).parent_path() / ("alone-" + std::to_string(::getpid()));
  const fs::path self = home / "bin" / "live_test";
  fs::create_directories(self.parent_path());
  fs::create_hard_link(fs::canonical("/proc/self/exe"),
                       self);  // programs are searched beside the running one
  const std::string command = self.string() + " -ns -tc='answers where there is no such program' >/dev/null";
  CHECK(std::system(command.c_str()) == 0);
  fs::remove_all(home);
}

TEST_CASE("no program is started when files may not be written, or none exists") {
  Program program("echo started > \"$0.in\"");
  program.view.no_save = "graph.save_off";
  CHECK(program.answer().reason == "live.save_not_allowed(graph.save_off)");
  program.view.no_save = "";
  program.view.file = "";
  CHECK(program.answer().reason == "live.mission_file_missing");
  CHECK_FALSE(fs::exists(program.file.string() + ".in"));
}

TEST_CASE_FIXTURE(Fixture, "the service answers from another thread than the hub's, in JSON and in CDR") {
  const json refused = call_json("/fulmar/save", R"({"component": "slc", "mark": ""})");
  CHECK(refused["accepted"] == false);
  CHECK(refused["reason"] == "live.mission_file_missing");
  CHECK((refused["lines"] == "" && refused["mark"] == ""));
  CHECK(call_json("/fulmar/save", R"({"component": "slc"})")["reason"] == "live.request_text_missing(mark)");
  CHECK(call_json("/fulmar/view", "{}")["no_save"] == "");
  const std::size_t before = peer.binaries.size();
  call("/fulmar/save", "cdr",
       std::string("\0\1\0\0", 4) + le(1) + std::string(4, '\0') + le(1) + std::string(1, '\0'));
  REQUIRE(until([&] { return peer.binaries.size() > before; }));
  const std::string& answer = peer.binaries.back();
  CHECK(answer[20] == 0);  // not accepted
  CHECK(answer.find("live.mission_file_missing") != std::string::npos);
  const std::size_t then = peer.binaries.size();
  call("/fulmar/save", "cdr", "");  // an invalid request is answered in the same form
  REQUIRE(until([&] { return peer.binaries.size() > then; }));
  CHECK(peer.binaries.back().ends_with(le(1) + std::string(4, '\0') + le(1) + std::string(1, '\0')));
}

}  // namespace saving_test
