// SPDX-License-Identifier: BSD-3-Clause
// The page that a browser gets on the port of the live view.
#pragma once
#include <string>

#include "core/tap/tap.hpp"

namespace fulmar::core::live {

/// One HTML file that asks for nothing else.
std::string page(const std::string& mission, const Tap& tap);

}  // namespace fulmar::core::live
