// SPDX-License-Identifier: BSD-3-Clause
#include "tools/chart/figure_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/chart/chart.hpp"
#include "tools/chart/numbers.hpp"

namespace fulmar::chart {
namespace {

// Millimetres.
constexpr double column = 0.1;       // visible width along a time axis
constexpr double seen_apart = 0.03;  // distance of the points of a track
constexpr double mark_apart = 14;
constexpr double swing = 1.2, max_swings = 0.5;  // mm; in a mm

// Colours of Okabe & Ito, Color Universal Design (2008), dark enough for white paper. Dashes distinguish
// lines without colours, and marks further lines.
constexpr std::array<const char*, 6> colours{"#0072b2", "#c04f00", "#007a5a",
                                             "#b0558a", "#8f6600", "#333333"};
constexpr std::array<const char*, 6> dashes{
    "", "2.4 1", "0.5 0.7", "3 0.9 0.5 0.9", "4.5 0.9", "1.6 0.6 0.4 0.6 0.4 0.6"};
constexpr std::array<Mark, 6> marks{Mark::none,    Mark::circle, Mark::square,
                                    Mark::diamond, Mark::plus,   Mark::cross};
static_assert(max_solid == marks.size());
static_assert(max_curves == dashes.size() * marks.size());

const char* colour_of(const Look& look) { return colours[look.curve % colours.size()]; }

using Points = std::vector<ChartPoint>;

/// The visible points of one column, in their order.
void keep_column(const Points& from, std::size_t begin, std::size_t end, Points& kept) {
  const auto less = [](const ChartPoint& a, const ChartPoint& b) { return a.y < b.y; };
  const auto at = [&](std::size_t i) { return from.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto [least, most] = std::minmax_element(at(begin), at(end), less);
  std::array places{at(begin), std::min(least, most), std::max(least, most), at(end) - 1};
  for (std::size_t i = 0; i < places.size(); ++i)
    if (i == 0 || places[i] != places[i - 1]) kept.push_back(*places[i]);
}

/// The visible part of one part of a curve, in millimetres of the figure.
Points seen_part(const Points& part, bool track) {
  Points kept;
  for (std::size_t i = 0, next = 0; i < part.size(); i = next) {
    next = i + 1;
    if (track) {
      const bool last = next == part.size();
      if (kept.empty() || last ||
          std::hypot(part[i].x - kept.back().x, part[i].y - kept.back().y) > seen_apart)
        kept.push_back(part[i]);
      continue;
    }
    while (next < part.size() && std::floor(part[next].x / column) == std::floor(part[i].x / column)) ++next;
    keep_column(part, i, next, kept);
  }
  return kept;
}

std::string path_of(const Points& part, bool held) {
  std::string d;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (i > 0 && held && part[i].y != part[i - 1].y) d += "L" + mm(part[i].x) + " " + mm(part[i - 1].y);
    d += (i == 0 ? "M" : "L") + mm(part[i].x) + " " + mm(part[i].y);
  }
  if (part.size() == 1) d += "h0.001";  // a single point is a dot
  return d;
}

std::string marks_along(const Points& part, const Look& look) {
  std::string d;
  double way = 0.5 * mark_apart + (look.solid ? 2.0 * static_cast<double>(look.curve) : 0);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double along = i > 0 ? part[i].x - part[i - 1].x : 0, up = i > 0 ? part[i].y - part[i - 1].y : 0;
    way += look.solid ? along : std::hypot(along, up);
    if (way < mark_apart) continue;
    way = 0;
    d += mark_path(look.mark(), part[i].x, part[i].y, 0.28, 3);
  }
  return d;
}

}  // namespace

std::string mm(double x) { return fixed(x, 3); }
std::string number(const char* name, double x) { return std::string(" ") + name + "=\"" + mm(x) + "\""; }

Mark Look::mark() const {
  if (behind) return Mark::none;
  return solid ? marks[curve] : marks[curve / dashes.size()];
}
std::string Look::stroke() const {
  if (behind) return " fill=\"none\" stroke=\"#b8b8b8\" stroke-width=\"0.9\" stroke-linejoin=\"round\"";
  const std::string dash = solid ? "" : dashes[curve % dashes.size()];
  return std::string(" fill=\"none\" stroke=\"") + colour_of(*this) + "\" stroke-width=\"" +
         (solid ? "0.2" : "0.35") + "\" stroke-linejoin=\"round\"" +
         (dash.empty() ? "" : " stroke-dasharray=\"" + dash + "\"");
}
std::string Look::marks_svg(const std::string& d) const {
  if (d.empty()) return "";
  return std::string("<path class=\"mark\" fill=\"") + (solid ? "#ffffff" : "none") + "\" stroke=\"" +
         colour_of(*this) + "\" stroke-width=\"0.3\" d=\"" + d + "\"/>\n";
}

bool is_noisy(const FigureCurve& curve, const Box& box) {
  double turns = 0, sign = 1, extreme = 0;
  AxisRange x;
  for (const ChartPoint& p : curve.points) {
    if (!is_there(p)) continue;
    const double y = box.py(p.y);
    if (x.empty()) extreme = y;
    x.take(box.px(p.x));
    extreme = sign * std::max(sign * extreme, sign * y);
    if (sign * (extreme - y) < swing) continue;
    sign = -sign;
    extreme = y;
    ++turns;
  }
  return turns > 4 && turns > max_swings * x.span();
}

std::string curve_svg(const FigureCurve& curve, const Look& look, const Box& box, bool track) {
  std::string d, dots;
  Points part;
  const auto finish = [&] {
    const Points seen = seen_part(part, track);
    d += path_of(seen, curve.held);
    if (look.mark() != Mark::none) dots += marks_along(seen, look);
    part.clear();
  };
  for (const ChartPoint& p : curve.points) {
    if (is_there(p))
      part.push_back({box.px(p.x), box.py(p.y)});
    else
      finish();
  }
  finish();
  if (d.empty()) return "";
  return "<path class=\"curve\"" + look.stroke() + " stroke-linecap=\"" +
         (d.find("h0.001") == std::string::npos ? "butt" : "round") + "\" d=\"" + d + "\"><title>" +
         in_html(curve.name) + "</title></path>\n" + look.marks_svg(dots);
}

}  // namespace fulmar::chart
