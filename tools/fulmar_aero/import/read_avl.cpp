// SPDX-License-Identifier: BSD-3-Clause
// AVL's derivatives: stability (ST, .st), body (SB, .sb) and mixed axes (SM). Axes and signs: AVL 3.32 doc
// and source (aoutput.f). One exception: the control columns Cld, Cnd of the .st are in body axes although
// their row says x', z'; versions that number controls with two digits ("d01") turn them.
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr double avl_degree = std::numbers::pi / 180;

struct AvlControl {
  std::string name, index;  ///< "aileron", "d1"
};

/// The heading "aileron d1 elevator d2 ...": names in the order of the columns.
std::vector<AvlControl> avl_controls(const Lines& lines, std::size_t first) {
  for (std::size_t i = first; i < lines.all.size(); ++i) {
    const std::string& text = lines.all[i];
    if (text.find('=') != std::string::npos || text.find('|') != std::string::npos) continue;
    std::vector<AvlControl> controls;
    std::string name;
    for (const std::string& word : words_of(text)) {
      const bool index =
          word.size() >= 2 && word[0] == 'd' && word.find_first_not_of("0123456789", 1) == std::string::npos;
      if (index && !name.empty()) {
        controls.push_back({name, word});
        name.clear();
      } else {
        name += (name.empty() ? "" : " ") + word;
      }
    }
    if (!controls.empty()) return controls;
  }
  return {};
}

/// True when the heading lists deflections: derivatives by the controls must follow.
bool deflected(const Lines& lines) {
  const auto first = lines.find("CYff");
  for (std::size_t i = first ? *first + 1 : lines.all.size(); i < lines.all.size(); ++i) {
    if (lines.all[i].find("-----") != std::string::npos) break;
    if (lines.all[i].find('=') != std::string::npos) return true;
  }
  return false;
}

/// +1, or -1 where AVL's geometric axes (x aft, z up) reverse the sign of CX, CZ, Cl and Cn, and of u, w, p
/// and r.
double avl_sign(const Lines& lines) {
  if (lines.has("Standard axis orientation")) return 1;
  if (lines.has("Geometric axis orientation")) return -1;
  refuse({lines.file, 0}, aero_messages::axis_orientation_missing());
}

void read_avl_header(const Lines& lines, const Pairs& pairs, double length, double sign, Analysis& a) {
  a.area_m2 = pairs.value("Sref", length * length);
  a.chord_m = pairs.value("Cref", length);
  a.span_m = pairs.value("Bref", length);
  a.reference_m = {pairs.value("Xref").x * length, pairs.value("Yref").x * length,
                   pairs.value("Zref").x * length};
  a.has_reference = true;
  a.alpha_rad = pairs.value("Alpha", avl_degree);
  if (const Pair& beta = pairs.pair("Beta"); std::abs(beta.value) > 0.01)
    refuse(lines.where(beta.line), aero_messages::avl_sideslip(figures(beta.value)));
  a.base[lift] = pairs.value("CLtot");
  a.base[drag] = pairs.value("CDtot");
  a.base[side] = pairs.value("CYtot");
  a.base[roll] = pairs.value("Cltot", sign);
  a.base[pitch] = pairs.value("Cmtot");
  a.base[yaw] = pairs.value("Cntot", sign);
  if (pairs.has("CDvis")) a.drag_without_moment = pairs.value("CDvis").x;
}

/// ST, and SM (`body_rates`), whose moments and rates are about the body's axes.
void read_avl_st(const Lines& lines, const Pairs& pairs, double sign, const std::vector<AvlControl>& controls,
                 bool body_rates, Analysis& a) {
  const double rad = a.alpha_rad.x;
  const auto column = [&](Column& to, const char* by, double of_column, bool longitudinal) {
    const std::string b = by;
    to[lift] = pairs.value("CL" + b, of_column);
    to[side] = pairs.value("CY" + b, of_column);
    to[roll] = pairs.value("Cl" + b, sign * of_column);
    to[pitch] = pairs.value("Cm" + b, of_column);
    to[yaw] = pairs.value("Cn" + b, sign * of_column);
    if (pairs.has("CD" + b) && longitudinal) to[drag] = pairs.value("CD" + b, of_column);
  };
  column(a.slope[alpha], "a", 1, true);
  column(a.slope[beta], "b", 1, false);
  column(a.slope[p], "p", sign, false);
  column(a.slope[q], "q", 1, true);
  column(a.slope[r], "r", sign, false);
  if (!body_rates) {
    for (const By by : {alpha, beta, q}) turn_moments(a.slope[by], rad);
    turn_rates(a.slope, rad);
  }
  const bool turned =
      !body_rates && lines.has("force CD") && !controls.empty() && controls[0].index.size() >= 3;
  for (const AvlControl& one : controls) {
    Control control;
    control.name = one.name;
    control.where = lines.where(pairs.pair("CL" + one.index).line);
    const double per_rad = 1 / avl_degree;  // AVL's are per unit of the control variable, a degree
    Column& to = control.of;
    to[lift] = pairs.value("CL" + one.index, per_rad);
    to[side] = pairs.value("CY" + one.index, per_rad);
    to[roll] = pairs.value("Cl" + one.index, sign * per_rad);
    to[pitch] = pairs.value("Cm" + one.index, per_rad);
    to[yaw] = pairs.value("Cn" + one.index, sign * per_rad);
    if (pairs.has("CDff" + one.index) || !lines.has("Neutral point"))  // else the file is cut off before it
      to[drag] = pairs.value("CDff" + one.index, per_rad);
    if (turned) turn_moments(to, rad);
    if (pairs.has(one.name)) control.at_rad = pairs.value(one.name).x * avl_degree;
    a.controls.push_back(control);
  }
}

