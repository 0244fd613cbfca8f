// SPDX-License-Identifier: BSD-3-Clause
// When a circuit of the plan is complete.
#pragma once
#include <cstdint>

namespace fulmar::path {

/// A circuit is complete when the waypoint at which it began is reached again, whatever was put in and taken
/// out meanwhile.
class Circuits {
 public:
  /// A waypoint is reached. Is a circuit complete with it?
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
  /// Id of the waypoint at which it began; 0: none.
  std::uint32_t begun_at() const { return id_; }

 private:
  bool begun_ = false;
  std::uint32_t id_ = 0, item_ = 0;  // of the waypoint at which it began
  std::uint32_t legs_ = 0;           // waypoints reached since
};

}  // namespace fulmar::path
