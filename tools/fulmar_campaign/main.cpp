// SPDX-License-Identifier: BSD-3-Clause
// `fulmar run` with --seeds, --repeat or --watch, as the program fulmar-campaign. Exit codes as of `fulmar
// run`.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/app/program.hpp"
#include "core/app/run_options.hpp"
#include "tools/fulmar_campaign/campaign.hpp"

int main(int argc, char** argv) {
  using namespace fulmar::core;
  CLI::App app{"Run several flights of a mission.", "fulmar"};
  app.require_subcommand(1);
  RunArguments run;
  CLI::App* command = app.add_subcommand("run", "fly a mission several times");
  run.add(command);
  return run_program(
      app,
      [&] {
        app.parse(argc, argv);
        return fly_campaign(run.options(command), run.many);
      },
      ExitCode::refused);
}
