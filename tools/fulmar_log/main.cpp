// SPDX-License-Identifier: BSD-3-Clause
// `fulmar log ...` and `fulmar response`, as the program fulmar-log. Exit codes: 0 done; 1 it failed, or the
// logs differ; 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/app/program.hpp"
#include "tools/fulmar_log/log_command.hpp"
#include "tools/fulmar_log/response_command.hpp"

int main(int argc, char** argv) {
  using namespace fulmar::core;
  CLI::App app{"Inspect, repair, export and compare logs.", "fulmar"};
  app.require_subcommand(1);
  const LogCommand log(app);
  const fulmar::response::ResponseCommand response(app);
  return run_program(app, [&] {
    if (asked_for_rows(argc, argv)) {
      std::fputs(command_rows(app).c_str(), stdout);
      return 0;
    }
    app.parse(argc, argv);
    return response.parsed() ? response.run() : log.run();
  });
}
