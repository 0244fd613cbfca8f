// SPDX-License-Identifier: BSD-3-Clause
// What all charts share: the range of an axis, its marks, and the shapes of points.
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
  /// Some room at both ends; of one value alone, room on both sides of it.
  void widen();
  void grow_to(double wanted);
};

/// Between marks of an axis: 1, 2 or 5 times a power of ten, so that there are at most `most`.
double step_of(double span, double most = 8);

/// A mark's number, with the decimals that its step needs.
std::string value_text(double x, double step);

/// Both are numbers.
bool is_there(const ChartPoint& p);

/// The path of a mark about (x, y), of one size to the eye: 6 units across times `size`.
std::string mark_path(Mark mark, double x, double y, double size, int decimals);

}  // namespace fulmar::chart
