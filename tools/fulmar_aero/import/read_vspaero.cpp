// SPDX-License-Identifier: BSD-3-Clause
// VSPAERO's .stab, versions 2.1 to 7.2: body moments CMl, CMm, CMn (CMx and CMz have the other sign), CFy (CS
// is of the airflow), rates without dimension, angles and groups of controls per radian. Source: VSPAERO's
// vspaero.C, CalculateStabilityDerivatives.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

constexpr double stab_degree = std::numbers::pi / 180;

struct StabBlock {
  std::size_t first = 0, last = 0;
};

std::vector<StabBlock> stab_blocks(const Lines& lines) {
  std::vector<StabBlock> blocks;
  for (std::size_t i = 0; i < lines.all.size(); ++i)
    if (begins(trimmed(lines.all[i]), "Sref_")) blocks.push_back({i, lines.all.size()});
  for (std::size_t k = 0; k + 1 < blocks.size(); ++k) blocks[k].last = blocks[k + 1].first;
  return blocks;
}

/// "Sref_  0.51 Lunit^2", and "Sref_: 0.5135" of version 2.
std::optional<Pair> headed(const Lines& lines, const StabBlock& block, const std::string& key) {
  for (std::size_t i = block.first; i < block.last; ++i) {
    const std::string text = trimmed(lines.all[i]);
    if (begins(text, "Case") || begins(text, "Base")) break;
    if (!begins(text, key)) continue;
    const std::string rest = text.substr(key.size());
    if (rest.empty() || (rest[0] != ' ' && rest[0] != ':' && rest[0] != '_' && rest[0] != '\t')) continue;
    const std::size_t at = lines.all[i].find(key) + key.size();
    const std::size_t number = lines.all[i].find_first_not_of(" \t:_", at);
    if (number == std::string::npos)
      refuse(lines.where(i), fulmar::located(key, aero_messages::heading_number_expected()));
    return Pair{number_at(lines, i, number, key), i, ""};
  }
  return {};
}

double head_value(const Lines& lines, const StabBlock& block, const std::string& key) {
  if (const auto found = headed(lines, block, key)) return found->value;
  refuse(lines.where(block.first), aero_messages::heading_number_missing(key));
}

/// A row of the table of cases: its name, and twelve (in version 2 nine) numbers behind it.
struct CaseRow {
  std::string name;
  std::size_t line = 0;
};

/// Start of the numbers of a row, counted from the right: a group's name may hold blanks and numbers.
std::optional<CaseRow> case_row(const Lines& lines, std::size_t i) {
  const std::vector<std::string> words = words_of(lines.all[i]);
  if (words.size() < 10 || words[0][0] == '#') return {};
  std::size_t unit = words.size();
  for (std::size_t k = 0; k < words.size(); ++k)
    if (words[k] == "deg" || begins(words[k], "rad/") || words[k] == "n/a" || words[k] == "no_unit") unit = k;
  CaseRow row;
  row.line = i;
  if (unit == words.size() || unit == 0) return {};
  for (std::size_t k = 0; k + 1 < unit; ++k) row.name += (k == 0 ? "" : " ") + words[k];
  return row;
}

/// Names of the groups, in the order of the columns ConGrp_1, ConGrp_2, ...: from the rows after "Mach".
std::vector<CaseRow> groups_of(const Lines& lines, const StabBlock& block) {
  std::vector<CaseRow> groups;
  bool behind = false;
  for (std::size_t i = block.first; i < block.last; ++i) {
    const std::string text = trimmed(lines.all[i]);
    if (begins(text, "Coef") || begins(text, "#             Base")) break;
    const std::optional<CaseRow> row = case_row(lines, i);
    if (!row) continue;
    if (behind) groups.push_back(*row);
    if (row->name == "Mach") behind = true;
  }
  return groups;
}

constexpr std::array<std::string_view, 12> stab_rows{"CFx", "CFy", "CFz", "CMx", "CMy", "CMz",
                                                     "CL",  "CD",  "CS",  "CMl", "CMm", "CMn"};

