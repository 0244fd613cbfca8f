// SPDX-License-Identifier: BSD-3-Clause
// JSBSim's XML, as far as Fulmar's model has it: functions that are one product of numbers, the dynamic
// pressure, S, b or c, and at most one state or one table over states. Axes LIFT, DRAG, SIDE of the airflow,
// ROLL, PITCH, YAW of the body; US units. Source: JSBSim reference manual, section 3.1 (aerodynamics). All
// else is refused by its name.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/rosflight.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

struct Element {
  std::string name, attributes, text;
  std::vector<Element> children;
  std::size_t line = 0;

  const Element* child(const std::string& wanted) const {
    for (const Element& one : children)
      if (one.name == wanted) return &one;
    return nullptr;
  }
  std::string attribute(const std::string& key) const {
    const std::size_t at = attributes.find(key + "=");
    if (at == std::string::npos || at + key.size() + 2 > attributes.size()) return "";
    const char quote = attributes[at + key.size() + 1];
    const std::size_t begin = at + key.size() + 2, end = attributes.find(quote, begin);
    return end == std::string::npos ? "" : attributes.substr(begin, end - begin);
  }
};

/// Elements, attributes, text and comments: what aircraft files have of XML.
class XmlReader {
 public:
  explicit XmlReader(const Lines& lines) : lines_(lines), text_(lines.text) {}

  Element root() {
    Element top;
    read_into(top, 0);
    if (top.children.empty()) refuse(lines_.where(0), "expected <fdm_config>");
    return top.children[0];
  }

 private:
  std::size_t line() const {
    return std::size_t(
        std::count(text_.begin(), text_.begin() + std::ptrdiff_t(std::min(at_, text_.size())), '\n'));
  }

  void read_into(Element& parent, int depth) {
    if (depth > 50) refuse(lines_.where(line()), "elements are nested deeper than 50");
    while (true) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string::npos) {
        if (!parent.name.empty())
          refuse(lines_.where(parent.line), "<" + parent.name + "> does not end; is the file cut off?");
        return;
      }
      parent.text += text_.substr(at_, open - at_);
      at_ = open;
      if (skipped("<!--", "-->") || skipped("<?", "?>") || skipped("<!", ">")) continue;
      const std::size_t close = text_.find('>', open);
      if (close == std::string::npos)
        refuse(lines_.where(line()), "a tag does not end; is the file cut off?");
      std::string tag = text_.substr(open + 1, close - open - 1);
      const std::size_t here = line();
      at_ = close + 1;
      if (!tag.empty() && tag[0] == '/') {
        if (trimmed(tag.substr(1)) != parent.name)
          refuse(lines_.where(here), "expected </" + parent.name + ">; found <" + tag + ">");
        return;
      }
      const bool empty = !tag.empty() && tag.back() == '/';
      if (empty) tag.pop_back();
      Element child;
      child.line = here;
      const std::size_t blank = tag.find_first_of(" \t\r\n");
      child.name = tag.substr(0, blank);
      if (blank != std::string::npos) child.attributes = tag.substr(blank);
      if (!empty) read_into(child, depth + 1);
      parent.children.push_back(std::move(child));
    }
  }
  bool skipped(const char* begin, const char* end) {
    if (text_.compare(at_, std::string(begin).size(), begin) != 0) return false;
    const std::size_t stop = text_.find(end, at_);
    if (stop == std::string::npos)
      refuse(lines_.where(line()), std::string(begin) + " does not end; is the file cut off?");
    at_ = stop + std::string(end).size();
    return true;
  }

  const Lines& lines_;
  const std::string& text_;
  std::size_t at_ = 0;
};

const Element& needed_child(const Lines& lines, const Element& parent, const std::string& name) {
  if (const Element* const found = parent.child(name)) return *found;
  refuse(lines.where(parent.line), "<" + parent.name + ">: expected <" + name + "> and did not find it");
}

double number_in(const Lines& lines, const Element& element) {
  std::string text = trimmed(element.text);
  return number_at(lines_of(lines.where(element.line).text(), text.empty() ? "?" : text), 0, 0,
                   "<" + element.name + ">");
}

