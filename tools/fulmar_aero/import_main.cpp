// SPDX-License-Identifier: BSD-3-Clause
// `fulmar import ...`, as the program fulmar-import: imports files of other autopilots and tools.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/app/program.hpp"
#include "core/types/text.hpp"
#include "fulmar/abi.h"
#include "tools/fulmar_aero/commands.hpp"

int main(int argc, char** argv) {
  namespace core = fulmar::core;
  CLI::App app{"Import an aircraft from another autopilot.", "fulmar import"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "fulmar import " FULMAR_VERSION);
  app.footer("Example: fulmar import rosplane rosplane_ws/params -o mine");
  std::string folder, out;
  CLI::App* const rosplane = app.add_subcommand(
      "rosplane",
      "import airframe, gains and missions from ROSplane and ROSflight files; exit code 1 on an error");
  rosplane->add_option("DIR", folder, "folder with parameter, gain and mission files of one aircraft")
      ->required();
  rosplane->add_option("-o,--out", out, "write to FOLDER; existing files of the same names are replaced")
      ->type_name("FOLDER")
      ->required();
  return core::run_program(
      app,
      [&] {
        if (core::asked_for_rows(argc, argv)) {
          std::fputs(core::command_rows(app).c_str(), stdout);
          return 0;
        }
        app.parse(argc, argv);
        return fulmar::aero::rosplane_command(folder, out);
      },
      core::ExitCode::refused);
}
