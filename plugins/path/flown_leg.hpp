// SPDX-License-Identifier: BSD-3-Clause
// The active leg: its present piece, the progress on it, and the pieces behind it.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::path {

/// A leg of a route in the form of its message.
inline PathPiece piece_of(const RoutePiece& from, double airspeed_mps) {
  PathPiece piece;
  piece.kind = from.kind;
  piece.turn = from.turn;
  piece.climb_ratio = from.climb_ratio;
  piece.origin_m = {from.north_m, from.east_m, -from.height_m};
  piece.airspeed_mps = airspeed_mps;
  piece.length_m = from.length_m;
  if (from.kind == PathKind::line) {
    const double norm = 1 / std::sqrt(1 + from.climb_ratio * from.climb_ratio);
    piece.direction_ratio = {from.unit_north_ratio * norm, from.unit_east_ratio * norm,
                             -from.climb_ratio * norm};
  } else {
    piece.radius_m = from.radius_m;
    piece.start_rad = from.start_rad;
  }
  return piece;
}

/// A leg, the next leg, and the progress along its pieces.
class FlownLeg {
 public:
  /// Starts at the begin of one of its pieces. `item`: the waypoint at its end.
  Path begin(const Route& route, const RouteLeg& leg, std::uint32_t item, std::size_t piece) {
    leg_ = leg;
    end_square_m2_ = unknown_std * unknown_std;
    along_m_ = 0;
    return change(route, item, piece);
  }
  /// The plan has changed the next leg and the airspeed; the aircraft stays at its place on this leg.
  Path keep(const Route& route, std::uint32_t item) {
    leg_.airspeed_mps = route.airspeed_mps(item);
    return change(route, item, piece_);
  }
  /// The same leg with a wider fillet at its end; the straight line before it stays active.
  Path widen(const Route& route, std::uint32_t item) {
    leg_ = route.leg(item);
    std::size_t straight = leg_.count;  // its last one: the number of pieces before it may have changed
    while (straight > 1 && leg_[straight - 1].kind != PathKind::line) --straight;
    return change(route, item, straight - 1);
  }
  Path begin_next_piece(const Route& route) {
    along_m_ = 0;
    return begin_piece(route, piece_ + 1);
  }
  void measure(const VehicleState& state);

  const Pose& end() const { return leg_.end; }
  const RouteLeg& next() const { return next_leg_; }
  const RoutePiece& piece() const { return leg_[piece_]; }
  /// The next piece, if it is the last of the leg.
  const RoutePiece* last_piece_next() const { return piece_ + 2 == leg_.count ? &leg_[piece_ + 1] : nullptr; }
  bool on_last_piece() const { return piece_ + 1 >= leg_.count; }
  double along_m() const { return along_m_; }
  bool past_piece() const { return !(along_m_ < piece().length_m); }
  /// Smallest distance so far from the end of the leg.
  double miss_m() const { return std::sqrt(end_square_m2_); }
  double off_piece_m(const Vec3<Ned>& at) const;
  void put_progress_into(Path& path) const;

 private:
  Path change(const Route& route, std::uint32_t item, std::size_t piece) {
    goes_on_ = route.closed() || item + 1 < route.size();
    if (goes_on_) next_leg_ = route.leg(route.after(item));
    return begin_piece(route, piece);
  }
  Path begin_piece(const Route& route, std::size_t index);
  void look_ahead(const Route& route, Path& path);
  void foresee(const RouteLeg& leg, std::size_t index, bool next_leg_follows, Path& path) const;

  RouteLeg leg_, next_leg_;
  bool goes_on_ = false;  // there is a next leg
  std::size_t piece_ = 0;
  double along_m_ = 0;        // on the piece; unwrapped on an arc
  double after_m_ = 0;        // length of the pieces behind it of the same curvature
  double end_square_m2_ = 0;  // smallest distance so far from the end of the leg
};

inline Path FlownLeg::begin_piece(const Route& route, std::size_t index) {
  piece_ = index;
  const PathPiece piece = piece_of(leg_[index], leg_.airspeed_mps);
  Path path;
  path.airspeed_mps = piece.airspeed_mps;
  path.kind = piece.kind;
  path.turn = piece.turn;
  path.climb_ratio = piece.climb_ratio;
  path.origin_m = piece.origin_m;
  path.direction_ratio = piece.direction_ratio;
  path.radius_m = piece.radius_m;
  look_ahead(route, path);
  return path;
}

