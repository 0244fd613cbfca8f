// SPDX-License-Identifier: BSD-3-Clause
// The command line. Exit codes: 0 done; 1 the flight, check or file failed; 2 wrong usage; 130 interrupted.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>

#include "core/app/extern_command.hpp"
#include "core/app/messages.hpp"
#include "core/app/program.hpp"
#include "core/app/run_command.hpp"
#include "core/error.hpp"
#include "core/say.hpp"
#include "core/types/text.hpp"

namespace {

using namespace fulmar::core;

/// Subcommands of this program, in the order of the help, which also lists those of other programs.
struct Commands {
  CLI::App app{
      "Fulmar: a fixed-wing autopilot for research. A mission is a YAML file; its components are plugins."};
  RunArguments run;
  std::function<int()> action;  // of the given subcommand

  explicit Commands(char** words) {
    app.set_version_flag("--version", "fulmar " FULMAR_VERSION);
    app.require_subcommand(1);
    const std::vector<std::string> programs = extern_commands();
    app.footer(
        "Example: fulmar run configs/missions/hourglass.yaml --seed 3 --set slc.roll_limit=\"30 deg\"" +
        (programs.empty()
             ? ""
             : "\n\n" + fulmar::app_messages::programs_beside(join(programs), programs[0]).text));
    add_run(words);
    for (const OwnCommand& command : own_commands()) {
      // entry in the help alone: another program executes it
      CLI::App* named = app.add_subcommand(command.word, command.help)->prefix_command();
      if (*command.help == '\0') named->group("");
    }
  }

  /// Another program runs several flights and `--watch`.
  void add_run(char** words) {
    CLI::App* command = app.add_subcommand("run", "fly a mission and print its results");
    run.add(command);
    command->callback([this, command, words] {
      action = [this, command, words] {
        if (run.many.asked()) become_program("fulmar-campaign", words);
        return run_command(run.options(command));
      };
    });
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
      list.push_back(command->get_name());
    return list;
  }

  /// Runs the program named by a word that is no subcommand, or prints an error.
  int other_program(char** words) {
    become_extern_command(words);
    std::vector<std::string> valid = names();
    for (const std::string& word : extern_commands()) valid.push_back(word);
    std::erase(valid, "complete");  // for shells
    const std::string word = words[0];
    std::fprintf(
        stderr, "fulmar: %s\n",
        fulmar::app_messages::command_unknown(for_terminal(word), choices_text(word, valid)).text.c_str());
    if (word == "fcu" || word == "ros2" || word == "aero" || word == "import")
      std::fprintf(stderr, "fulmar: %s\n",
                   fulmar::app_messages::program_not_built("fulmar-" + word).text.c_str());
    return 2;
  }

  int parse(int argc, char** argv) {
    if (asked_for_rows(argc, argv)) {
      std::fputs(command_rows(app).c_str(), stdout);
      return 0;
    }
    become_own_command(argv);
    const std::vector<std::string> known = names();
    if (argc > 1 && argv[1][0] != '-' && std::find(known.begin(), known.end(), argv[1]) == known.end())
      return other_program(argv + 1);
    app.parse(argc, argv);
    return action ? action() : 2;
  }
};

}  // namespace

int main(int argc, char** argv) {
  Commands commands(argv);
  return run_program(
      commands.app, [&] { return commands.parse(argc, argv); }, ExitCode::refused);
}
