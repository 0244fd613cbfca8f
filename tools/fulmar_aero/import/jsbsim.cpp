// SPDX-License-Identifier: BSD-3-Clause
// JSBSim's XML, within the limits of Fulmar's model: functions that are one product of numbers, the dynamic
// pressure, S, b or c, and at most one state or one table over states. Axes LIFT, DRAG, SIDE of the airflow,
// ROLL, PITCH, YAW of the body; US units. Source: JSBSim reference manual, section 3.1 (aerodynamics). All
// else is rejected with its name.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/import/xml_elements.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

double number_in(const Lines& lines, const Element& element) {
  std::string text = trimmed(element.text);
  return number_at(lines_of(lines.where(element.line).text(), text.empty() ? "?" : text), 0, 0,
                   "<" + element.name + ">");
}

/// In SI; JSBSim's default units are US customary ones.
Value measured(const Lines& lines, const Element& parent, const std::string& name,
               const std::map<std::string, double>& units, const char* usual) {
  const Element& element = needed_child(lines, parent, name);
  const std::string unit = element.attribute("unit").empty() ? usual : element.attribute("unit");
  const auto factor = units.find(unit);
  if (factor == units.end()) {
    std::string valid;
    for (const auto& [known, x] : units) valid += (valid.empty() ? "" : ", ") + known;
    refuse(lines.where(element.line), aero_messages::element_unit_unknown(name, unit, valid));
  }
  return {number_in(lines, element) * factor->second, lines.place(element.line, name)};
}

struct State {
  const char* property;
  Term term;
};
constexpr std::array<State, 12> states{{{"aero/alpha-rad", t_alpha},
                                        {"aero/beta-rad", t_beta},
                                        {"velocities/p-aero-rad_sec", t_p},
                                        {"velocities/q-aero-rad_sec", t_q},
                                        {"velocities/r-aero-rad_sec", t_r},
                                        {"velocities/p-rad_sec", t_p},
                                        {"velocities/q-rad_sec", t_q},
                                        {"velocities/r-rad_sec", t_r},
                                        {"fcs/elevator-pos-rad", t_elevator},
                                        {"fcs/left-aileron-pos-rad", t_aileron},
                                        {"fcs/aileron-pos-rad", t_aileron},
                                        {"fcs/rudder-pos-rad", t_rudder}}};

/// Possible independent variable of a table: its name in Fulmar, and radians of one unit.
struct Axis {
  const char *property, *name;
  double unit;
};
constexpr double table_degree_rad = std::numbers::pi / 180;
constexpr std::array<Axis, 12> axes_of_tables{{{"aero/alpha-rad", "alpha", 1},
                                               {"aero/alpha-deg", "alpha", table_degree_rad},
                                               {"aero/beta-rad", "beta", 1},
                                               {"aero/beta-deg", "beta", table_degree_rad},
                                               {"velocities/mach", "mach", 1},
                                               {"fcs/elevator-pos-rad", "elevator", 1},
                                               {"fcs/elevator-pos-deg", "elevator", table_degree_rad},
                                               {"fcs/left-aileron-pos-rad", "aileron", 1},
                                               {"fcs/left-aileron-pos-deg", "aileron", table_degree_rad},
                                               {"fcs/aileron-pos-rad", "aileron", 1},
                                               {"fcs/rudder-pos-rad", "rudder", 1},
                                               {"fcs/rudder-pos-deg", "rudder", table_degree_rad}}};
constexpr std::size_t max_tables = 8, max_rows = 32, max_columns = 16, max_cells = 256;

/// A table over one or two variables: values by rows.
struct LookUp {
  const Axis *over = nullptr, *and_over = nullptr;
  std::vector<double> at, and_at, values;
};

const Axis& axis_of(const Lines& lines, const Element& variable, const std::string& who) {
  const std::string property = trimmed(variable.text);
  std::string valid;
  for (const Axis& axis : axes_of_tables) {
    if (property == axis.property) return axis;
    valid += std::string(valid.empty() ? "" : ", ") + axis.property;
  }
  refuse(lines.where(variable.line),
         fulmar::located(who, aero_messages::table_axis_unsupported(property, valid)));
}

