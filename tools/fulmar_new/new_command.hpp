// SPDX-License-Identifier: BSD-3-Clause
// `fulmar new`: writes the project of a plugin that fills roles of a mission or
// stands beside them.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

struct NewOptions {
  std::string name;                  // of the plugin: "my_law"
  std::vector<std::string> roles;    // that it fills: "outer"; none: it stands beside them
  std::vector<std::string> in, out;  // then its ports: "state=nav.state", "range=Range"
  std::string from_template;         // or what it is like: "sensor"
  std::string mission;               // whose role; "" : the shipped hourglass
  std::string folder;                // "" : ./NAME
};

/// Writes the project and says what to do next. Throws Error. Returns the exit code.
int new_command(const NewOptions& options);

}  // namespace fulmar::core
