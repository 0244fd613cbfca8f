// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tools/fulmar_live/messages.hpp"

namespace fulmar::core {
namespace {

// Colours of the terminal that are distinct on black and on white: cyan, yellow, magenta, green, red, blue.
constexpr std::array<int, 6> colours{36, 33, 35, 32, 31, 34};
std::string coloured(const std::string& text, std::size_t series, bool on) {
  return on ? "\x1b[" + std::to_string(colours[series % colours.size()]) + "m" + text + "\x1b[0m" : text;
}

std::string number(double value, int digits = 4) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, std::abs(value) < 1e-12 ? 0.0 : value);
  return buffer;
}

/// Dots, 2 wide and 4 high in each character (Unicode block U+2800).
class Dots {
 public:
  Dots(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        cells_(static_cast<std::size_t>(columns * rows)),
        owner_(cells_.size(), 0) {}
  int width() const { return 2 * columns_; }
  int height() const { return 4 * rows_; }

  void dot(int x, int y, std::size_t series) {  // from the lower left
    if (x < 0 || y < 0 || x >= width() || y >= height()) return;
    static constexpr std::array<std::array<std::uint8_t, 2>, 4> bits{
        {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
    const int down = height() - 1 - y;
    const auto at = static_cast<std::size_t>(down / 4) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(x / 2);
    cells_[at] |= bits[static_cast<std::size_t>(down % 4)][static_cast<std::size_t>(x % 2)];
    owner_[at] = series;
  }

  void line(int x0, int y0, int x1, int y1, std::size_t series) {
    const int steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
    for (int i = 0; i <= steps; ++i)
      dot(x0 + static_cast<int>(std::lround(static_cast<double>(i) * (x1 - x0) / steps)),
          y0 + static_cast<int>(std::lround(static_cast<double>(i) * (y1 - y0) / steps)), series);
  }

  std::string row(int r, bool with_colours) const {
    std::string text;
    for (int c = 0; c < columns_; ++c) {
      const auto at =
          static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
      if (cells_[at] == 0) {
        text += ' ';
        continue;
      }
      const unsigned code = 0x2800u + cells_[at];
      const std::string character{static_cast<char>(0xE0u | (code >> 12)),
                                  static_cast<char>(0x80u | ((code >> 6) & 0x3Fu)),
                                  static_cast<char>(0x80u | (code & 0x3Fu))};
      text += coloured(character, owner_[at], with_colours);
    }
    return text;
  }

 private:
  int columns_, rows_;
  std::vector<std::uint8_t> cells_;
  std::vector<std::size_t> owner_;
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Range range_of(const std::vector<Series>& series, double from) {
  Range range;
  for (const Series& s : series)
    for (const auto& [time, value] : s.points) {
      if (time < from || !std::isfinite(value)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  if (range.low > range.high) return {0, 1};
  const double least = std::max(1e-9, 1e-6 * std::max(std::abs(range.low), std::abs(range.high)));
  if (range.high - range.low < least)
    range = {range.low - std::max(0.5 * std::abs(range.low), least),
             range.high + std::max(0.5 * std::abs(range.high), least)};
  return range;
}

void draw_series(Dots& dots, const Series& s, std::size_t index, double from, double seconds, double low,
                 double high) {
  bool joined = false;
  int x_before = 0, y_before = 0;
  for (const auto& [time, value] : s.points) {
    if (time < from) continue;
    if (!std::isfinite(value)) {
      joined = false;
      continue;
    }
    const int x = static_cast<int>(std::lround((time - from) / seconds * (dots.width() - 1)));
    const int y = static_cast<int>(std::lround((value - low) / (high - low) * (dots.height() - 1)));
    dots.line(joined ? x_before : x, joined ? y_before : y, x, y, index);
    joined = true;
    x_before = x;
    y_before = y;
  }
}

std::string legend(const std::vector<Series>& series, const PlotSize& size) {
  std::string text;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& s = series[i];
    const std::string value = s.points.empty()
                                  ? remote_messages::sample_absent.c_str()
                                  : number(s.points.back().second, 6) + (s.unit.empty() ? "" : " " + s.unit);
    std::string line = "\u2501\u2501 " + s.label + "  " + value;
    if (!size.colours && series.size() > 1) line = std::to_string(i + 1) + " " + s.label + "  " + value;
    text += coloured(line, i, size.colours) + "\n";
  }
  return text;
}

/// Times below the axis, at round seconds.
std::string time_line(double from, double seconds, std::size_t margin, int columns) {
  std::string line(margin + static_cast<std::size_t>(columns) + 2, ' ');
  for (const double t : ticks(from, from + seconds, columns / 12)) {
    if (t < from || t > from + seconds) continue;
    const std::string text = number(t, 6);
    const auto at = static_cast<std::size_t>(std::lround((t - from) / seconds * (columns - 1)));
    const std::size_t begin =
        std::min(margin + 1 + at - std::min(at, text.size() / 2), line.size() - 2 - text.size());
    line.replace(begin, text.size(), text);
  }
  line.replace(line.size() - 1, 1, "s");
  return line;
}

}  // namespace

std::vector<double> ticks(double low, double high, int most) {
  const double rough = (high - low) / std::max(most, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough * (1 - 1e-9)) step = factor * power;
  std::vector<double> list;
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  for (double i = first; i <= last && list.size() < 100; i += 1) list.push_back(i * step);
  return list;
}

std::string draw_plot(const std::vector<Series>& series, double end_s, double seconds, const PlotSize& size) {
  const double from = end_s - seconds;
  const int rows = std::max(4, size.rows - static_cast<int>(series.size()) - 3);
  const Range range = range_of(series, from);
  const std::vector<double> levels = ticks(range.low, range.high, std::max(2, rows / 3));
  const double low = levels.front(), high = levels.back();
  std::size_t margin = 0;
  for (const double level : levels) margin = std::max(margin, number(level).size());
  const int columns = std::max(10, size.columns - static_cast<int>(margin) - 2);

  Dots dots(columns, rows);
  for (std::size_t i = 0; i < series.size(); ++i) draw_series(dots, series[i], i, from, seconds, low, high);
  std::vector<std::string> labels(static_cast<std::size_t>(rows));
  for (const double level : levels)
    labels[static_cast<std::size_t>(std::lround((1 - (level - low) / (high - low)) * (rows - 1)))] =
        number(level);

  std::string text = legend(series, size);
  for (int r = 0; r < rows; ++r) {
    const std::string& label = labels[static_cast<std::size_t>(r)];
    const std::string dots_text = dots.row(r, size.colours);
    std::string line =
        std::string(margin - label.size(), ' ') + label + (label.empty() ? "\u2502" : "\u2524") + dots_text;
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  std::string axis;
  for (int c = 0; c < columns; ++c) axis += "\u2500";
  return text + std::string(margin, ' ') + "\u2514" + axis + "\n" +
         time_line(from, seconds, margin, columns) + "\n";
}

}  // namespace fulmar::core
