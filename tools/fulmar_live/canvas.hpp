// SPDX-License-Identifier: BSD-3-Clause
// A plot of numbers over time in characters: braille dots, axes, one colour per series.
#pragma once
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace fulmar::core {

struct Series {
  std::string label;  // "nav.state.height_m"
  std::string unit;
  std::deque<std::pair<double, double>> points;  // time_s, value; times increase
};

struct PlotSize {
  int columns = 80, rows = 24;  // of the whole picture, legend included
  bool colours = false;
};

/// Draws the last `seconds` before `end_s`. Values that are not finite leave a gap.
std::string draw_plot(const std::vector<Series>& series, double end_s, double seconds, const PlotSize& size);

/// Round numbers for an axis: from at or below `low` to at or above `high`, 1, 2 or 5 times a power of ten
/// apart, about `most` of them.
std::vector<double> ticks(double low, double high, int most);

}  // namespace fulmar::core
