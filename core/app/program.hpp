// SPDX-License-Identifier: BSD-3-Clause
// Shared by the command-line programs: exit codes, usage errors and the rows for shell completion.
#pragma once
#include <functional>
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace fulmar::core {

struct ExitCode {
  enum : int {
    done = 0,
    failed = 1,   // a flight that failed or has not begun; logs that differ
    usage = 2,    // a command line that cannot be parsed
    guarded = 3,  // with --strict: a guard stopped a component in the flight
    refused = 4,  // a mission, a plugin or a file is rejected before the flight
    interrupted = 130,
  };
};

/// Runs `words`, which parses the command line and returns the exit code. An Error is printed and gives the
/// exit code `fault`; output that cannot be written gives 1. Messages of the host go to standard error.
int run_program(CLI::App& app, const std::function<int()>& words, int fault = ExitCode::failed);

/// Prints the requested help or the fault of the command line, without control characters. Returns the exit
/// code.
int report_usage(const CLI::App& app, const CLI::ParseError& fault);

/// Sentence for users about an exception: the texts of the libraries are for programmers.
std::string sentence_of(const std::exception& fault);

/// One line per subcommand, fields separated by tabs: the subcommand's words, its options, those options that
/// take a value, its subcommands. With `--rows` as its only argument every program prints them
/// (asked_for_rows) for shell completion.
std::string command_rows(const CLI::App& app);
bool asked_for_rows(int argc, char** argv);

}  // namespace fulmar::core
