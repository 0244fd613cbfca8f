// SPDX-License-Identifier: BSD-3-Clause
// Completion of the command line in shells: commands and options from the table of commands, the rest from
// the running flight.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

class Session;

/// `shell`: "bash" or "zsh". The installed programs list their commands. Throws Error.
std::string completion_script(const std::string& shell);

/// The words of a kind (port, field, param, component, request, phase) that begin with `prefix`.
std::vector<std::string> completions(Session& session, const std::string& kind, const std::string& prefix);

/// Prints them, one per line. Prints nothing without a flight; always ends quickly.
int complete_command(const std::string& at, const std::string& token, const std::string& kind,
                     const std::string& prefix);
/// The same for the numbers of a log.
int complete_from_log(const std::string& log, const std::string& prefix);

}  // namespace fulmar::core
