// SPDX-License-Identifier: BSD-3-Clause
// OpenVSP's results as CSV (WriteResultsCSVFile, "Export to *.csv"): blocks that begin with "Results_Name,X",
// with a key and its values on each line. Source: OpenVSP's ResultsMgr.cpp, VSPAEROMgr.cpp (ReadStabFile),
// ParasiteDragMgr.cpp.
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

struct ResultRow {
  std::size_t line = 0;
  std::vector<std::string> cells;  ///< behind the key
};

struct ResultBlock {
  std::string name;
  std::size_t line = 0, last = 0;
  std::map<std::string, ResultRow> rows;
};

std::vector<ResultBlock> blocks_in(const Lines& lines) {
  std::vector<ResultBlock> blocks;
  for (std::size_t i = 0; i < lines.all.size(); ++i) {
    std::vector<std::string> cells = cells_of(lines.all[i]);
    const std::string key = cells[0];
    if (key == "Results_Name") {
      if (cells.size() < 2 || cells[1].empty()) refuse(lines.where(i), aero_messages::result_name_missing());
      blocks.push_back({cells[1], i, i + 1, {}});
    }
    if (blocks.empty() || key.empty()) continue;
    cells.erase(cells.begin());
    blocks.back().rows.emplace(key, ResultRow{i, std::move(cells)});
    blocks.back().last = i + 1;
  }
  return blocks;
}

class ResultReader {
 public:
  ResultReader(const Lines& lines, const ResultBlock& block) : lines_(lines), block_(block) {}

  bool has(const std::string& key) const { return block_.rows.count(key) > 0; }
  std::vector<double> numbers(const std::string& key, std::size_t count) const {
    const auto found = block_.rows.find(key);
    if (found == block_.rows.end())
      refuse(lines_.where(block_.last - 1), aero_messages::result_row_missing(key, block_.name));
    const ResultRow& row = found->second;
    if (row.cells.size() != count && count > 0)
      refuse(lines_.where(row.line),
             fulmar::located(key, aero_messages::result_count_mismatch(count, row.cells.size())));
    std::vector<double> values;
    for (const std::string& cell : row.cells) values.push_back(number(row.line, key, cell));
    return values;
  }
  Value value(const std::string& key, double factor = 1) const {
    return {numbers(key, 1)[0] * factor, lines_.place(block_.rows.at(key).line, key)};
  }
  Value positive(const std::string& key, double factor) const {
    const Value out = value(key, factor);
    if (!(out.x > 0))
      refuse(lines_.where(block_.rows.at(key).line),
             fulmar::located(key, aero_messages::positive_value_expected(figures(out.x / factor))));
    return out;
  }
  const ResultBlock& block() const { return block_; }

 private:
  double number(std::size_t line, const std::string& key, const std::string& cell) const {
    const Lines one = lines_of("", cell.empty() ? " " : cell);
    const auto foreign = cell.find_first_not_of("0123456789.+-eE");
    if (cell.empty() || foreign != std::string::npos)
      refuse(lines_.where(line), fulmar::located(key, aero_messages::result_number_expected(cell)));
    return number_at(one, 0, 0, lines_.where(line).text() + ": " + key);
  }

  const Lines& lines_;
  const ResultBlock& block_;
};

Body body_of_result(const ResultReader& in, double length) {
  const double unit = length * length;
  Body body;
  body.mass_kg = in.positive("Total_Mass", 1);
  const std::vector<double> at = in.numbers("Total_CG", 3);
  for (std::size_t k = 0; k < 3; ++k) body.cg_m[k] = at[k] * length;
  body.has_cg = true;
  body.xx = in.value("Total_Ixx", unit);
  body.yy = in.value("Total_Iyy", unit);
  body.zz = in.value("Total_Izz", unit);
  body.xz = in.value("Total_Ixz", unit);  // x aft and z up: xz keeps its sign
  return body;
}

constexpr std::array<const char*, 8> plain_columns{"Total", "Alpha", "Beta", "p", "q", "r", "Mach", "U"};

/// "CMl_<group>" for columns other than the plain ones, in alphabetical order as in the file.
std::vector<std::string> groups_in(const ResultBlock& block, const std::string& row) {
  std::vector<std::string> groups;
  for (const auto& [key, cells] : block.rows) {
    if (!begins(key, row + "_")) continue;
    const std::string group = key.substr(row.size() + 1);
    bool plain = false;
    for (const char* const column : plain_columns) plain = plain || group == column;
    if (!plain) groups.push_back(group);
  }
  return groups;
}

Analysis stability_of_result(const Lines& lines, const ResultReader& in, double length) {
  const auto column = [&](const std::string& by) {
    Column out;
    out[lift] = in.value("CL_" + by);
    out[drag] = in.value("CD_" + by);
    out[side] = in.value("CFy_" + by);
    out[roll] = in.value("CMl_" + by);
    out[pitch] = in.value("CMm_" + by);
    out[yaw] = in.value("CMn_" + by);
    return out;
  };
  const auto head = [&](const std::string& key) {
    return in.has("FC_" + key) ? "FC_" + key : "FC_" + key + "_";
  };
  Analysis a;
  a.area_m2 = in.positive(head("Sref"), length * length);
  a.chord_m = in.positive(head("Cref"), length);
  a.span_m = in.positive(head("Bref"), length);
  a.reference_m = {in.value(head("Xcg")).x * length, in.value(head("Ycg")).x * length,
                   in.value(head("Zcg")).x * length};
  a.has_reference = true;
  a.alpha_rad = in.value(head("AoA"), std::numbers::pi / 180);
  if (const Value beta_deg = in.value(head("Beta")); std::abs(beta_deg.x) > 0.01)
    refuse(lines.where(in.block().line), aero_messages::result_sideslip(head("Beta")));
  a.airspeed_mps = in.value(head("Vinf")).x * length;
  a.density_kgm3 = in.value(head("Rho")).x;
  a.base = column("Total");
  a.slope = {column("Alpha"), column("Beta"), column("p"), column("q"), column("r")};
  for (const std::string& group : groups_in(in.block(), "CMl")) {
    Control control;
    control.name = group;
    control.where = lines.where(in.block().line);
    control.of = column(group);
    a.controls.push_back(control);
  }
  return a;
}

}  // namespace

Input read_vsp_results(const Lines& lines, const ReadOptions& options) {
  Input input;
  input.file = lines.file;
  input.what = "OpenVSP results";
  const double length = options.length_m > 0 ? options.length_m : 1;
  std::string others;
  for (const ResultBlock& block : blocks_in(lines)) {
    const ResultReader in(lines, block);
    if (block.name == "Parasite_Drag") {
      input.polar.push_back({0, 0, in.value("Total_CD_Total")});
    } else if (block.name == "Mass_Properties") {
      input.body = body_of_result(in, length);
      input.notes.push_back("OpenVSP does not say its unit of mass; taken as kg");
    } else if (block.name == "VSPAERO_Stab") {
      input.analyses.push_back(stability_of_result(lines, in, length));
      input.airspeed_mps = input.analyses.back().airspeed_mps;
    } else if (others.find(block.name) == std::string::npos) {
      others += (others.empty() ? "" : ", ") + block.name;
    }
  }
  if (!others.empty()) input.notes.push_back(aero_messages::results_unused(others));
  if (!input.analyses.empty() && options.length_m <= 0)
    input.notes.push_back("VSPAERO does not say its unit of length; taken as metre (--length-unit)");
  if (input.analyses.empty() && input.polar.empty() && !input.body.mass_kg.known)
    input.unused = aero_messages::results_missing(others).line();
  return input;
}

}  // namespace fulmar::aero::imports
