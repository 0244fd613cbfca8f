// SPDX-License-Identifier: BSD-3-Clause
// Which plugin files flew, as the metadata of a log name them (core/run/record/setup.cpp writes these).
#pragma once
#include <string>
#include <vector>

#include "core/log/reader.hpp"

namespace fulmar::core {

struct FlownPlugin {
  std::string component, file, version, sha256;
};

/// Of the metadata "plugins", whose keys are "slc.file", "slc.version", ... Throws Error when it is not
/// there, or a component's is not whole.
std::vector<FlownPlugin> flown_plugins(const McapFile& log);

}  // namespace fulmar::core