/// In SI; JSBSim's default units are US ones.
Value measured(const Lines& lines, const Element& parent, const std::string& name,
               const std::map<std::string, double>& units, const char* usual) {
  const Element& element = needed_child(lines, parent, name);
  const std::string unit = element.attribute("unit").empty() ? usual : element.attribute("unit");
  const auto factor = units.find(unit);
  if (factor == units.end()) {
    std::string valid;
    for (const auto& [known, x] : units) valid += (valid.empty() ? "" : ", ") + known;
    refuse(lines.where(element.line),
           "<" + name + ">: '" + unit + "' is no unit that is known; valid: " + valid);
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

/// What a table may be over: Fulmar's name, and radians of one unit.
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
constexpr std::size_t most_tables = 8, most_rows = 32, most_columns = 16, most_cells = 256;

/// Over one state, or over two: values by rows.
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
  refuse(lines.where(variable.line), who + ": a table over '" + property + "' is not read; valid: " + valid);
}

void refuse_points(const Lines& lines, const Element& table, const std::string& who,
                   const std::vector<double>& at) {
  for (std::size_t i = 1; i < at.size(); ++i)
    if (!(at[i] > at[i - 1]))
      refuse(lines.where(table.line), who + ": the points of a table must rise; " + figures(at[i - 1]) +
                                          " is followed by " + figures(at[i]));
}

LookUp table_of(const Lines& lines, const Element& table, const std::string& who) {
  LookUp out;
  for (const Element& part : table.children) {
    if (part.name == "tableData") continue;
    if (part.name != "independentVar")
      refuse(lines.where(part.line), who + ": <" + part.name + "> in a table is not read");
    const std::string lookup = part.attribute("lookup");
    if (lookup == "table") refuse(lines.where(part.line), who + ": a table over three states is not read");
    (lookup == "column" ? out.and_over : out.over) = &axis_of(lines, part, who);
  }
  if (!out.over) refuse(lines.where(table.line), who + ": expected <independentVar> in the table");
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
      refuse(lines.where(data.line + i),
             who + ": expected " + (wanted > 0 ? std::to_string(wanted) + " numbers" : "points") +
                 " in this row of the table; found '" + trimmed(rows.all[i]) + "'");
    if (heading) {
      for (const double x : numbers) out.and_at.push_back(x * out.and_over->unit);
      continue;
    }
    out.at.push_back(numbers[0] * out.over->unit);
    out.values.insert(out.values.end(), numbers.begin() + 1, numbers.end());
  }
  if (out.at.empty()) refuse(lines.where(data.line), who + ": the table is empty");
  if (out.at.size() > most_rows || out.and_at.size() > most_columns || out.values.size() > most_cells)
    refuse(lines.where(data.line), who + ": the table has " + std::to_string(out.at.size()) + " by " +
                                       std::to_string(std::max<std::size_t>(1, out.and_at.size())) +
                                       " points; at most 32 by 16 and 256 values are read");
  refuse_points(lines, table, who, out.at);
  refuse_points(lines, table, who, out.and_at);
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
  if (begins(property, "-")) out.number = -out.number, property = property.substr(1);
  for (const State& one : states)
    if (property == one.property) {
      ++out.states_in, out.term = one.term;
      return;
    }
  if (property == "aero/qbar-psf")
    ++out.pressure;
  else if (property == "metrics/Sw-sqft")
    ++out.area;
  else if (property == "aero/qbar-area")
    ++out.pressure, ++out.area;
  else if (property == "metrics/bw-ft")
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
    refuse(lines.where(line),
           who + ": " + what +
               " is not read; expected one <product> of a <value>, aero/qbar-psf, metrics/Sw-sqft, "
               "metrics/bw-ft or cbarw-ft, aero/bi2vel or ci2vel, and a state or a <table>");
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

std::string list_text(const std::vector<double>& numbers, double factor = 1) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : ", ") + figures(x * factor, 7);
  return "[" + text + "]";
}

std::string table_line(const LookUp& table, const char* coefficient, double factor, const std::string& from) {
  std::string text = std::string("    - {coefficient: ") + coefficient + ", over: " + table.over->name +
                     ", at: " + list_text(table.at);
  if (table.and_over)
    text += std::string(", and_over: ") + table.and_over->name + ", and_at: " + list_text(table.and_at);
  return text + ", values: " + list_text(table.values, factor) + "}  # " + from + "\n";
}

