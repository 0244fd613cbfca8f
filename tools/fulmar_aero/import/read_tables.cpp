// SPDX-License-Identifier: BSD-3-Clause
// Files in addition to the derivatives: polars with friction, VSPAERO's .flt, .history and .vspaero,
// OpenVSP's mass properties and parasite drag.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr double table_degree = std::numbers::pi / 180;

std::size_t column_named(const Lines& lines, std::size_t heading, const std::vector<std::string>& words,
                         const char* name) {
  const auto found = std::find(words.begin(), words.end(), name);
  if (found == words.end())
    refuse(lines.where(heading),
           aero_messages::column_missing(name, trimmed(lines.all[heading]).substr(0, 60)));
  return std::size_t(found - words.begin());
}

/// Columns by the names of the heading; surplus numbers are ignored (version 6.2 has 21 under 20 names).
std::vector<PolarPoint> polar_points(const Lines& lines, std::size_t heading, const char* angle,
                                     const char* CL, const char* CD, const char* sideslip,
                                     const char* friction, double& max_friction) {
  const std::vector<std::string> words = words_of(lines.all[heading]);
  const std::size_t a = column_named(lines, heading, words, angle),
                    l = column_named(lines, heading, words, CL), d = column_named(lines, heading, words, CD),
                    f = column_named(lines, heading, words, friction);
  const bool has_sideslip = std::find(words.begin(), words.end(), sideslip) != words.end();
  const std::size_t s = has_sideslip ? column_named(lines, heading, words, sideslip) : 0;
  std::vector<PolarPoint> points;
  for (std::size_t i = heading + 1; i < lines.all.size(); ++i) {
    if (trimmed(lines.all[i]).empty()) continue;
    const std::vector<double> values = numbers_at(lines, i, 0);
    if (values.empty()) break;
    if (values.size() < words.size())
      refuse(lines.where(i), aero_messages::row_incomplete(words.size(), values.size()));
    if (has_sideslip && std::abs(values[s]) > 0.01) continue;
    max_friction = std::max(max_friction, std::abs(values[f]));
    points.push_back({values[a] * table_degree, values[l], {values[d], lines.place(i, CD)}});
  }
  if (points.empty()) refuse(lines.where(heading), aero_messages::rows_missing());
  return points;
}

Input started(const Lines& lines, const char* what) {
  Input input;
  input.file = lines.file;
  input.what = what;
  return input;
}

/// All numbers of a line, with any text between them.
std::vector<double> numbers_among(const Lines& lines, std::size_t i) {
  std::vector<double> out;
  std::string word;
  for (const char c : lines.all[i] + " ") {
    if (c == ' ' || c == '\t' || c == ',' || c == '(' || c == ')' || c == ':') {
      if (!word.empty() && word.find_first_not_of("0123456789.+-eE") == std::string::npos &&
          word.find_first_of("0123456789") != std::string::npos)
        out.push_back(number_at(lines_of(lines.file, word), 0, 0, "a table"));
      word.clear();
    } else {
      word += c;
    }
  }
  return out;
}

/// The numbers of a label, on its line.
std::vector<double> labelled(const Lines& lines, const char* label, std::size_t count) {
  const auto line = lines.find(label);
  if (!line) refuse({lines.file, int(lines.all.size())}, aero_messages::labelled_line_missing(label));
  const std::vector<double> values = numbers_among(lines, *line);
  if (values.size() != count)
    refuse(lines.where(*line),
           fulmar::located(label, aero_messages::result_count_mismatch(count, values.size())));
  return values;
}

std::optional<std::string> element(const Lines& lines, const std::string& name, std::size_t from = 0) {
  const std::size_t begin = lines.text.find("<" + name + ">", from);
  if (begin == std::string::npos) return {};
  const std::size_t end = lines.text.find("</" + name + ">", begin);
  if (end == std::string::npos)
    refuse({lines.file, int(lines.all.size())}, aero_messages::end_tag_missing(name));
  return trimmed(lines.text.substr(begin + name.size() + 2, end - begin - name.size() - 2));
}

double element_number(const Lines& lines, const std::string& name, const std::string& text) {
  return number_at(lines_of(lines.file, text), 0, 0, "<" + name + ">");
}

