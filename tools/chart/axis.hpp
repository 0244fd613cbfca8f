// SPDX-License-Identifier: BSD-3-Clause
// Common parts of all charts: the range of an axis, its marks, and the shapes of points.
#pragma once
#include <initializer_list>
#include <string>

namespace fulmar::chart {

struct ChartPoint {
  double x = 0, y = 0;
};

enum class Mark { none, circle, square, triangle, diamond, cross, plus };

struct AxisRange {
  double min = 1e300, max = -1e300;
  double span() const { return max - min; }
  bool empty() const { return max < min; }
  void take(double x);
  /// Adds some room at both ends; for a single value, room on both sides.
  void widen();
  void grow_to(double wanted);
};

/// Interval of the marks of an axis: 1, 2 or 5 times a power of ten, with at most `most` marks.
double step_of(double span, double most = 8);

/// Number of a mark, with the decimals of its step.
std::string value_text(double x, double step);

/// True when both coordinates are finite.
bool is_there(const ChartPoint& p);

/// Path of a mark about (x, y) of equal visual size: 6 units across times `size`.
std::string mark_path(Mark mark, double x, double y, double size, int decimals);

}  // namespace fulmar::chart
