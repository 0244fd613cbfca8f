// SPDX-License-Identifier: BSD-3-Clause
// Files of other tools to an airframe file.
#pragma once
#include <optional>

#include "tools/fulmar_aero/import/airframe_yaml.hpp"
#include "tools/fulmar_aero/import/readers.hpp"

namespace fulmar::aero::imports {

/// Reads, converts, merges and completes; `name` is what the airframe file is called. Throws core::Error.
Imported imported_from(const std::vector<std::string>& files, const ImportOptions& options,
                       const std::string& name);

/// A file of another tool, as it is: signs that cannot be right stay, for a check to find them. Nothing for
/// an airframe file, or one that nobody knows.
std::optional<Imported> imported_for_check(const std::string& name);

}  // namespace fulmar::aero::imports
