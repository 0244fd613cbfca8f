// SPDX-License-Identifier: BSD-3-Clause
// XFLR5's stability log: derivatives in stability axes at the trimmed angle of attack, rates with the
// reference span and, for q, the plane's mean aerodynamic chord. Source: XFLR5 6.54, PlaneOpp and
// StabDerivatives; A. Deperrois, "Stability analysis in XFLR5" (2010).
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr double xflr5_gravity = 9.81;  // the value in its state matrices

/// One control position of one analysis: lines first..last-1.
struct LogBlock {
  std::size_t head = 0, first = 0, last = 0;
  double position = 0, rotated = 0;
};

std::vector<LogBlock> blocks_of(const Lines& lines) {
  std::vector<LogBlock> blocks;
  std::size_t head = 0;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    if (lines.all[i].find("Launching Analysis") != std::string::npos) head = i;
    if (const std::size_t at = lines.all[i].find("Calculation for control position"); at != std::string::npos)
      blocks.push_back({head, i, lines.all.size(), number_at(lines, i, at + 32, "control position"), 0});
  }
  for (std::size_t k = 0; k + 1 < blocks.size(); ++k) blocks[k].last = blocks[k + 1].first;
  for (LogBlock& block : blocks)
    for (std::size_t i = block.first; i < block.last; ++i)
      if (const std::size_t at = lines.all[i].find("total angle is"); at != std::string::npos)
        block.rotated = std::max(block.rotated, std::abs(number_at(lines, i, at + 14, "total angle")));
  return blocks;
}

bool has_derivatives(const Lines& lines, const LogBlock& block) {
  const auto at = lines.find("Longitudinal derivatives", block.first);
  return at && *at < block.last;
}

/// The block with zero deflections: the derivatives of the aircraft as drawn.
LogBlock chosen(const Lines& lines, std::vector<std::string>& notes) {
  const std::vector<LogBlock> all = blocks_of(lines);
  std::optional<LogBlock> best;
  int usable = 0;
  for (const LogBlock& block : all) {
    if (!has_derivatives(lines, block)) continue;
    ++usable;
    if (!best || block.rotated < best->rotated) best = block;
  }
  if (best) {
    if (usable > 1)
      notes.push_back("it has " + std::to_string(usable) + " analyses; taken is the one on line " +
                      std::to_string(best->first + 1) + ", with its surfaces turned by " +
                      std::to_string(best->rotated).substr(0, 4) + " deg at most");
    return *best;
  }
  if (const auto failed = lines.find("Unsuccessfull attempt to trim"))
    refuse(lines.where(*failed), aero_messages::xflr5_trim_missing());
  if (const auto type = lines.find("Type "); type && lines.all[*type].find("Type 7") == std::string::npos)
    refuse(lines.where(*type), aero_messages::log_type_mismatch(trimmed(lines.all[*type])));
  const auto last = all.empty() ? lines.all.size() : all.back().last;
  refuse({lines.file, int(last)}, aero_messages::longitudinal_derivatives_missing());
}

double with_unit(const Lines& lines, const Pair& pair, const std::string& key,
                 const std::optional<double>& factor) {
  if (!factor)
    refuse(lines.where(pair.line), fulmar::located(key, aero_messages::log_unit_unknown(pair.unit)));
  return pair.value * *factor;
}

struct LogHead {
  double density = 0;
  Value area, span;
};

/// "Reference Area   =     0.51348m²": keys of several words.
double after(const Lines& lines, const std::string& key, std::size_t first, std::size_t last,
             std::string& unit, std::size_t& line) {
  const auto at = lines.find(key, first);
  if (!at || *at >= last) refuse({lines.file, int(last)}, aero_messages::log_value_missing(key));
  line = *at;
  const std::string& text = lines.all[line];
  const std::size_t equals = text.find('=', text.find(key));
  if (equals == std::string::npos) refuse(lines.where(line), key + ": expected '='");
  std::size_t end = 0;
  const double number = number_at(lines, line, equals + 1, key, &end);
  unit = trimmed(text.substr(end));
  unit = unit.substr(0, unit.find_first_of(" \t"));
  return number;
}