std::optional<double> element_value(const Lines& lines, const std::string& name) {
  const auto text = element(lines, name);
  if (!text || text->empty()) return {};
  return element_number(lines, name, *text);
}

std::vector<double> triple(const Lines& lines, const std::string& name, std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  const std::vector<double> values = numbers_at(lines_of(lines.file, text), 0, 0);
  if (values.size() != 3)
    throw core::Error(located(lines.file, aero_messages::three_numbers_expected(name, text)));
  return values;
}

/// The number of the line, from 0, of a place in the text.
std::size_t line_at(const Lines& lines, std::size_t place) {
  return std::size_t(std::count(lines.text.begin(), lines.text.begin() + std::ptrdiff_t(place), '\n'));
}

/// Sum of the point masses; no text gives the place of the wings' own mass.
Body point_masses(const Lines& lines, double length, double mass_unit_kg) {
  double mass = 0, at[3] = {}, square[3] = {}, xz = 0;
  for (std::size_t from = lines.text.find("<Point_Mass>"); from != std::string::npos;
       from = lines.text.find("<Point_Mass>", from + 1)) {
    const auto own = element(lines, "Mass", from), place = element(lines, "coordinates", from);
    if (!own || !place) refuse(lines.where(line_at(lines, from)), aero_messages::point_mass_incomplete());
    const double m = element_number(lines, "Mass", *own) * mass_unit_kg;
    const std::vector<double> x = triple(lines, "coordinates", *place);
    mass += m;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] += m * x[k] * length;
      square[k] += m * x[k] * x[k] * length * length;
    }
    xz += m * x[0] * x[2] * length * length;
  }
  Body body;
  if (!(mass > 0)) return body;
  const std::string from = lines.place(*lines.find("<Point_Mass>"), "point masses");
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] /= mass;
    square[k] -= mass * at[k] * at[k];
    body.cg_m[k] = at[k];
  }
  body.mass_kg = {mass, from};
  body.xx = {square[1] + square[2], from};
  body.yy = {square[0] + square[2], from};
  body.zz = {square[0] + square[1], from};
  body.xz = {xz - mass * at[0] * at[2], from};
  body.has_cg = true;
  return body;
}

}  // namespace

Input read_xflr5_polar(const Lines& lines) {
  Input input = started(lines, "XFLR5 polar of a plane");
  if (const auto line = lines.find("Plane name")) {
    const std::size_t colon = lines.all[*line].find(':');
    if (colon != std::string::npos) input.title = trimmed(lines.all[*line].substr(colon + 1));
  }
  std::optional<std::size_t> heading;
  for (std::size_t i = 0; i < lines.all.size() && !heading; ++i)
    if (begins(trimmed(lines.all[i]), "alpha ")) heading = i;
  if (!heading) refuse({lines.file, int(lines.all.size())}, aero_messages::polar_heading_missing());
  double friction = 0;
  input.polar = polar_points(lines, *heading, "alpha", "CL", "CD", "Beta", "CDv", friction);
  if (friction > 0) return input;
  input.polar.clear();
  input.unused = "its CDv is 0: the polar is without friction; export one of type 1 or 2 with viscosity";
  return input;
}

