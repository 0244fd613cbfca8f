// SPDX-License-Identifier: BSD-3-Clause
// Reads a figure from its drawing: axes by their numbers, curves by their coordinates.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tools/chart/test/reading_kit.hpp"

namespace plot_test {

using namespace fulmar::chart::test;

struct Point {
  double x = 0, y = 0;
};

struct ReadCurve {
  std::string name, style;  // its dashes and marks
  std::vector<std::vector<Point>> parts;
  std::vector<Point> points() const {
    std::vector<Point> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }
};
struct ReadBand {
  std::string name;
  double from = 0, to = 0;
};
struct ReadPanel {
  std::string y_words;
  std::vector<double> y_marks;
  std::vector<std::string> legend;
  std::vector<ReadCurve> curves;
  std::vector<ReadBand> bands;
  double x_per_mm = 0, y_per_mm = 0;
};
struct ReadFigure {
  double wide_mm = 0, high_mm = 0;
  std::string title, x_words;
  std::vector<double> x_marks;
  std::vector<std::string> phase_words;
  std::vector<ReadPanel> panels;
};

inline std::string attribute(const std::string& tag, const std::string& name) {
  const auto found = between(tag, " " + name + "=\"", "\"");
  return found.empty() ? "" : found[0];
}
inline double length(const std::string& tag, const std::string& name) {
  const std::string text = attribute(tag, name);
  REQUIRE(!text.empty());
  return std::stod(text);
}

struct ReadText {
  double x = 0, y = 0;
  std::string words;
};
inline std::vector<ReadText> texts(const std::string& svg, const std::string& kind) {
  std::vector<ReadText> all;
  for (const std::string& one : between(svg, "<text class=\"" + kind + "\"", "</text>"))
    all.push_back({length(one, "x"), length(one, "y"), one.substr(one.find('>') + 1)});
  return all;
}

inline ReadCurve read_curve(const std::string& tag, const AxisScale& x, const AxisScale& y) {
  return {between(tag, "<title>", "</title>").at(0), attribute(tag, "stroke-dasharray"),
          read_parts<Point>(attribute(tag, "d"), x, y)};
}

inline ReadFigure read_figure(const std::string& svg) {
  ReadFigure figure;
  const std::string head = between(svg, "<svg", ">").at(0);
  figure.wide_mm = length(head, "width");
  figure.high_mm = length(head, "height");
  CHECK(attribute(head, "width").ends_with("mm"));
  figure.title = between(svg, "<title>", "</title>").at(0);
  figure.x_words = texts(svg, "x-axis").at(0).words;
  std::vector<double> x_mm;
  for (const ReadText& t : texts(svg, "x")) {
    x_mm.push_back(t.x);
    figure.x_marks.push_back(std::stod(t.words));
  }
  for (const ReadText& t : texts(svg, "phase")) figure.phase_words.push_back(t.words);
  const AxisScale x = scale_of(x_mm, figure.x_marks);
  for (const std::string& one : between(svg, "<g class=\"panel\">", "</g>")) {
    ReadPanel panel;
    panel.y_words = texts(one, "y-axis").at(0).words;
    std::vector<double> y_mm;
    for (const ReadText& t : texts(one, "y")) {
      y_mm.push_back(t.y - 1);
      panel.y_marks.push_back(std::stod(t.words));
    }
    for (const ReadText& t : texts(one, "legend")) panel.legend.push_back(t.words);
    const AxisScale y = scale_of(y_mm, panel.y_marks);
    panel.x_per_mm = x.per_place;
    panel.y_per_mm = -y.per_place;
    for (const std::string& tag : between(one, "<path class=\"curve\"", "</path>"))
      panel.curves.push_back(read_curve(tag, x, y));
    for (const std::string& tag : between(one, "<rect class=\"phase\"", "</rect>"))
      panel.bands.push_back({between(tag, "<title>", "</title>").at(0), x.at(length(tag, "x")),
                             x.at(length(tag, "x") + length(tag, "width"))});
    figure.panels.push_back(panel);
  }
  return figure;
}

/// The first tag that is not closed where it should be, or an & that stands alone; "": it is well formed.
inline std::string ill_formed(const std::string& svg) {
  for (std::size_t at = 0; (at = svg.find('&', at)) != std::string::npos; ++at)
    if (svg.find(';', at) - at > 5) return "& at " + std::to_string(at);
  return unbalanced(svg);
}

}  // namespace plot_test
