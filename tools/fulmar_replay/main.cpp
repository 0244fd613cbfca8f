// SPDX-License-Identifier: BSD-3-Clause
// `fulmar replay`, as the program fulmar-replay. Exit codes: 0 equal, or an experiment that was flown; 1 it
// differs or failed; 2 wrong usage; 4 refused; 130 interrupted.
#include <cstdio>

#include "core/app/program.hpp"
#include "tools/fulmar_replay/replay_command.hpp"

int main(int argc, char** argv) {
  using namespace fulmar::core;
  CLI::App app{"Replay logs.", "fulmar"};
  app.require_subcommand(1);
  ReplayCommand replay(app);
  return run_program(
      app,
      [&] {
        if (asked_for_rows(argc, argv)) {
          std::fputs(command_rows(app).c_str(), stdout);
          return 0;
        }
        app.parse(argc, argv);
        return replay.run();
      },
      ExitCode::refused);
}
