// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/isolate/shared.hpp"

namespace fulmar::core {

/// Request of the host on the command line.
struct Order {
  const char *copy, *script, *path, *file;
  std::size_t index;
  std::uint64_t seed;
};

/// Loads the plugin, creates the component and serves the host's calls until the call to end. Returns the
/// exit code.
int serve(std::byte* memory, std::size_t size, const Order& order);

}  // namespace fulmar::core
