// SPDX-License-Identifier: BSD-3-Clause
// What the programs of the command line share: how they end, and what they tell shells of their words.
#pragma once
#include <functional>
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace fulmar::core {

/// How a program ends.
struct ExitCode {
  enum : int {
    done = 0,
    failed = 1,   // a flight that failed or has not begun; logs that differ
    usage = 2,    // a command line that cannot be parsed
    guarded = 3,  // with --strict: flown, but a guard has fired
    refused = 4,  // a mission, a plugin or a file, before anything was flown
    interrupted = 130,
  };
};

/// Runs `words`, which parses the command line and returns the exit code. An Error becomes a sentence and the
/// exit code `fault`; output that cannot be written becomes 1. What the host says goes to standard error.
int run_program(CLI::App& app, const std::function<int()>& words, int fault = ExitCode::failed);

/// Prints the help that was asked for, or what is wrong with the command line, without what a terminal obeys;
/// the exit code.
int report_usage(const CLI::App& app, const CLI::ParseError& fault);

/// What was thrown, in words for people: those of the libraries are for programmers.
std::string sentence_of(const std::exception& fault);

/// One line per command, its fields between tabs: the words that lead to it, its options, those of them that
/// take a value, its subcommands. With `--rows` alone as its command line every program prints them
/// (asked_for_rows), so that the completion in shells knows all of them.
std::string command_rows(const CLI::App& app);
bool asked_for_rows(int argc, char** argv);

}  // namespace fulmar::core