LogHead head_of(const Lines& lines, const LogBlock& block) {
  LogHead head;
  std::string unit;
  std::size_t line = 0;
  head.density = after(lines, "Density", block.head, block.first, unit, line);
  if (!begins(unit, "kg")) {
    if (!begins(unit, "slug")) refuse(lines.where(line), aero_messages::density_unit_unknown(unit));
    head.density *= 14.593902937 / std::pow(0.3048, 3);
  }
  const double area = after(lines, "Reference Area", block.head, block.first, unit, line);
  head.area = {with_unit(lines, {area, line, unit}, "Reference Area", area_unit(unit)),
               lines.place(line, "Reference Area")};
  const double span = after(lines, "Reference length", block.head, block.first, unit, line);
  head.span = {with_unit(lines, {span, line, unit}, "Reference length", length_unit(unit)),
               lines.place(line, "Reference length, the span")};
  if (!(head.density > 0 && head.area.x > 0 && head.span.x > 0))
    refuse(lines.where(line), aero_messages::log_reference_not_positive(
                                  figures(head.density), figures(head.area.x), figures(head.span.x)));
  return head;
}

Body body_of(const Lines& lines, const Pairs& pairs) {
  Body body;
  const auto value = [&](const char* key, const auto& unit) {
    const Pair& pair = pairs.pair(key);
    return Value(with_unit(lines, pair, key, unit(pair.unit)), lines.place(pair.line, key));
  };
  body.mass_kg = value("Mass", mass_unit);
  body.cg_m = {value("CoG_x", length_unit).x, value("CoG_y", length_unit).x, value("CoG_z", length_unit).x};
  body.has_cg = true;
  body.xx = value("Ibxx", inertia_unit);
  body.yy = value("Ibyy", inertia_unit);
  body.zz = value("Ibzz", inertia_unit);
  body.xz = value("Ibxz", inertia_unit);  // as entered: the integral of x z dm
  return body;
}

/// "Alpha=4.01774°", "VInf = 14.70616 m/s"
Value trimmed_at(const Lines& lines, const LogBlock& block, const std::string& key) {
  for (std::size_t i = block.first; i < block.last; ++i) {
    const std::size_t at = lines.all[i].find(key);
    if (at == std::string::npos) continue;
    const std::size_t equals = lines.all[i].find('=', at);
    if (equals != std::string::npos) return {number_at(lines, i, equals + 1, key), lines.place(i, key)};
  }
  refuse(lines.where(block.last - 1), aero_messages::trim_value_missing(key));
}

Value negative(Value value) {
  value.x = -value.x;
  value.from += ", sign turned";
  return value;
}

void read_control(const Lines& lines, const LogBlock& block, const Pairs& pairs, double rad, Analysis& a) {
  const std::size_t first = block.first, last = block.last;
  if (!pairs.has("CXde")) {
    for (const char* behind :
         {"No active control", "longitudinal modes", "Longitudinal modes", "Finished operating point"})
      if (const auto at = lines.find(behind, first); at && *at < last) return;
    refuse({lines.file, int(last)}, aero_messages::log_control_missing());
  }
  Control control;
  control.where = lines.where(pairs.pair("CXde").line);
  Column& to = control.of;
  to[drag] = negative(pairs.value("CXde"));
  to[lift] = negative(pairs.value("CZde"));
  to[side] = pairs.value("CYde");
  to[roll] = pairs.value("CLde");
  to[pitch] = pairs.value("CMde");
  to[yaw] = pairs.value("CNde");
  turn_moments(to, rad);
  a.controls.push_back(control);
}

/// "Eigenvalue:     -5.788+   -7.204i   | ...": those with an imaginary part of at least 0.
std::vector<std::complex<double>> eigenvalues_at(const Lines& lines, std::size_t line) {
  std::vector<std::complex<double>> values;
  std::size_t at = lines.all[line].find(':') + 1;
  while (at < lines.all[line].size()) {
    std::size_t end = 0;
    const double real = number_at(lines, line, at, "Eigenvalue", &end);
    const std::size_t plus = lines.all[line].find('+', end);
    if (plus == std::string::npos) refuse(lines.where(line), aero_messages::eigenvalue_form_invalid());
    const double imaginary = number_at(lines, line, plus + 1, "Eigenvalue", &end);
    if (imaginary >= 0) values.push_back({real, imaginary});
    const std::size_t bar = lines.all[line].find('|', end);
    if (bar == std::string::npos) break;
    at = bar + 1;
  }
  return values;
}

