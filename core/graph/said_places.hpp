// SPDX-License-Identifier: BSD-3-Clause
// Places of a parameter and its parts in a mission file.
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

/// Places of a whole record; they replace all previous ones.
SaidPlacesPtr places_of(const Node& node);

/// Adds the places of `node`, a part of the record.
SaidPlacesPtr with_place(const SaidPlacesPtr& places, const std::string& field, const Node& node);

/// "stall_alpha_rad" and "stall_alpha" are one place.
std::string without_units(const std::string& path);

}  // namespace fulmar::core
