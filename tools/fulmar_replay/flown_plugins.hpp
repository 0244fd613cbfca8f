// SPDX-License-Identifier: BSD-3-Clause
// The plugin files of a flight, from the metadata of its log (written by core/run/record/setup.cpp).
#pragma once
#include <string>
#include <vector>

#include "core/log/reader.hpp"

namespace fulmar::core {

struct FlownPlugin {
  std::string component, file, version, sha256;
};

/// Plugins from the metadata "plugins", with keys "slc.file", "slc.version", ... Throws Error when the
/// metadata are missing or incomplete.
std::vector<FlownPlugin> flown_plugins(const McapFile& log);

}  // namespace fulmar::core
