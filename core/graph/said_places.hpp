// SPDX-License-Identifier: BSD-3-Clause
// Where a mission file says a parameter and its parts.
#pragma once
#include <map>
#include <memory>
#include <string>

#include "core/error.hpp"

namespace fulmar::core {

struct Node;

/// "" is the whole parameter, "inertia.xz" or "contacts[2].at" a part of a record, without suffixes of units.
using SaidPlaces = std::map<std::string, Where>;
using SaidPlacesPtr = std::shared_ptr<const SaidPlaces>;

/// Those of a whole record, in place of all before.
SaidPlacesPtr places_of(const Node& node);

/// With those of `node`, a part of it.
SaidPlacesPtr with_place(const SaidPlacesPtr& places, const std::string& field, const Node& node);

/// "stall_alpha_rad" and "stall_alpha" are one place.
std::string without_units(const std::string& path);

}  // namespace fulmar::core
