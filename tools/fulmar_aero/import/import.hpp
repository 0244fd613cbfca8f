// SPDX-License-Identifier: BSD-3-Clause
// Files of other tools to an airframe file.
#pragma once
#include "tools/fulmar_aero/import/airframe_yaml.hpp"
#include "tools/fulmar_aero/import/readers.hpp"

namespace fulmar::aero::imports {

/// Reads, converts, merges and completes; `name` is what the airframe file is called. Throws core::Error.
Imported imported_from(const std::vector<std::string>& files, const ImportOptions& options,
                       const std::string& name);

}  // namespace fulmar::aero::imports
