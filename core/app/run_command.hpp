// SPDX-License-Identifier: BSD-3-Clause
// `fulmar run`.
#pragma once
#include <optional>
#include <string>

#include "core/graph/graph.hpp"

namespace fulmar::core {

struct RunOptions {
  std::string mission;
  Overrides overrides;
  double speed = 0;  // times real time; 0: as fast as possible
  std::optional<double> duration_s;
  std::string log_file;
  bool no_log = false, json = false;
};

/// "real" -> 1, "max" -> 0, "10" -> 10. Throws CLI::ValidationError (wrong usage).
double parse_speed(const std::string& text);

/// Flies; prints progress, then a table or JSON. Returns the exit code.
int run_command(const RunOptions& options);

}  // namespace fulmar::core
