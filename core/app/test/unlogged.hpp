// SPDX-License-Identifier: BSD-3-Clause
// Flights without a log, with the copies of their plugins in a temporary folder.
#pragma once
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/run/flight.hpp"

namespace fulmar::core::test {

struct OwnStore {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("fulmar-own-store-" + std::to_string(getpid()));
  OwnStore() {
    std::filesystem::create_directories(path);
    setenv("FULMAR_STORE", (path / "store").c_str(), 1);
  }
  ~OwnStore() { std::filesystem::remove_all(path); }
  OwnStore(const OwnStore&) = delete;
  OwnStore& operator=(const OwnStore&) = delete;
};

inline FlightOptions unlogged() {
  FlightOptions o;
  o.log = false;
  return o;
}

}  // namespace fulmar::core::test
