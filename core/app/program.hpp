// SPDX-License-Identifier: BSD-3-Clause
// What the programs of the command line share: how they end, and what they tell shells of their words.
#pragma once
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace fulmar::core {

/// Runs `words`, which parses the command line and returns the exit code. Faults become a sentence and exit
/// code 1; a command line that cannot be parsed becomes 2; so does output that cannot be written become 1.
int run_program(CLI::App& app, const std::function<int()>& words);

/// One line per command, its fields between tabs: the words that lead to it, its options, those of them that
/// take a value, its subcommands. With `--rows` alone as its command line every program prints them
/// (asked_for_rows), so that the completion in shells knows all of them.
std::string command_rows(const CLI::App& app);
bool asked_for_rows(int argc, char** argv);

}  // namespace fulmar::core
