// SPDX-License-Identifier: BSD-3-Clause
// Detects a complete circuit of the plan.
#pragma once
#include <cstdint>

namespace fulmar::path {

/// A circuit is complete when the waypoint at its begin is reached again, in spite of waypoints that were
/// added or removed meanwhile.
class Circuits {
 public:
  /// Called when a waypoint is reached. Returns true when a circuit is complete.
  bool reach(std::uint32_t id, std::uint32_t item) {
    if (!begun_) {
      begun_ = true;
      id_ = id;
      item_ = item;
      return false;
    }
    if (id != 0 ? id != id_ : item != item_) {
      ++legs_;
      return false;
    }
    const bool complete = legs_ > 0;
    legs_ = 0;
    return complete;
  }
  /// Id of the waypoint at the begin; 0: none.
  std::uint32_t begun_at() const { return id_; }

 private:
  bool begun_ = false;
  std::uint32_t id_ = 0, item_ = 0;  // of the waypoint at the begin
  std::uint32_t legs_ = 0;           // number of waypoints reached since then
};

}  // namespace fulmar::path
