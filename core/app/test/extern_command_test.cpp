// SPDX-License-Identifier: BSD-3-Clause
// Subcommands that are separate programs: found beside the host and in PATH, started with the remaining
// words, reported when they are missing.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "sdk/test/said.hpp"

namespace fs = std::filesystem;
using namespace fulmar::test;

namespace {

/// A home folder for a copy of the host, and a folder for PATH.
struct Home {
  fs::path folder = fs::temp_directory_path() / ("fulmar-extern-test-" + std::to_string(getpid()));
  Home() {
    fs::create_directories(folder / "bin");
    fs::create_directories(folder / "path");
    fs::copy_file(FULMAR_BIN_DIR "/fulmar", folder / "bin" / "fulmar");
  }
  ~Home() { fs::remove_all(folder); }
  void program(const std::string& name, const std::string& text, bool executable = true) const {
    std::ofstream(folder / name) << text;
    chmod((folder / name).c_str(), executable ? 0755 : 0644);
  }
  Said fulmar(const std::string& arguments) const {
    return shell("cd " + folder.string() + " && PATH=" + (folder / "path").string() +
                 ":path:$PATH bin/fulmar " + arguments + " 2>&1");
  }
};

/// A program that prints its name and its arguments, one per line.
std::string reporter(const std::string& name, int code) {
  return "#!/bin/sh\necho " + name + "\nfor word in \"$@\"; do echo \"[$word]\"; done\nexit " +
         std::to_string(code) + "\n";
}

}  // namespace

TEST_CASE(
    "a word that is no command of the host starts the program of that name with the remaining words, and "
    "ends with its code") {
  const Home home;
  home.program("bin/fulmar-tell", reporter("beside", 7));
  home.program("path/fulmar-tell", reporter("path", 8));
  home.program("path/fulmar-far", reporter("path", 9));
  const Said beside = home.fulmar("tell --json 'two words' '' -x=1");
  CHECK(beside.out == "beside\n[--json]\n[two words]\n[]\n[-x=1]\n");
  CHECK(beside.code == 7);
  const Said far = home.fulmar("far");
  CHECK(far.out == "path\n");
  CHECK(far.code == 9);
}

TEST_CASE("help lists the programs beside the host") {
  const Home home;
  CHECK_FALSE(holds(home.fulmar("--help").out, "app.programs_beside"));
  home.program("bin/fulmar-zeta", reporter("zeta", 0));
  home.program("bin/fulmar-aero", reporter("aero", 0));
  home.program("bin/fulmar-notes.txt", "text");
  home.program("bin/fulmar-idle", reporter("idle", 0), false);
  home.program("bin/fulmar-child", reporter("child", 0));
  home.program("bin/fulmar-replay", reporter("replay", 0));
  const Said help = home.fulmar("--help");
  CHECK(help.code == 0);
  CHECK(holds(help.out, "app.programs_beside(aero, zeta, aero)"));
}

TEST_CASE("an unknown subcommand is reported with the valid ones, and a built-in one is not replaced") {
  const Home home;
  home.program("bin/fulmar-aero", reporter("aero", 0));
  home.program("bin/fulmar-check", reporter("check", 0));
  home.program("bin/fulmar-idle", reporter("idle", 0), false);
  home.program("bin/fulmar-probe", reporter("probe", 0));
  home.program("bin/fulmar-save", reporter("save", 0));
  home.program("other", reporter("other", 0));
  const Said missing = home.fulmar("areo");
  CHECK(missing.code == 2);
  CHECK(holds(missing.out, "fulmar: app.command_unknown(areo,  [aero] run, check, graph, inspect, new, "));
  CHECK(holds(missing.out, ", aero"));
  CHECK_FALSE(holds(home.fulmar("check none.yaml").out, "\ncheck"));
  for (const char* word : {"idle", "probe", "save", "/../other", "../other", "''"}) {
    CAPTURE(word);
    const Said r = home.fulmar(word);
    CHECK(r.code == 2);
    CHECK(holds(r.out, "fulmar: app.command_unknown("));
  }
}

