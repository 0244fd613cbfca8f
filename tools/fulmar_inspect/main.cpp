// SPDX-License-Identifier: BSD-3-Clause
// `fulmar check`, `fulmar graph` and `fulmar inspect`, as the program fulmar-inspect. Exit codes: 0 done; 2
// wrong usage; 4 refused.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/app/mission_options.hpp"
#include "core/app/program.hpp"
#include "core/loader/library.hpp"
#include "tools/fulmar_inspect/check.hpp"
#include "tools/fulmar_inspect/inspect.hpp"
#include "tools/fulmar_inspect/print_graph.hpp"

int main(int argc, char** argv) {
  using namespace fulmar::core;
  CLI::App app{"Check missions and inspect plugins.", "fulmar"};
  app.require_subcommand(1);
  MissionOptions mission, checked;
  std::string format = "text", plugin;
  bool fields = false, markdown = false;
  CLI::App* check = app.add_subcommand("check", "check a mission file and report all errors");
  checked.add(check);
  check->footer("Example: fulmar check configs/missions/hourglass.yaml");
  CLI::App* graph =
      app.add_subcommand("graph", "print components, connections, order and phases of a mission");
  mission.add(graph);
  graph->add_option("--format", format, "set the output format: text, dot or mermaid")
      ->check(CLI::IsMember({"text", "dot", "mermaid"}));
  graph->footer("Example: fulmar graph configs/missions/hourglass.yaml --format mermaid");
  CLI::App* inspect = app.add_subcommand("inspect", "print components, parameters and ports of a plugin");
  inspect->add_option("PLUGIN", plugin, "plugin file (shared object or script)")->required();
  inspect->add_flag("--fields", fields, "print the fields of every message too");
  inspect->add_flag("--markdown", markdown,
                    "print a Markdown reference page with every parameter, port and field");
  inspect->footer("Example: fulmar inspect build/lib/fulmar/control_slc.so");
  return run_program(
      app,
      [&] {
        if (asked_for_rows(argc, argv)) {
          std::fputs(command_rows(app).c_str(), stdout);
          return 0;
        }
        app.parse(argc, argv);
        const auto print = [](const std::string& text) {
          std::fputs(text.c_str(), stdout);
          return 0;
        };
        if (check->parsed()) return check_mission(checked.mission, checked.overrides(check));
        if (graph->parsed())
          return print(print_graph(load_mission(mission.mission, mission.overrides(graph)), format));
        const std::shared_ptr<Library> library = Library::open(plugin);
        return print(markdown ? describe_plugin_markdown(library->info())
                              : describe_plugin(library->info(), fields));
      },
      ExitCode::refused);
}
