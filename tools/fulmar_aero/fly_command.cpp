// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero fly`: from an airframe file to a flight, in one.
#include "core/app/program.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {

int fly_command(const FlightOptions& options, bool write) {
  TuneOptions tuning;
  tuning.verify = true;
  tuning.write = write;
  const auto step = [](const char* name, int code) {
    if (code == core::ExitCode::done) return true;
    std::fprintf(stderr, "not flown: `fulmar aero %s` has failed\n", name);
    return false;
  };
  if (!step("check", check_command(options))) return core::ExitCode::failed;
  print_text("\n");
  if (!step("trim", trim_command(options))) return core::ExitCode::failed;
  print_text("\n");
  if (!step("modes", modes_command(options, "", ""))) return core::ExitCode::failed;
  print_text("\n");
  return tune_command(options, tuning);
}

}  // namespace fulmar::aero
