// SPDX-License-Identifier: BSD-3-Clause
// Files of other tools to an airframe file.
#pragma once
#include <optional>

#include "tools/fulmar_aero/import/airframe_yaml.hpp"
#include "tools/fulmar_aero/import/readers.hpp"

namespace fulmar::aero::imports {

/// Reads, converts, merges and completes; `name`: name of the airframe file. Throws core::Error.
Imported imported_from(const std::vector<std::string>& files, const ImportOptions& options,
                       const std::string& name);

/// A file of another tool without corrections: wrong signs stay for the check. No value for an airframe file
/// or an unknown one.
std::optional<Imported> imported_for_check(const std::string& name);

}  // namespace fulmar::aero::imports
