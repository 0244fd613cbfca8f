// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/see/chart.hpp"

#include <algorithm>
#include <cmath>

#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// Of the picture, in its own units.
constexpr double picture_wide = 460, picture_high = 300, left = 62, top = 12, inner_wide = 386,
                 inner_high = 234;

struct AxisRange {
  double min = 1e300, max = -1e300;
  double span() const { return max - min; }
  void take(double x) {
    min = std::min(min, x);
    max = std::max(max, x);
  }
  /// Some room at both ends; of one value alone, room on both sides of it.
  void widen() {
    const double least = 1e-6 * std::max({std::abs(min), std::abs(max), 1e-6});
    const double more = span() > least ? 0.05 * span() : std::max(0.05 * std::abs(min), least);
    min -= more;
    max += more;
  }
  void grow_to(double wanted) {
    const double more = 0.5 * (wanted - span());
    min -= more;
    max += more;
  }
};

/// Between marks of an axis: 1, 2 or 5 times a power of ten.
double step_of(double span) {
  const double power = std::pow(10.0, std::floor(std::log10(span / 5)));
  for (const double step : {1.0, 2.0, 5.0})
    if (span / (step * power) <= 8) return step * power;
  return 10 * power;
}

std::string value_text(double x, double step) {
  if (std::abs(x) < 1e-6 * step) return "0";
  if (std::abs(x) >= 1e6 || step < 1e-5) return figures(x, 6);
  return fixed(x, std::max(0, int(-std::floor(std::log10(step) + 1e-9))));
}

std::string tenth(double x) { return fixed(x, 1); }

std::string words_at(double x, double y, const std::string& text, const std::string& more) {
  return "<text x=\"" + tenth(x) + "\" y=\"" + tenth(y) + "\" " + more + ">" + in_html(text) + "</text>\n";
}

bool is_there(const ChartPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string class_of(int style) { return style < 0 ? "plain" : "s" + std::to_string(style % styles); }

/// About (x, y), of one size to the eye.
std::string mark_path(Mark mark, double x, double y, double size = 1) {
  const auto at = [&](double dx, double dy) { return tenth(x + size * dx) + " " + tenth(y + size * dy); };
  const auto polygon = [&](std::initializer_list<ChartPoint> corners) {
    std::string d;
    for (const ChartPoint& c : corners) d += (d.empty() ? "M" : "L") + at(c.x, c.y);
    return d + "Z";
  };
  switch (mark) {
    case Mark::none: break;
    case Mark::circle: {
      const std::string r = figures(3 * size), arc = "a" + r + " " + r + " 0 1 0 ", d = figures(6 * size);
      return "M" + at(-3, 0) + arc + d + " 0" + arc + "-" + d + " 0Z";
    }
    case Mark::square: return polygon({{-2.7, -2.7}, {2.7, -2.7}, {2.7, 2.7}, {-2.7, 2.7}});
    case Mark::triangle: return polygon({{0, -3.6}, {3.4, 2.6}, {-3.4, 2.6}});
    case Mark::diamond: return polygon({{0, -4}, {3.4, 0}, {0, 4}, {-3.4, 0}});
    case Mark::cross: return "M" + at(-3, -3) + "L" + at(3, 3) + "M" + at(-3, 3) + "L" + at(3, -3);
    case Mark::plus: return "M" + at(-3.5, 0) + "L" + at(3.5, 0) + "M" + at(0, -3.5) + "L" + at(0, 3.5);
  }
  return "";
}

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

  bool empty() const { return x_.max < x_.min; }

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
        marks += mark_path(line.mark, px(p.x), py(p.y), size);
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
    out += "<path class=\"mark " + style + "\" d=\"" + mark_path(line.mark, 17, 6) + "\"/>";
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

}  // namespace fulmar::aero
