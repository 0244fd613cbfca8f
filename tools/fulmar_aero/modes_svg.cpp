// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/modes_svg.hpp"

#include <algorithm>
#include <cmath>

#include "tools/fulmar_aero/mode_words.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

// The palette of Okabe and Ito, distinct for any colour vision.
constexpr std::array<const char*, 6> colours{"#0072b2", "#e69f00", "#009e73",
                                             "#d55e00", "#cc79a7", "#56b4e9"};

struct Box {
  int number = 0;  ///< 0: all modes; 1: the slow ones
  double left = 0, top = 0, width = 0, height = 0;
  double real_min = 0, real_max = 0, imag_max = 0;  ///< shown range, 1/s; from the real axis up
  double x(double real) const { return left + (real - real_min) / (real_max - real_min) * width; }
  double y(double imag) const { return top + height - imag / imag_max * height; }
};

/// 1, 2 or 5 times a power of ten: about six to a side.
double tick(double span) {
  const double power = std::pow(10.0, std::floor(std::log10(span / 6)));
  for (const double step : {1., 2., 5.})
    if (span / (step * power) <= 7) return step * power;
  return 10 * power;
}

std::string number(double x) { return fixed(x, 1); }

std::string text_at(double x, double y, const std::string& text, const char* anchor, const char* more = "") {
  std::string safe;
  for (const char c : text)
    safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
         safe + "</text>\n";
}

std::string stroke(double x1, double y1, double x2, double y2, const char* style) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
         number(y2) + "\" " + style + "/>\n";
}

std::string axes(const Box& box) {
  std::string out;
  const double zero = box.x(0), bottom = box.top + box.height, end = box.left + box.width;
  out += "<rect x=\"" + number(zero) + "\" y=\"" + number(box.top) + "\" width=\"" + number(end - zero) +
         "\" height=\"" + number(box.height) + "\" fill=\"#fbeaea\"/>\n";
  constexpr const char* grid = "stroke=\"#e0e0e0\"";
  const double by = tick(box.real_max - box.real_min), up = tick(box.imag_max);
  const int decimals = by < 0.1 ? 2 : by < 1 ? 1 : 0, up_decimals = up < 0.1 ? 2 : up < 1 ? 1 : 0;
  for (int i = int(std::ceil(box.real_min / by)); i * by <= box.real_max; ++i) {
    out += stroke(box.x(i * by), box.top, box.x(i * by), bottom, grid);
    out += text_at(box.x(i * by), bottom + 16, fixed(i * by, decimals), "middle");
  }
  for (int i = 0; i * up <= box.imag_max; ++i) {
    out += stroke(box.left, box.y(i * up), end, box.y(i * up), grid);
    out += text_at(box.left - 6, box.y(i * up) + 4, fixed(i * up, up_decimals), "end");
  }
  out += stroke(zero, box.top, zero, bottom, "stroke=\"#808080\" stroke-width=\"1.5\"");
  out += stroke(box.left, bottom, end, bottom, "stroke=\"#808080\" stroke-width=\"1.5\"");
  out += text_at(box.left + box.width / 2, bottom + 34, "real part, 1/s", "middle");
  return out + text_at(box.left, box.top - 8, "imaginary part, rad/s", "start");
}

bool inside(const Box& box, const std::complex<double>& e) {
  return e.real() >= box.real_min && e.real() <= box.real_max && e.imag() <= box.imag_max;
}

/// Label at the first and the last airspeed: next to points of a rising curve, above points on the real axis.
std::string speed_label(const Mode& mode, std::size_t i, const std::vector<ModesAtSpeed>& sweep, double x,
                        double y) {
  if (i != 0 && i + 1 != sweep.size()) return "";
  const std::string speed = figures(sweep[i].airspeed_mps, 4);
  constexpr const char* small = " font-size=\"10\" fill=\"#606060\"";
  return mode.oscillates() ? text_at(x + 9, y + 4, speed, "start", small)
                           : text_at(x, y - 9, speed, "middle", small);
}

