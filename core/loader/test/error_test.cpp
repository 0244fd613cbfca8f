// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"

#include <doctest/doctest.h>

namespace error_test {

using namespace fulmar::core;

TEST_CASE("the nearest name is found despite a typing error") {
  const std::vector<std::string> names{"airspeed_mps", "height_m", "course_rad", "roll_kp", "tecs"};
  CHECK(nearest("heigth_m", names) == "height_m");
  CHECK(nearest("Height_M", names) == "height_m");
  CHECK(nearest("airspeed", names) == "");  // four of eight letters are missing
  CHECK(nearest("airspeedmps", names) == "airspeed_mps");
  CHECK(nearest("coarse_rad", names) == "course_rad");
  CHECK(nearest("tec", names) == "tecs");
}

TEST_CASE("a name with few common letters is not near") {
  CHECK(nearest("banana", {"height_m", "roll_kp"}) == "");
  CHECK(nearest("", {"a"}) == "");
  CHECK(nearest("a", {"b"}) == "");
  CHECK(nearest("abc", {}) == "");
}

TEST_CASE("two neighbouring letters swapped are one edit") {
  CHECK(nearest("ekf2", {"efk2", "kkk2"}) == "efk2");
}

TEST_CASE("choices form a sentence") {
  CHECK(join({}) == "none");
  CHECK(join({"a"}) == "a");
  CHECK(join({"a", "b", "c"}) == "a, b, c");
  const std::vector<std::string> fields = {"height_m", "course_rad"};
  CHECK(choices_text("heigh_m", fields) == " [height_m] " + join(fields));
  CHECK(choices_text("zzzzzz", fields) == " [] height_m, course_rad");
  CHECK(choices_text("x", {}) == " [] none");
}

}  // namespace error_test
