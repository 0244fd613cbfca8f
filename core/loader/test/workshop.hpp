// SPDX-License-Identifier: BSD-3-Clause
// A temporary folder with its own plugin store, and helpers for plugin files in it.
#pragma once
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "core/loader/library.hpp"

namespace workshop {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-loader-test-" + std::to_string(::getpid()));
  Folder() {
    fs::create_directories(path);
    ::setenv("FULMAR_STORE", (path / "store").c_str(), 1);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

inline const fs::path& folder() {
  static const Folder one;
  return one.path;
}

inline fs::path plugin(const std::string& name) {
  folder();
  return fs::path(FULMAR_TEST_PLUGIN_DIR) / (name + ".so");
}

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline fs::path write(const std::string& name, const std::string& bytes) {
  const fs::path file = folder() / name;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  return file;
}

/// The message with which the host rejects a file.
inline std::string refusal(const fs::path& file) {
  try {
    fulmar::core::Library::open(file);
    return "accepted";
  } catch (const fulmar::core::Error& e) {
    return e.what();
  }
}

struct Environment {  // sets a variable for its lifetime
  std::string name, before;
  Environment(const char* variable, const std::string& value) : name(variable) {
    if (const char* old = std::getenv(variable)) before = old;
    ::setenv(variable, value.c_str(), 1);
  }
  ~Environment() {
    if (before.empty()) {
      ::unsetenv(name.c_str());
    } else {
      ::setenv(name.c_str(), before.c_str(), 1);
    }
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
};

}  // namespace workshop
