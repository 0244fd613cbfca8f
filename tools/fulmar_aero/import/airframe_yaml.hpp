// SPDX-License-Identifier: BSD-3-Clause
// The airframe file of an imported aircraft: every number with its source, and every missing one with its
// default.
#pragma once
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/import/aircraft.hpp"

namespace fulmar::aero::imports {

struct Imported {
  Aircraft aircraft;
  std::string text;                      ///< of the airframe file
  std::vector<std::string> assumptions;  ///< "mass 4.1 kg: ...", values that no file has
  AirframeFile file;                     ///< `text`, read back
};

/// Completes the aircraft and trims it; messages name the text `name`. Throws core::Error when the result is
/// invalid.
Imported written(Aircraft aircraft, const ImportOptions& options, const std::string& name);

}  // namespace fulmar::aero::imports
