// SPDX-License-Identifier: BSD-3-Clause
// For flight_control.cpp alone.
#pragma once
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/run/control.hpp"

namespace fulmar::core {

/// What can be read and commanded; only a swap changes it.
struct FlightControl::Directory {
  FlightView view;
  std::shared_ptr<const CommandTable> commands;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>>
      overlaid;  // per phase: component and parameter

  explicit Directory(const Flight::Impl& flight);
};

}  // namespace fulmar::core
