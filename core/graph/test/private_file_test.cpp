// SPDX-License-Identifier: BSD-3-Clause
// Possible writers of a plugin file. The files are no plugins: a rejected file is never opened.
#include "core/graph/private_file.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "core/graph/catalogue.hpp"
#include "shelf.hpp"

namespace private_file_test {

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

// A folder that holds build/law.so and other.so.
struct Place {
  test::Folder folder;

  Place() {
    for (const char* name : {"build", "open"}) fs::create_directory(folder.path / name);
    put("build/law.so", "a law");
    put("other.so", "another");
  }
  fs::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder.path / name, std::ios::binary) << bytes;
    ::chmod((folder.path / name).c_str(), 0644);
    return folder.path / name;
  }
  // The message about a file; "" when it may be loaded.
  std::string printed(const std::string& name) const {
    try {
      check_private_file(folder.path / name);
      return "";
    } catch (const Error& fault) {
      return fault.what();
    }
  }
};

}  // namespace

TEST_CASE("a file that all may write is rejected") {
  Place place;
  const fs::path real = fs::canonical(place.folder.path);
  ::chmod((real / "build/law.so").c_str(), 0646);
  const std::string fault = "graph.file_not_private(law.so, " + (real / "build/law.so").string() + ")";
  CHECK(place.printed("build/law.so") == fault);
  place.put("open/x.so", "x");
  ::chmod((real / "open").c_str(), 0777);
  CHECK(place.printed("open/x.so") == "graph.folder_not_private(x.so, " + (real / "open").string() + ")");
  ::chmod((real / "open").c_str(), 01777);  // like /tmp: other users cannot replace it
  CHECK(place.printed("open/x.so") == "");
}

TEST_CASE("a file of another user is rejected") {
  if (::geteuid() != 0) {
    MESSAGE("only root can give a file away: not tried");
    return;
  }
  Place place;
  REQUIRE(::chown((place.folder.path / "other.so").c_str(), 4711, 4711) == 0);
  unsetenv("SUDO_UID");
  CHECK(place.printed("other.so") == "graph.file_owner_foreign(other.so, 4711, " +
                                         (fs::canonical(place.folder.path) / "other.so").string() + ")");
  setenv("SUDO_UID", "4711", 1);
  CHECK(place.printed("other.so") == "");
  unsetenv("SUDO_UID");
}

TEST_CASE("a mission checks before it opens a file, and reports the place of its use") {
  Place place;
  const std::string file =
      place.folder.write("m.yaml", "mission: m\ncomponents:\n  mine: {use: build/law.so}\n");
  ::chmod((place.folder.path / "build/law.so").c_str(), 0646);
  const std::string store = (place.folder.path / "store").string();
  setenv("FULMAR_STORE", store.c_str(), 1);
  setenv("FULMAR_PROBE", "/nowhere/fulmar-probe", 1);
  std::string printed;
  try {
    load_mission(file);
  } catch (const Error& fault) {
    printed = fault.what();
  }
  CHECK(printed.find("m.yaml:3: components.mine: graph.file_not_private(law.so, ") != std::string::npos);
  CHECK_FALSE(fs::exists(store));
  unsetenv("FULMAR_PROBE");
  unsetenv("FULMAR_STORE");
}

}  // namespace private_file_test
