// SPDX-License-Identifier: BSD-3-Clause
// Start of viewers: links and command lines, as documented by the viewers.
#include "tools/fulmar_live/view.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "tools/fulmar_live/commands.hpp"

namespace view_test {

namespace fs = std::filesystem;
using namespace fulmar::core;
using Words = std::vector<std::string>;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-view-test-" + std::to_string(getpid()));
  Folder() {
    fs::create_directories(path);
    std::ofstream(path / "a log.mcap") << "\x89MCAP0\r\n";
  }
  ~Folder() { fs::remove_all(path); }
  std::string log() const { return (path / "a log.mcap").string(); }
};

struct Result {
  int code = -1;
  std::string text;
};

Result shell(const std::string& command) {
  Result r;
  FILE* pipe = popen(("(" + command + ") 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) r.text.append(buffer, n);
  const int status = pclose(pipe);
  r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return r;
}

Result view(const std::string& words) { return shell(FULMAR_BIN_DIR "/fulmar view " + words); }

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a link names the flight, and carries the token as one value") {
  const LiveAddress target = parse_target("192.168.1.7:9000", "a b&c=d/é");
  CHECK(opening_of("lichtblick", "", target).link ==
        "lichtblick://open?ds=foxglove-websocket&ds.url=ws%3A%2F%2F192.168.1.7%3A9000%2F%3Ftoken%3Da%2520b%"
        "2526c%253Dd%252F%25C3%25A9");
  CHECK(opening_of("page", "", target).link == "http://192.168.1.7:9000/?token=a%20b%26c%3Dd%2F%C3%A9");
  CHECK(opening_of("foxglove", "", parse_target("")).link ==
        "foxglove://open?ds=foxglove-websocket&ds.url=ws%3A%2F%2F127.0.0.1%3A8765%2F");
  CHECK(opening_of("page", "", parse_target("[::1]:8765")).link == "http://[::1]:8765/");
  CHECK(opening_of("page", "", target).words == Words{"xdg-open", opening_of("page", "", target).link});
}

TEST_CASE("a log is a command line, with the layout that is shipped for the viewer") {
  const LiveAddress nowhere = parse_target("");
  const Opening lichtblick = opening_of("lichtblick", "/a/b.mcap", nowhere);
  CHECK(lichtblick.words == Words{"lichtblick", "--source=/a/b.mcap", "--defaultLayout=fulmar"});
  CHECK(fs::exists(lichtblick.layout));
  CHECK(fs::path(lichtblick.layout).filename() == "fulmar.json");
  const Opening plots = opening_of("plotjuggler", "/a/b.mcap", nowhere);
  REQUIRE(plots.words.size() == 5);
  CHECK(plots.words[2] == "/a/b.mcap");
  CHECK(fs::path(plots.words[4]).filename() == "plotjuggler.xml");
  CHECK(fs::exists(plots.words[4]));
  CHECK(opening_of("rerun", "/a/b.mcap", nowhere).words == Words{"rerun", "/a/b.mcap"});
  CHECK(opening_of("foxglove", "/a/b.mcap", nowhere).words.back() == "/a/b.mcap");
  CHECK(opening_of("page", "/a/b.mcap", nowhere).words == Words{"xdg-open", "/a/b.html"});
  CHECK(opening_of("page", "/a/b.mcap", nowhere).report == "/a/b.html");
  CHECK(opening_of("rerun", "/a/b.mcap", nowhere).report.empty());
}

TEST_CASE("what a viewer cannot do, and one that nobody knows, is refused with what can be done") {
  const LiveAddress nowhere = parse_target("");
  CHECK_THROWS_AS(opening_of("rerun", "", nowhere), WrongUsage);
  const Folder folder;
  Result r = view("--in lichtblik --print");
  CHECK(r.code == 2);
  CHECK(holds(
      r.text,
      "remote.viewer_unknown(lichtblik,  [lichtblick] page, lichtblick, foxglove, rerun, plotjuggler)"));
  r = view("none.mcap --print");
  CHECK(r.code == 1);
  CHECK(holds(r.text, "remote.log_missing(none.mcap)"));
  r = view(folder.path.string());
  CHECK(r.code == 1);
  CHECK(holds(r.text, "remote.log_is_folder(" + folder.path.string() + ")"));
  r = view(FULMAR_SOURCE_DIR "/README.md");
  CHECK(r.code == 1);
  CHECK(holds(r.text, "remote.log_expected(" FULMAR_SOURCE_DIR "/README.md)"));
  fs::rename(folder.log(), folder.path / "b.mcap.part");
  r = view((folder.path / "b.mcap.part").string());
  CHECK(r.code == 1);
  CHECK(holds(r.text, "remote.log_incomplete(" + (folder.path / "b.mcap.part").string() + ")"));
}

TEST_CASE("the page of a log that is there is opened as it is, unless the log is younger") {
  const Folder folder;
  const fs::path page = fs::path(folder.log()).replace_extension(".html");
  std::ofstream(page) << "mine";
  const auto log_s = fs::last_write_time(folder.log());
  fs::last_write_time(page, log_s + std::chrono::seconds(1));
  Result r = view("'" + folder.log() + "' --in page --print");
  CHECK(r.code == 0);
  CHECK(r.text == "xdg-open '" + page.string() + "'\n");
  fs::last_write_time(page, log_s - std::chrono::seconds(1));
  r = view("'" + folder.log() + "' --in page --print");
  CHECK(r.code == 1);
  CHECK(holds(r.text, "remote.page_outdated(" + page.string() + ", "));
  std::string kept;
  std::ifstream(page) >> kept;
  CHECK(kept == "mine");
}

TEST_CASE("nobody flies: told, and no link is given; --print gives it all the same") {
  Result r = view("--at 127.0.0.1:1");
  CHECK(r.code == 1);
  CHECK_FALSE(holds(r.text, "http"));
  r = view("--at 127.0.0.1:1 --print");
  CHECK(r.code == 0);
  CHECK(r.text == "http://127.0.0.1:1/\n");
}

TEST_CASE("what is printed is the line that a shell runs") {
  const Folder folder;
  const Result r = view("'" + folder.log() + "' --in rerun --print");
  CHECK(r.code == 0);
  CHECK(r.text == "rerun '" + folder.log() + "'\n");
  CHECK(shell("printf %s " + shell_quoted("it's $HOME \\ \"x\"")).text == "it's $HOME \\ \"x\"");
  CHECK(shell("printf %s " + shell_quoted("")).text == "");
  CHECK(shell_quoted("") == "''");
}

TEST_CASE("a viewer is started where there is a display and a terminal, and nowhere else") {
  const Folder folder;
  const fs::path fake = folder.path / "lichtblick", reported = folder.path / "told";
  std::ofstream(fake) << "#!/bin/sh\nprintf '%s|' \"$@\" >'" << reported.string() << ".new'\nmv '"
                      << reported.string() << ".new' '" << reported.string() << "'\n";
  fs::permissions(fake, fs::perms::owner_all);
  const std::string command = std::string(FULMAR_BIN_DIR "/fulmar view \"") + folder.log() + "\"",
                    at_terminal = "script -qec '" + command + "' /dev/null", path = folder.path.string();
  const auto started = [&] {
    for (int i = 0; i < 100 && !fs::exists(reported); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return fs::exists(reported);
  };
  CHECK(shell("PATH=" + path + ":$PATH DISPLAY=:9 " + command).code == 0);
  CHECK(shell("PATH=" + path + ":$PATH DISPLAY= WAYLAND_DISPLAY= " + at_terminal).code == 0);
  CHECK_FALSE(fs::exists(reported));
  CHECK(shell("PATH=" + path + ":$PATH DISPLAY=:9 " + at_terminal).code == 0);
  REQUIRE(started());
  std::stringstream words;
  words << std::ifstream(reported).rdbuf();
  CHECK(words.str() == "--source=" + folder.log() + "|--defaultLayout=fulmar|");
  fs::remove(fake);
  const Result missing = shell("DISPLAY=:9 " + at_terminal);
  CHECK(missing.code == 1);
  CHECK(holds(missing.text, "remote.viewer_not_installed(lichtblick)"));
}

}  // namespace view_test
