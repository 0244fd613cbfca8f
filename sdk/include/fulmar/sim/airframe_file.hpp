// SPDX-License-Identifier: BSD-3-Clause
// An airframe from its YAML file, as the host reads it. The only part of the model with a library:
// lib/libfulmar_sim.so, which the CMake target fulmar::sim links.
#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

#include "fulmar/msg/airframe.hpp"

extern "C" {
/// Reads an airframe into an Airframe of `size` bytes. Returns 0, or 1 for an error.
int fulmar_sim_read_airframe(const char* name, void* airframe, std::size_t size);
/// Text of the last error of this thread.
const char* fulmar_sim_error();
}

namespace fulmar::sim {

/// `name`: a file, or a shipped one such as "fulmar:airframes/anaconda.yaml". Throws std::invalid_argument
/// that lists every fault with file:line.
inline Airframe read_airframe(const std::string& name) {
  Airframe a;
  if (fulmar_sim_read_airframe(name.c_str(), &a, sizeof a) != 0)
    throw std::invalid_argument(fulmar_sim_error());
  return a;
}

}  // namespace fulmar::sim
