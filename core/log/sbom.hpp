// SPDX-License-Identifier: BSD-3-Clause
// The software bill of materials of a flight: CycloneDX 1.5, JSON (ECMA-424,
// https://cyclonedx.org/docs/1.5/json/).
#pragma once
#include <string>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

/// This program, the plugins, and every shared library that is mapped into the process now, each with its
/// version, SHA-256 or build id as far as it has one. Same software, same text: sorted, without time, serial
/// number or path.
std::string sbom_text(const std::vector<const PluginInfo*>& plugins);

}  // namespace fulmar::core
