// SPDX-License-Identifier: BSD-3-Clause
// The figures of the DDS bridge.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace fulmar::core {

struct DdsStats {
  std::uint64_t sent = 0;      // samples of exports that have a reader
  std::uint64_t received = 0;  // samples for inputs that were passed to the loop
  // rejected samples and requests: another layout, or values outside the input's ranges
  std::uint64_t refused = 0;
  std::uint64_t lost = 0;      // samples that this sink lost because it was too slow, exports and imports
  std::uint64_t requests = 0;  // service requests
  /// Delay of an imported topic until the loop gets the sample; one tick follows. It is measured from the
  /// writer's clock to the clock of this computer, so between computers it includes their clock offset.
  struct Import {
    std::string port, topic;
    std::uint64_t received = 0, refused = 0, lost = 0;
    double latency_mean_s = 0, latency_max_s = 0;
  };
  std::vector<Import> imports;
};

}  // namespace fulmar::core
