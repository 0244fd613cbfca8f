// SPDX-License-Identifier: BSD-3-Clause
// `fulmar new`: writes the project of a plugin that fills roles of a mission or has no role.
#pragma once
#include <string>
#include <vector>

namespace fulmar::core {

struct NewOptions {
  std::string name;                  // of the plugin: "my_law"
  std::vector<std::string> roles;    // roles that it fills: "outer"; empty: a component without a role
  std::vector<std::string> in, out;  // ports of a component without a role: "state=nav.state", "range=Range"
  std::string from_template;         // or the template: "sensor"
  std::string mission;               // mission of the role; "": the shipped hourglass
  std::string folder;                // "" : ./NAME
};

/// Writes the project and prints the next steps. Throws Error. Returns the exit code.
int new_command(const NewOptions& options);

}  // namespace fulmar::core
