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

/// Required fields of a record type that a map does not set: "mass", "wing.span".
std::vector<std::string> missing_in_record(const Type& type, const Node& map);

/// Writes the fields that `node` names into `data`, a struct of `type` with initial values for the others.
/// Keys are field names, exact ("mass_kg: 4.5") or without the suffix and then with a unit ("stall_alpha: 15
/// deg"). `path` names the struct in faults, "" for a separate file. Keys in `also` are left to the caller.
void fill_record(const Type& type, const Node& node, std::byte* data, const std::string& path, Report& report,
                 const std::vector<std::string>& also = {});

/// One field of the struct, at `field` = "aero.lift.alpha" or "waypoints[2].up"; lists keep their length.
void fill_record_field(const Type& type, const std::string& field, const Node& node, std::byte* data,
                       const std::string& path, Report& report);

/// The field that a key names, exactly or without its unit suffix; nullptr when there is none or several.
const Field* field_of_key(const Type& type, const std::string& key);

/// Sets the flag "given" of a parameter record, if its type has one: the record was supplied.
void mark_given(const Type& type, std::byte* data);

}  // namespace fulmar::core
