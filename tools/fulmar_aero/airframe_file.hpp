// SPDX-License-Identifier: BSD-3-Clause
// An airframe file with the place of each of its values.
#pragma once
#include <map>
#include <string>

#include "core/graph/yaml.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::aero {

struct AirframeFile {
  std::string name;  ///< as given
  Airframe airframe;
  core::Node root;
  /// For a text that was made from another file: origin of the value of each line. Empty: the file itself.
  std::map<int, core::Where> origin;

  /// Place of a field, "aero.pitch.alpha_ratio"; for a missing one the place of its parent.
  core::Where where(const std::string& field) const;
  /// True when the file gives a field, "limits.airspeed_max_mps" of a map; else its default is used.
  bool says(const std::string& field) const;
  /// Name of the aircraft, or of the file without one.
  std::string title() const;
};

/// `name`: a file, or a shipped one, as in fulmar:airframes/anaconda.yaml. Throws core::Error with file:line
/// for all faults. A value without a valid model, such as a negative mass, is one.
AirframeFile read_airframe_file(const std::string& name);

/// The same for a text in memory.
AirframeFile airframe_of_text(const std::string& text, const std::string& name);

/// "aero.pitch.alpha_ratio" -> "aero.pitch.alpha"
std::string shown_field(const std::string& field);

}  // namespace fulmar::aero