void refuse_points(const Lines& lines, const Element& table, const std::string& who,
                   const std::vector<double>& at, const Axis* axis) {
  for (std::size_t i = 1; i < at.size(); ++i)
    if (!(at[i] > at[i - 1]))
      refuse(lines.where(table.line),
             fulmar::located(who, aero_messages::table_points_not_increasing(figures(at[i - 1] / axis->unit),
                                                                             figures(at[i] / axis->unit))));
}

LookUp table_of(const Lines& lines, const Element& table, const std::string& who) {
  const auto no = [&](std::size_t line, const Diagnostic& why) {
    refuse(lines.where(line), fulmar::located(who, why));
  };
  LookUp out;
  for (const Element& part : table.children) {
    if (part.name == "tableData") continue;
    if (part.name != "independentVar") no(part.line, aero_messages::table_element_unsupported(part.name));
    const std::string lookup = part.attribute("lookup");
    if (lookup == "table") no(part.line, aero_messages::table_states_unsupported());
    (lookup == "column" ? out.and_over : out.over) = &axis_of(lines, part, who);
  }
  if (!out.over)
    refuse(lines.where(table.line), fulmar::located(who, aero_messages::table_variable_missing()));
  const Element& data = needed_child(lines, table, "tableData");
  const Lines rows = lines_of(lines.file, data.text);
  for (std::size_t i = 0; i < rows.all.size(); ++i) {
    if (trimmed(rows.all[i]).empty()) continue;
    const Lines row = lines_of(lines.where(data.line + i).text(), rows.all[i]);
    std::vector<double> numbers = numbers_at(row, 0, 0);
    const bool heading = out.and_over && out.and_at.empty();
    const std::size_t wanted = heading ? 0 : 1 + std::max<std::size_t>(1, out.and_at.size());
    if (numbers.empty() || numbers.size() != words_of(rows.all[i]).size() ||
        (wanted > 0 && numbers.size() != wanted))
      no(data.line + i,
         aero_messages::table_row_invalid(wanted > 0 ? std::to_string(wanted) + " numbers" : "points",
                                          trimmed(rows.all[i])));
    if (heading) {
      for (const double x : numbers) out.and_at.push_back(x * out.and_over->unit);
      continue;
    }
    out.at.push_back(numbers[0] * out.over->unit);
    out.values.insert(out.values.end(), numbers.begin() + 1, numbers.end());
  }
  if (out.at.empty()) no(data.line, aero_messages::table_empty());
  if (out.at.size() > max_rows || out.and_at.size() > max_columns || out.values.size() > max_cells)
    no(data.line, aero_messages::table_too_large(out.at.size(), std::max<std::size_t>(1, out.and_at.size())));
  refuse_points(lines, table, who, out.at, out.over);
  refuse_points(lines, table, who, out.and_at, out.and_over);
  return out;
}

/// The factors of one product.
struct Product {
  double number = 1;
  int states_in = 0, pressure = 0, area = 0, chord = 0, span = 0, by_chord = 0, by_span = 0, lift_squared = 0;
  Term term = t_zero;
  std::vector<LookUp> tables;
};

void take_property(std::string property, Product& out, std::string& unknown) {
  if (begins(property, "-")) {
    out.number = -out.number;
    property = property.substr(1);
  }
  for (const State& one : states)
    if (property == one.property) {
      ++out.states_in;
      out.term = one.term;
      return;
    }
  if (property == "aero/qbar-psf")
    ++out.pressure;
  else if (property == "metrics/Sw-sqft")
    ++out.area;
  else if (property == "aero/qbar-area") {
    ++out.pressure;
    ++out.area;
  } else if (property == "metrics/bw-ft")
    ++out.span;
  else if (property == "metrics/cbarw-ft")
    ++out.chord;
  else if (property == "aero/bi2vel")
    ++out.by_span;
  else if (property == "aero/ci2vel")
    ++out.by_chord;
  else if (property == "aero/cl-squared")
    ++out.lift_squared;
  else
    unknown = "the property '" + property + "'";
}

