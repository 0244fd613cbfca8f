// SPDX-License-Identifier: BSD-3-Clause
#include "tools/chart/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/chart/chart.hpp"
#include "tools/chart/numbers.hpp"

namespace fulmar::chart {
namespace {

// Millimetres.
constexpr double type_size = 2.8;  // 8 point
constexpr double least_type = 1.1;
constexpr double letter_wide = 0.52 * type_size;
constexpr double edge = 2, gap = 3.5, row_high = 4, band_high = 4.5, under_high = 10.5, sample_wide = 9;
constexpr double least_plot = 8;     // of a panel's height and width
constexpr double column = 0.1;       // of what is seen along an axis of time
constexpr double seen_apart = 0.03;  // points of a track
constexpr double mark_apart = 14;

// Colours of Okabe & Ito, Color Universal Design (2008), dark enough for white paper; dashes tell the lines
// apart where there are no colours, marks where the dashes are used up.
constexpr std::array<const char*, 6> colours{"#0072b2", "#c04f00", "#007a5a",
                                             "#b0558a", "#8f6600", "#333333"};
constexpr std::array<const char*, 6> dashes{
    "", "2.4 1", "0.5 0.7", "3 0.9 0.5 0.9", "4.5 0.9", "1.6 0.6 0.4 0.6 0.4 0.6"};
constexpr std::array<Mark, 6> marks{Mark::none,    Mark::circle, Mark::square,
                                    Mark::diamond, Mark::plus,   Mark::cross};
static_assert(most_curves == dashes.size() * marks.size());

std::string mm(double x) { return fixed(x, 3); }
std::string number(const char* name, double x) { return std::string(" ") + name + "=\"" + mm(x) + "\""; }

double text_wide(const std::string& text) {
  const auto letters = std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return letter_wide * static_cast<double>(letters);
}

/// Where the text's room is less than it takes, its letters are smaller.
std::string text_at(const char* kind, double x, double y, const std::string& text, const char* anchor,
                    double room = 1e9, bool upright = false) {
  const double wide = text_wide(text);
  return "<text class=\"" + std::string(kind) + "\"" + number("x", x) + number("y", y) + " text-anchor=\"" +
         anchor + "\"" + (wide > room ? number("font-size", type_size * std::max(room, 1.0) / wide) : "") +
         (upright ? " transform=\"rotate(-90 " + mm(x) + " " + mm(y) + ")\"" : "") + ">" + in_html(text) +
         "</text>\n";
}

std::string stroke_of(std::size_t curve) {
  const std::size_t style = curve % dashes.size();
  const std::string dash = dashes[style];
  return std::string(" fill=\"none\" stroke=\"") + colours[style] + "\" stroke-width=\"0.35\"" +
         " stroke-linejoin=\"round\"" + (dash.empty() ? "" : " stroke-dasharray=\"" + dash + "\"");
}
Mark mark_of(std::size_t curve) { return marks[curve / dashes.size()]; }
std::string marks_path(std::size_t curve, const std::string& d) {
  if (d.empty()) return "";
  return std::string("<path class=\"mark\" fill=\"none\" stroke=\"") + colours[curve % colours.size()] +
         "\" stroke-width=\"0.3\" d=\"" + d + "\"/>\n";
}

using Points = std::vector<ChartPoint>;

/// Of the points of one column those that show, in their order.
void keep_column(const Points& from, std::size_t begin, std::size_t end, Points& kept) {
  const auto less = [](const ChartPoint& a, const ChartPoint& b) { return a.y < b.y; };
  const auto at = [&](std::size_t i) { return from.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto [least, most] = std::minmax_element(at(begin), at(end), less);
  std::array places{at(begin), std::min(least, most), std::max(least, most), at(end) - 1};
  for (std::size_t i = 0; i < places.size(); ++i)
    if (i == 0 || places[i] != places[i - 1]) kept.push_back(*places[i]);
}

/// One part of a curve, in millimetres of the figure: what can be seen of it.
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

/// Between marks of an axis: at most so many, but two at least, since one alone tells no scale.
double step_in(const AxisRange& range, double most) {
  const auto marks_in = [&](double step) {
    return std::floor(range.max / step) - std::ceil(range.min / step) + 1;
  };
  double step = step_of(range.span(), most);
  for (; marks_in(step) < 2 && most < 20; most += 1) step = step_of(range.span(), most);
  return step;
}

/// A box of the figure with its axes.
struct Box {
  double left = 0, top = 0, wide = 0, high = 0;
  AxisRange x, y;
  double px(double v) const { return left + (v - x.min) / x.span() * wide; }
  double py(double v) const { return top + high - (v - y.min) / y.span() * high; }
  double bottom() const { return top + high; }
  double right() const { return left + wide; }
};

std::string path_of(const Points& part, bool held) {
  std::string d;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (i > 0 && held && part[i].y != part[i - 1].y) d += "L" + mm(part[i].x) + " " + mm(part[i - 1].y);
    d += (i == 0 ? "M" : "L") + mm(part[i].x) + " " + mm(part[i].y);
  }
  if (part.size() == 1) d += "h0.001";  // a point alone is a dot
  return d;
}

std::string marks_along(const Points& part, Mark mark) {
  std::string d;
  double way = 0.5 * mark_apart;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (i > 0) way += std::hypot(part[i].x - part[i - 1].x, part[i].y - part[i - 1].y);
    if (way < mark_apart) continue;
    way = 0;
    d += mark_path(mark, part[i].x, part[i].y, 0.28, 3);
  }
  return d;
}

std::string curve_svg(const FigureCurve& curve, std::size_t number, const Box& box, bool track) {
  std::string d, dots;
  Points part;
  const auto finish = [&] {
    const Points seen = seen_part(part, track);
    d += path_of(seen, curve.held);
    if (mark_of(number) != Mark::none) dots += marks_along(seen, mark_of(number));
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
  return "<path class=\"curve\"" + stroke_of(number) + " stroke-linecap=\"" +
         (d.find("h0.001") == std::string::npos ? "butt" : "round") + "\" d=\"" + d + "\"><title>" +
         in_html(curve.name) + "</title></path>\n" + marks_path(number, dots);
}

/// Where each curve's name stands in the rows above a panel.
struct Legend {
  struct Place {
    double x = 0;
    std::size_t row = 0;
  };
  std::vector<Place> places;
  std::size_t rows = 0;
};
Legend legend_of(const FigurePanel& panel, double wide) {
  Legend legend;
  double x = 0;
  for (const FigureCurve& curve : panel.curves) {
    const double needs = sample_wide + text_wide(curve.name) + 4;
    if (x > 0 && x + needs > wide) x = 0, ++legend.rows;
    legend.places.push_back({x, legend.rows});
    x += needs;
  }
  legend.rows += legend.places.empty() ? 0 : 1;
  return legend;
}

class Drawing {
 public:
  explicit Drawing(const Figure& figure) : figure_(figure) {
    boxes_.resize(figure.panels.size());
    set_ranges();
    set_places();
  }

  double plot_high() const { return high_; }
  double plot_wide() const { return boxes_.empty() ? least_plot : boxes_[0].wide; }

  std::string svg() const {
    const std::string wide = figures(figure_.wide_mm, 6), high = figures(figure_.high_mm, 6);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + wide + "mm\" height=\"" + high +
                      "mm\" viewBox=\"0 0 " + wide + " " + high +
                      "\" font-family=\"Helvetica, Arial, Liberation Sans, sans-serif\" font-size=\"" +
                      figures(type_size) + "\">\n<title>" + in_html(figure_.title) +
                      "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (std::size_t i = 0; i < boxes_.size(); ++i) out += panel_svg(i);
    const Box& last = boxes_.back();
    out += text_at("x-axis", last.left + last.wide / 2, last.bottom() + 8.2, figure_.x, "middle", last.wide);
    return out + "</svg>\n";
  }

 private:
  void set_ranges() {
    AxisRange all = figure_.shown;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      for (const FigureCurve& curve : figure_.panels[i].curves)
        for (const ChartPoint& p : curve.points)
          if (is_there(p)) all.take(p.x), boxes_[i].y.take(p.y);
      if (boxes_[i].y.empty()) boxes_[i].y.min = 0, boxes_[i].y.max = 1;
      if (boxes_[i].y.min == 0 && boxes_[i].y.max == 0) boxes_[i].y.min = -1, boxes_[i].y.max = 1;
      boxes_[i].y.widen();
    }
    if (all.empty()) all.min = 0, all.max = 1;
    if (figure_.track || all.span() <= 0) all.widen();
    for (Box& box : boxes_) box.x = all;
  }

  void set_places() {
    double label_wide = 0;
    for (const Box& box : boxes_) {
      const double step = step_in(box.y, 6);
      for (double i = std::ceil(box.y.min / step); i * step <= box.y.max; ++i)
        label_wide = std::max(label_wide, text_wide(value_text(i * step, step)));
    }
    const double left = edge + type_size + 2.5 + label_wide, wide = figure_.wide_mm - left - edge - 2;
    double rest = figure_.high_mm - edge - under_high - (figure_.bands.empty() ? 0 : band_high);
    for (const FigurePanel& panel : figure_.panels) {
      legends_.push_back(legend_of(panel, wide));
      rest -= static_cast<double>(legends_.back().rows) * row_high;
    }
    rest -= gap * static_cast<double>(boxes_.size() - 1);
    high_ = rest / static_cast<double>(boxes_.size());
    double top = edge + (figure_.bands.empty() ? 0 : band_high);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      top += static_cast<double>(legends_[i].rows) * row_high;
      boxes_[i].left = left, boxes_[i].wide = wide, boxes_[i].top = top, boxes_[i].high = high_;
      top += high_ + gap;
      if (!figure_.even) continue;
      Box& box = boxes_[i];
      const double scale = std::max(box.x.span() / box.wide, box.y.span() / box.high);
      box.x.grow_to(scale * box.wide);
      box.y.grow_to(scale * box.high);
    }
  }

