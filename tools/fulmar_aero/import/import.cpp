// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/import/import.hpp"

#include <algorithm>

namespace fulmar::aero::imports {

Imported imported_from(const std::vector<std::string>& files, const ImportOptions& options,
                       const std::string& name) {
  std::vector<std::string> names = files;
  for (const std::string& more : {options.drag_from, options.controls_from})
    if (!more.empty() && std::find(names.begin(), names.end(), more) == names.end()) names.push_back(more);
  std::vector<Lines> all;
  for (const std::string& file : names) {
    if (std::count(names.begin(), names.end(), file) > 1) throw core::Error(file + ": it is given twice");
    all.push_back(read_lines(file));
  }
  ReadOptions reading{options.length_m};
  // AVL's mass table says what its geometry's unit is; a run case less surely
  for (const char* key : {"Lunit", "X_cg"})
    for (const Lines& lines : all)
      if (reading.length_m <= 0 && lines.has(key)) reading.length_m = length_in(lines).value_or(0);
  std::vector<Input> inputs;
  inputs.reserve(all.size());
  for (const Lines& lines : all) inputs.push_back(read_any(lines, reading));
  return written(aircraft_of(inputs, options), options, name);
}

}  // namespace fulmar::aero::imports
