// SPDX-License-Identifier: BSD-3-Clause
// Style of the curves of a figure, and their visible parts.
#pragma once
#include <string>

#include "tools/chart/figure.hpp"

namespace fulmar::chart {

/// A number of millimetres, and an attribute of one.
std::string mm(double x);
std::string number(const char* name, double x);

/// A box of the figure with its axes.
struct Box {
  double left = 0, top = 0, wide = 0, high = 0;
  AxisRange x, y;
  double px(double v) const { return left + (v - x.min) / x.span() * wide; }
  double py(double v) const { return top + high - (v - y.min) / y.span() * high; }
  double bottom() const { return top + high; }
  double right() const { return left + wide; }
};

/// Style of a curve. `solid`: no dashes, distinguished by a mark. `behind`: grey, the only one of its kind.
struct Look {
  std::size_t curve = 0;
  bool solid = false, behind = false;
  Mark mark() const;
  std::string stroke() const;
  std::string marks_svg(const std::string& d) const;
};
/// Largest number of solid curves in a panel.
constexpr std::size_t max_solid = 6;

/// True when it changes direction so often, by a visible amount, that dashes cannot be seen.
bool is_noisy(const FigureCurve& curve, const Box& box);

std::string curve_svg(const FigureCurve& curve, const Look& look, const Box& box, bool track);

}  // namespace fulmar::chart