Product product_of(const Lines& lines, const Element& function) {
  const std::string who = "function '" + function.attribute("name") + "'";
  const auto no = [&](std::size_t line, const std::string& what) {
    refuse(lines.where(line), fulmar::located(who, aero_messages::function_factor_unsupported(what)));
  };
  Product out;
  for (const Element& part : function.children)
    if (part.name != "product" && part.name != "description") no(part.line, "<" + part.name + ">");
  const Element& product = needed_child(lines, function, "product");
  for (const Element& factor : product.children) {
    if (factor.name == "description") continue;
    if (factor.name == "value" || factor.name == "v") {
      out.number *= number_in(lines, factor);
      continue;
    }
    if (factor.name == "table") {
      out.tables.push_back(table_of(lines, factor, who));
      continue;
    }
    if (factor.name != "property" && factor.name != "p") no(factor.line, "<" + factor.name + ">");
    std::string unknown;
    take_property(trimmed(factor.text), out, unknown);
    if (!unknown.empty()) no(factor.line, unknown);
  }
  return out;
}

std::string list_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : ", ") + figures(x, 7);
  return "[" + text + "]";
}

std::string table_line(const LookUp& table, const char* coefficient, const std::string& from) {
  std::string text = std::string("    - {coefficient: ") + coefficient + ", over: " + table.over->name +
                     ", at: " + list_text(table.at);
  if (table.and_over)
    text += std::string(", and_over: ") + table.and_over->name + ", and_at: " + list_text(table.and_at);
  return text + ", values: " + list_text(table.values) + "}  # " + from + "\n";
}

/// Drag terms that already include the induced drag.
struct Drag {
  bool over_alpha = false, squared = false;
};

/// A table of a coefficient, with Fulmar's sign.
struct CoefficientLookUp {
  Force force = lift;
  LookUp table;
  std::string from;
};
using Tables = std::vector<CoefficientLookUp>;

void take_function(const Lines& lines, const Element& function, Force force, Aircraft& a, Tables& tables,
                   Drag& of_drag) {
  const Product product = product_of(lines, function);
  const bool moment = force == roll || force == pitch || force == yaw;
  const bool by_rate = product.term == t_p || product.term == t_q || product.term == t_r;
  const int lengths = product.chord + product.span;
  const std::string who = "function '" + function.attribute("name") + "'";
  if (product.pressure != 1 || product.area != 1 || lengths != (moment ? 1 : 0) ||
      product.by_span + product.by_chord != (by_rate ? 1 : 0))
    refuse(lines.where(function.line), fulmar::located(who, aero_messages::function_factors_invalid()));
  if (product.states_in + int(product.tables.size()) + product.lift_squared > 1)
    refuse(lines.where(function.line), fulmar::located(who, aero_messages::function_product_unsupported()));
  const double own = force == pitch ? a.chord_m.x : a.span_m.x,
               given = product.chord ? a.chord_m.x : a.span_m.x;
  double value = product.number * (moment ? given / own : 1);
  if (by_rate)
    value *= (product.by_chord ? a.chord_m.x : a.span_m.x) / (product.term == t_q ? a.chord_m.x : a.span_m.x);
  const std::string from = lines.place(function.line, function.attribute("name"));
  if (!product.tables.empty()) {
    LookUp table = product.tables[0];
    if (tables.size() == max_tables)
      refuse(lines.where(function.line), fulmar::located(who, aero_messages::too_many_tables()));
    for (double& x : table.values) x *= value;
    tables.push_back({force, table, from});
    for (const Axis* const axis : {table.over, table.and_over})
      if (axis && force == drag && std::string(axis->name) == "alpha") of_drag.over_alpha = true;
    return;
  }
  if (product.lift_squared == 1) {
    const double AR = a.span_m.x * a.span_m.x / a.area_m2.x;
    if (force != drag || !(value > 0) || of_drag.squared)
      refuse(lines.where(function.line), fulmar::located(who, aero_messages::lift_squared_invalid()));
    of_drag.squared = true;
    a.oswald = {1 / (std::numbers::pi * value * AR), from + ", 1/(pi AR factor)"};
    return;
  }
  if (force == drag && product.term == t_zero) {
    a.parasite = {a.parasite.x + value, from};
    return;
  }
  if (force == drag && product.term == t_alpha && value != 0) of_drag.over_alpha = true;
  Value& to = a.c[force][product.term];
  to = {to.x + value, to.known ? to.from + " and " + function.attribute("name") : from};
}

