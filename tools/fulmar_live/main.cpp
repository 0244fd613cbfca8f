// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of a running flight, as the program fulmar-live: `fulmar echo nav.state` starts
// `fulmar-live echo nav.state`. Exit codes: 0 done; 1 it failed; 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/app/extern_command.hpp"
#include "core/app/program.hpp"
#include "tools/fulmar_live/remote.hpp"

int main(int argc, char** argv) {
  using namespace fulmar::core;
  CLI::App app{"Observe and control a running flight.", "fulmar"};
  app.require_subcommand(1);
  const RemoteCommands commands(app, extern_commands());
  return run_program(app, [&] {
    if (asked_for_rows(argc, argv)) {
      std::fputs(command_rows(app).c_str(), stdout);
      return 0;
    }
    app.parse(argc, argv);
    return commands.run();
  });
}
