// SPDX-License-Identifier: BSD-3-Clause
#include "tools/chart/chart.hpp"

#include <algorithm>
#include <cmath>

#include "tools/chart/numbers.hpp"

namespace fulmar::chart {
namespace {

/// Size of the picture in its own units.
constexpr double picture_wide = 460, picture_high = 300, left = 62, top = 12, inner_wide = 386,
                 inner_high = 234;

std::string tenth(double x) { return fixed(x, 1); }

std::string words_at(double x, double y, const std::string& text, const std::string& more) {
  return "<text x=\"" + tenth(x) + "\" y=\"" + tenth(y) + "\" " + more + ">" + in_html(text) + "</text>\n";
}

std::string class_of(int style) { return style < 0 ? "plain" : "s" + std::to_string(style % styles); }

class ChartDrawing {
 public:
  explicit ChartDrawing(const Chart& chart) : chart_(chart) {
    for (const ChartLine& line : chart.lines)
      for (const ChartPoint& p : line.points)
        if (is_there(p)) {
          x_.take(p.x);
          y_.take(p.y);
        }
    if (empty()) return;
    if (chart.with_zero) y_.take(0);
    if (chart.unstable) x_.take(0);
    x_.widen();
    y_.widen();
    if (!chart.even) return;
    const double scale = std::max(x_.span() / inner_wide, y_.span() / inner_high);
    x_.grow_to(scale * inner_wide);
    y_.grow_to(scale * inner_high);
  }

  bool empty() const { return x_.empty(); }

  std::string svg() const {
    std::string out = "<svg viewBox=\"0 0 " + fixed(picture_wide, 0) + " " + fixed(picture_high, 0) +
                      "\" role=\"img\" aria-label=\"" + in_html(chart_.title) + "\">\n" + grid();
    for (const bool thin : {true, false})
      for (const ChartLine& line : chart_.lines)
        if (line.thin == thin) out += curve(line);
    return out + "</svg>\n";
  }

 private:
  double px(double x) const { return left + (x - x_.min) / x_.span() * inner_wide; }
  double py(double y) const { return top + inner_high - (y - y_.min) / y_.span() * inner_high; }

  std::string grid() const {
    const double bottom = top + inner_high, end = left + inner_wide;
    std::string lines, zero, out;
    const auto line = [](double x1, double y1, double x2, double y2) {
      return "M" + tenth(x1) + " " + tenth(y1) + "L" + tenth(x2) + " " + tenth(y2);
    };
    if (chart_.unstable)
      out += "<rect class=\"unstable\" x=\"" + tenth(px(0)) + "\" y=\"" + tenth(top) + "\" width=\"" +
             tenth(end - px(0)) + "\" height=\"" + tenth(inner_high) + "\"/>\n";
    const double dx = step_of(x_.span()), dy = step_of(y_.span());
    for (double i = std::ceil(x_.min / dx); i * dx <= x_.max; ++i) {
      (i == 0 ? zero : lines) += line(px(i * dx), top, px(i * dx), bottom);
      out += words_at(px(i * dx), bottom + 15, value_text(i * dx, dx), "class=\"x\"");
    }
    for (double i = std::ceil(y_.min / dy); i * dy <= y_.max; ++i) {
      (i == 0 ? zero : lines) += line(left, py(i * dy), end, py(i * dy));
      out += words_at(left - 6, py(i * dy) + 4, value_text(i * dy, dy), "class=\"y\"");
    }
    out += "<path class=\"grid\" d=\"" + lines + "\"/>\n";
    if (!zero.empty()) out += "<path class=\"zero\" d=\"" + zero + "\"/>\n";
    const double middle = top + inner_high / 2;
    return out + "<path class=\"frame\" d=\"M" + tenth(left) + " " + tenth(top) + "V" + tenth(bottom) + "H" +
           tenth(end) + "\"/>\n" +
           words_at(left + inner_wide / 2, bottom + 34, axis(chart_.x), "class=\"xaxis\"") +
           words_at(14, middle, axis(chart_.y),
                    "class=\"yaxis\" transform=\"rotate(-90 14 " + tenth(middle) + ")\"");
  }

  static std::string axis(const ChartAxis& a) { return a.words + " [" + a.unit + "]"; }

  std::string curve(const ChartLine& line) const {
    std::string d, marks;
    bool drawing = false;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const ChartPoint& p = line.points[i];
      const bool there = is_there(p);
      const double size = line.growing ? 0.4 + 0.8 * double(i) / double(line.points.size()) : line.size;
      if (!there && drawing && line.closed) d += "Z";
      if (there) {
        d += (drawing ? "L" : "M") + tenth(px(p.x)) + " " + tenth(py(p.y));
        marks += mark_path(line.mark, px(p.x), py(p.y), size, 1);
      }
      drawing = there;
    }
    if (drawing && line.closed) d += "Z";
    const std::string style = class_of(line.style) + (line.thin ? " thin" : "");
    std::string out;
    if (line.joined && !d.empty()) out += "<path class=\"line " + style + "\" d=\"" + d + "\"/>\n";
    if (!marks.empty()) out += "<path class=\"mark " + style + "\" d=\"" + marks + "\"/>\n";
    return out;
  }

  const Chart& chart_;
  AxisRange x_, y_;
};

std::string sample(const ChartLine& line) {
  std::string out = "<svg class=\"sample\" viewBox=\"0 0 34 12\" aria-hidden=\"true\">";
  const std::string style = class_of(line.style) + (line.thin ? " thin" : "");
  if (line.joined) out += "<path class=\"line " + style + "\" d=\"M1 6H33\"/>";
  if (line.mark != Mark::none)
    out += "<path class=\"mark " + style + "\" d=\"" + mark_path(line.mark, 17, 6, 1, 1) + "\"/>";
  return out + "</svg>";
}

std::string legend(const Chart& chart) {
  std::string out;
  const auto add = [&](const ChartLine& line) {
    out += "<li>" + sample(line) + in_html(line.name) + "</li>\n";
  };
  for (const ChartLine& line : chart.lines)
    if (!line.name.empty() && std::any_of(line.points.begin(), line.points.end(), is_there)) add(line);
  for (const ChartLine& line : chart.keys) add(line);
  return out.empty() ? "" : "<ul class=\"legend\">\n" + out + "</ul>\n";
}

}  // namespace

std::string in_html(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '<'    ? "&lt;"
            : c == '>'  ? "&gt;"
            : c == '&'  ? "&amp;"
            : c == '"'  ? "&quot;"
            : c == '\'' ? "&#39;"
                        : std::string(1, static_cast<unsigned char>(c) < 0x20 ? ' ' : c);
  return safe;
}

std::string style_sample(int style) { return sample({.name = "", .style = style, .points = {}}); }

std::string chart_html(const Chart& chart) {
  const ChartDrawing drawing(chart);
  return "<figure>\n<figcaption>" + in_html(chart.title) + "</figcaption>\n" +
         (drawing.empty() ? "<p>" + in_html(chart.empty) + "</p>\n" : drawing.svg() + legend(chart)) +
         "</figure>\n";
}

}  // namespace fulmar::chart
