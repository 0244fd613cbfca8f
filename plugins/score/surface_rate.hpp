// SPDX-License-Identifier: BSD-3-Clause
// Rate of the surface commands.
#pragma once
#include <cstdint>

#include "fulmar/msg/actuators.hpp"
#include "mean_square.hpp"

namespace fulmar::score {

class SurfaceRate {
 public:
  /// Adds a command. `counts`: the flight is scored.
  void command(const Actuators& now, std::int64_t now_ns, bool counts) {
    const double dt_s = 1e-9 * static_cast<double>(now_ns - last_ns_);
    if (counts && seen_ > 0 && dt_s > 0) {
      rate_.add((now.aileron_rad - last_.aileron_rad) / dt_s);
      rate_.add((now.elevator_rad - last_.elevator_rad) / dt_s);
      rate_.add((now.rudder_rad - last_.rudder_rad) / dt_s);
    }
    last_ = now;
    last_ns_ = now_ns;
    ++seen_;
  }
  double rms_if_any() const { return rate_.rms_if_any(); }

 private:
  MeanSquare rate_;
  Actuators last_;
  std::int64_t last_ns_ = 0;
  std::uint64_t seen_ = 0;
};

}  // namespace fulmar::score
