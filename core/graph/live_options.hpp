// SPDX-License-Identifier: BSD-3-Clause
// Checks of the options of the live view: for the host, and for the live view itself.
#pragma once
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Throws Error when others can reach the address and there is no token.
void check_live_options(const LiveOptions& options);
/// Reason why clients may not write parameters into files; "": they may. For clients beyond this computer the
/// mission must allow it.
std::string why_no_save(const LiveOptions& options);
/// Whether an address, or "localhost", is a loopback one.
bool is_loopback(const std::string& host);
/// "https://tile.example.org/{z}/{x}/{y}.png" -> "https://tile.example.org"; "" -> "".
std::string origin_of(const std::string& tiles);

}  // namespace fulmar::core
