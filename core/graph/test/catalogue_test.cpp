// SPDX-License-Identifier: BSD-3-Clause
// The plugins that the host offers to a user.
#include "core/graph/catalogue.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

#include "core/error.hpp"

namespace catalogue_test {

using namespace fulmar::core;
namespace fs = std::filesystem;

TEST_CASE("only plugins are offered: a script that does not use the SDK is none") {
  const fs::path folder = fs::temp_directory_path() / ("fulmar-catalogue-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "law.so") << "x";
  std::ofstream(folder / "my_law.py") << "import math\nimport fulmar_plugin as f\n";
  std::ofstream(folder / "table.py") << "import json, sys\nprint(json.load(sys.stdin)['flights'])\n";
  PluginCatalogue catalogue({folder});
  CHECK(catalogue.names() == std::vector<std::string>{"law", "my_law.py"});
  CHECK_THROWS_WITH_AS(catalogue.open("/etc"), "graph.plugin_path_invalid(/etc, ' is a folder)", Error);
  CHECK_THROWS_WITH_AS(catalogue.open("/nowhere/law.so"), "graph.plugin_file_missing(/nowhere/law.so)",
                       Error);
  fs::remove_all(folder);
}

}  // namespace catalogue_test
