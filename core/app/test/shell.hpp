// SPDX-License-Identifier: BSD-3-Clause
// The program `fulmar` for tests, as users call it.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace app_test {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-app-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};
inline const fs::path& folder() {
  static Folder f;
  return f.path;
}

struct Result {
  int code = -1;
  std::string out, err;
};

inline Result shell(const std::string& command) {
  const fs::path err = folder() / "stderr.txt";
  Result r;
  FILE* pipe = popen(("(" + command + ") 2>" + err.string()).c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) r.out.append(buffer, n);
  const int status = pclose(pipe);
  r.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::ifstream file(err);
  r.err.assign(std::istreambuf_iterator<char>(file), {});
  return r;
}

inline const std::string program = FULMAR_BIN_DIR "/fulmar ";
inline const std::string hourglass = FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml";

inline Result fulmar(const std::string& arguments) { return shell(program + arguments); }

/// A mission that extends the shipped ones, with `text` in it.
inline fs::path mission(const std::string& text, const std::string& airframe = "anaconda.yaml") {
  const fs::path file = folder() / "mission.yaml";
  std::ofstream(file) << "mission: trial\nextends: " FULMAR_SOURCE_DIR
                         "/configs/missions/common.yaml\nio: sim\nairframe: " FULMAR_SOURCE_DIR
                         "/configs/airframes/"
                      << airframe << "\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
                      << text;
  return file;
}
inline const std::string plan =
    "components:\n  plan: {params: {plan: " FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml}}\n";

}  // namespace app_test
