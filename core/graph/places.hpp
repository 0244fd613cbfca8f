// SPDX-License-Identifier: BSD-3-Clause
// Where parameters are said: so that what a component refuses in its set-up gets a file and a line.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/graph/said_places.hpp"

namespace fulmar::core {

struct Component;

/// Of a sentence that begins with a parameter or a part of one, "airframe.inertia.xz: ...": the place of it,
/// or of the nearest thing around it that a file says. Nothing when no file says it.
std::optional<Where> place_in(const Component& component, const std::string& sentence);

}  // namespace fulmar::core
