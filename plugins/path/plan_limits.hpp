// SPDX-License-Identifier: BSD-3-Clause
// Checks of a plan against its aircraft and place: waypoints inside the fence, airspeed and bank within the
// limits of the airframe.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "fulmar/flight/path/fence.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/plan.hpp"
#include "messages.hpp"

namespace fulmar::path {

/// Ends the set-up with a message at a part of a parameter.
[[noreturn]] inline void refuse(const std::string& path, const Diagnostic& fault) {
  throw std::runtime_error(located(path, fault).line());
}
inline std::string path_of_waypoint(std::size_t i) { return "plan.waypoints[" + std::to_string(i) + "]"; }

/// The fence of a plan, for its waypoints in the file and in edits.
class PlanFence {
 public:
  /// Throws std::runtime_error for an invalid fence.
  void set(const safety::Fence& fence, const Origin& origin) {
    polygon_.set(fence, origin);
    floor_m_ = fence.floor_m;
    ceiling_m_ = fence.ceiling_m;
  }
  /// Why a place is not inside; empty: it is, or there is no fence. [tick]
  std::optional<Text<80>> fault_of(const Vec3<Ned>& p) const {
    if (!polygon_.given()) return {};
    const double up_m = -p.down, room_m = polygon_.room_m(p.north, p.east);
    const Fixed height{up_m, 1};
    if (room_m < 0) return path_messages::waypoint_outside_fence.to<Text<80>>(std::lround(-room_m));
    if (up_m > ceiling_m_) return path_messages::waypoint_above_ceiling.to<Text<80>>(height, ceiling_m_);
    if (up_m < floor_m_) return path_messages::waypoint_below_floor.to<Text<80>>(height, floor_m_);
    return {};
  }

 private:
  safety::Polygon polygon_;
  double floor_m_ = 0, ceiling_m_ = 0;
};

/// A warning of an airspeed outside of the airframe's limits; "" for one inside.
inline std::array<char, 96> airspeed_doubt(const Plan& plan, const FlightLimits& limits) {
  std::array<char, 96> words{};
  const auto look = [&](double Va) {
    if (words[0] != 0 || Va <= 0 || (Va >= limits.airspeed_min_mps && Va <= limits.airspeed_max_mps)) return;
    path_messages::airspeed_beyond_airframe.write(words.data(), words.size(), Fixed{Va, 0},
                                                  Fixed{limits.airspeed_min_mps, 0},
                                                  Fixed{limits.airspeed_max_mps, 0});
  };
  look(plan.airspeed_mps);
  for (const Waypoint& w : plan.waypoints) look(w.airspeed_mps);
  return words;
}

/// The same for a turn radius that needs more bank than the limit. r = Va^2 / (g tan phi).
inline std::array<char, 96> radius_doubt(const Plan& plan, const FlightLimits& limits) {
  constexpr double g_mps2 = 9.80665, degrees = 180 / std::numbers::pi;
  std::array<char, 96> words{};
  const double Va2 = plan.airspeed_mps * plan.airspeed_mps;
  const double least_m = Va2 / (g_mps2 * std::tan(limits.roll_max_rad));
  if (plan.turn_radius_m < least_m)
    path_messages::turn_radius_tight.write(words.data(), words.size(), Fixed{plan.turn_radius_m, 0},
                                           Fixed{degrees * std::atan(Va2 / (g_mps2 * plan.turn_radius_m)), 0},
                                           Fixed{degrees * limits.roll_max_rad, 0}, Fixed{least_m, 0});
  return words;
}

}  // namespace fulmar::path