  std::string panel_svg(std::size_t i) const {
    const Box& box = boxes_[i];
    const FigurePanel& panel = figure_.panels[i];
    std::string out =
        "<g class=\"panel\">\n" + bands_svg(box, i == 0) + axes_svg(box, i + 1 == boxes_.size());
    out += text_at("y-axis", edge + type_size - 0.6, box.top + box.high / 2, panel.y, "middle",
                   box.high + gap, true);
    for (std::size_t k = 0; k < panel.curves.size(); ++k)
      out += curve_svg(panel.curves[k], k, box, figure_.track);
    out += "<rect class=\"frame\"" + rectangle(box.left, box.top, box.wide, box.high) +
           " fill=\"none\" stroke=\"#333333\" stroke-width=\"0.2\"/>\n";
    return out + legend_svg(i) + "</g>\n";
  }

  static std::string rectangle(double x, double y, double wide, double high) {
    return number("x", x) + number("y", y) + number("width", wide) + number("height", high);
  }

  /// Every second one is shaded; a name stands above the first panel, upright and smaller where it is too
  /// long, and nowhere where it could not be read.
  std::string bands_svg(const Box& box, bool with_names) const {
    std::string out;
    for (std::size_t i = 0; i < figure_.bands.size(); ++i) {
      const FigureBand& band = figure_.bands[i];
      const double from = box.px(std::max(band.from, box.x.min)), to = box.px(std::min(band.to, box.x.max));
      if (!(to > from)) continue;
      out += "<rect class=\"phase\"" + rectangle(from, box.top, to - from, box.high) + " fill=\"" +
             (i % 2 == 0 ? "#ffffff" : "#ececec") + "\"><title>" + in_html(band.name) + "</title></rect>\n";
      if (!with_names) continue;
      const double middle = (from + to) / 2;
      if (text_wide(band.name) < to - from + 1)
        out += text_at("phase", middle, edge + 2.6, band.name, "middle");
      else if (const double size = std::min(to - from, type_size); size > least_type)
        out += text_at("phase", middle + 0.35 * size, box.top + 1, band.name, "end",
                       std::min(box.high, text_wide(band.name) * size / type_size), true);
    }
    return out;
  }

