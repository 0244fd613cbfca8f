// SPDX-License-Identifier: BSD-3-Clause
// The library with the DDS bridge, which a flight opens when its mission has a section `dds:`.
#pragma once
#include <filesystem>
#include <vector>

#include "core/dds/library.hpp"
#include "core/error.hpp"

namespace fulmar::core {

/// Opens lib/fulmar/host/fulmar_dds.so of the first of the folders that has one; it stays open. `section`:
/// the place in the mission that asks for it. Throws Error when there is none, when it cannot be loaded, and
/// when it comes from another build than this program.
const DdsLibrary& dds_library(const std::vector<std::filesystem::path>& homes, const Where& section);

}  // namespace fulmar::core
