// SPDX-License-Identifier: BSD-3-Clause
// The commands of `fulmar fcu`. Each returns an exit code; a failure is an Error of one sentence.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_fcu/client.hpp"

namespace fulmar::fcu {

struct Options {
  std::string port = "/dev/ttyACM0";
  std::int64_t baud = 921600;
  bool json = false;
  bool yes = false;
};

// status_command.cpp
int status_command(Client& client, const Options& options, bool once);
int version_command(Client& client, const Options& options);

// params_command.cpp
struct ParamsOptions {
  std::string pattern, name, value, file;
  bool write = false, replace = false;
};
int params_list(Client& client, const Options& options, const ParamsOptions& what);
int params_get(Client& client, const Options& options, const ParamsOptions& what);
int params_set(Client& client, const Options& options, const ParamsOptions& what);
int params_write(Client& client, const Options& options);
int params_save(Client& client, const Options& options, const ParamsOptions& what);
int params_load(Client& client, const Options& options, const ParamsOptions& what);
int params_diff(Client& client, const Options& options, const ParamsOptions& what);

// hardware_command.cpp
struct HardwareOptions {
  std::string what;          ///< to calibrate
  std::string file, record;  ///< of magnetometer samples: to read, to write
  std::string airframe;
  bool dry_run = false, propeller_off = false, write = false;
};
int calibrate_command(Client& client, const Options& options, const HardwareOptions& what);
int reboot_command(Client& client, const Options& options);
int mixer_command(Client& client, const Options& options);
int check_command(Client& client, const Options& options, const HardwareOptions& what);
int outputs_command(Client& client, const Options& options, const HardwareOptions& what);

// bench_command.cpp
struct BenchOptions {
  std::string file;  ///< .json, or Markdown
  double seconds = 20;
  bool replace = false;
};
int bench_command(Client& client, const Options& options, const BenchOptions& what);

// mag_command.cpp
int calibrate_mag(Client& client, const Options& options, const HardwareOptions& what);
/// Fits a file without setting anything: needs no controller.
int try_mag_file(const Options& options, const HardwareOptions& what);

/// Writes the parameters to flash and reports it. Throws Error without an acknowledgement.
void write_flash(Client& client);

/// Asks "... [y/N]" on a terminal. Elsewhere throws Error "... add <flag>".
bool confirmed(const std::string& question, bool yes, const std::string& flag);
bool on_terminal();
/// On a terminal: replaces the present line. Elsewhere: no output.
void show_progress(const std::string& text);

void catch_interrupt();
/// True after SIGINT or SIGTERM.
bool interrupted();

}  // namespace fulmar::fcu