  std::string axes_svg(const Box& box, bool with_x_numbers) const {
    std::string lines, words;
    const auto line = [](double x1, double y1, double x2, double y2) {
      return "M" + mm(x1) + " " + mm(y1) + "L" + mm(x2) + " " + mm(y2);
    };
    const double dx = step_in(box.x, std::clamp(std::floor(box.wide / 14), 2.0, 10.0)),
                 dy = step_in(box.y, std::clamp(std::floor(box.high / 6), 2.0, 6.0));
    for (double i = std::ceil(box.x.min / dx); i * dx <= box.x.max; ++i) {
      lines += line(box.px(i * dx), box.top, box.px(i * dx), box.bottom());
      if (with_x_numbers)
        words += text_at("x", box.px(i * dx), box.bottom() + 3.8, value_text(i * dx, dx), "middle");
    }
    for (double i = std::ceil(box.y.min / dy); i * dy <= box.y.max; ++i) {
      lines += line(box.left, box.py(i * dy), box.right(), box.py(i * dy));
      words += text_at("y", box.left - 1, box.py(i * dy) + 1, value_text(i * dy, dy), "end");
    }
    return "<path class=\"grid\" fill=\"none\" stroke=\"#cfcfcf\" stroke-width=\"0.1\" d=\"" + lines +
           "\"/>\n" + words;
  }

