// SPDX-License-Identifier: BSD-3-Clause
// A mock flight at 400 Hz with a live view, and commands that its user types in a shell.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "links/live/server.hpp"
#include "links/live/test/mock.hpp"
#include "tools/fulmar_live/session.hpp"

namespace remote_test {

namespace fs = std::filesystem;
using namespace fulmar::core;
using Words = std::vector<std::string>;

struct MockFlight {
  Tap tap{test::mock_channels()};
  test::MockControl control;
  std::unique_ptr<LiveServer> server;
  std::atomic<bool> stop{false};
  std::thread loop;

  explicit MockFlight(const std::string& token = "") {
    LiveOptions options;
    options.port = 0;
    options.token = token;
    server = std::make_unique<LiveServer>(tap, control, options);
    loop = std::thread([this] {
      auto due = std::chrono::steady_clock::now();
      for (int i = 0; !stop; ++i) {
        test::mock_tick(tap, i);
        std::this_thread::sleep_until(due += std::chrono::microseconds(2500));
      }
    });
  }
  ~MockFlight() {
    stop = true;
    loop.join();
  }
  std::string at() const { return "127.0.0.1:" + std::to_string(server->port()); }
  LiveAddress target(const std::string& token = "") const { return parse_target(at(), token); }
  bool heard(const std::string& what) const {
    for (const std::string& word : control.received())
      if (word == what) return true;
    return false;
  }
  /// The request that came last, decoded.
  std::string leg() const {
    test::Leg leg;
    const std::vector<std::byte> bytes = control.message();
    REQUIRE(bytes.size() == sizeof leg);
    std::memcpy(&leg, bytes.data(), sizeof leg);
    std::ostringstream text;
    text << control.received().back().substr(std::strlen("request ")) << ": kind " << int{leg.kind}
         << ", course " << leg.has_course << ' ' << leg.course_rad << ", position " << leg.position_m.north
         << ' ' << leg.position_m.east << ' ' << leg.position_m.down;
    return text.str();
  }
};

struct Result {
  int code = -1;
  std::string out, err;
};
struct Folder {
  fs::path path = fs::temp_directory_path() /
                  ("fulmar-remote-test-" + std::to_string(getpid()) + "-" + std::to_string(next()));
  Folder() { fs::create_directories(path); }
  static int next() {
    static int number = 0;
    return number++;
  }
  ~Folder() { fs::remove_all(path); }
};

inline std::string content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

inline Result shell(const std::string& command) {
  const Folder folder;
  Result r;
  FILE* pipe = popen(("(" + command + ") 2>" + (folder.path / "err").string()).c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) r.out.append(buffer, n);
  const int status = pclose(pipe);
  r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  r.err = content(folder.path / "err");
  return r;
}

inline const std::string program = FULMAR_BIN_DIR "/fulmar";

inline Result typed(const MockFlight& flight, const std::string& words) {
  return shell("FULMAR_LIVE=" + flight.at() + " " + program + " " + words);
}

inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

}  // namespace remote_test
