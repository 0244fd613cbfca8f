// SPDX-License-Identifier: BSD-3-Clause
// Reads a page as a reader does: axes by their marks, curves by where they are drawn.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "tools/chart/chart.hpp"
#include "tools/chart/test/reading_kit.hpp"

namespace fulmar::aero::test {

using namespace chart;
using namespace chart::test;

struct ReadCurve {
  std::string kind;  // "line s0"
  std::vector<std::vector<ChartPoint>> parts;
  std::vector<ChartPoint> points() const {
    std::vector<ChartPoint> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }
};
struct ReadChart {
  std::string title, x_words, y_words;
  std::vector<double> x_marks, y_marks;
  std::vector<ReadCurve> curves;
  std::vector<std::string> legend;
  double x_per_px = 0, y_per_px = 0;

  /// The curves of a kind, in their order.
  std::vector<ReadCurve> all(const std::string& kind) const {
    std::vector<ReadCurve> found;
    for (const ReadCurve& c : curves)
      if (c.kind == kind) found.push_back(c);
    return found;
  }
};

inline ReadChart read_chart(const std::string& figure) {
  ReadChart chart;
  chart.title = between(figure, "<figcaption>", "</figcaption>").at(0);
  if (figure.find("<svg viewBox") == std::string::npos) return chart;
  const std::string svg = between(figure, "<svg viewBox", "</svg>").at(0);
  std::vector<double> x_px, y_px;
  static const std::regex text("x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" class=\"([a-z]+)\"[^>]*>([^<]*)");
  for (const std::string& one : between(svg, "<text ", "</text>")) {
    std::smatch m;
    REQUIRE(std::regex_search(one, m, text));
    if (m[3] == "xaxis") chart.x_words = m[4];
    if (m[3] == "yaxis") chart.y_words = m[4];
    if (m[3] == "x") {
      x_px.push_back(std::stod(m[1]));
      chart.x_marks.push_back(std::stod(m[4]));
    }
    if (m[3] == "y") {
      y_px.push_back(std::stod(m[2]) - 4);
      chart.y_marks.push_back(std::stod(m[4]));
    }
  }
  const AxisScale x = scale_of(x_px, chart.x_marks), y = scale_of(y_px, chart.y_marks);
  chart.x_per_px = std::abs(x.per_place);
  chart.y_per_px = std::abs(y.per_place);
  for (const std::string& one : between(svg, "<path ", "/>")) {  // long: no regular expression
    const std::string kind = between(one, "class=\"", "\"").at(0), d = between(one, " d=\"", "\"").at(0);
    if (!kind.starts_with("line ") && !kind.starts_with("mark ")) continue;
    chart.curves.push_back({kind, read_parts<ChartPoint>(d, x, y)});
  }
  for (const std::string& item : between(figure, "<li>", "</li>"))
    chart.legend.push_back(item.substr(item.find("</svg>") + 6));
  return chart;
}

inline std::vector<ReadChart> read_charts(const std::string& page) {
  std::vector<ReadChart> charts;
  for (const std::string& figure : between(page, "<figure>", "</figure>"))
    charts.push_back(read_chart(figure));
  return charts;
}

/// The chart of that title, or the first whose title has these words.
inline ReadChart chart_named(const std::vector<ReadChart>& charts, const std::string& words) {
  for (const ReadChart& chart : charts)
    if (chart.title == words) return chart;
  for (const ReadChart& chart : charts)
    if (chart.title.find(words) != std::string::npos) return chart;
  FAIL("no chart '" << words << "'");
  return {};
}

/// The value of a curve at x, between its points.
inline double value_at(const std::vector<ChartPoint>& points, double x) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ChartPoint &a = points[i - 1], &b = points[i];
    if (a.x <= x && x <= b.x && b.x > a.x) return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
  }
  return std::nan("");
}

inline const std::string policy_start =
    "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';";

/// What every page of ours keeps.
inline void check_page(const std::string& page) {
  CHECK(page.size() < 2'000'000);
  CHECK(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
  CHECK(page.ends_with("</html>\n"));
  CHECK(unbalanced(page) == "");
  CHECK(page.find(policy_start) != std::string::npos);
  CHECK(page.find("prefers-color-scheme:dark") != std::string::npos);
  CHECK(page.find("@media print") != std::string::npos);
  // nothing is loaded, nothing runs
  for (const char* word : {"http:", "https:", "//", "<script", "<link", "<img", "url(", "@import",
                           " src=", " href=", "nan", "inf\""})
    CHECK_MESSAGE(page.find(word) == std::string::npos, word);
  const std::vector<ReadChart> charts = read_charts(page);
  CHECK(charts.size() >= 7);
  for (const ReadChart& chart : charts) {
    INFO(chart.title);
    if (chart.curves.empty()) continue;
    CHECK(std::regex_match(chart.x_words, std::regex(".+ \\[[^\\]]+\\]")));
    CHECK(std::regex_match(chart.y_words, std::regex(".+ \\[[^\\]]+\\]")));
    CHECK(chart.x_marks.size() >= 3);
    CHECK(chart.y_marks.size() >= 3);
  }
}

}  // namespace fulmar::aero::test
