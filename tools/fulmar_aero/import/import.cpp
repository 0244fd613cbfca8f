// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/import/import.hpp"

#include <algorithm>
#include <filesystem>

#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/rosflight.hpp"

namespace fulmar::aero::imports {
namespace {

bool is_whole(const Lines& lines) {
  return is_rosflight(lines) || is_coefficient_json(lines) || is_jsbsim(lines);
}

Aircraft whole_aircraft(const Lines& lines, bool mend) {
  if (is_jsbsim(lines)) return jsbsim_aircraft(lines);
  return is_rosflight(lines) ? rosflight_aircraft(lines, mend) : json_aircraft(lines);
}

Aircraft with_options(Aircraft a, const ImportOptions& options) {
  if (options.mass_kg > 0) a.mass_kg = {options.mass_kg, "--mass"};
  if (options.parasite_drag > 0) a.parasite = {options.parasite_drag, "--parasite-drag"};
  if (!options.name.empty()) a.name = options.name;
  return a;
}

}  // namespace

namespace {

/// Maps lines of the airframe's text to the lines of the one file that their comments name.
Imported with_origins(Imported imported, const std::string& name) {
  const std::string base = std::filesystem::path(name).filename().string() + ":";
  const Lines text = lines_of(name, imported.text);
  for (std::size_t i = 0; i < text.all.size(); ++i) {
    core::Where& where = imported.file.origin[int(i) + 1];
    where.file = name;
    const std::size_t at = text.all[i].find("# " + base);
    if (at != std::string::npos) where.line = std::atoi(text.all[i].c_str() + at + 2 + base.size());
  }
  return imported;
}

}  // namespace

std::optional<Imported> imported_for_check(const std::string& name) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(name, fault)) return {};
  const Lines lines = read_lines(name);
  if (lines.has("aero:") && lines.has("propulsion:")) return {};
  if (is_whole(lines)) return with_origins(written(whole_aircraft(lines, false), {}, name), name);
  try {
    if (read_any(lines, {}).analyses.empty()) return {};
  } catch (const core::Error&) {
    return {};  // an airframe file with faults, or an unknown file
  }
  return with_origins(imported_from({name}, {}, name), name);
}

Imported imported_from(const std::vector<std::string>& files, const ImportOptions& options,
                       const std::string& name) {
  std::vector<std::string> names = files;
  for (const std::string& more : {options.drag_from, options.controls_from})
    if (!more.empty() && std::find(names.begin(), names.end(), more) == names.end()) names.push_back(more);
  std::vector<Lines> all;
  for (const std::string& file : names) {
    if (std::count(names.begin(), names.end(), file) > 1)
      throw core::Error(located(file, aero_messages::file_duplicate()));
    all.push_back(read_lines(file));
  }
  for (const Lines& lines : all)
    if (is_whole(lines)) {
      if (all.size() > 1) throw core::Error(located(lines.file, aero_messages::aircraft_not_mergeable()));
      return written(with_options(whole_aircraft(lines, true), options), options, name);
    }
  ReadOptions reading{options.length_m};
  // AVL's mass table has the unit of its geometry; a run case is less reliable
  for (const char* key : {"Lunit", "X_cg"})
    for (const Lines& lines : all)
      if (reading.length_m <= 0 && lines.has(key)) reading.length_m = length_in(lines).value_or(0);
  std::vector<Input> inputs;
  inputs.reserve(all.size());
  for (const Lines& lines : all) inputs.push_back(read_any(lines, reading));
  return written(aircraft_of(inputs, options), options, name);
}

}  // namespace fulmar::aero::imports
