// SPDX-License-Identifier: BSD-3-Clause
// Subcommands that are separate programs: `fulmar fcu status` runs `fulmar-fcu status`, as git does.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

/// Subcommand of Fulmar that another program executes: `fulmar echo` runs `fulmar-live echo`.
struct OwnCommand {
  const char *word, *program, *help;
};
/// In the order of the help.
const std::vector<OwnCommand>& own_commands();

/// Replaces this process by the program that executes the subcommand words[1], from the same folder. Returns
/// when words[1] is no such subcommand. Throws Error.
void become_own_command(char** words);

/// Replaces this process by that program from the same folder. Throws Error.
[[noreturn]] void become_program(const std::string& program, char** words);

/// Subcommands whose programs are in the host's folder, sorted: {"aero", "fcu"}.
std::vector<std::string> extern_commands();

/// Replaces this process by the program fulmar-<word> from the host's folder, or else from PATH. `words`
/// begins with the subcommand's name and ends with nullptr. Returns only when there is no such program.
/// Throws Error when the program cannot be started.
void become_extern_command(char** words);

}  // namespace fulmar::core