  std::string legend_svg(std::size_t panel) const {
    const Box& box = boxes_[panel];
    const Legend& legend = legends_[panel];
    std::string out;
    for (std::size_t k = 0; k < legend.places.size(); ++k) {
      const double x = box.left + legend.places[k].x,
                   y = box.top - 1.6 - row_high * static_cast<double>(legend.rows - 1 - legend.places[k].row);
      out += "<path class=\"sample\"" + stroke_of(k) + " d=\"M" + mm(x) + " " + mm(y - 0.9) + "h" +
             mm(sample_wide - 1.5) + "\"/>\n";
      if (mark_of(k) != Mark::none)
        out += marks_path(k, mark_path(mark_of(k), x + (sample_wide - 1.5) / 2, y - 0.9, 0.28, 3));
      out += text_at("legend", x + sample_wide, y, figure_.panels[panel].curves[k].name, "start",
                     box.right() - x - sample_wide);
    }
    return out;
  }

  const Figure& figure_;
  std::vector<Box> boxes_;
  std::vector<Legend> legends_;
  double high_ = 0;
};

}  // namespace

std::string too_small(const Figure& figure) {
  const Drawing drawing(figure);
  const double higher = (least_plot - drawing.plot_high()) * static_cast<double>(figure.panels.size()),
               wider = 3 * least_plot - drawing.plot_wide();
  if (higher <= 0 && wider <= 0) return "";
  return "has no room for its axes and " + std::to_string(figure.panels.size()) +
         (figure.panels.size() == 1 ? " panel" : " panels") + "; it takes at least " +
         fixed(std::ceil(figure.wide_mm + std::max(0.0, wider)), 0) + "x" +
         fixed(std::ceil(figure.high_mm + std::max(0.0, higher)), 0) + "mm";
}

std::string figure_svg(const Figure& figure) { return Drawing(figure).svg(); }

}  // namespace fulmar::chart
