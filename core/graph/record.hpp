// SPDX-License-Identifier: BSD-3-Clause
// Fills a described struct (an airframe, a plan, a message to send) from YAML. Every fault has the record's
// own file and line.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/graph/yaml.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// What a map of a whole record does not say though its type asks for it: "mass", "wing.span".
std::vector<std::string> missing_in_record(const Type& type, const Node& map);

/// Writes the fields that `node` names into `data`, a struct of `type` that holds what is to stay where the
/// file says nothing. Keys are field names, exact ("mass_kg: 4.5") or without the suffix and then with a unit
/// ("stall_alpha: 15 deg"). `path` is how faults name the struct, "" for a file of its own. Keys in `also`
/// are left to the caller.
void fill_record(const Type& type, const Node& node, std::byte* data, const std::string& path, Report& report,
                 const std::vector<std::string>& also = {});

/// One field of the struct, at `field` = "aero.lift.alpha" or "waypoints[2].up"; lists keep their length.
void fill_record_field(const Type& type, const std::string& field, const Node& node, std::byte* data,
                       const std::string& path, Report& report);

/// The field that a key names, exactly or without its unit suffix; nullptr when there is none or several.
const Field* field_of_key(const Type& type, const std::string& key);

/// The bare flag of a parameter record that tells whether it was supplied ("given"), set when the type has
/// one.
void mark_given(const Type& type, std::byte* data);

}  // namespace fulmar::core
