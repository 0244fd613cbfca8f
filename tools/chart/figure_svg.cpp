// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/chart/chart.hpp"
#include "tools/chart/figure.hpp"
#include "tools/chart/figure_curves.hpp"
#include "tools/chart/messages.hpp"
#include "tools/chart/numbers.hpp"

namespace fulmar::chart {
namespace {

// Millimetres.
constexpr double type_size = 2.8;  // 8 point
constexpr double min_type = 1.1;
constexpr double letter_wide = 0.52 * type_size;
constexpr double edge = 2, gap = 3.5, row_high = 4, band_high = 4.5, under_high = 10.5, sample_wide = 9;
constexpr double min_plot = 8;      // of a panel's height and width
constexpr double max_upright = 14;  // of a name above the first panel
constexpr double even_plot = 130,
                 min_even = 45;  // sides of a track: minimum of the longer and of the other one

double text_wide(const std::string& text) {
  const auto letters = std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return letter_wide * static_cast<double>(letters);
}

/// A text that is wider than its room gets smaller letters.
std::string text_at(const char* kind, double x, double y, const std::string& text, const char* anchor,
                    double room = 1e9, bool upright = false) {
  const double wide = text_wide(text);
  return "<text class=\"" + std::string(kind) + "\"" + number("x", x) + number("y", y) + " text-anchor=\"" +
         anchor + "\"" + (wide > room ? number("font-size", type_size * std::max(room, 1.0) / wide) : "") +
         (upright ? " transform=\"rotate(-90 " + mm(x) + " " + mm(y) + ")\"" : "") + ">" + in_html(text) +
         "</text>\n";
}

/// Interval of the marks of an axis: limits their number, but gives at least two, since a single one shows no
/// scale.
double step_in(const AxisRange& range, double most) {
  const auto marks_in = [&](double step) {
    return std::floor(range.max / step) - std::ceil(range.min / step) + 1;
  };
  double step = step_of(range.span(), most);
  for (; marks_in(step) < 2 && most < 20; most += 1) step = step_of(range.span(), most);
  return step;
}

/// Places of the names of curves in the rows above a panel.
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
    if (x > 0 && x + needs > wide) {
      x = 0;
      ++legend.rows;
    }
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
    for (std::size_t i = 0; i < boxes_.size(); ++i) looks_.push_back(looks_of(i));
  }

