// SPDX-License-Identifier: BSD-3-Clause
// Reads a page as a reader does: axes by their marks, curves by where they are drawn.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "tools/chart/chart.hpp"

namespace fulmar::aero::test {

using namespace chart;

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

/// What stands between two texts, each time.
inline std::vector<std::string> between(const std::string& text, const std::string& from,
                                        const std::string& to) {
  std::vector<std::string> all;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
    at += from.size();
    const std::size_t end = text.find(to, at);
    if (end == std::string::npos) break;
    all.push_back(text.substr(at, end - at));
  }
  return all;
}

/// Pixels to values, by the first and the last mark of an axis.
struct AxisScale {
  double px0 = 0, value0 = 0, per_px = 0;
  double at(double px) const { return value0 + (px - px0) * per_px; }
};
inline AxisScale scale_of(const std::vector<double>& px, const std::vector<double>& values) {
  REQUIRE(px.size() >= 2);
  return {px[0], values[0], (values.back() - values[0]) / (px.back() - px[0])};
}

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
    if (m[3] == "x") x_px.push_back(std::stod(m[1])), chart.x_marks.push_back(std::stod(m[4]));
    if (m[3] == "y") y_px.push_back(std::stod(m[2]) - 4), chart.y_marks.push_back(std::stod(m[4]));
  }
  const AxisScale x = scale_of(x_px, chart.x_marks), y = scale_of(y_px, chart.y_marks);
  chart.x_per_px = std::abs(x.per_px), chart.y_per_px = std::abs(y.per_px);
  for (const std::string& one : between(svg, "<path ", "/>")) {  // long: no regular expression
    const std::string kind = between(one, "class=\"", "\"").at(0), d = between(one, " d=\"", "\"").at(0);
    if (!kind.starts_with("line ") && !kind.starts_with("mark ")) continue;
    ReadCurve curve{kind, {}};
    for (std::size_t at = 0; (at = d.find_first_of("ML", at)) != std::string::npos; ++at) {
      char* next = nullptr;
      const double px = std::strtod(d.c_str() + at + 1, &next), py = std::strtod(next, nullptr);
      if (d[at] == 'M') curve.parts.emplace_back();
      REQUIRE(!curve.parts.empty());
      curve.parts.back().push_back({x.at(px), y.at(py)});
    }
    chart.curves.push_back(curve);
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

/// The first tag that is not closed where it should be; "": all are.
inline std::string unbalanced(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos; ++at) {
    if (page.compare(at, 2, "<!") == 0) continue;
    const bool closes = page.compare(at, 2, "</") == 0;
    const std::size_t begin = at + (closes ? 2 : 1), end = page.find('>', at);
    const std::string name = page.substr(begin, page.find_first_of(" />", begin) - begin);
    if (name == "meta" || page[end - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
      continue;
    }
    if (open.empty() || open.back() != name) return "</" + name + "> at " + std::to_string(at);
    open.pop_back();
  }
  return open.empty() ? "" : "<" + open.back() + ">";
}

/// What every page of ours keeps.
inline void check_page(const std::string& page) {
  CHECK(page.size() < 2'000'000);
  CHECK(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
  CHECK(page.ends_with("</html>\n"));
  CHECK(unbalanced(page) == "");
  CHECK(page.find("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';") !=
        std::string::npos);
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
