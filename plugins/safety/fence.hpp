// SPDX-License-Identifier: BSD-3-Clause
// Room between the turn back and a fence.
#pragma once
#include "fulmar/flight/path/fence.hpp"

namespace fulmar::safety {

/// A turn back: after `reaction_s` along the present track, at the bank `roll_rad` through air that moves
/// with the wind, until the ground track points to a place.
struct TurnBack {
  double north_m = 0, east_m = 0;          ///< position of the aircraft
  double v_north_mps = 0, v_east_mps = 0;  ///< ground velocity
  double w_north_mps = 0, w_east_mps = 0;  ///< wind
  double roll_rad = 0.6, reaction_s = 1;
};

/// Least room along the turn, m. `side` +1: to the right. In still air the turn is an arc of radius Vg^2 / (g
/// tan phi), Beard & McLain, Small Unmanned Aircraft (2012), (9.14).
inline double room_of_turn(const Polygon& fence, const TurnBack& t, const Spot& to, double side) {
  constexpr double g = 9.80665;
  double n = t.north_m + t.v_north_mps * t.reaction_s, e = t.east_m + t.v_east_mps * t.reaction_s;
  double room = std::min(fence.room_m(t.north_m, t.east_m), fence.room_m(n, e));
  const double an = t.v_north_mps - t.w_north_mps, ae = t.v_east_mps - t.w_east_mps;
  const double Va = std::max(std::hypot(an, ae), 1.0), omega = g * std::tan(t.roll_rad) / Va;
  const double psi0 = std::atan2(ae, an);
  constexpr double step_rad = 0.15;
  for (double turned = 0; turned < 6.3;) {
    const double a = psi0 + side * turned, dt = step_rad / omega;
    const double b = a + side * step_rad;
    // the chord of the arc is exact at its end
    n += side * Va / omega * (std::sin(b) - std::sin(a)) + t.w_north_mps * dt;
    e -= side * Va / omega * (std::cos(b) - std::cos(a)) - t.w_east_mps * dt;
    turned += step_rad;
    room = std::min(room, fence.room_m(n, e));
    const double track = std::atan2(Va * std::sin(b) + t.w_east_mps, Va * std::cos(b) + t.w_north_mps);
    const double left = side * angle_difference(std::atan2(to.east_m - e, to.north_m - n), track);
    if (left <= 0.1 && left > -1.5) break;  // the track points to the place
  }
  return room;
}

/// The better of both turns, +1 to the right, and its room. The short turn is preferred while it leaves
/// `enough_m`.
struct WayBack {
  double room_m = 0, side = 0;
};
inline WayBack way_back(const Polygon& fence, const TurnBack& t, const Spot& to, double enough_m) {
  const double track = std::atan2(t.v_east_mps, t.v_north_mps);
  const double error = angle_difference(std::atan2(to.east_m - t.east_m, to.north_m - t.north_m), track);
  const double side = error < 0 ? -1 : 1, room = room_of_turn(fence, t, to, side);
  if (room >= enough_m) return {room, side};
  const double other = room_of_turn(fence, t, to, -side);
  return other > room ? WayBack{other, -side} : WayBack{room, side};
}

/// Room to floor and ceiling, m, minus the height to level off at `pull_mps2` after `reaction_s`.
inline double room_of_height(double height_m, double climb_mps, double floor_m, double ceiling_m,
                             double pull_mps2, double reaction_s) {
  const double needed = std::abs(climb_mps) * reaction_s + climb_mps * climb_mps / (2 * pull_mps2);
  const double up = ceiling_m - height_m - (climb_mps > 0 ? needed : 0);
  const double down = height_m - floor_m - (climb_mps < 0 ? needed : 0);
  return std::min(up, down);
}

}  // namespace fulmar::safety