void read_printed(const Lines& lines, const LogBlock& block, PrintedModes& modes) {
  for (const bool longitudinal : {true, false}) {
    const auto title = lines.find(longitudinal ? "Longitudinal modes" : "Lateral modes", block.first);
    if (!title || *title >= block.last) continue;
    const auto line = lines.find("Eigenvalue:", *title);
    if (!line || *line >= block.last) continue;
    (longitudinal ? modes.longitudinal : modes.lateral) = eigenvalues_at(lines, *line);
    modes.from = lines.place(*line);
  }
}

}  // namespace

Input read_xflr5_log(const Lines& lines) {
  Input input;
  input.file = lines.file;
  input.what = "XFLR5 stability log";
  const LogBlock block = chosen(lines, input.notes);
  const LogHead head = head_of(lines, block);
  if (const auto type = lines.find("Type 7", block.head); type && *type > 0)
    input.title = trimmed(lines.all[*type - 1]);
  const Pairs pairs(lines, block.first, block.last, "XFLR5");
  input.body = body_of(lines, pairs);
  Analysis a;
  a.area_m2 = head.area;
  a.span_m = head.span;
  a.reference_m = input.body.cg_m;
  a.has_reference = true;
  a.alpha_rad = trimmed_at(lines, block, "Alpha");
  a.alpha_rad.x *= std::numbers::pi / 180;
  const Value speed = trimmed_at(lines, block, "VInf");
  a.airspeed_mps = speed.x;
  if (!(speed.x > 0))
    refuse(lines.where(block.first), aero_messages::log_airspeed_not_positive(figures(speed.x)));
  a.density_kgm3 = head.density;
  const double rad = a.alpha_rad.x, flow = 0.5 * head.density * speed.x * head.area.x;
  // the chord of q is the plane's, which is not printed: Mw = Cma c rho V S / 2
  const Value Cma = pairs.value("Cma");
  if (Cma.x == 0) refuse(lines.where(pairs.pair("Cma").line), aero_messages::log_chord_unknown());
  a.chord_m = {pairs.value("Mw").x / (Cma.x * flow),
               lines.place(pairs.pair("Mw").line, "Mw / (Cma rho V S/2)")};
  const double CL = input.body.mass_kg.x * xflr5_gravity / (flow * speed.x);
  const Value CD(-0.5 * pairs.value("Cxu").x,
                 lines.place(pairs.pair("Cxu").line, "-Cxu/2, without friction"));
  a.base[lift] = {CL, speed.from + ", the weight at that speed"};
  a.base[drag] = CD;
  a.base[pitch] = {0, a.alpha_rad.from + ", trimmed there"};
  for (const Force force : {side, roll, yaw}) a.base[force] = {0, lines.place(block.first, "symmetric")};
  Column& by_alpha = a.slope[alpha];
  by_alpha[lift] = {pairs.value("CLa").x - CD.x, lines.place(pairs.pair("CLa").line, "CLa - CD")};
  by_alpha[drag] = {CL - pairs.value("Cxa").x, lines.place(pairs.pair("Cxa").line, "CL - Cxa")};
  by_alpha[pitch] = Cma;
  a.slope[q][lift] = pairs.value("CLq");
  a.slope[q][pitch] = pairs.value("Cmq");
  const auto lateral = [&](By by, const char* of) {
    a.slope[by][side] = pairs.value(std::string("CY") + of);
    a.slope[by][roll] = pairs.value(std::string("Cl") + of);
    a.slope[by][yaw] = pairs.value(std::string("Cn") + of);
  };
  lateral(beta, "b");
  lateral(p, "p");
  lateral(r, "r");
  turn_moments(a.slope[beta], rad);
  turn_rates(a.slope, rad);
  read_control(lines, block, pairs, rad, a);
  if (a.controls.empty())
    input.notes.push_back("no control was active in this analysis: it has no control derivatives");
  a.weak_lateral = true;
  read_printed(lines, block, input.modes);
  input.modes.airspeed_mps = speed.x;
  input.modes.density_kgm3 = head.density;
  input.airspeed_mps = speed.x;
  input.analyses.push_back(a);
  return input;
}

}  // namespace fulmar::aero::imports