/// What of the drag has the induced one in it already.
struct Drag {
  bool over_alpha = false, squared = false;
};

void take_function(const Lines& lines, const Element& function, Force force, Aircraft& a,
                   std::vector<std::string>& tables, Drag& of_drag) {
  const Product product = product_of(lines, function);
  const bool moment = force == roll || force == pitch || force == yaw;
  const bool by_rate = product.term == t_p || product.term == t_q || product.term == t_r;
  const int lengths = product.chord + product.span;
  const std::string who = "function '" + function.attribute("name") + "'";
  if (product.pressure != 1 || product.area != 1 || lengths != (moment ? 1 : 0) ||
      product.by_span + product.by_chord != (by_rate ? 1 : 0))
    refuse(lines.where(function.line), who +
                                           ": expected the dynamic pressure and S once, b or c once in "
                                           "moments alone, and bi2vel or ci2vel with rates alone");
  if (product.states_in + int(product.tables.size()) + product.lift_squared > 1)
    refuse(lines.where(function.line),
           who + ": expected one state or one table at most; a product of two is not read");
  const double own = force == pitch ? a.chord_m.x : a.span_m.x,
               given = product.chord ? a.chord_m.x : a.span_m.x;
  double value = product.number * (moment ? given / own : 1);
  if (by_rate)
    value *= (product.by_chord ? a.chord_m.x : a.span_m.x) / (product.term == t_q ? a.chord_m.x : a.span_m.x);
  const std::string from = lines.place(function.line, function.attribute("name"));
  if (!product.tables.empty()) {
    constexpr std::array<const char*, forces> names{"lift", "drag", "side", "roll", "pitch", "yaw"};
    const LookUp& table = product.tables[0];
    if (tables.size() == most_tables)
      refuse(lines.where(function.line), who + ": it is the ninth table, and an airframe has at most 8");
    tables.push_back(table_line(table, names[force], value, from));
    for (const Axis* const axis : {table.over, table.and_over})
      if (axis && force == drag && std::string(axis->name) == "alpha") of_drag.over_alpha = true;
    return;
  }
  if (product.lift_squared == 1) {
    const double AR = a.span_m.x * a.span_m.x / a.area_m2.x;
    if (force != drag || !(value > 0) || of_drag.squared)
      refuse(lines.where(function.line),
             who + ": aero/cl-squared is read once, in drag, with a positive factor");
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

/// An induced drag that cannot be told from 0.
constexpr double no_induced_drag = 1e6;

void finish_drag(const std::vector<std::string>& tables, const Drag& of_drag, Aircraft& a) {
  if (!tables.empty()) {
    a.more_aero += "  tables:  # a flight that leaves them ends\n";
    for (const std::string& table : tables) a.more_aero += table;
  }
  a.converted_parasite = a.parasite.x;
  if (!of_drag.over_alpha || of_drag.squared) return;
  a.oswald = {no_induced_drag, "none: the file's drag over alpha has the induced one in it"};
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
    if (!(value->x > 0)) throw core::Error(value->from + ": expected more than 0");
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
  std::vector<std::string> tables;
  Drag of_drag;
  for (const Element& part : needed_child(lines, root, "aerodynamics").children) {
    if (part.name != "axis")
      refuse(lines.where(part.line),
             "<aerodynamics>: <" + part.name + "> is not read; expected <axis> alone");
    const auto force = axes.find(part.attribute("name"));
    if (force == axes.end())
      refuse(lines.where(part.line),
             "axis '" + part.attribute("name") + "' is not read; valid: LIFT, DRAG, SIDE, ROLL, PITCH, YAW");
    for (const Element& function : part.children) {
      if (function.name != "function")
        refuse(lines.where(function.line),
               "<axis>: <" + function.name + "> is not read; expected <function>");
      take_function(lines, function, force->second, a, tables, of_drag);
    }
  }
  finish_drag(tables, of_drag, a);
  return a;
}

}  // namespace fulmar::aero::imports
