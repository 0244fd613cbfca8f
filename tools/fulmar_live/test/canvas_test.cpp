// SPDX-License-Identifier: BSD-3-Clause
// The picture of a plot, and messages as text and tables.
#include "tools/fulmar_live/canvas.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/message_text.hpp"
#include "tools/fulmar_live/ports.hpp"
#include "tools/fulmar_live/table.hpp"

namespace canvas_test {

using namespace fulmar::core;
using json = nlohmann::ordered_json;

namespace {

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

}  // namespace

TEST_CASE("an axis has round numbers around all values") {
  CHECK(ticks(0, 1, 5) == std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1});
  CHECK(ticks(-3, 14, 4) == std::vector<double>{-5, 0, 5, 10, 15});
  CHECK(ticks(68.2, 71.9, 4) == std::vector<double>{68, 69, 70, 71, 72});
  CHECK(ticks(0, 100, 1) == std::vector<double>{0, 100});
}

TEST_CASE("a line from corner to corner is drawn from corner to corner, in at most 80 columns") {
  Series s{"nav.state.height_m", "m", {}};
  for (int i = 0; i <= 100; ++i) s.points.emplace_back(i * 0.1, i * 0.5);
  const auto picture = lines(draw_plot({s}, 10, 10, {80, 20, false}));
  REQUIRE(picture.size() == 19);  // legend, 16 rows, axis, times
  CHECK(picture[0] == "\u2501\u2501 nav.state.height_m  50 m");
  for (const std::string& line : picture) CHECK(width_of(line) <= 80);
  CHECK(picture[1].starts_with("50\u2524"));
  CHECK(picture[1].ends_with("\u2809"));  // the dots of the upper row: the value reaches 50 at the right
  CHECK(width_of(picture[1]) == 79);  // 2 digits, the axis, 76 characters, of which the last ends the line
  CHECK(picture[16].starts_with(" 0\u2524\u2860"));  // from the lowest dot on the left, upwards
  CHECK(picture[18].find("10") != std::string::npos);
}

TEST_CASE("what is not finite leaves a gap, a constant is a line, and no sample at all is a picture, too") {
  Series s{"a", "", {}};
  for (int i = 0; i <= 100; ++i) s.points.emplace_back(i * 0.1, i < 30 || i > 70 ? 2.0 : NAN);
  const auto picture = lines(draw_plot({s}, 10, 10, {80, 12, false}));
  std::size_t dots = 0;
  for (const std::string& line : picture)
    for (std::size_t at = line.find('\xE2'); at != std::string::npos; at = line.find('\xE2', at + 1))
      dots += line[at + 1] >= '\xA0' && line[at + 1] <= '\xA3';  // U+2800 to U+28FF
  for (const std::string& line : picture) CHECK(width_of(line) <= 80);
  CHECK(dots > 30);
  CHECK(dots < 60);  // of 76 columns, 60 % of which hold the line
  CHECK(lines(draw_plot({{"b", "m", {}}}, 0, 10, {80, 12, false})).at(0) ==
        "\u2501\u2501 b  remote.sample_absent");
}

TEST_CASE("several series are told apart by number without colours and by colour with them") {
  const std::vector<Series> two{{"a", "", {{0, 1}, {1, 2}}}, {"b", "", {{0, 2}, {1, 1}}}};
  CHECK(lines(draw_plot(two, 1, 1, {60, 12, false})).at(1) == "2 b  1");
  const std::string coloured = draw_plot(two, 1, 1, {60, 12, true});
  CHECK(coloured.find("\x1b[36m") != std::string::npos);
  CHECK(coloured.find("\x1b[33m") != std::string::npos);
}

TEST_CASE("a message is one line per field for people, and one cell per number in a table") {
  const test::Mixed value = test::mixed_value();
  const TypePtr type = test::mixed_type();
  const json message = shown_json(*type, test::bytes_of(value));
  CHECK(short_text(message["attitude_std_deg"]) == "{north: 28.6479, east: 57.2958, down: 114.592}");
  CHECK(message_lines(json{{"c", 1.23456789}, {"b", {1, 2}}, {"a", nullptr}}) ==
        "  c: 1.23457\n  b: [1, 2]\n  a: -\n");
  const std::vector<std::string> names = columns(*type, ""), row = cells(*type, message);
  REQUIRE(names.size() == row.size());
  const auto cell = [&](const std::string& name) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) return row[i];
    return std::string("there is no such column");
  };
  CHECK(cell("speed_mps") == "1.5");
  CHECK(cell("gains_ratio[2]") == "-2.0");
  CHECK(cell("attitude_std_deg.north").substr(0, 7) == "28.6478");
  CHECK(cell("samples_volt") == "\"[0.5,1.0]\"");
  CHECK(cell("mode") == "hold");
  CHECK(csv_cell("a \"b\", c") == "\"a \"\"b\"\", c\"");
  CHECK(part_of(message, "legs[1].position_m.east") == 7.0);
  CHECK(part_of(message, "legs[0].course_rad").get<double>() == doctest::Approx(28.6478897565));
  CHECK(part_of(message, "legs[2].course_rad").is_null());
}

}  // namespace canvas_test
