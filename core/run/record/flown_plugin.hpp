// SPDX-License-Identifier: BSD-3-Clause
// Which plugin files flew, as the metadata of logs tell it.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/log/reader.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

struct FlownPlugin {
  std::string component, file, version, sha256;
};

/// For the log: file, version, sha256, and build_id when there is one.
std::vector<std::pair<std::string, std::string>> flown_pairs(const PluginInfo& plugin);

/// Of the metadata "plugins", whose keys are "slc.file", "slc.version", ... Throws Error when it is not
/// there, or a component's is not whole.
std::vector<FlownPlugin> flown_plugins(const McapFile& log);

}  // namespace fulmar::core