Input read_xflr5_xml(const Lines& lines) {
  const bool polar = lines.has("<Plane_Polar");
  if (const char* const end = polar ? "</Plane_Polar>" : "</explane>"; !lines.has(end))
    refuse({lines.file, int(lines.all.size())}, aero_messages::document_end_missing(end));
  Input input = started(lines, polar ? "XFLR5 settings of a polar" : "XFLR5 plane");
  const double length = element_value(lines, "length_unit_to_meter").value_or(1);
  const double mass = element_value(lines, "mass_unit_to_kg").value_or(1);
  if (const auto name = element(lines, polar ? "Plane_Name" : "Name")) input.title = *name;
  if (!polar) {
    input.body = point_masses(lines, length, mass);
    if (!input.body.mass_kg.known)
      input.unused = "it has a drawing and no masses; the stability log has what is analysed";
    for (std::size_t from = lines.text.find("<Volume_Mass>"); from != std::string::npos;
         from = lines.text.find("<Volume_Mass>", from + 1))
      if (const auto text = element(lines, "Volume_Mass", from);
          text && element_number(lines, "Volume_Mass", *text) > 0) {
        input.body = Body();
        input.unused =
            "its wings have a mass that is spread over their volume, which the file does not place; the "
            "stability log has the sum";
      }
    return input;
  }
  const double inertia = element_value(lines, "inertia_unit_to_kgm2").value_or(mass * length * length);
  const auto own = element_value(lines, "Mass"), xx = element_value(lines, "CoG_Ixx"),
             yy = element_value(lines, "CoG_Iyy"), zz = element_value(lines, "CoG_Izz"),
             xz = element_value(lines, "CoG_Ixz");
  if (!own || !(*own > 0)) {
    input.unused = "it has settings and no mass";
    return input;
  }
  const std::string from = lines.place(*lines.find("<Mass>"), "<Inertia_Value>");
  input.body.mass_kg = {*own * mass, from};
  if (xx && yy && zz && *xx > 0) {
    input.body.xx = {*xx * inertia, from};
    input.body.yy = {*yy * inertia, from};
    input.body.zz = {*zz * inertia, from};
    input.body.xz = {xz.value_or(0) * inertia, from};
  }
  if (const auto place = element(lines, "CoG")) {
    const std::vector<double> x = triple(lines, "CoG", *place);
    input.body.cg_m = {x[0] * length, x[1] * length, x[2] * length};
    input.body.has_cg = true;
  }
  return input;
}

Input read_vspaero_flt(const Lines& lines) {
  Input input = started(lines, "VSPAERO .flt");
  const auto value = [&](const char* key) {
    const auto line = lines.find(key);
    if (!line) refuse({lines.file, int(lines.all.size())}, aero_messages::labelled_number_missing(key));
    return Value(number_at(lines, *line, lines.all[*line].find(key) + std::string(key).size(), key),
                 lines.place(*line, key));
  };
  input.polar.push_back({value("ALPHA_o:").x * table_degree, value("CLo:").x, value("CDo:")});
  // Up to 6.2 its CDo is the total, and the .stab is without friction. From 6.4 on it counts friction twice,
  // and the .stab is the total: it is used only when the .stab has no friction.
  input.notes.push_back(
      "of a .flt only the drag counts, and only when the derivatives have no friction: from VSPAERO 6.4 on "
      "it has friction twice");
  return input;
}

Input read_vspaero_polar(const Lines& lines) {
  Input input = started(lines, "VSPAERO polar");
  std::optional<std::size_t> heading;
  for (std::size_t i = 0; i < lines.all.size() && !heading; ++i)
    if (begins(trimmed(lines.all[i]), "Beta ")) heading = i;
  if (!heading) refuse({lines.file, int(lines.all.size())}, aero_messages::sweep_heading_missing());
  const std::vector<std::string> words = words_of(lines.all[*heading]);
  const bool total = std::find(words.begin(), words.end(), "CLtot") != words.end();
  double friction = 0;
  input.polar =
      polar_points(lines, *heading, "AoA", total ? "CLtot" : "CL", "CDtot", "Beta", "CDo", friction);
  return input;
}

Input read_vspaero_history(const Lines& lines) {
  Input input = started(lines, "VSPAERO history");
  input.unused = "it tells how the wake has converged, and no derivatives";
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::vector<std::string> words = words_of(lines.all[i]);
    if (words.empty() || words[0] != "Iter") continue;
    const bool total = std::find(words.begin(), words.end(), "CLtot") != words.end();
    const std::size_t CL = column_named(lines, i, words, total ? "CLtot" : "CL");
    std::vector<double> all;
    for (std::size_t k = i + 1; k < lines.all.size(); ++k) {
      const std::vector<double> values = numbers_at(lines, k, 0);
      if (values.size() <= CL) break;
      all.push_back(values[CL]);
    }
    const std::size_t n = all.size();
    if (n == 1) input.notes.push_back("only one iteration of the wake: nothing says that it has converged");
    if (n >= 2 && std::abs(all[n - 1] - all[n - 2]) > 1e-3)
      input.notes.push_back("in the last iteration of the wake CL still changed by " +
                            figures(all[n - 1] - all[n - 2]) + ": let it iterate more often (line " +
                            std::to_string(i + n + 1) + ")");
    break;  // the first case is the analysed flow
  }
  return input;
}

