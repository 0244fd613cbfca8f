// SPDX-License-Identifier: BSD-3-Clause
// Charts as HTML figures with inline SVG: the same numbers give the same bytes.
#pragma once
#include <string>
#include <vector>

#include "tools/chart/axis.hpp"

namespace fulmar::chart {

/// A curve, or only marks. A point that is not finite interrupts it.
struct ChartLine {
  std::string name;  ///< in the legend; "": not in it
  int style = 0;     ///< colour and dashes; no_style: those of the text
  std::vector<ChartPoint> points;
  Mark mark = Mark::none;  ///< at each point
  bool joined = true;      ///< false: only marks
  bool closed = false;     ///< each part is closed
  bool thin = false;       ///< behind the others, pale
  bool growing = false;    ///< marks, from the first point to the last
  double size = 1;         ///< of marks
};
inline constexpr int no_style = -1, styles = 6;

/// Words and unit: "airspeed", "m/s"; "-" without a dimension.
struct ChartAxis {
  std::string words, unit;
};

struct Chart {
  std::string title;
  ChartAxis x, y;
  std::vector<ChartLine> lines;
  std::vector<ChartLine> keys;      ///< more for the legend
  bool even = false;                ///< both axes in one scale
  bool unstable = false;            ///< shades the half plane right of zero
  bool with_zero = false;           ///< the y axis includes 0
  std::string empty = "no values";  ///< text in place of an empty chart
};

std::string chart_html(const Chart& chart);

/// Text as it is written in HTML and in its attributes; control characters become spaces.
std::string in_html(const std::string& text);

/// A legend's sample of a style: a short line.
std::string style_sample(int style);

}  // namespace fulmar::chart
