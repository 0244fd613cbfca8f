// SPDX-License-Identifier: BSD-3-Clause
// What the options of the live view allow: of the host, which checks them, and of the live view itself.
#pragma once
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Throws Error when others can reach the address and there is no token.
void check_live_options(const LiveOptions& options);
/// Why clients may not have parameters written into files; "": they may. Beyond this computer the mission has
/// to say so.
std::string why_no_save(const LiveOptions& options);
/// Of an address, or "localhost".
bool is_loopback(const std::string& host);
/// "https://tile.example.org/{z}/{x}/{y}.png" -> "https://tile.example.org"; "" -> "".
std::string origin_of(const std::string& tiles);

}  // namespace fulmar::core
