// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>

#include "core/app/program.hpp"
#include "core/graph/quantity.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/import/compare_modes.hpp"
#include "tools/fulmar_aero/import/import.hpp"
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/rosplane.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero::imports {
namespace {

double said(const char* option, const std::string& text, const char* unit) {
  if (text.empty()) return 0;
  try {
    const double value = core::quantity_in(text, unit, core::UnitRule::optional);
    if (value > 0) return value;
  } catch (const core::Error& fault) {
    throw CLI::ValidationError(option, fault.what());
  }
  throw CLI::ValidationError(option, aero_messages::option_not_positive(text).line());
}

double length_said(const std::string& text) {
  if (text.empty()) return 0;
  if (const auto unit = length_unit(text)) return *unit;
  return said("--length-unit", text, "m");
}

ImportOptions options_of(const ImportArguments& words) {
  ImportOptions options;
  options.mass_kg = said("--mass", words.mass, "kg");
  options.length_m = length_said(words.length_unit);
  options.cruise_mps = said("--cruise", words.cruise, "m/s");
  options.parasite_drag = said("--parasite-drag", words.parasite_drag, "");
  options.name = words.name;
  options.drag_from = words.drag_from;
  options.controls_from = words.controls_from;
  if (!words.alpha.empty()) {
    try {
      options.alpha_rad = core::quantity_in(words.alpha, "rad", core::UnitRule::required);
    } catch (const core::Error& fault) {
      throw CLI::ValidationError("--alpha", fault.what());
    }
  }
  if (words.inertia.empty()) return options;
  if (words.inertia.size() != 3 && words.inertia.size() != 4)
    throw CLI::ValidationError("--inertia",
                               aero_messages::inertia_values_expected(words.inertia.size()).line());
  for (std::size_t i = 0; i < words.inertia.size(); ++i) options.inertia[i] = words.inertia[i];
  if (!(options.inertia[0] > 0 && options.inertia[1] > 0 && options.inertia[2] > 0))
    throw CLI::ValidationError("--inertia", aero_messages::inertia_not_positive().line());
  return options;
}

std::string complex_text(const std::complex<double>& value) {
  return fixed(value.real(), 3) + (value.imag() == 0 ? "" : " +- " + fixed(std::abs(value.imag()), 3) + "i");
}

std::string modes_text(const ModeComparison& modes, const PrintedModes& printed) {
  if (printed.empty()) return "";
  if (!modes.fault.empty()) return "eigenvalues of " + printed.from + ": not compared, " + modes.fault + "\n";
  std::string text = "eigenvalues at " + figures(modes.airspeed_mps, 4) + " m/s: " + padded("mode", 14) +
                     padded(printed.from, 22) + padded("this model", 22) + "difference" +
                     (printed.apparent_mass ? " of size" : "") + "\n";
  for (const ModePair& pair : modes.pairs)
    text += "  " + padded(pair.name, 32) + padded(complex_text(pair.tool), 22) +
            padded(complex_text(pair.own), 22) + fixed(100 * pair.off_ratio, 2) + " %" +
            (pair.max_ratio <= 0 ? ""
             : pair.agrees()
                 ? ""
                 : aero_messages::eigenvalue_difference_large(fixed(100 * pair.max_ratio, 0)).line()) +
            "\n";
  return text;
}

std::string report_text(const Imported& imported, const ModeComparison& modes) {
  const Aircraft& a = imported.aircraft;
  std::string text;
  for (const std::string& source : a.sources) text += "read     " + source + "\n";
  for (const std::string& note : a.notes) text += "note     " + note + "\n";
  for (const std::string& one : imported.assumptions) text += "assumed  " + one + "\n";
  return text + modes_text(modes, a.modes);
}

/// Possible causes of a wrong aircraft, printed last.
std::string doubts_text(const Imported& imported) {
  std::string text;
  for (const std::string& warning : imported.aircraft.warnings) text += "DOUBTFUL " + warning + "\n";
  return text;
}

nlohmann::json import_json(const Imported& imported, const ModeComparison& modes,
                           const nlohmann::json& check) {
  const Aircraft& a = imported.aircraft;
  nlohmann::json coefficients = nlohmann::json::object(), pairs = nlohmann::json::array();
  constexpr std::array<const char*, terms> names{"0", "alpha",   "beta",    "p",       "q",
                                                 "r", "delta_a", "delta_e", "delta_r", "delta_f"};
  for (std::size_t force = 0; force < forces; ++force)
    for (std::size_t term = 0; term < terms; ++term)
      if (const Value& one = a.c[force][term]; one.known)
        coefficients[std::string(force_symbol(Force(force))) + "_" + names[term]] = {{"value", one.x},
                                                                                     {"from", one.from}};
  coefficients["CD_p"] = {
      {"value", a.parasite.x}, {"from", a.parasite.from}, {"converted", a.converted_parasite}};
  for (const ModePair& pair : modes.pairs)
    pairs.push_back({{"mode", pair.name},
                     {"file", {pair.tool.real(), pair.tool.imag()}},
                     {"model", {pair.own.real(), pair.own.imag()}},
                     {"off_ratio", pair.off_ratio},
                     {"agrees", pair.agrees()}});
  return {{"files", a.sources},     {"coefficients", coefficients},    {"notes", a.notes},
          {"doubtful", a.warnings}, {"assumed", imported.assumptions}, {"modes", pairs},
          {"check", check}};
}

void write_file(const std::string& name, const std::string& text) {
  std::ofstream out(name, std::ios::binary);
  if (!(out << text) || !out.flush()) throw core::Error(located(name, aero_messages::output_not_writable()));
}

int run_import(const ImportArguments& words) {
  const ImportOptions options = options_of(words);
  const Imported imported =
      imported_from(words.files, options, words.out.empty() ? "imported.yaml" : words.out);
  const ModeComparison modes = compare_modes(imported);
  Findings findings(imported.file);
  check_all(findings, 0);
  bool agrees = true;
  for (const ModePair& pair : modes.pairs) agrees = agrees && pair.agrees();
  if (!words.out.empty()) write_file(words.out, imported.text);
  if (words.json) {
    print_object(import_json(imported, modes, findings_json(findings, 0)));
  } else {
    const std::string report =
        report_text(imported, modes) + findings_text(findings, 0) + doubts_text(imported);
    if (words.out.empty()) {
      print_text(imported.text);
      std::fputs(report.c_str(), stderr);
    } else {
      print_text(report + "written to " + words.out + "\n");
    }
  }
  return findings.count(Verdict::fault) == 0 && agrees ? core::ExitCode::done : core::ExitCode::failed;
}

int run_rosplane(const std::string& folder, const std::string& out) {
  const RosplaneSet set = rosplane_set(folder);
  Findings findings(set.airframe.file);
  check_all(findings, 0);
  std::error_code fault;
  std::filesystem::create_directories(out, fault);
  std::string text = report_text(set.airframe, {});
  for (const std::string& note : set.notes) text += "note     " + note + "\n";
  for (const std::string& doubt : set.doubts) text += "DOUBTFUL " + doubt + "\n";
  text += findings_text(findings, 0) + doubts_text(set.airframe);
  for (const OutFile& file : set.files) {
    const std::string path = (std::filesystem::path(out) / file.name).string();
    write_file(path, file.text);
    text += "written to " + path + "\n";
  }
  print_text(text);
  return findings.count(Verdict::fault) == 0 ? core::ExitCode::done : core::ExitCode::failed;
}

}  // namespace
}  // namespace fulmar::aero::imports

int fulmar::aero::import_command(const ImportArguments& words) { return imports::run_import(words); }

int fulmar::aero::rosplane_command(const std::string& folder, const std::string& out) {
  return imports::run_rosplane(folder, out);
}
