// SPDX-License-Identifier: BSD-3-Clause
// Commands that are programs of their own: `fulmar fcu status` is `fulmar-fcu status`, as git does it.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

/// The commands whose programs stand beside the host, sorted: {"aero", "fcu"}.
std::vector<std::string> extern_commands();

/// Becomes the program fulmar-<word>, which stands beside the host or else in PATH; `words` begin with the command's own name and end with
/// nullptr. Returns only when there is no such program. Throws Error when there is one that cannot be started.
void become_extern_command(char** words);

}  // namespace fulmar::core