/// Oswald factor of a drag polar without induced drag.
constexpr double no_induced_drag = 1e6;

void put_tables(const Tables& tables, Aircraft& a) {
  constexpr std::array<const char*, forces> names{"lift", "drag", "side", "roll", "pitch", "yaw"};
  if (!tables.empty()) a.more_aero += "  tables:  # a flight that leaves them ends\n";
  for (const CoefficientLookUp& one : tables)
    a.more_aero += table_line(one.table, names[one.force], one.from);
}

void finish_drag(const Drag& of_drag, Aircraft& a) {
  a.converted_parasite = a.parasite.x;
  if (!of_drag.over_alpha || of_drag.squared) return;
  a.oswald = {no_induced_drag, "none: the file's drag over alpha has the induced one in it"};
}

/// For a lift or a pitching moment that is a table over the angle of attack alone: the tangent at 3 deg gives
/// constant and slope, which laws and trims need. The table keeps the difference.
void take_line(CoefficientLookUp& of, Aircraft& a) {
  LookUp& t = of.table;
  if ((of.force != lift && of.force != pitch) || a.c[of.force][t_alpha].known || t.and_over ||
      std::string(t.over->name) != "alpha" || t.at.size() < 2)
    return;
  std::size_t upper = 1;
  while (upper + 1 < t.at.size() && t.at[upper] < 3 * table_degree_rad) ++upper;
  const double slope = (t.values[upper] - t.values[upper - 1]) / (t.at[upper] - t.at[upper - 1]);
  const double zero = t.values[upper] - slope * t.at[upper];
  for (std::size_t i = 0; i < t.at.size(); ++i) {
    t.values[i] -= zero + slope * t.at[i];
    if (std::abs(t.values[i]) < 1e-12) t.values[i] = 0;
  }
  a.c[of.force][t_alpha] = {slope, of.from + ", its line at 3 deg"};
  Value& to = a.c[of.force][t_zero];
  to = {to.x + zero, of.from + ", its line at 3 deg"};
  of.from += ", less that line";
}

/// Point of action of the forces, from the centre of gravity, m.
struct Arm {
  double aft = 0, up = 0;
};

/// JSBSim's forces act at AERORP (reference manual, section 2.2.1; FGAerodynamics::Run): moments include
/// their arms about the centre of gravity. In body axes N = CL cos(alpha) + CD sin(alpha) and
/// A = CD cos(alpha) - CL sin(alpha), so Cm -= (N aft - A up) / c, Cn -= CY aft / b, Cl += CY up / b.
class Mover {
 public:
  Mover(Aircraft& a, const Arm& arm) : a_(a), arm_(arm), c_(a.chord_m.x), b_(a.span_m.x) {}

