// SPDX-License-Identifier: BSD-3-Clause
// Charts: where points come to lie, and what becomes of values that are not there.
#include <random>

#include "tools/fulmar_aero/see/page.hpp"
#include "tools/fulmar_aero/see/test/page_kit.hpp"

namespace fulmar::aero::test {
namespace {

Chart with_line(const std::vector<ChartPoint>& points) {
  return {.title = "a",
          .x = {"x", "m"},
          .y = {"y", "s"},
          .lines = {{.name = "one", .points = points}},
          .keys = {}};
}

const double nowhere = std::nan("");

TEST_CASE("a point is drawn where the marks of the axes say") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-4, 5), part(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const double size = std::pow(10, exponent(random)), about = size * 3 * part(random);
    std::vector<ChartPoint> points;
    for (int k = 0; k < 5; ++k)
      points.push_back({about + size * part(random), -about + 0.1 * size * part(random)});
    const ReadChart chart = read_chart(chart_html(with_line(points)));
    CHECK(chart.x_words == "x [m]");
    CHECK(chart.y_words == "y [s]");
    for (const std::vector<double>& marks : {chart.x_marks, chart.y_marks}) {
      CHECK(marks.size() >= 3);
      CHECK(marks.size() <= 9);
      // round numbers, evenly
      const double step = marks[1] - marks[0];
      const double lead = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-6))));
      CHECK((std::abs(lead - 1) < 1e-3 || std::abs(lead - 2) < 1e-3 || std::abs(lead - 5) < 1e-3));
      for (std::size_t k = 1; k < marks.size(); ++k)
        CHECK(std::abs(marks[k] - marks[k - 1] - step) < 1e-3 * step);
    }
    const std::vector<ReadCurve> lines = chart.all("line s0");
    REQUIRE(lines.size() == 1);
    const std::vector<ChartPoint> read = lines[0].points();
    REQUIRE(read.size() == points.size());
    for (std::size_t k = 0; k < read.size(); ++k) {
      CHECK(std::abs(read[k].x - points[k].x) < 0.3 * chart.x_per_px);
      CHECK(std::abs(read[k].y - points[k].y) < 0.3 * chart.y_per_px);
    }
  }
}

TEST_CASE("what is not finite parts a line and is not drawn") {
  const double infinite = INFINITY;
  const ReadChart chart =
      read_chart(chart_html(with_line({{0, 1}, {1, 2}, {2, nowhere}, {infinite, 3}, {4, 5}, {5, 4}})));
  const std::vector<ReadCurve> lines = chart.all("line s0");
  REQUIRE(lines.size() == 1);
  REQUIRE(lines[0].parts.size() == 2);
  CHECK(lines[0].parts[0].size() == 2);
  CHECK(lines[0].parts[1].size() == 2);
  const std::string empty = chart_html(with_line({{0, nowhere}, {nowhere, 1}}));
  CHECK(empty.find("<p>no values</p>") != std::string::npos);
  CHECK(empty.find("<svg viewBox") == std::string::npos);
}

TEST_CASE("one value, and the same twice, have axes too") {
  for (const ChartPoint p : {ChartPoint{0, 0}, ChartPoint{3, -7e5}, ChartPoint{1e-9, 1e12}}) {
    const ReadChart chart = read_chart(chart_html(with_line({p, p})));
    CHECK(chart.x_marks.size() >= 2);
    CHECK(chart.y_marks.size() >= 2);
  }
}

TEST_CASE("a closed line ends where it began, part by part; an even chart has one scale") {
  Chart square = with_line({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {nowhere, 0}, {2, 0}, {3, 0}, {3, 1}});
  square.lines[0].closed = true;
  square.even = true;
  const std::string html = chart_html(square);
  const std::string d = between(html, "class=\"line s0\" d=\"", "\"").at(0);
  CHECK(std::count(d.begin(), d.end(), 'Z') == 2);
  const ReadChart chart = read_chart(html);
  CHECK(std::abs(chart.x_per_px / chart.y_per_px - 1) < 0.01);
}

TEST_CASE("six sets differ by colour and by dashes, in light and in dark") {
  const std::string page = page_html("a", "");
  const std::string light = between(page, ":root{", "}").at(0),
                    dark = between(page, "dark){:root{", "}").at(0);
  std::vector<std::string> seen;
  for (int i = 0; i < styles; ++i) {
    const std::string name = std::to_string(i);
    for (const std::string* theme : {&light, &dark}) {
      const std::string colour = between(*theme + ";", "--c" + name + ":", ";").at(0);
      CHECK(colour.size() == 7);
      CHECK(std::count(seen.begin(), seen.end(), colour) == 0);
      seen.push_back(colour);
    }
    const auto dashes = between(page, ".line.s" + name + "{stroke-dasharray:", "}");
    CHECK(dashes.size() == (i == 0 ? 0 : 1));
    if (dashes.empty()) continue;
    CHECK(std::count(seen.begin(), seen.end(), dashes[0]) == 0);
    seen.push_back(dashes[0]);
  }
}

TEST_CASE("text is text") {
  const std::string evil = "</style></title><script>alert('\"&\x01')</script>";
  const std::string escaped =
      "&lt;/style&gt;&lt;/title&gt;&lt;script&gt;alert(&#39;&quot;&amp; &#39;)&lt;/script&gt;";
  CHECK(in_html(evil) == escaped);
  Chart chart = with_line({{0, 0}, {1, 1}});
  chart.title = chart.x.words = chart.y.unit = chart.lines[0].name = chart.empty = evil;
  chart.keys.push_back({.name = evil, .points = {}});
  const std::string page =
      page_html(evil, chart_html(chart) + table_html({{evil, evil}, {evil, evil}}) + sentence_html(evil));
  CHECK(page.find("<script") == std::string::npos);
  CHECK(page.find("alert('") == std::string::npos);
  CHECK(unbalanced(page) == "");
}

}  // namespace
}  // namespace fulmar::aero::test
