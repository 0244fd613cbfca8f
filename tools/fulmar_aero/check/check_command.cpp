// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/app/program.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/import/import.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// In the order of the file's lines.
std::vector<Finding> ordered(const Findings& findings) {
  std::vector<Finding> list = findings.list();
  std::stable_sort(list.begin(), list.end(),
                   [](const Finding& a, const Finding& b) { return a.where.line < b.where.line; });
  return list;
}

std::string counted(int n, const std::string& what) {
  return n == 0 ? "no " + what : std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace

void check_all(Findings& findings, double altitude_m) {
  check_body(findings);
  check_derivatives(findings);
  check_symmetry(findings);
  check_angles(findings);
  check_parts(findings);
  check_stability(findings);
  check_class(findings);
  check_flight(findings, altitude_m);
}

nlohmann::json findings_json(const Findings& findings, double altitude_m) {
  nlohmann::json figures_map = nlohmann::json::object(), faults = nlohmann::json::array(), warnings = faults;
  for (const Figure& figure : findings.figures())
    if (!figure.key.empty()) figures_map[figure.key] = figure.value;
  for (const Finding& one : ordered(findings))
    (one.verdict == Verdict::fault ? faults : warnings)
        .push_back({{"key", shown_field(one.field)},
                    {"file", one.where.file},
                    {"line", one.where.line},
                    {"value", one.value},
                    {"sentence", one.sentence}});
  return {{"airframe", findings.file().title()},
          {"altitude_m", altitude_m},
          {"figures", figures_map},
          {"faults", faults},
          {"warnings", warnings},
          {"values_checked", findings.values()}};
}

std::string findings_text(const Findings& findings, double altitude_m) {
  std::string text = findings.file().title() + ": " + findings.file().name + ", " + fixed(altitude_m, 0) +
                     " m above the sea\n";
  for (const Figure& figure : findings.figures())
    if (!figure.name.empty()) text += "  " + padded(figure.name, 22) + figure.text + "\n";
  for (const Finding& one : ordered(findings))
    text += std::string(one.verdict == Verdict::fault ? "FAULT    " : "warning  ") + one.where.text() + ": " +
            shown_field(one.field) + ": " + one.sentence + "\n";
  return text + std::to_string(findings.values()) +
         " values checked: " + counted(findings.count(Verdict::fault), "fault") + ", " +
         counted(findings.count(Verdict::warning), "warning") + "\n";
}

int check_command(const FlightOptions& options) {
  const double altitude_m = options.altitude_m();
  // a file of another tool is checked without changes
  const std::optional<imports::Imported> imported = imports::imported_for_check(options.airframe);
  const AirframeFile file = imported ? imported->file : read_airframe_file(options.airframe);
  Findings findings(file);
  check_all(findings, altitude_m);
  if (options.json)
    print_object(findings_json(findings, altitude_m));
  else
    print_text(findings_text(findings, altitude_m));
  return findings.count(Verdict::fault) == 0 ? core::ExitCode::done : core::ExitCode::failed;
}

}  // namespace fulmar::aero
