// SPDX-License-Identifier: BSD-3-Clause
// Commands that are programs of their own: `fulmar fcu status` is `fulmar-fcu status`, as git does it.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

/// A command of Fulmar's own that another program carries out: `fulmar echo` is `fulmar-live echo`.
struct OwnCommand {
  const char *word, *program, *says;
};
/// In the order of the help.
const std::vector<OwnCommand>& own_commands();

/// Becomes the program beside this one that carries out words[1], when that is such a command; else returns.
/// Throws Error.
void become_own_command(char** words);

/// Becomes that program, which stands beside this one. Throws Error.
[[noreturn]] void become_program(const std::string& program, char** words);

/// The commands whose programs stand beside the host, sorted: {"aero", "fcu"}.
std::vector<std::string> extern_commands();

/// Becomes the program fulmar-<word>, which stands beside the host or else in PATH; `words` begin with the
/// command's own name and end with nullptr. Returns only when there is no such program. Throws Error when
/// there is one that cannot be started.
void become_extern_command(char** words);

}  // namespace fulmar::core
