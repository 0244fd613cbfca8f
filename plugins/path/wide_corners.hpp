// SPDX-License-Identifier: BSD-3-Clause
// Fillets of the leg that are flown wider than planned, because the wind makes them too tight.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "flown_leg.hpp"
#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "leg_ends.hpp"
#include "wide_fillet.hpp"

namespace fulmar::path {

/// The corners at begin and end of the leg.
class WideCorners {
 public:
  operator std::span<const WideCorner>() const { return corners_; }

  /// A corner without room in a changed plan is flown as planned.
  void fit(const Route& route, const Plan& plan) {
    for (WideCorner& corner : corners_) {
      const std::uint32_t i = find_id(plan, corner.id);
      if (i == plan.waypoints.count || route.widest_fillet_m(i) < corner.radius_m) corner = {};
    }
  }
  /// Begins a leg: the corners of the lap before are dropped.
  void begin_leg(const Route& route, std::uint32_t item) {
    for (WideCorner& corner : corners_)
      if (corner.id != route.id(item) && corner.id != route.id(route.before(item))) corner = {};
  }
  /// True when the fillet at the end of the leg becomes wider now. Decided once, a second before the wider
  /// one begins.
  bool widen(const Route& route, const FlownLeg& leg, std::uint32_t item, const VehicleState& state,
             double bank_rad) {
    const std::uint32_t id = route.id(item);
    const RoutePiece* const arc = leg.last_piece_next();
    if (!arc || bank_rad <= 0 || id == 0 || corners_[1].id == id || !state.wind_valid) return false;
    if (leg.piece().kind != PathKind::line || arc->kind != PathKind::orbit) return false;
    const double Va = state.airspeed_mps, half_turn = arc->length_m / arc->radius_m;  // half of the arc
    const double to_corner_m = leg.piece().length_m - leg.along_m() + arc->radius_m * std::tan(half_turn);
    const auto begins = [&](double radius_m) {
      return radius_m > arc->radius_m &&
             to_corner_m < radius_m * std::tan(half_turn) + before_s * state.ground_speed_mps;
    };
    const double most_m = wider_fillet_m(arc->radius_m, radius_in_any_wind(Va, state.wind_mps, bank_rad));
    if (!begins(most_m)) return false;
    const double course = std::atan2(leg.piece().unit_east_ratio, leg.piece().unit_north_ratio);
    const double held_m =
        radius_in_wind(course, 2 * sign_of(arc->turn) * half_turn, Va, state.wind_mps, bank_rad);
    const double radius_m = std::min(wider_fillet_m(arc->radius_m, held_m), route.widest_fillet_m(item));
    if (!begins(radius_m)) return false;
    corners_ = {corners_[1], {id, radius_m}};
    return true;
  }

 private:
  static constexpr double before_s = 1;
  std::array<WideCorner, 2> corners_{};
};

}  // namespace fulmar::path