  void derivatives() {
    for (std::size_t i = 0; i < terms; ++i) {
      const Term term = Term(i);
      const double CL = a_.c[lift][term].x, CD = a_.c[drag][term].x, CY = a_.c[side][term].x;
      add(pitch, term, pitching(CL, CD));
      add(yaw, term, -CY * arm_.aft / b_);
      add(roll, term, CY * arm_.up / b_);
    }
    const double AR = b_ * b_ / a_.area_m2.x, CL = a_.c[lift][t_zero].x;
    const double CD = a_.parasite.x + CL * CL / (std::numbers::pi * AR * a_.oswald.x);
    const double CD_alpha = 2 * CL * a_.c[lift][t_alpha].x / (std::numbers::pi * AR * a_.oswald.x);
    add(pitch, t_zero, pitching(0, CD));
    add(pitch, t_alpha, pitching(CD, CD_alpha - CL));  // the axes of the airflow turn with alpha
  }

  /// Moment of a force table about the centre of gravity: tables of the moments.
  void table(const CoefficientLookUp& of, Tables& out) const {
    const auto moment = [&](Force force, auto factor) {
      CoefficientLookUp more = of;
      more.force = force;
      const std::size_t columns = std::max<std::size_t>(1, of.table.and_at.size());
      double most = 0;
      for (std::size_t i = 0; i < of.table.values.size(); ++i) {
        const double alpha = is_alpha(of.table.over)       ? of.table.at[i / columns]
                             : is_alpha(of.table.and_over) ? of.table.and_at[i % columns]
                                                           : 0;
        more.table.values[i] *= factor(alpha);
        most = std::max(most, std::abs(more.table.values[i]));
      }
      more.from += ", moved to the centre of gravity";
      if (most > 1e-6) out.push_back(more);
    };
    if (of.force == lift)
      moment(pitch, [&](double x) { return pitching(std::cos(x), -std::sin(x)); });
    else if (of.force == drag)
      moment(pitch, [&](double x) { return pitching(std::sin(x), std::cos(x)); });
    else if (of.force == side) {
      moment(yaw, [&](double) { return -arm_.aft / b_; });
      moment(roll, [&](double) { return arm_.up / b_; });
    }
  }

 private:
  static bool is_alpha(const Axis* axis) { return axis && std::string(axis->name) == "alpha"; }
  double pitching(double normal, double aft) const { return (aft * arm_.up - normal * arm_.aft) / c_; }
  void add(Force force, Term term, double x) {
    if (std::abs(x) < 1e-9) return;
    Value& to = a_.c[force][term];
    const std::string moved = "moved to the centre of gravity";
    if (!to.known)
      to = {x, moved};
    else if (to.x += x; to.from.find(moved) == std::string::npos)
      to.from += ", " + moved;
  }

  Aircraft& a_;
  Arm arm_;
  double c_, b_;
};

/// x aft, y right, z up, m; none when the file has no such place.
std::optional<std::array<double, 3>> place_of(const Lines& lines, const Element& parent,
                                              const std::string& name) {
  for (const Element& one : parent.children) {
    if (one.name != "location" || one.attribute("name") != name) continue;
    const std::string unit = one.attribute("unit").empty() ? "IN" : one.attribute("unit");
    const std::map<std::string, double> units{{"IN", 0.0254}, {"FT", 0.3048}, {"M", 1}};
    if (units.count(unit) == 0) refuse(lines.where(one.line), aero_messages::location_unit_unknown(unit));
    std::array<double, 3> at{};
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = number_in(lines, needed_child(lines, one, axes[i])) * units.at(unit);
    return at;
  }
  return {};
}

void move_moments(const Lines& lines, const Element& metrics, const Element& mass, Aircraft& a,
                  Tables& tables) {
  const auto point = place_of(lines, metrics, "AERORP"), centre = place_of(lines, mass, "CG");
  if (!point || !centre) {
    a.notes.push_back(aero_messages::moment_reference_missing(point ? "CG" : "AERORP"));
    return;
  }
  const Arm arm{(*point)[0] - (*centre)[0], (*point)[2] - (*centre)[2]};
  if (std::abs((*point)[1] - (*centre)[1]) > 1e-3 * a.span_m.x)
    a.warnings.push_back(aero_messages::moment_reference_beside());
  if (std::abs(arm.aft) + std::abs(arm.up) < 1e-3 * a.chord_m.x) return;
  Mover move(a, arm);
  move.derivatives();
  Tables more;
  for (const CoefficientLookUp& one : tables) move.table(one, more);
  if (tables.size() + more.size() > max_tables)
    refuse(lines.where(metrics.line), aero_messages::too_many_moment_tables(tables.size() + more.size()));
  tables.insert(tables.end(), more.begin(), more.end());
  a.notes.push_back(aero_messages::moments_moved(figures(arm.aft, 3), figures(arm.up, 3)));
}

}  // namespace