Input read_vspaero_setup(const Lines& lines) {
  Input input = started(lines, "VSPAERO set-up");
  const auto line = lines.find("NumberOfControlGroups");
  if (!line) {
    input.unused = "it has no groups of controls";
    return input;
  }
  const std::size_t equals = lines.all[*line].find('=');
  if (equals == std::string::npos) refuse(lines.where(*line), "NumberOfControlGroups: expected '='");
  const double count = number_at(lines, *line, equals + 1, "NumberOfControlGroups");
  for (std::size_t k = 0; k < std::size_t(std::max(0.0, count)); ++k) {
    const std::size_t at = *line + 1 + 4 * k;
    if (at + 3 >= lines.all.size())
      refuse({lines.file, int(lines.all.size())}, aero_messages::control_groups_missing(figures(count)));
    const std::vector<double> gains = numbers_among(lines, at + 2);
    const std::string& surfaces = lines.all[at + 1];
    const std::size_t count_of = 1 + std::size_t(std::count(surfaces.begin(), surfaces.end(), ','));
    if (gains.size() != count_of)
      refuse(lines.where(at + 2),
             aero_messages::gain_count_mismatch(count_of, trimmed(surfaces), gains.size()));
    double sum = 0;
    for (const double gain : gains) sum += std::abs(gain);
    if (!gains.empty()) input.gains.push_back({trimmed(lines.all[at]), sum / double(gains.size())});
  }
  if (input.gains.empty()) input.unused = "it has no groups of controls";
  return input;
}

Input read_vsp_masses(const Lines& lines, const ReadOptions& options) {
  Input input = started(lines, "OpenVSP mass properties");
  const double length = options.length_m > 0 ? options.length_m : 1;
  const std::vector<double> mass = labelled(lines, "Total Mass", 1),
                            at = labelled(lines, "Center of Gravity", 3),
                            square = labelled(lines, "Ixx, Iyy, Izz", 3),
                            mixed = labelled(lines, "Ixy, Ixz, Iyz", 3);
  if (!(mass[0] > 0))
    refuse(lines.where(*lines.find("Total Mass")), aero_messages::total_mass_not_positive(figures(mass[0])));
  const std::string from = lines.place(*lines.find("Ixx, Iyy, Izz"), "mass properties");
  Body& body = input.body;
  body.mass_kg = {mass[0], lines.place(*lines.find("Total Mass"), "Total Mass, in kg")};
  body.cg_m = {at[0] * length, at[1] * length, at[2] * length};
  body.has_cg = true;
  const double unit = length * length;
  body.xx = {square[0] * unit, from};
  body.yy = {square[1] * unit, from};
  body.zz = {square[2] * unit, from};
  body.xz = {mixed[1] * unit, from};  // x aft and z up: xz keeps its sign
  input.notes.push_back("OpenVSP does not say its unit of mass; taken as kg");
  return input;
}

Input read_vsp_drag(const Lines& lines) {
  Input input = started(lines, "OpenVSP parasite drag");
  // a table of components under a heading with C_D or Cd; the last row has the totals
  std::vector<std::string> heading;
  std::size_t column = 0;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines.all[i]);
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (const std::string cell = lower(cells[k]);
          heading.empty() && (cell == "cd" || cell == "c_d" || cell == "cd0")) {
        heading = cells;
        column = k;
      }
    const bool totals = std::any_of(cells.begin(), cells.end(),
                                    [](const std::string& cell) { return begins(lower(cell), "total"); });
    if (heading.empty() || !totals) continue;
    if (cells.size() != heading.size())
      refuse(lines.where(i), aero_messages::cell_count_mismatch(heading.size(), cells.size()));
    const Lines cell = lines_of(lines.file, cells[column].empty() ? "-" : cells[column]);
    const double CD = number_at(cell, 0, 0, "Totals, Cd");
    input.polar.push_back({0, 0, {CD, lines.place(i, "Totals, Cd")}});
  }
  if (input.polar.empty()) refuse({lines.file, int(lines.all.size())}, aero_messages::drag_table_missing());
  return input;
}

}  // namespace fulmar::aero::imports
