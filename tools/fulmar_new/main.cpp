// SPDX-License-Identifier: BSD-3-Clause
// `fulmar new ...`, as the program fulmar-new. Exit codes: 0 done; 1 it failed; 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/app/program.hpp"
#include "tools/fulmar_new/new_command.hpp"

int main(int argc, char** argv) {
  using namespace fulmar::core;
  CLI::App app{"Create plugin projects.", "fulmar"};
  app.require_subcommand(1);
  NewOptions options;
  CLI::App* command = app.add_subcommand("new", "create a plugin project for a mission");
  command->add_option("NAME", options.name, "name of the plugin: letters, digits and _")->required();
  const auto each = [&](const char* name, std::vector<std::string>& to, const char* words) {
    command->add_option(name, to, words)->allow_extra_args(false);
  };
  each("--role", options.roles, "fill ROLE, as in outer; repeat it to fill several roles at once");
  command->add_option("--template", options.from_template,
                      "select a template: sensor or planner without a role, point_mass with --role vehicle");
  each("--in", options.in,
       "without a role: add an input, as in state=nav.state; gnss=vehicle.gnss[] is a queue");
  each("--out", options.out, "without a role: add an output, as in range=Range; edits=PlanEdit[] is a queue");
  command
      ->add_option("--mission", options.mission,
                   "take the role from mission FILE; default: the shipped hourglass")
      ->type_name("FILE");
  command->add_option("--dir", options.folder, "write the project to FOLDER; default ./NAME")
      ->type_name("FOLDER");
  command->footer("Example: fulmar new my_law --role outer");
  return run_program(app, [&] {
    if (asked_for_rows(argc, argv)) {
      std::fputs(command_rows(app).c_str(), stdout);
      return 0;
    }
    app.parse(argc, argv);
    return new_command(options);
  });
}
