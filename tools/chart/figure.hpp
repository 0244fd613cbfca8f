// SPDX-License-Identifier: BSD-3-Clause
// Figures for print as SVG: panels above each other over one axis, line styles that tell curves apart without
// colours. The same numbers give the same bytes.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "tools/chart/axis.hpp"

namespace fulmar::chart {

struct FigureCurve {
  std::string name;                ///< in the legend
  std::vector<ChartPoint> points;  ///< one that is not finite parts the curve
  bool held = false;               ///< a value stays until the next one: a choice, a flag
  bool behind = false;             ///< grey and broad, under the others
};

struct FigurePanel {
  std::string y;  ///< what stands beside the axis, unit and all
  std::vector<FigureCurve> curves;
};

/// Shaded, behind the curves.
struct FigureBand {
  std::string name;
  double from = 0, to = 0;
};

struct Figure {
  double wide_mm = 160, high_mm = 90;
  std::string title;   ///< for readers that do not see it
  std::string x;       ///< what stands beside the axis, unit and all
  bool track = false;  ///< x is no time: points are drawn in their order, and may go back
  bool even = false;   ///< both axes in one scale
  AxisRange shown;     ///< of x, beside what is drawn
  std::vector<FigurePanel> panels;
  std::vector<FigureBand> bands;
};

/// So many curves of one panel can be told apart.
constexpr std::size_t max_curves = 36;

/// What there is to say when a figure of that size has no room for so many panels; "": it has.
std::string too_small(const Figure& figure);

/// Gives it the size in which one panel with one scale on both axes is filled.
void fit_even(Figure& figure);

/// Curves hold what can be seen, no more: of the points within a tenth of a millimetre of an axis of time the
/// first, the least, the largest and the last.
std::string figure_svg(const Figure& figure);

}  // namespace fulmar::chart
