// SPDX-License-Identifier: BSD-3-Clause
// JSON of messages for users.
#include <doctest/doctest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

namespace json_test {

using namespace fulmar::core;
using namespace fulmar::core::test;
using nlohmann::json;

TEST_CASE("a message has its fields by name, enums by label, lists by their items") {
  const Mixed m = mixed_value();
  CHECK(to_json(*mixed_type(), bytes_of(m), false) == json::parse(R"({
    "armed": true, "speed_mps": 1.5, "count": 7, "gains_ratio": [1.0, 2.0, -2.0], "name": "ab", "samples_volt": [0.5, 1.0], "mode": "hold",
    "stamp_ns": -2, "load_ratio": 0.25, "offset": -3, "attitude_std_rad": {"north": 0.5, "east": 1.0, "down": 2.0}, "tags": ["x", "yzw"],
    "legs": [{"kind": "orbit", "has_course": true, "course_rad": 0.5, "position_m": {"north": 3.0, "east": 4.0, "down": 5.0}},
             {"kind": "line", "has_course": false, "course_rad": -0.5, "position_m": {"north": 6.0, "east": 7.0, "down": 8.0}}]})"));
}

TEST_CASE("radians become degrees with their key, inside nested structs too, and metres stay metres") {
  const Mixed m = mixed_value();
  const json shown = to_json(*mixed_type(), bytes_of(m), true);
  CHECK_FALSE(shown.contains("attitude_std_rad"));
  CHECK(shown["attitude_std_deg"]["east"].get<double>() == doctest::Approx(57.29577951308232).epsilon(1e-15));
  CHECK(shown["legs"][1]["course_deg"].get<double>() == doctest::Approx(-28.64788975654116).epsilon(1e-15));
  CHECK(shown["legs"][1]["position_m"]["down"] == 8.0);
  CHECK(shown["speed_mps"] == 1.5);
}

TEST_CASE("shown JSON has the message's order, and rates in degrees as well as angles") {
  struct Value {
    double z_m = 1;
    std::array<double, 2> rates_radps{0.5, -1};
    double bank_rad = 2, a_radps2 = 3, load_ratio = 4;
  } const value;
  const TypePtr type =
      make_type("Turns", sizeof value, 8,
                {scalar("z_m", FULMAR_F64, 0, 8), array(scalar("rates_radps", FULMAR_F64, 8, 8), 2),
                 scalar("bank_rad", FULMAR_F64, 24, 8), scalar("a_radps2", FULMAR_F64, 32, 8),
                 scalar("load_ratio", FULMAR_F64, 40, 8)});
  const nlohmann::ordered_json shown = shown_json(*type, bytes_of(value));
  CHECK(shown_name("p_radps") == "p_degps");
  CHECK(shown_name("p_degps") == "p_degps");
  std::vector<std::string> keys;
  for (const auto& item : shown.items()) keys.push_back(item.key());
  CHECK(keys == std::vector<std::string>{"z_m", "rates_degps", "bank_deg", "a_degps2", "load_ratio"});
  CHECK(shown["rates_degps"][0].get<double>() == doctest::Approx(28.64788975654116).epsilon(1e-15));
  CHECK(shown["bank_deg"].get<double>() == doctest::Approx(114.59155902616465).epsilon(1e-15));
  CHECK(shown["a_degps2"].get<double>() == doctest::Approx(171.88733853924697).epsilon(1e-15));
  CHECK(shown["load_ratio"] == 4.0);
  CHECK(to_json(*type, bytes_of(value), true).contains("a_radps2"));  // results keep rates in radians
}

TEST_CASE(
    "a number that is not finite is null, a label that does not exist a number, broken text stays JSON") {
  Mixed m = mixed_value();
  m.speed_mps = std::numeric_limits<double>::quiet_NaN();
  m.load_ratio = -std::numeric_limits<float>::infinity();
  m.mode = 9;
  m.name = {'a', static_cast<char>(0xFF), 'b'};
  const json shown = to_json(*mixed_type(), bytes_of(m), true);
  CHECK(shown["speed_mps"].is_null());
  CHECK(shown["load_ratio"].is_null());
  CHECK(shown["mode"] == 9);
  CHECK(shown["name"] ==
        "a\xEF\xBF\xBD"
        "b");
  CHECK_NOTHROW(shown.dump());
}

TEST_CASE("JSON of 32 levels is not too deep for a parser, and brackets inside a text are no level") {
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  CHECK_FALSE(json_too_deep(nested(32)));
  CHECK(json_too_deep(nested(33)));
  CHECK_FALSE(json_too_deep("[\"\\\"" + nested(33) + "\"]"));
}

}  // namespace json_test
