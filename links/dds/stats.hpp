// SPDX-License-Identifier: BSD-3-Clause
// The figures of the DDS bridge.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace fulmar::core {

struct DdsStats {
  std::uint64_t sent = 0;      // samples of exports that have a reader
  std::uint64_t received = 0;  // samples for inputs that were handed to the loop
  // samples and requests whose layout is another one, or that the input's ranges do not allow
  std::uint64_t refused = 0;
  std::uint64_t lost = 0;      // samples that this sink was too slow for, out of the flight and into it
  std::uint64_t requests = 0;  // of services
  /// What an imported topic adds to a sample's age before the loop sees it, which takes one tick more. From
  /// the writer's clock to that of this computer: between two computers it is as good as their clocks agree.
  struct Import {
    std::string port, topic;
    std::uint64_t received = 0, refused = 0, lost = 0;
    double latency_mean_s = 0, latency_max_s = 0;
  };
  std::vector<Import> imports;
};

}  // namespace fulmar::core