  double plot_high() const { return high_; }
  /// Height over width of the data in a panel, in the units of the axes.
  double shape() const { return shape_; }
  double plot_wide() const { return boxes_.empty() ? min_plot : boxes_[0].wide; }

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
          if (is_there(p)) {
            all.take(p.x);
            boxes_[i].y.take(p.y);
          }
      if (boxes_[i].y.empty()) {
        boxes_[i].y.min = 0;
        boxes_[i].y.max = 1;
      }
      if (boxes_[i].y.min == 0 && boxes_[i].y.max == 0) {
        boxes_[i].y.min = -1;
        boxes_[i].y.max = 1;
      }
      boxes_[i].y.widen();
    }
    if (all.empty()) {
      all.min = 0;
      all.max = 1;
    }
    if (figure_.track || all.span() <= 0) all.widen();
    for (Box& box : boxes_) box.x = all;
    shape_ = boxes_.empty() ? 1 : boxes_[0].y.span() / all.span();
  }

  /// In a panel of few curves marks replace dashes where these would be illegible.
  std::vector<Look> looks_of(std::size_t i) const {
    const auto& curves = figure_.panels[i].curves;
    const bool can_be_solid = !figure_.track && curves.size() > 1 && curves.size() <= max_solid;
    std::vector<Look> looks;
    for (std::size_t k = 0; k < curves.size(); ++k)
      looks.push_back({k, can_be_solid && is_noisy(curves[k], boxes_[i]), curves[k].behind});
    return looks;
  }

  /// Of a name above the first panel; 0: horizontal. The size of its letters is limited by the width of its
  /// band.
  double upright_size(const FigureBand& band) const {
    const double wide = band_wide(band);
    return text_wide(band.name) < wide + 1 ? 0 : std::min(wide, type_size);
  }
  double band_wide(const FigureBand& band) const {
    const Box& box = boxes_[0];
    return box.px(std::min(band.to, box.x.max)) - box.px(std::max(band.from, box.x.min));
  }
  /// Height of the names of bands above the first panel.
  double names_high() const {
    double high = figure_.bands.empty() ? 0 : band_high;
    for (const FigureBand& band : figure_.bands)
      if (const double size = upright_size(band); size > min_type)
        high = std::max(high, std::min(max_upright, text_wide(band.name) * size / type_size) + 2);
    return high;
  }

  void set_places() {
    double label_wide = 0;
    for (const Box& box : boxes_) {
      const double step = step_in(box.y, 6);
      for (double i = std::ceil(box.y.min / step); i * step <= box.y.max; ++i)
        label_wide = std::max(label_wide, text_wide(value_text(i * step, step)));
    }
    const double left = edge + type_size + 2.5 + label_wide, wide = figure_.wide_mm - left - edge - 2;
    for (Box& box : boxes_) {
      box.left = left;
      box.wide = wide;
    }
    const double names = names_high();
    double rest = figure_.high_mm - edge - under_high - names;
    for (const FigurePanel& panel : figure_.panels) {
      legends_.push_back(legend_of(panel, wide));
      rest -= static_cast<double>(legends_.back().rows) * row_high;
    }
    rest -= gap * static_cast<double>(boxes_.size() - 1);
    high_ = rest / static_cast<double>(boxes_.size());
    double top = edge + names;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      top += static_cast<double>(legends_[i].rows) * row_high;
      boxes_[i].top = top;
      boxes_[i].high = high_;
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
    for (const bool behind : {true, false})
      for (std::size_t k = 0; k < panel.curves.size(); ++k)
        if (panel.curves[k].behind == behind)
          out += curve_svg(panel.curves[k], looks_[i][k], box, figure_.track);
    out += "<rect class=\"frame\"" + rectangle(box.left, box.top, box.wide, box.high) +
           " fill=\"none\" stroke=\"#333333\" stroke-width=\"0.2\"/>\n";
    return out + legend_svg(i, i == 0 ? names_high() : 0) + "</g>\n";
  }

  static std::string rectangle(double x, double y, double wide, double high) {
    return number("x", x) + number("y", y) + number("width", wide) + number("height", high);
  }

  /// Shades every second band. A name is above the first panel, upright and smaller when it is too long, and
  /// left out when it would be illegible.
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
      const double size = upright_size(band);
      if (size == 0)
        out += text_at("phase", middle, box.top - 1.2, band.name, "middle");
      else if (size > min_type)
        out += text_at("phase", middle + 0.35 * size, box.top - 1, band.name, "start",
                       std::min(max_upright, text_wide(band.name) * size / type_size), true);
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

  /// `under`: height between it and the panel.
  std::string legend_svg(std::size_t panel, double under) const {
    const Box& box = boxes_[panel];
    const Legend& legend = legends_[panel];
    std::string out;
    for (std::size_t k = 0; k < legend.places.size(); ++k) {
      const double x = box.left + legend.places[k].x,
                   y = box.top - under - 1.6 -
                       row_high * static_cast<double>(legend.rows - 1 - legend.places[k].row);
      const Look& look = looks_[panel][k];
      out += "<path class=\"sample\"" + look.stroke() + " d=\"M" + mm(x) + " " + mm(y - 0.9) + "h" +
             mm(sample_wide - 1.5) + "\"/>\n";
      if (look.mark() != Mark::none)
        out += look.marks_svg(mark_path(look.mark(), x + (sample_wide - 1.5) / 2, y - 0.9, 0.28, 3));
      out += text_at("legend", x + sample_wide, y, figure_.panels[panel].curves[k].name, "start",
                     box.right() - x - sample_wide);
    }
    return out;
  }

  const Figure& figure_;
  std::vector<Box> boxes_;
  std::vector<Legend> legends_;
  std::vector<std::vector<Look>> looks_;
  double high_ = 0, shape_ = 1;
};

}  // namespace

std::string too_small(const Figure& figure) {
  const Drawing drawing(figure);
  const double higher = (min_plot - drawing.plot_high()) * static_cast<double>(figure.panels.size()),
               wider = 3 * min_plot - drawing.plot_wide();
  if (higher <= 0 && wider <= 0) return "";
  return chart_messages::figure_too_small(figure.panels.size(),
                                          figure.panels.size() == 1 ? " panel" : " panels",
                                          fixed(std::ceil(figure.wide_mm + std::max(0.0, wider)), 0),
                                          fixed(std::ceil(figure.high_mm + std::max(0.0, higher)), 0))
      .line();
}

void fit_even(Figure& figure) {
  for (int i = 0; i < 2; ++i) {  // a wrapped legend takes another row
    const Drawing drawing(figure);
    const double wide = even_plot / std::max(1.0, drawing.shape()),
                 high = even_plot * std::min(1.0, drawing.shape());
    figure.wide_mm = std::round(figure.wide_mm + std::max(wide, min_even) - drawing.plot_wide());
    figure.high_mm = std::round(figure.high_mm + std::max(high, min_even) - drawing.plot_high());
  }
}

std::string figure_svg(const Figure& figure) { return Drawing(figure).svg(); }

}  // namespace fulmar::chart