struct Table {
  std::map<std::string, std::pair<std::size_t, std::vector<double>>> rows;
};

/// The rows "CL total alpha beta p q r Mach U groups..." under "Coef".
Table coefficients(const Lines& lines, const StabBlock& block, std::size_t groups) {
  Table table;
  std::size_t heading = block.last;
  for (std::size_t i = block.first; i < block.last; ++i)
    if (lines.all[i].find("Derivative:") != std::string::npos) {
      heading = i;
      break;
    }
  for (std::size_t i = heading; i < block.last; ++i) {
    const std::string& text = lines.all[i];
    const std::vector<std::string> words = words_of(text);
    // version 4.1 has more tables, whose rows are called CFx_p or CMm_(q + alpha_dot)
    if (words.empty() || std::find(stab_rows.begin(), stab_rows.end(), words[0]) == stab_rows.end()) continue;
    if (table.rows.count(words[0])) continue;
    const std::vector<double> values = numbers_at(lines, i, text.find(words[0]) + words[0].size());
    if (values.size() != 8 + groups)
      refuse(lines.where(i), fulmar::located(words[0], aero_messages::derivative_count_mismatch(
                                                           8 + groups, groups, values.size())));
    table.rows[words[0]] = {i, values};
  }
  return table;
}

Value cell(const Lines& lines, const Table& table, const std::string& row, std::size_t column,
           const std::string& by, double sign = 1) {
  const auto found = table.rows.find(row);
  return {sign * found->second.second[column],
          lines.place(found->second.first, row + " " + by + (sign < 0 ? ", sign turned" : ""))};
}

void refuse_missing(const Lines& lines, const StabBlock& block, const Table& table, const std::string& row) {
  if (!table.rows.count(row)) refuse(lines.where(block.last - 1), aero_messages::derivative_row_missing(row));
}

Column column_of(const Lines& lines, const Table& table, bool has_body, std::size_t k,
                 const std::string& by) {
  Column out;
  out[lift] = cell(lines, table, "CL", k, by);
  out[drag] = cell(lines, table, "CD", k, by);
  out[side] = cell(lines, table, "CFy", k, by);
  out[pitch] = has_body ? cell(lines, table, "CMm", k, by) : cell(lines, table, "CMy", k, by);
  out[roll] = has_body ? cell(lines, table, "CMl", k, by) : cell(lines, table, "CMx", k, by, -1);
  out[yaw] = has_body ? cell(lines, table, "CMn", k, by) : cell(lines, table, "CMz", k, by, -1);
  return out;
}

Analysis analysis_in(const Lines& lines, const StabBlock& block, double length) {
  const std::vector<CaseRow> groups = groups_of(lines, block);
  const Table table = coefficients(lines, block, groups.size());
  for (const char* row : {"CL", "CD", "CFy"}) refuse_missing(lines, block, table, row);
  const bool has_body = table.rows.count("CMl") && table.rows.count("CMm") && table.rows.count("CMn");
  if (!has_body)
    for (const char* row : {"CMx", "CMy", "CMz"}) refuse_missing(lines, block, table, row);
  Analysis a;
  const auto reference = [&](const char* key, double unit) {
    const auto found = headed(lines, block, key);
    if (!found) refuse(lines.where(block.first), aero_messages::heading_key_missing(key));
    if (!(found->value > 0))
      refuse(
          lines.where(found->line),
          fulmar::located(std::string(key), aero_messages::positive_value_expected(figures(found->value))));
    return Value(found->value * unit, lines.place(found->line, key));
  };
  a.area_m2 = reference("Sref_", length * length);
  a.chord_m = reference("Cref_", length);
  a.span_m = reference("Bref_", length);
  a.reference_m = {head_value(lines, block, "Xcg_") * length, head_value(lines, block, "Ycg_") * length,
                   head_value(lines, block, "Zcg_") * length};
  a.has_reference = true;
  const auto angle = headed(lines, block, "AoA");
  if (!angle) refuse(lines.where(block.first), aero_messages::heading_alpha_missing());
  a.alpha_rad = {angle->value * stab_degree, lines.place(angle->line, "AoA")};
  const double sideslip = head_value(lines, block, "Beta_");
  if (std::abs(sideslip) > 0.01) a.airspeed_mps = -1;  // reported by the caller
  if (a.airspeed_mps >= 0) a.airspeed_mps = head_value(lines, block, "Vinf_") * length;
  a.density_kgm3 = head_value(lines, block, "Rho_");
  a.base = column_of(lines, table, has_body, 0, "total");
  a.slope[alpha] = column_of(lines, table, has_body, 1, "by alpha");
  a.slope[beta] = column_of(lines, table, has_body, 2, "by beta");
  a.slope[p] = column_of(lines, table, has_body, 3, "by p");
  a.slope[q] = column_of(lines, table, has_body, 4, "by q");
  a.slope[r] = column_of(lines, table, has_body, 5, "by r");
  for (std::size_t k = 0; k < groups.size(); ++k) {
    Control control;
    control.name = groups[k].name;
    control.where = lines.where(groups[k].line);
    control.of = column_of(lines, table, has_body, 8 + k, "by " + groups[k].name);
    if (const auto at = headed(lines, block, groups[k].name)) control.at_rad = at->value * stab_degree;
    a.controls.push_back(control);
  }
  return a;
}

