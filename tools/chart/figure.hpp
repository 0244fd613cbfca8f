// SPDX-License-Identifier: BSD-3-Clause
// Figures for print as SVG: panels above each other over one axis, with line styles that are distinct without
// colours. The same numbers give the same bytes.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "tools/chart/axis.hpp"

namespace fulmar::chart {

struct FigureCurve {
  std::string name;                ///< in the legend
  std::vector<ChartPoint> points;  ///< a point that is not finite interrupts the curve
  bool held = false;               ///< a value is held until the next one: a choice, a flag
  bool behind = false;             ///< grey and broad, under the others
};

struct FigurePanel {
  std::string y;  ///< label of the axis with its unit
  std::vector<FigureCurve> curves;
};

/// A shaded interval behind the curves.
struct FigureBand {
  std::string name;
  double from = 0, to = 0;
};

struct Figure {
  double wide_mm = 160, high_mm = 90;
  std::string title;   ///< for screen readers
  std::string x;       ///< label of the axis with its unit
  bool track = false;  ///< x is not time: points are drawn in their order, and may go back
  bool even = false;   ///< both axes in one scale
  AxisRange shown;     ///< further range of x, in addition to the data
  std::vector<FigurePanel> panels;
  std::vector<FigureBand> bands;
};

/// Largest number of distinct curves in one panel.
constexpr std::size_t max_curves = 36;

/// Message when a figure of that size has no room for so many panels; "" when it has.
std::string too_small(const Figure& figure);

/// Sets the size for which one panel with equal scales is filled.
void fit_even(Figure& figure);

/// Curves hold only visible points: of the points within a tenth of a millimetre of a time axis the first,
/// the smallest, the largest and the last.
std::string figure_svg(const Figure& figure);

}  // namespace fulmar::chart
