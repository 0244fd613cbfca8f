// SPDX-License-Identifier: BSD-3-Clause
#include "tools/chart/axis.hpp"

#include <algorithm>
#include <cmath>

#include "tools/chart/numbers.hpp"

namespace fulmar::chart {

void AxisRange::take(double x) {
  min = std::min(min, x);
  max = std::max(max, x);
}

void AxisRange::widen() {
  const double least = 1e-6 * std::max({std::abs(min), std::abs(max), 1e-6});
  const double more = span() > least ? 0.05 * span() : std::max(0.05 * std::abs(min), least);
  min -= more;
  max += more;
}

void AxisRange::grow_to(double wanted) {
  const double more = 0.5 * (wanted - span());
  min -= more;
  max += more;
}

double step_of(double span, double most) {
  const double power = std::pow(10.0, std::floor(std::log10(span / 5)));
  for (const double step : {1.0, 2.0, 5.0})
    if (span / (step * power) <= most) return step * power;
  return 10 * power;
}

std::string value_text(double x, double step) {
  if (std::abs(x) < 1e-6 * step) return "0";
  if (std::abs(x) >= 1e6 || step < 1e-5) return figures(x, 6);
  return fixed(x, std::max(0, int(-std::floor(std::log10(step) + 1e-9))));
}

bool is_there(const ChartPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string mark_path(Mark mark, double x, double y, double size, int decimals) {
  const auto at = [&](double dx, double dy) {
    return fixed(x + size * dx, decimals) + " " + fixed(y + size * dy, decimals);
  };
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

}  // namespace fulmar::chart