/// 0.01 deg, the step of version 7: an error of convergence grows by 5730 per radian.
bool small_steps(const Lines& lines) {
  const auto line = lines.find("Alpha ");
  return line && lines.all[*line].find("+0.010 deg") != std::string::npos;
}

}  // namespace

Input read_vspaero_stab(const Lines& lines, const ReadOptions& options) {
  Input input;
  input.file = lines.file;
  input.what = "VSPAERO stability derivatives";
  const std::vector<StabBlock> blocks = stab_blocks(lines);
  if (blocks.empty()) refuse({lines.file, 1}, aero_messages::heading_reference_missing());
  if (!lines.has("Derivative:"))
    refuse({lines.file, int(lines.all.size())}, aero_messages::derivative_table_missing());
  double length = options.length_m;
  const double rho = head_value(lines, blocks[0], "Rho_");
  if (length <= 0 && rho > 0.0005 && rho < 0.003) {
    length = 0.3048;
    input.notes.push_back("its density is " + std::to_string(rho).substr(0, 8) +
                          ", slug/ft3: lengths are taken as feet");
  } else if (length <= 0) {
    length = 1;
    input.notes.push_back("VSPAERO does not say its unit of length; taken as metre (--length-unit)");
  }
  std::size_t sideslips = 0;
  for (const StabBlock& block : blocks) {
    Analysis a = analysis_in(lines, block, length);
    if (a.airspeed_mps < 0) {
      ++sideslips;
      continue;
    }
    if (!input.analyses.empty() && a.controls.size() != input.analyses[0].controls.size())
      refuse(lines.where(block.first),
             aero_messages::control_groups_mismatch(a.controls.size(), input.analyses[0].controls.size()));
    if (rho < 0.003) a.density_kgm3 *= 14.593902937 / std::pow(0.3048, 3);
    a.rate_noise = small_steps(lines);
    if (a.controls.empty() && input.analyses.empty())
      input.notes.push_back("it has no groups of controls" +
                            std::string(lines.has("Base Aero") ? ": version 2 had none" : ""));
    input.airspeed_mps = a.airspeed_mps;
    input.analyses.push_back(std::move(a));
  }
  if (sideslips > 0)
    input.notes.push_back(std::to_string(sideslips) + " analyses in a sideslip are left out");
  if (input.analyses.empty())
    refuse(lines.where(blocks[0].first), aero_messages::straight_analysis_missing());
  if (small_steps(lines))
    input.notes.push_back(
        "its steps are 0.01 deg and 0.01 rad/s (VSPAERO 7): with default tolerances derivatives by rates are "
        "off by up to a half; tighten the solver's");
  if (lines.has("adjoint")) input.notes.push_back("adjoint derivatives in it are not read");
  return input;
}

}  // namespace fulmar::aero::imports
