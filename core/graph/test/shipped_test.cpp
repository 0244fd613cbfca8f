// SPDX-License-Identifier: BSD-3-Clause
// Files of the installation, named from any folder.
#include "core/graph/shipped.hpp"

#include <doctest/doctest.h>

#include <filesystem>

#include "core/graph/test/shelf.hpp"

namespace shipped_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
namespace fs = std::filesystem;

TEST_CASE("a name means a file of the folder, or of the installation from any folder") {
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

TEST_CASE("a mission names shipped files, and a missing one is reported with the existing ones") {
  Mission mission;
  mission.folder.write("anaconda.yaml", "{}");  // similar, but not the named file
  mission.text = "extends: fulmar:missions/comon.yaml\n";
  const std::string printed = mission.faults();
  CHECK(printed.find(
            "hourglass.yaml:1: graph.extends_file_invalid(graph.file_missing(fulmar:missions/comon.yaml, "
            ". Did you mean 'fulmar:missions/common.yaml'?))") == 0);
  CHECK(printed.find("aerosonde") == std::string::npos);
}

TEST_CASE("a shipped mission is loaded by its name") {
  CHECK_THROWS_WITH_AS(load_mission("fulmar:missions/hour.yaml"),
                       "graph.file_missing(fulmar:missions/hour.yaml, . Did you mean "
                       "'fulmar:missions/hourglass.yaml' or 'fulmar:plans/hourglass.yaml'?)",
                       Error);
  CHECK_THROWS_WITH_AS(load_mission("hourglas"),
                       "graph.file_missing(hourglas, . Did you mean 'fulmar:missions/hourglass.yaml' or "
                       "'fulmar:plans/hourglass.yaml'?)",
                       Error);
  CHECK_THROWS_WITH_AS(load_mission("nothing-like-it"), "graph.file_missing(nothing-like-it, )", Error);
}

TEST_CASE("a file of another folder is suggested under its name from this folder") {
  Mission mission;
  mission.folder.write("common.yaml", "rate: 400 Hz\n");
  mission.text = "extends: comon.yaml\n";
  CHECK(mission.faults() ==
        "hourglass.yaml:1: graph.extends_file_invalid(graph.file_missing(comon.yaml, . Did you mean "
        "'common.yaml'?))");
  Mission elsewhere;
  elsewhere.replace("airframe: anaconda.yaml", "airframe: craft/anaconda.yaml");
  CHECK(elsewhere.faults().find("airframe: graph.file_missing(craft/anaconda.yaml, . Did you mean "
                                "'fulmar:airframes/anaconda.yaml'?)") != std::string::npos);
}

}  // namespace shipped_test
