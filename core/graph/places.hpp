// SPDX-License-Identifier: BSD-3-Clause
// Places of parameters in files: a fault from a component's set-up gets a file and a line.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/graph/said_places.hpp"

namespace fulmar::core {

struct Component;

/// Place of the parameter, or of a part of it, with which a sentence begins, as in "airframe.inertia.xz:
/// ...". Falls back to the nearest enclosing part that a file sets. Nothing when no file sets it.
std::optional<Where> place_in(const Component& component, const std::string& sentence);

}  // namespace fulmar::core