TEST_CASE("a fault of the command line is printed without control characters") {
  const Home home;
  for (const char* const word : {"a\\033[2J", "a\\302\\2332J"})
    for (const char* const before : {"", "run --", "run x ", "run x --set ", "completion "}) {
      const std::string words = before + ("\"$(printf 'WORD')\"" + std::string());
      const Said r = home.fulmar(std::string(words).replace(words.find("WORD"), 4, word));
      CAPTURE(r.out);
      CHECK(r.code != 0);
      CHECK(r.out.find('\x1b') == std::string::npos);
      CHECK(r.out.find("\xc2\x9b") == std::string::npos);
    }
}

TEST_CASE("a program that was not built is reported with the way to build it") {
  const Home home;
  for (const std::string word : {"fcu", "ros2"}) {
    const Said missing = home.fulmar(word + " status");
    CHECK(missing.code == 2);
    CHECK(holds(missing.out, "fulmar: app.program_not_built(fulmar-" + word + ")"));
  }
  CHECK_FALSE(holds(home.fulmar("fca").out, "app.program_not_built"));
}

TEST_CASE("a subcommand of the host whose program is missing is reported with the program's name") {
  const Home home;
  const std::map<std::string, std::string> program_of = {
      {"check", "fulmar-inspect"}, {"graph", "fulmar-inspect"}, {"log", "fulmar-log"},
      {"param", "fulmar-live"},    {"new", "fulmar-new"},       {"replay", "fulmar-replay"}};
  for (const auto& entry : program_of) {
    CAPTURE(entry.first);
    const Said r = home.fulmar(entry.first + " --help");
    CHECK(r.code == 4);
    CHECK(holds(r.out, "app.command_program_missing(" + entry.first + ", " + entry.second + ")"));
  }
  for (const std::string several : {"--seeds 1..2", "--repeat 2", "--watch", "--build make"}) {
    const Said r = home.fulmar("run x.yaml " + several);
    CHECK(r.code == 4);
    CHECK(holds(r.out, "app.command_program_missing(run, fulmar-campaign)"));
  }
}

TEST_CASE("the host's help lists every subcommand of the programs beside it, as their own help does") {
  const auto words_of = [](const std::string& program) {
    FILE* pipe = popen((FULMAR_BIN_DIR "/" + program + " --help 2>&1").c_str(), "r");
    REQUIRE(pipe != nullptr);
    char line[512];
    std::map<std::string, std::string> words;
    bool listed = false;
    while (fgets(line, sizeof line, pipe)) {
      std::istringstream in(line);
      std::string word, description;
      const bool indented = std::string(line).rfind("  ", 0) == 0;
      if (in >> word && listed && indented && std::getline(in >> std::ws, description))
        words[word] = description;
      listed = listed || word == "Subcommands:";
    }
    pclose(pipe);
    return words;
  };
  const std::map<std::string, std::string> host = words_of("fulmar");
  CHECK(host.count("run") == 1);
  std::size_t elsewhere = 0;
  for (const char* program : {"fulmar-inspect", "fulmar-new", "fulmar-replay", "fulmar-log", "fulmar-live"})
    for (const auto& entry : words_of(program)) {
      CAPTURE(entry.first);
      REQUIRE(host.count(entry.first) == 1);
      CHECK(host.at(entry.first) == entry.second);
      ++elsewhere;
    }
  CHECK(elsewhere + 1 == host.size());
}

TEST_CASE("the program does not depend on the present folder: relative folders of PATH are skipped") {
  const Home home;
  fs::create_directories(home.folder / "elsewhere" / "path");
  home.program("elsewhere/path/fulmar-near", reporter("near", 0));
  const Said r = home.fulmar("--version >/dev/null; cd elsewhere && ../bin/fulmar near");
  CHECK(r.code == 2);
  CHECK(holds(r.out, "fulmar: app.command_unknown(near, "));
}

TEST_CASE("a program that cannot be started is named in the message") {
  const Home home;
  home.program("bin/fulmar-broken", "#!/no/such/interpreter\n");
  const Said r = home.fulmar("broken");
  CHECK(r.code == 4);
  CHECK(holds(r.out, "app.command_not_started(broken, " + (home.folder / "bin" / "fulmar-broken").string() +
                         ", " + std::make_error_code(std::errc::no_such_file_or_directory).message() + ")"));
}