/// The points of one kind, small at the lowest airspeed and large at the highest.
std::string points(const Box& box, const std::vector<ModesAtSpeed>& sweep, ModeKind kind) {
  std::string out;
  const std::string colour = colours[std::size_t(kind)];
  for (std::size_t i = 0; i < sweep.size(); ++i)
    for (const Mode& mode : sweep[i].modes) {
      if (mode.kind != kind || !inside(box, mode.eigenvalue)) continue;
      const double part = sweep.size() > 1 ? double(i) / double(sweep.size() - 1) : 1;
      const double x = box.x(mode.eigenvalue.real()), y = box.y(mode.eigenvalue.imag());
      out += "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + number(2 + 3 * part) +
             "\" fill=\"" + colour + "\" fill-opacity=\"0.75\" stroke=\"#ffffff\" stroke-width=\"0.5\"/>\n";
      const bool slow = kind == ModeKind::phugoid || kind == ModeKind::spiral;
      if (slow == (box.number == 1)) out += speed_label(mode, i, sweep, x, y);
    }
  return out;
}

Box around(const std::vector<ModesAtSpeed>& sweep, Box box, double nearest) {
  double left = -0.1 * nearest, right = 0.1 * nearest, up = 0.2 * nearest;
  for (const ModesAtSpeed& at : sweep)
    for (const Mode& mode : at.modes) {
      if (std::abs(mode.eigenvalue) > nearest) continue;
      left = std::min(left, mode.eigenvalue.real());
      right = std::max(right, mode.eigenvalue.real());
      up = std::max(up, mode.eigenvalue.imag());
    }
  const double margin = 0.08 * (right - left);
  box.real_min = left - margin;
  box.real_max = right + margin;
  box.imag_max = 1.12 * up;
  return box;
}

/// Largest magnitude of all modes, or of the slow ones: phugoid and spiral.
double largest(const std::vector<ModesAtSpeed>& sweep, bool slow) {
  double found = 0.1;
  for (const ModesAtSpeed& at : sweep)
    for (const Mode& mode : at.modes)
      if (!slow || mode.kind == ModeKind::phugoid || mode.kind == ModeKind::spiral)
        found = std::max(found, std::abs(mode.eigenvalue));
  return 1.01 * found;
}

std::string legend(const std::vector<ModesAtSpeed>& sweep) {
  std::string out;
  double x = 70;
  for (std::size_t kind = 0; kind < colours.size(); ++kind) {
    bool there = false;
    for (const ModesAtSpeed& at : sweep)
      for (const Mode& mode : at.modes) there = there || std::size_t(mode.kind) == kind;
    if (!there) continue;
    out += "<circle cx=\"" + number(x) + "\" cy=\"456.0\" r=\"5\" fill=\"" + colours[kind] + "\"/>\n";
    out += text_at(x + 10, 460, mode_name(ModeKind(kind)), "start");
    x += 125;
  }
  return out;
}

}  // namespace

std::string modes_svg(const std::string& title, const std::vector<ModesAtSpeed>& sweep) {
  const Box all =
      around(sweep, {.number = 0, .left = 60, .top = 70, .width = 420, .height = 320}, largest(sweep, false));
  const Box near =
      around(sweep, {.number = 1, .left = 560, .top = 70, .width = 320, .height = 320}, largest(sweep, true));
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"475\" viewBox=\"0 0 900 475\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"900\" height=\"475\" fill=\"#ffffff\"/>\n";
  out += text_at(60, 28, title, "start", " font-size=\"15\"");
  for (const Box& box : {all, near}) {
    out += axes(box);
    for (std::size_t kind = 0; kind < colours.size(); ++kind) out += points(box, sweep, ModeKind(kind));
  }
  return out + legend(sweep) + "</svg>\n";
}

}  // namespace fulmar::aero
