// SPDX-License-Identifier: BSD-3-Clause
// Finds a waypoint, and the active leg, in a plan that was changed.
#pragma once
#include <cstdint>

#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/plan.hpp"

namespace fulmar::path {

inline bool same_spot(const Vec3<Ned>& a, const Vec3<Ned>& b) {
  return a.north == b.north && a.east == b.east;
}

/// Index of the waypoint of this id; the plan's size when there is none.
inline std::uint32_t find_id(const Plan& plan, std::uint32_t id) {
  std::uint32_t i = 0;
  while (i < plan.waypoints.count && plan.waypoints[i].id != id) ++i;
  return i;
}

/// The points at begin and end of the leg, which identify it after a change of the plan.
class LegEnds {
 public:
  void remember(const Route& route, const Plan& plan, std::uint32_t item) {
    from_ = plan.waypoints[route.before(item)].position_m;
    target_ = plan.waypoints[item].position_m;
  }
  void remember_point(const Vec3<Ned>& point) { target_ = point; }
  bool ends_at(const Vec3<Ned>& point) const { return same_spot(point, target_); }
  bool begins_at(const Vec3<Ned>& point) const { return same_spot(point, from_); }
  /// Index of the waypoint at its end, the one nearest to `near` in the list; the plan's size for none.
  std::uint32_t find_target(const Plan& plan, std::uint32_t near) const {
    const std::uint32_t n = plan.waypoints.count;
    for (std::uint32_t d = 0; d < n || d <= near; ++d) {  // the list may have become shorter than `near`
      if (near + d < n && ends_at(plan.waypoints[near + d].position_m)) return near + d;
      if (near >= d && near - d < n && ends_at(plan.waypoints[near - d].position_m)) return near - d;
    }
    return n;
  }

 private:
  Vec3<Ned> from_, target_;
};

}  // namespace fulmar::path
