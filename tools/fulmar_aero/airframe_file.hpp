// SPDX-License-Identifier: BSD-3-Clause
// An airframe file with the place of each of its values.
#pragma once
#include <map>
#include <string>

#include "core/graph/yaml.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar::aero {

struct AirframeFile {
  std::string name;  ///< as it was given
  Airframe airframe;
  core::Node root;
  /// Of a text that was made from another file: where the value of a line is from. Empty: the file itself.
  std::map<int, core::Where> origin;

  /// Where a field stands, "aero.pitch.alpha_ratio"; where it is missing, the place of what it would be in.
  core::Where where(const std::string& field) const;
  /// Whether the file says it itself, a field "limits.airspeed_max_mps" of a map; else its default counts.
  bool says(const std::string& field) const;
  /// The aircraft's name, or the file's when it has none.
  std::string title() const;
};

/// `name`: a file, or one that is shipped, as in fulmar:airframes/anaconda.yaml. Throws core::Error with
/// file:line for every fault; one of them is a value of which no model can be made, such as a negative mass.
AirframeFile read_airframe_file(const std::string& name);

/// The same of a text that is not in a file yet.
AirframeFile airframe_of_text(const std::string& text, const std::string& name);

/// "aero.pitch.alpha_ratio" -> "aero.pitch.alpha"
std::string shown_field(const std::string& field);

}  // namespace fulmar::aero