bool is_jsbsim(const Lines& lines) { return lines.has("<fdm_config"); }

Aircraft jsbsim_aircraft(const Lines& lines) {
  const Element root = XmlReader(lines).root();
  if (root.name != "fdm_config")
    refuse(lines.where(root.line), "expected <fdm_config>; found <" + root.name + ">");
  Aircraft a;
  a.sources.push_back("JSBSim aircraft: " + lines.place(0).substr(0, lines.place(0).rfind(':')));
  a.name = root.attribute("name");
  constexpr double ft = 0.3048, slug = 14.593902937, lb = 0.45359237;
  const std::map<std::string, double> lengths{{"FT", ft}, {"IN", 0.0254}, {"M", 1}};
  const Element &metrics = needed_child(lines, root, "metrics"),
                &mass = needed_child(lines, root, "mass_balance");
  a.area_m2 = measured(lines, metrics, "wingarea", {{"FT2", ft * ft}, {"M2", 1}}, "FT2");
  a.span_m = measured(lines, metrics, "wingspan", lengths, "FT");
  a.chord_m = measured(lines, metrics, "chord", lengths, "FT");
  for (const Value* value : {&a.area_m2, &a.span_m, &a.chord_m})
    if (!(value->x > 0))
      throw core::Error(located(value->from, aero_messages::positive_value_expected(
                                                 figures(value->x) + (value == &a.area_m2 ? " m2" : " m"))));
  const std::map<std::string, double> inertias{{"SLUG*FT2", slug * ft * ft}, {"KG*M2", 1}};
  a.mass_kg = measured(lines, mass, "emptywt", {{"LBS", lb}, {"KG", 1}}, "LBS");
  a.xx = measured(lines, mass, "ixx", inertias, "SLUG*FT2");
  a.yy = measured(lines, mass, "iyy", inertias, "SLUG*FT2");
  a.zz = measured(lines, mass, "izz", inertias, "SLUG*FT2");
  a.xz = mass.child("ixz") ? measured(lines, mass, "ixz", inertias, "SLUG*FT2") : Value(0, "not in the file");
  if (a.xz.x != 0)
    a.warnings.push_back("ixz is taken as the integral of x z dm; versions of JSBSim differ in its sign");
  a.notes.push_back("mass is the empty weight; point masses and tanks are not counted");
  a.parasite = {0, "not in the file"};
  const std::map<std::string, Force> axes{{"LIFT", lift}, {"DRAG", drag},   {"SIDE", side},
                                          {"ROLL", roll}, {"PITCH", pitch}, {"YAW", yaw}};
  Tables tables;
  Drag of_drag;
  for (const Element& part : needed_child(lines, root, "aerodynamics").children) {
    if (part.name != "axis")
      refuse(lines.where(part.line), aero_messages::aerodynamics_element_unsupported(part.name));
    const auto force = axes.find(part.attribute("name"));
    if (force == axes.end())
      refuse(lines.where(part.line), aero_messages::axis_unsupported(part.attribute("name")));
    for (const Element& function : part.children) {
      if (function.name != "function")
        refuse(lines.where(function.line), aero_messages::axis_element_unsupported(function.name));
      take_function(lines, function, force->second, a, tables, of_drag);
    }
  }
  finish_drag(of_drag, a);
  for (CoefficientLookUp& table : tables) take_line(table, a);
  move_moments(lines, metrics, mass, a, tables);
  put_tables(tables, a);
  return a;
}

}  // namespace fulmar::aero::imports