/// Of CX and CZ, body axes, in a flow of this angle of attack.
Value lift_of(const Value& X, const Value& Z, double rad) {
  return {X.x * std::sin(rad) - Z.x * std::cos(rad), Z.from + ", CX of it, turned to the airflow"};
}
Value drag_of(const Value& X, const Value& Z, double rad) {
  return {-X.x * std::cos(rad) - Z.x * std::sin(rad), X.from + ", CZ of it, turned to the airflow"};
}

void read_avl_sb(const Lines& lines, const Pairs& pairs, double sign, const std::vector<AvlControl>& controls,
                 Analysis& a) {
  const double rad = a.alpha_rad.x, c = std::cos(rad), s = std::sin(rad);
  const Value CX = pairs.value("CXtot", sign), CZ = pairs.value("CZtot", sign);
  struct Row {
    Value X, Z;
    Column of;
  };
  const auto row = [&](const std::string& by, double column) {
    Row out;
    out.X = pairs.value("CX" + by, sign * column);
    out.Z = pairs.value("CZ" + by, sign * column);
    out.of[side] = pairs.value("CY" + by, column);
    out.of[roll] = pairs.value("Cl" + by, sign * column);
    out.of[pitch] = pairs.value("Cm" + by, column);
    out.of[yaw] = pairs.value("Cn" + by, sign * column);
    out.of[lift] = lift_of(out.X, out.Z, rad);
    out.of[drag] = drag_of(out.X, out.Z, rad);
    return out;
  };
  // u, v, w are velocities of unit airspeed, u = cos(alpha), w = sin(alpha)
  const Row u = row("u", sign), v = row("v", 1), w = row("w", sign);
  for (std::size_t i = 0; i < forces; ++i)
    a.slope[alpha][i] = {w.of[i].x * c - u.of[i].x * s, w.of[i].from + " and by u"};
  const double X = w.X.x * c - u.X.x * s, Z = w.Z.x * c - u.Z.x * s;
  a.slope[alpha][lift].x = X * s + CX.x * c - Z * c + CZ.x * s;
  a.slope[alpha][drag].x = -X * c + CX.x * s - Z * s - CZ.x * c;
  a.slope[beta] = v.of;
  a.slope[p] = row("p", sign).of;
  a.slope[q] = row("q", 1).of;
  a.slope[r] = row("r", sign).of;
  for (const AvlControl& one : controls) {
    Control control;
    control.name = one.name;
    const std::size_t line = pairs.pair("CX" + one.index).line;
    control.where = lines.where(line);
    control.of = row(one.index, 1).of;
    for (Value& value : control.of) value.x /= avl_degree;
    if (pairs.has(one.name)) control.at_rad = pairs.value(one.name).x * avl_degree;
    a.controls.push_back(control);
  }
}

}  // namespace

Input read_avl_derivatives(const Lines& lines, const ReadOptions& options) {
  Input input;
  const bool stability = lines.has("Stability-axis derivatives"),
             body = lines.has("Geometry-axis derivatives"),
             mixed = lines.has(" Derivatives...") || lines.has("\nDerivatives...");
  input.file = lines.file;
  input.what = stability ? "AVL stability derivatives"
               : body    ? "AVL body derivatives"
                         : "AVL derivatives (SM)";
  if (!stability && !body && !mixed) {
    input.what = "AVL forces";
    if (const auto line = lines.find("Neutral point"); line || lines.has("derivatives"))
      refuse({lines.file, int(lines.all.size())}, aero_messages::avl_derivatives_missing());
    input.unused = "it has forces and no derivatives; AVL's ST writes them";
    return input;
  }
  if (const auto line = lines.find("Configuration:"))
    input.title = trimmed(lines.all[*line].substr(lines.all[*line].find(':') + 1));
  const double length = options.length_m > 0 ? options.length_m : 1;
  const Pairs pairs(lines, 0, lines.all.size(), "AVL");
  const double sign = avl_sign(lines);
  const std::size_t first = *lines.find(stability ? "Stability-axis derivatives"
                                        : body    ? "Geometry-axis derivatives"
                                                  : "Derivatives...");
  const std::vector<AvlControl> controls = avl_controls(lines, first);
  if (controls.empty() && deflected(lines))
    refuse({lines.file, int(lines.all.size())}, aero_messages::control_derivatives_missing());
  Analysis a;
  read_avl_header(lines, pairs, length, sign, a);
  if (body)
    read_avl_sb(lines, pairs, sign, controls, a);
  else
    read_avl_st(lines, pairs, sign, controls, mixed, a);
  if (controls.empty()) input.notes.push_back("it has no control surfaces");
  if (stability && !controls.empty() && controls[0].index.size() >= 3 && !lines.has("force CD"))
    input.doubts.push_back(aero_messages::derivative_axes_unknown());
  if (lines.has("Symmetry:"))
    input.notes.push_back(
        "half of the aircraft was analysed with a plane of symmetry: forces to the side are AVL's");
  if (options.length_m <= 0)
    input.notes.push_back(
        "AVL does not say its unit of length; taken as metre (--length-unit, or the .mass file)");
  input.analyses.push_back(a);
  return input;
}

}  // namespace fulmar::aero::imports
