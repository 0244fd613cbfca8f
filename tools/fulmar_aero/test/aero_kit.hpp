// SPDX-License-Identifier: BSD-3-Clause
// Runs `fulmar aero ...` as people do, and writes airframe files for it.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace fulmar::aero::test {

struct Answer {
  int code = -1;
  std::string out;  // what was printed, faults too
  bool says(const std::string& text) const { return out.find(text) != std::string::npos; }
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

inline Answer call(const std::string& words) {
  Answer answer;
  std::FILE* const pipe = ::popen((FULMAR_BIN_DIR "/fulmar aero " + words + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) answer.out.append(buffer, n);
  const int status = ::pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  INFO(answer.out);
  return answer;
}

/// A folder that goes when the test ends.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("fulmar-aero-" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() {
    std::error_code code;
    std::filesystem::remove_all(path, code);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
};

inline std::string text_of(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A shipped airframe file with one thing changed.
inline std::string changed(const std::string& airframe, const std::string& old, const std::string& by) {
  std::string text = text_of(FULMAR_SOURCE_DIR "/configs/airframes/" + airframe + ".yaml");
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), by);
}

}  // namespace fulmar::aero::test
