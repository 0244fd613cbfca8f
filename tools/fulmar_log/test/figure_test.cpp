// SPDX-License-Identifier: BSD-3-Clause
// Figures for print: line styles, axes, and names with little room.
#include "tools/chart/figure.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <utility>

#include "tools/fulmar_log/test/figure_kit.hpp"

namespace plot_test {

using namespace fulmar;

/// Its corners from the first one on, in tenths of a millimetre, and where there are arcs.
std::string shape_of(const std::string& d) {
  std::string shape;
  double x0 = 0, y0 = 0;
  for (std::size_t at = 0; (at = d.find_first_of("MLa", at)) != std::string::npos; ++at) {
    char* next = nullptr;
    const double x = std::strtod(d.c_str() + at + 1, &next), y = std::strtod(next, nullptr);
    if (at == 0) {
      x0 = x;
      y0 = y;
    }
    shape += d[at] == 'a' ? "a"
                          : std::to_string(std::lround(10 * (x - x0))) + "," +
                                std::to_string(std::lround(10 * (y - y0))) + " ";
  }
  return shape;
}

TEST_CASE("curves can be told apart without colours; equal logs give equal figures") {
  chart::Figure figure;
  figure.high_mm = 200;
  figure.x = "time [s]";
  figure.panels.resize(1);
  for (std::size_t i = 0; i < chart::max_curves; ++i)
    figure.panels[0].curves.push_back(
        {"c" + std::to_string(i), {{0, double(i)}, {10, double(i) + 1}}, false});
  const std::string svg = chart::figure_svg(figure);
  CHECK(ill_formed(svg) == "");
  std::set<std::string> looks;
  for (const std::string& tag : between(svg, "<path class=\"sample\"", "<text")) {
    const auto mark = between(tag, "<path class=\"mark\"", "/>");
    looks.insert(attribute(tag, "stroke-dasharray") + " " +
                 (mark.empty() ? "" : shape_of(attribute(mark[0], "d"))));
  }
  CHECK(looks.size() == chart::max_curves);
  CHECK(svg == chart::figure_svg(figure));
}

TEST_CASE("an axis has two numbers at least, whatever the range and however little room there is") {
  const std::vector<std::pair<double, double>> ranges{{0, 0},        {7, 7},       {-400, 400},
                                                      {-0.9, 0.9},   {4.9, 25.1},  {1e-9, 2e-9},
                                                      {99.9, 100.1}, {1e6, 1.4e6}, {-3, 1e4}};
  for (const auto& range : ranges)
    for (const double high_mm : {32.0, 38.0, 60.0, 90.0}) {
      const double low = range.first, high = range.second;
      CAPTURE(low);
      CAPTURE(high);
      CAPTURE(high_mm);
      chart::Figure figure;
      figure.wide_mm = 50;
      figure.high_mm = high_mm;
      figure.x = "time [s]";
      figure.panels.push_back({"y", {{"c", {{low, low}, {high, high}}, false}}});
      CHECK(chart::too_small(figure) == "");
      const ReadFigure f = read_figure(chart::figure_svg(figure));
      CHECK(f.x_marks.size() >= 2);
      CHECK(f.panels[0].y_marks.size() >= 2);
      CHECK(f.panels[0].y_marks.size() <= 9);
      for (const Point& p : f.panels[0].curves[0].points())
        CHECK((std::abs(p.y - low) < 0.01 * f.panels[0].y_per_mm ||
               std::abs(p.y - high) < 0.01 * f.panels[0].y_per_mm));
      if (low == 0 && high == 0) CHECK(f.panels[0].y_marks.back() > 0.1);
    }
}

TEST_CASE("a name that is longer than its room is written in smaller letters") {
  chart::Figure figure;
  figure.wide_mm = 80;
  figure.x = "time [s]";
  figure.panels.push_back(
      {"y", {{"short", {{0, 0}, {1, 1}}, false}, {std::string(100, 'n'), {{0, 0}}, false}}});
  const std::vector<std::string> texts =
      between(chart::figure_svg(figure), "<text class=\"legend\"", "</text>");
  REQUIRE(texts.size() == 2);
  CHECK(attribute(texts[0], "font-size") == "");
  const double size = length(texts[1], "font-size");
  CHECK(size < 2.8);
  CHECK(length(texts[1], "x") + 100 * 0.52 * size < 80);
}

TEST_CASE("the name of a short phase stands upright, in smaller letters, and not where none can be read") {
  chart::Figure figure;
  figure.x = "time [s]";
  figure.panels.push_back({"y", {{"c", {{0, 0}, {1000, 1}}, false}}});
  figure.bands = {{"cruise", 0, 900}, {"flare", 900, 914}, {"touch", 914, 917}, {"roll", 917, 1000}};
  const std::string svg = chart::figure_svg(figure);
  std::vector<std::string> names;
  for (const ReadText& t : texts(svg, "phase")) names.push_back(t.words);
  CHECK(names == std::vector<std::string>{"cruise", "flare", "roll"});
  const std::string flare = between(svg, "<text class=\"phase\"", "</text>").at(1);
  CHECK(attribute(flare, "transform").starts_with("rotate(-90 "));
  const ReadPanel panel = read_figure(svg).panels[0];
  CHECK(length(flare, "font-size") == doctest::Approx(14 / panel.x_per_mm).epsilon(0.01));
  CHECK(panel.bands.size() == 4);
  CHECK(panel.bands[2].name == "touch");
}

TEST_CASE("names of phases are above the first panel and below its legend, upright ones as well") {
  chart::Figure figure;
  figure.x = "time [s]";
  figure.panels.push_back({"y", {{"c", {{0, 0}, {1000, 1}}, false}}});
  figure.bands = {{"cruise", 0, 900}, {"takeoff", 900, 920}, {std::string(40, 'n'), 920, 1000}};
  const std::string svg = chart::figure_svg(figure);
  const double top = length(between(svg, "<rect class=\"frame\"", "/>").at(0), "y");
  const double legend = texts(svg, "legend").at(0).y;
  const auto names = between(svg, "<text class=\"phase\"", "</text>");
  REQUIRE(names.size() == 3);
  for (const std::string& name : names) {
    const bool upright = attribute(name, "transform") != "";
    const std::string size = attribute(name, "font-size");
    const double letter = size.empty() ? 2.8 : std::stod(size);
    const double letters = static_cast<double>(name.size() - name.find('>') - 1);
    CHECK(length(name, "y") < top);
    CHECK(length(name, "y") - (upright ? 0.52 * letter * letters : letter) > legend);
    CHECK(attribute(name, "text-anchor") == (upright ? "start" : "middle"));
  }
  CHECK(attribute(names[0], "transform") == "");
  CHECK(attribute(names[1], "transform") != "");
  CHECK(legend > 2.8);
}

TEST_CASE("noisy curves of a panel have marks in place of dashes, and smooth ones keep their dashes") {
  chart::Figure figure;
  figure.x = "time [s]";
  figure.panels.resize(1);
  const auto add = [&](const char* name, double noise) {
    figure.panels[0].curves.push_back({name, {}, false});
    for (int i = 0; i <= 4000; ++i)
      figure.panels[0].curves.back().points.push_back(
          {0.1 * i, std::sin(0.02 * i) + noise * std::sin(1.7 * i)});
  };
  add("a", 0);
  add("b", 0);
  add("c", 0.3);
  add("d", 0.3);
  add("e", 0.001);
  const std::string svg = chart::figure_svg(figure);
  const ReadFigure f = read_figure(svg);
  std::vector<bool> dashed;
  for (const ReadCurve& c : f.panels[0].curves) dashed.push_back(!c.style.empty());
  CHECK(dashed == std::vector<bool>{false, true, false, false, true});
  CHECK(between(svg, "<path class=\"mark\"", "/>").size() == 4);  // two curves, and their samples
  std::set<std::string> samples;
  for (const std::string& tag : between(svg, "<path class=\"sample\"", "<text")) {
    const auto mark = between(tag, "<path class=\"mark\"", "/>");
    samples.insert(attribute(tag, "stroke-dasharray") +
                   (mark.empty() ? "" : shape_of(attribute(mark[0], "d"))));
  }
  CHECK(samples.size() == 5);
  figure.track = true;
  CHECK(between(chart::figure_svg(figure), "<path class=\"mark\"", "/>").empty());
}

TEST_CASE("a track with one scale on both axes fills the figure that is fitted to it") {
  // No structured binding: clang before 16 does not capture one.
  for (const auto& corner : {std::pair{400.0, 800.0}, {800.0, 200.0}, {300.0, 300.0}, {5000.0, 10.0}}) {
    const double east = corner.first, north = corner.second;
    CAPTURE(east);
    CAPTURE(north);
    chart::Figure figure;
    figure.x = "east [m]";
    figure.track = figure.even = true;
    figure.panels.push_back({"north [m]", {{"flown", {{0, 0}, {east, north}}, false}}});
    chart::fit_even(figure);
    CHECK(chart::too_small(figure) == "");
    const std::string svg = chart::figure_svg(figure);
    const ReadPanel panel = read_figure(svg).panels[0];
    CHECK(panel.x_per_mm == doctest::Approx(panel.y_per_mm).epsilon(0.01));
    const std::string frame = between(svg, "<rect class=\"frame\"", "/>").at(0);
    const double wide = length(frame, "width") * panel.x_per_mm,
                 high = length(frame, "height") * panel.y_per_mm;
    CHECK(std::max(east / wide, north / high) > 0.85);
    if (std::max(east, north) < 2.5 * std::min(east, north))
      CHECK(std::min(east / wide, north / high) > 0.85);
    CHECK(std::max(length(frame, "width"), length(frame, "height")) < 135);
  }
}

}  // namespace plot_test
