// SPDX-License-Identifier: BSD-3-Clause
// Files of the installation, named from anywhere.
#include "core/graph/shipped.hpp"

#include <doctest/doctest.h>

#include <filesystem>

#include "core/graph/test/shelf.hpp"

namespace shipped_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

TEST_CASE("a name is one of the folder, or of the installation wherever one stands") {
  CHECK(named_file("some/where", "../a.yaml") == "some/a.yaml");
  CHECK(named_file("some/where", "/a.yaml") == "/a.yaml");
  const fs::path common = named_file("some/where", "fulmar:missions/common.yaml");
  CHECK(fs::is_regular_file(common));
  CHECK(common.filename() == "common.yaml");
  CHECK(shipped_name(common) == "fulmar:missions/common.yaml");
  CHECK(shipped_name(common.parent_path() / ".." / "missions" / "common.yaml") ==
        "fulmar:missions/common.yaml");
  CHECK(shipped_name("/bin/sh") == "");
  CHECK(shipped_name("not/there.yaml") == "");
}

TEST_CASE("a mission names shipped files, and what is not there is told with what is") {
  Mission mission;
  mission.folder.write("anaconda.yaml", "{}");  // not the one that is named
  mission.text = "extends: fulmar:missions/comon.yaml\n";
  const std::string said = mission.faults();
  CHECK(said.find("hourglass.yaml:1: extends: there is no file fulmar:missions/comon.yaml. Did you mean "
                  "'fulmar:missions/common.yaml'? Valid: fulmar:airframes/aerosonde.yaml, ") == 0);
}

TEST_CASE("a shipped mission is loaded by its name") {
  CHECK_THROWS_WITH_AS(load_mission("fulmar:missions/hour.yaml"),
                       doctest::Contains("there is no file fulmar:missions/hour.yaml. Did you mean"), Error);
}

}  // namespace shipped_test
