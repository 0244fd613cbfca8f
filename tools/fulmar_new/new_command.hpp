// SPDX-License-Identifier: BSD-3-Clause
// `fulmar new`: writes the project of a plugin that fills a role of a mission.
#pragma once
#include <string>

namespace fulmar::core {

struct NewOptions {
  std::string name;     // of the plugin: "my_law"
  std::string role;     // that it fills: "outer"
  std::string mission;  // whose role; "" : the shipped hourglass
  std::string folder;   // "" : ./NAME
};

/// Writes the project and says what to do next. Throws Error. Returns the exit code.
int new_command(const NewOptions& options);

}  // namespace fulmar::core