/// Looks ahead from this piece: distance to the next change of curvature, and the piece there. A fillet
/// belongs to two legs, but is one arc.
inline void FlownLeg::look_ahead(const Route& route, Path& path) {
  const double kappa = piece().curvature();
  after_m_ = 0;
  path.next_curvature_ratio = kappa;
  const auto passes = [&](const RouteLeg& leg, std::size_t from) {
    for (std::size_t i = from; i < leg.count; ++i) {
      path.next_curvature_ratio = leg[i].curvature();
      if (std::abs(path.next_curvature_ratio - kappa) > 1e-9) {
        foresee(leg, i, goes_on_ && &leg == &leg_, path);
        return false;
      }
      after_m_ += leg[i].length_m;
    }
    return true;
  };
  if (!passes(leg_, piece_ + 1)) return;
  if (goes_on_) {
    passes(next_leg_, 0);
  } else {
    const RouteOrbit orbit = route.final_orbit();
    path.next_curvature_ratio = sign_of(orbit.turn) / route.radius_m();
    path.has_next = true;
    path.next.kind = PathKind::orbit;
    path.next.turn = orbit.turn;
    path.next.origin_m = {orbit.north_m, orbit.east_m, -orbit.height_m};
    path.next.radius_m = orbit.radius_m;
    path.next.start_rad = std::atan2(leg_.end.east_m - orbit.east_m, leg_.end.north_m - orbit.north_m);
    path.next.airspeed_mps = leg_.airspeed_mps;
  }
}

/// The next piece, with those behind it of the same curvature.
inline void FlownLeg::foresee(const RouteLeg& leg, std::size_t index, bool next_leg_follows,
                              Path& path) const {
  path.has_next = true;
  path.next = piece_of(leg[index], leg.airspeed_mps);
  const double kappa = leg[index].curvature();
  const auto goes_on = [&](const RouteLeg& of, std::size_t from) {
    for (std::size_t i = from; i < of.count; ++i) {
      if (std::abs(of[i].curvature() - kappa) > 1e-9) return false;
      path.next.length_m += of[i].length_m;
    }
    return true;
  };
  if (goes_on(leg, index + 1) && next_leg_follows) goes_on(next_leg_, 0);
}

inline void FlownLeg::measure(const VehicleState& state) {
  const Vec3<Ned>& at = state.position_m;
  const RoutePiece& piece = leg_[piece_];
  const double s = piece.along(at.north, at.east);
  along_m_ =
      piece.kind == PathKind::line ? s : along_m_ + piece.radius_m * wrap_pi((s - along_m_) / piece.radius_m);
  const double n = at.north - leg_.end.north_m, e = at.east - leg_.end.east_m;
  if (piece_ + 1 == leg_.count) end_square_m2_ = std::min(end_square_m2_, n * n + e * e);
}

/// Distance from the piece: positive to the right of a line, outside of a circle.
inline double FlownLeg::off_piece_m(const Vec3<Ned>& at) const {
  const RoutePiece& piece = leg_[piece_];
  const double n = at.north - piece.north_m, e = at.east - piece.east_m;
  return piece.kind == PathKind::line ? piece.unit_north_ratio * e - piece.unit_east_ratio * n
                                      : std::hypot(n, e) - piece.radius_m;
}

/// Remaining length of the piece. The height of an arc is that at the aircraft, which is unique on turns of
/// more than half a circle.
inline void FlownLeg::put_progress_into(Path& path) const {
  const RoutePiece& piece = leg_[piece_];
  path.remaining_m = piece.length_m - along_m_ + after_m_;
  if (piece.kind != PathKind::orbit) return;
  const double s = std::clamp(along_m_, 0.0, piece.length_m);
  path.start_rad = wrap_pi(piece.start_rad + sign_of(piece.turn) * s / piece.radius_m);
  path.origin_m.down = -piece.height_at(s);
}

}  // namespace fulmar::path
