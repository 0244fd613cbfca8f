// SPDX-License-Identifier: BSD-3-Clause
// Where a mission file says a parameter and its parts.
#pragma once
#include <map>
#include <memory>
#include <string>

#include "core/error.hpp"

namespace fulmar::core {

/// "" is the whole parameter, "inertia.xz" or "contacts[2].at" a part of a record, without suffixes of units.
using SaidPlaces = std::map<std::string, Where>;
using SaidPlacesPtr = std::shared_ptr<const SaidPlaces>;

}  // namespace fulmar::core
