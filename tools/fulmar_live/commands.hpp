// SPDX-License-Identifier: BSD-3-Clause
// The subcommands for a running flight. Each returns the exit code, and throws Error without a flight or for
// an unknown name.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/fulmar_live/client.hpp"

namespace fulmar::plot {
struct LogPlotArguments;
}

namespace fulmar::core {

/// An invalid command line: exit code 2.
struct WrongUsage : Error {
  using Error::Error;
};

int list_command(const LiveAddress& target, bool rates, bool json);

struct EchoOptions {
  std::vector<std::string> ports;
  double rate_hz = 0;       // of each port at most; 0: all
  std::uint64_t count = 0;  // samples, then the end; 0: until the flight ends
  bool json = false, csv = false;
};
int echo_command(const LiveAddress& target, const EchoOptions& options);

struct PlotOptions {
  std::vector<std::string> fields;
  double seconds = 10;  // of flight in the picture
};
int plot_command(const LiveAddress& target, const PlotOptions& options);
/// Picture of logs over time, one per panel.
int picture_command(const plot::LogPlotArguments& words);

/// At a terminal until interrupted; otherwise once.
int watch_command(const LiveAddress& target);

int param_list_command(const LiveAddress& target, const std::string& pattern, bool json);
int param_get_command(const LiveAddress& target, const std::vector<std::string>& names, bool json);
/// NAME VALUE [NAME VALUE ...]: sets one after another, until one is rejected.
int param_set_command(const LiveAddress& target, const std::vector<std::string>& words);
struct SaveOptions {
  std::string component, mission;
  bool dry_run = false, yes = false;
};
int param_save_command(const LiveAddress& target, const SaveOptions& options);

/// `words`: one text in braces, or key=value.
int call_command(const LiveAddress& target, const std::string& request,
                 const std::vector<std::string>& words);
int phase_command(const LiveAddress& target, const std::string& phase);
int swap_command(const LiveAddress& target, const std::string& component, const std::string& file);
int reset_command(const LiveAddress& target);

// pace.cpp
int pause_command(const LiveAddress& target);
int resume_command(const LiveAddress& target);
/// Ends after the last of the ticks.
int step_command(const LiveAddress& target, const std::string& ticks);
int speed_command(const LiveAddress& target, const std::string& speed);
/// Ends when the new flight has begun. `seed`: "" is that of the old flight.
int restart_command(const LiveAddress& target, const std::string& seed);

}  // namespace fulmar::core
