// SPDX-License-Identifier: BSD-3-Clause
// One flight of each row of one aircraft through the host, within the bars of bench_autotune.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

namespace {
int exit_of(const std::string& arguments) {
  const int status =
      std::system((std::string(FULMAR_BIN_DIR "/bench_autotune ") + arguments + " >/dev/null 2>&1").c_str());
  return status / 256;
}
}  // namespace

TEST_CASE("from 0.3 to 3 times its gains the X8 measures its margins or goes back, and the model agrees" *
          doctest::test_suite("amounts")) {
  CHECK(exit_of("--seeds 1 x8") == 0);
}
TEST_CASE("what it does not know it refuses") {
  CHECK(exit_of("--seeds 0") == 2);
  CHECK(exit_of("x9") == 2);
  CHECK(exit_of("--first 0") == 2);
  CHECK(exit_of("--factor 0") == 2);
  CHECK(exit_of("--wind strong") == 2);
}
