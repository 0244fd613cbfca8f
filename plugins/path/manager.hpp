// SPDX-License-Identifier: BSD-3-Clause
// Follows the route of the plan piece by piece: join, legs, final orbit. Beard & McLain, Small Unmanned
// Aircraft (2012), chapter 11, with fillets and Dubins paths treated alike as pieces whose end is a length
// along them, so that no half-plane can be missed.
#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "reckoning.hpp"
#include "wide_fillet.hpp"

namespace fulmar::path {

struct Manager {
  static constexpr const char* doc =
      "The piece of the plan's route that is to be flown now, and how far the plan has been flown.";
  struct Inputs {
    In<VehicleState> state;
    In<Plan> plan;
  };
  struct Outputs {
    Out<Path> path;  // silent until the position is known
    Progress progress;
  };
  struct Params {
    Param hold_height{50, "m", 0, 10000, "lowest height of the orbit that is flown while the plan is empty"};
    Count first_item{0, 0, 65535, "index of the waypoint to begin with; changed in flight: go there at once"};
    Param rejoin_distance{25, "m", 5, 1000,
                          "off the way to the plan by more than this: draw a new one from here"};
    Param fillet_bank{0.72, "rad", 0, 1.4,
                      "a fillet that takes more than this in the wind is flown wider; 0: never"};
    Param reckon_std{50, "m", 0, 1000, "without a fix the plan goes on up to this deviation of the position"};
    Param reckon_time{115, "s", 0, 3600,
                      "and for so long after the position stopped being valid, 5 s after the fix"};
  };

  void configure(const Params& p) { retune(p); }
  void retune(const Params& p) {
    if (p.first_item == first_item_) return;
    first_item_ = p.first_item;
    begin_with_ = progress_.item = static_cast<std::uint32_t>(first_item_);
    mode_ = Mode::idle;
  }
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out);
  Status activate(const Tick&, const Inputs&, const Params&, const Outputs&) {
    mode_ = Mode::idle;  // take up the plan from where the aircraft is by then, at the same waypoint
    return Status::ok;
  }

 private:
  enum class Mode : std::uint8_t { idle, join, leg, orbit };
  struct Lap {
    bool begun = false;
    std::uint32_t id = 0, item = 0;  // of the waypoint at which it began
    std::uint32_t legs = 0;          // waypoints reached since
  };

  void adopt(const Route& route, const Plan& plan, const VehicleState& state, const Params& p);
  void keep_or_join(const Route& route, const Plan& plan, const VehicleState& state);
  std::uint32_t find(const Plan& plan, const Vec3<Ned>& point, std::uint32_t near) const;
  static std::uint32_t find_id(const Plan& plan, std::uint32_t id) {
    std::uint32_t i = 0;
    while (i < plan.waypoints.count && plan.waypoints[i].id != id) ++i;
    return i;
  }
  void begin_orbit(const RouteOrbit& orbit);
  void begin_join(const Route& route, const VehicleState& state, std::uint32_t item);
  void begin_leg(const Route& route, const RouteLeg& leg, Mode mode, std::uint32_t item, std::size_t piece);
  void begin_piece(const Route& route, std::size_t index);
  void look_ahead(const Route& route);
  void foresee(const RouteLeg& leg, std::size_t index, bool next_leg_follows);
  void widen(const Route& route, const VehicleState& state, double bank_rad);
  void fly(const Route& route, const VehicleState& state, const Params& p);
  void measure(const VehicleState& state);
  void count_lap(const Route& route);
  void reach(const Route& route, const VehicleState& state);
  void circle(const Route& route, const VehicleState& state);
  void fill(const Route& route, const Plan& plan, const VehicleState& state);

  Mode mode_ = Mode::idle;
  std::array<WideCorner, 2> wide_{};  // of the leg: where it begins, and where it ends
  RouteLeg leg_, next_leg_;
  std::size_t piece_ = 0;
  double along_m_ = 0;        // on the piece; unwrapped on an arc
  double after_m_ = 0;        // length of the pieces behind it of the same curvature
  double end_square_m2_ = 0;  // closest so far to the end of the leg
  RouteOrbit orbit_;
  double swept_rad_ = 0, azimuth_rad_ = 0;  // on the orbit
  bool on_orbit_ = false;
  Pose joined_from_;
  Path path_;
  Progress progress_;
  Reckoning reckoning_;
  std::uint32_t item_ = 0, jumps_ = 0, revision_ = 0;
  Lap lap_;
  std::int64_t first_item_ = 0;              // as the parameter was seen last
  std::optional<std::uint32_t> begin_with_;  // of the next adoption of a plan
  Vec3<Ned> target_, from_;                  // of the leg: to recognise them after a change of the plan
};

inline Pose pose_of(const VehicleState& state) {
  return {state.position_m.north, state.position_m.east, state.course_rad};
}

inline bool same_spot(const Vec3<Ned>& a, const Vec3<Ned>& b) {
  return a.north == b.north && a.east == b.east;
}

/// A piece of a route as a message tells it.
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

inline Status Manager::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const VehicleState& state = *in.state;
  const Plan& plan = *in.plan;
  const Route route(plan, wide_);
  // Nothing is known of the progress: the path that was published stays in force.
  if (!reckoning_.located(state, tick.now_ns, p.reckon_std, p.reckon_time)) {
    out.progress = progress_;
    return Status::degraded;
  }
  if (mode_ == Mode::idle || in.plan.fresh() || plan.revision != revision_) adopt(route, plan, state, p);
  if (mode_ == Mode::orbit) {
    circle(route, state);
  } else {
    fly(route, state, p);
  }
  fill(route, plan, state);
  out.path.publish(path_);
  out.progress = progress_;
  return state.position_valid ? Status::ok : Status::degraded;
}

/// Takes up a plan that is new or changed. The waypoint that is flown to stays the same one if it is still
/// there.
inline void Manager::adopt(const Route& route, const Plan& plan, const VehicleState& state, const Params& p) {
  const std::optional<std::uint32_t> first = std::exchange(begin_with_, std::nullopt);
  const bool was_empty = progress_.items == 0,
             jump = first || plan.jumps != jumps_ || was_empty || revision_ == 0;
  const bool was_idle = mode_ == Mode::idle;
  // The waypoint at which the circuit began was taken out: it begins with the next one that is reached.
  if (lap_.id != 0 && find_id(plan, lap_.id) == plan.waypoints.count) lap_ = {};
  for (WideCorner& corner : wide_) {  // one that a changed plan has no room for is flown as planned
    const std::uint32_t i = find_id(plan, corner.id);
    if (i == plan.waypoints.count || route.widest_fillet_m(i) < corner.radius_m) corner = {};
  }
  revision_ = plan.revision;
  jumps_ = plan.jumps;
  progress_.items = route.size();
  progress_.plan_revision = plan.revision;
  if (route.size() == 0) {
    if (was_empty && !was_idle) {  // go on with the orbit
      orbit_.radius_m = route.radius_m();
      return;
    }
    item_ = 0;
    lap_ = {};
    progress_.finished = false;
    const double height_m = std::max(state.height_m, p.hold_height.value);
    begin_orbit({state.position_m.north, state.position_m.east, height_m, route.radius_m(), Turn::right});
    return;
  }
  if (route.is_point()) {
    const bool same =
        !jump && !was_idle && mode_ == Mode::orbit && same_spot(plan.waypoints[0].position_m, target_);
    item_ = 0;
    target_ = plan.waypoints[0].position_m;
    RouteOrbit orbit{target_.north, target_.east, route.height_m(0), route.radius_m(), orbit_.turn};
    if (!same) orbit.turn = min_turning(pose_of(state), orbit.north_m, orbit.east_m, orbit.radius_m);
    if (!same) progress_.finished = false;
    if (same)
      orbit_ = orbit;
    else
      begin_orbit(orbit);
    return;
  }
  if (jump) {
    lap_ = {};
    progress_.finished = false;
    begin_join(route, state, std::min(first.value_or(plan.jump_item), route.size() - 1));
  } else if (was_idle) {
    begin_join(route, state, std::min(item_, route.size() - 1));
  } else {
    keep_or_join(route, plan, state);
  }
}

inline void Manager::keep_or_join(const Route& route, const Plan& plan, const VehicleState& state) {
  const std::uint32_t n = route.size(), k = find(plan, target_, item_);
  if (k == n) return begin_join(route, state, std::min(item_, n - 1));
  if (mode_ == Mode::orbit) {  // the end of the plan was reached; it goes on if waypoints came behind it
    if (!route.closed() && k + 1 == n) {
      item_ = k;
      orbit_ = route.final_orbit();
      return;
    }
    progress_.finished = false;
    return begin_join(route, state, route.after(k));
  }
  if (mode_ == Mode::join) {
    const Pose end = route.passage(k).middle;
    const bool same = end.north_m == leg_.end.north_m && end.east_m == leg_.end.east_m &&
                      end.course_rad == leg_.end.course_rad;
    if (!same) return begin_join(route, state, k);
    item_ = k;
    leg_.airspeed_mps = route.airspeed_mps(k);
    if (route.closed() || k + 1 < route.size()) next_leg_ = route.leg(route.after(k));
    return begin_piece(route, piece_);
  }
  if (!same_spot(plan.waypoints[route.before(k)].position_m, from_)) return begin_join(route, state, k);
  const RouteLeg leg = route.leg(k);
  double best_m = unknown_std;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < leg.count; ++i) {
    RouteLeg one;
    one.count = 1;
    one.pieces[0] = leg[i];
    const double d = nearest(one, state.position_m.north, state.position_m.east).distance_m;
    if (d < best_m - 1e-6) {
      best_m = d;
      piece = i;
    }
  }
  begin_leg(route, leg, Mode::leg, k, piece);
}

/// Index of a waypoint at this point, the one nearest to `near` in the list; the plan's size when there is
/// none.
inline std::uint32_t Manager::find(const Plan& plan, const Vec3<Ned>& point, std::uint32_t near) const {
  const std::uint32_t n = plan.waypoints.count;
  for (std::uint32_t d = 0; d < n || d <= near; ++d) {  // the list may have become shorter than `near`
    if (near + d < n && same_spot(plan.waypoints[near + d].position_m, point)) return near + d;
    if (near >= d && near - d < n && same_spot(plan.waypoints[near - d].position_m, point)) return near - d;
  }
  return n;
}

inline void Manager::begin_orbit(const RouteOrbit& orbit) {
  mode_ = Mode::orbit;
  orbit_ = orbit;
  swept_rad_ = 0;
  on_orbit_ = false;
  path_ = {};
  path_.kind = PathKind::orbit;
}

inline void Manager::begin_join(const Route& route, const VehicleState& state, std::uint32_t item) {
  joined_from_ = pose_of(state);
  begin_leg(route, route.join(joined_from_, state.height_m, item), Mode::join, item, 0);
}

inline void Manager::begin_leg(const Route& route, const RouteLeg& leg, Mode mode, std::uint32_t item,
                               std::size_t piece) {
  leg_ = leg;
  mode_ = mode;
  item_ = item;
  end_square_m2_ = unknown_std * unknown_std;
  along_m_ = 0;
  for (WideCorner& corner : wide_)  // those of the lap before
    if (corner.id != route.id(item) && corner.id != route.id(route.before(item))) corner = {};
  if (route.closed() || item + 1 < route.size()) next_leg_ = route.leg(route.after(item));
  begin_piece(route, piece);
}

inline void Manager::begin_piece(const Route& route, std::size_t index) {
  piece_ = index;
  const PathPiece piece = piece_of(leg_[index], leg_.airspeed_mps);
  path_ = {};
  path_.airspeed_mps = piece.airspeed_mps;
  path_.kind = piece.kind;
  path_.turn = piece.turn;
  path_.climb_ratio = piece.climb_ratio;
  path_.origin_m = piece.origin_m;
  path_.direction_ratio = piece.direction_ratio;
  path_.radius_m = piece.radius_m;
  look_ahead(route);
}

/// What comes behind this piece: how far it is to the next change of curvature, and to which piece. A fillet
/// is of two legs, and one arc to who looks ahead.
inline void Manager::look_ahead(const Route& route) {
  const double kappa = leg_[piece_].curvature();
  const bool goes_on = route.closed() || item_ + 1 < route.size();
  after_m_ = 0;
  path_.next_curvature_ratio = kappa;
  const auto passes = [&](const RouteLeg& leg, std::size_t from) {
    for (std::size_t i = from; i < leg.count; ++i) {
      path_.next_curvature_ratio = leg[i].curvature();
      if (std::abs(path_.next_curvature_ratio - kappa) > 1e-9) {
        foresee(leg, i, goes_on && &leg == &leg_);
        return false;
      }
      after_m_ += leg[i].length_m;
    }
    return true;
  };
  if (!passes(leg_, piece_ + 1)) return;
  if (goes_on) {
    passes(next_leg_, 0);
  } else {
    const RouteOrbit orbit = route.final_orbit();
    path_.next_curvature_ratio = sign_of(orbit.turn) / route.radius_m();
    path_.has_next = true;
    path_.next.kind = PathKind::orbit;
    path_.next.turn = orbit.turn;
    path_.next.origin_m = {orbit.north_m, orbit.east_m, -orbit.height_m};
    path_.next.radius_m = orbit.radius_m;
    path_.next.start_rad = std::atan2(leg_.end.east_m - orbit.east_m, leg_.end.north_m - orbit.north_m);
    path_.next.airspeed_mps = leg_.airspeed_mps;
  }
}

/// The piece that comes next, with those behind it that go on with its curvature.
inline void Manager::foresee(const RouteLeg& leg, std::size_t index, bool next_leg_follows) {
  path_.has_next = true;
  path_.next = piece_of(leg[index], leg.airspeed_mps);
  const double kappa = leg[index].curvature();
  const auto goes_on = [&](const RouteLeg& of, std::size_t from) {
    for (std::size_t i = from; i < of.count; ++i) {
      if (std::abs(of[i].curvature() - kappa) > 1e-9) return false;
      path_.next.length_m += of[i].length_m;
    }
    return true;
  };
  if (goes_on(leg, index + 1) && next_leg_follows) goes_on(next_leg_, 0);
}

/// A fillet that the wind makes too tight is flown wider: decided once, a second before the wider one begins.
inline void Manager::widen(const Route& route, const VehicleState& state, double bank_rad) {
  constexpr double before_s = 1;
  const std::uint32_t id = route.id(item_);
  if (piece_ + 2 != leg_.count || bank_rad <= 0 || id == 0 || wide_[1].id == id || !state.wind_valid) return;
  const RoutePiece &line = leg_[piece_], &arc = leg_[piece_ + 1];
  if (line.kind != PathKind::line || arc.kind != PathKind::orbit) return;
  const double Va = state.airspeed_mps, half_turn = arc.length_m / arc.radius_m;  // the arc is half of it
  const double to_corner_m = line.length_m - along_m_ + arc.radius_m * std::tan(half_turn);
  const auto begins = [&](double radius_m) {
    return radius_m > arc.radius_m &&
           to_corner_m < radius_m * std::tan(half_turn) + before_s * state.ground_speed_mps;
  };
  if (!begins(wider_fillet_m(arc.radius_m, radius_in_any_wind(Va, state.wind_mps, bank_rad)))) return;
  const double course = std::atan2(line.unit_east_ratio, line.unit_north_ratio);
  const double held_m =
      radius_in_wind(course, 2 * sign_of(arc.turn) * half_turn, Va, state.wind_mps, bank_rad);
  const double radius_m = std::min(wider_fillet_m(arc.radius_m, held_m), route.widest_fillet_m(item_));
  if (!begins(radius_m)) return;
  wide_ = {wide_[1], {id, radius_m}};
  leg_ = route.leg(item_);
  next_leg_ = route.leg(route.after(item_));
  std::size_t straight = leg_.count;  // its last: what leads there may be another number of pieces now
  while (straight > 1 && leg_[straight - 1].kind != PathKind::line) --straight;
  begin_piece(route, straight - 1);
}

inline void Manager::fly(const Route& route, const VehicleState& state, const Params& p) {
  if (mode_ == Mode::join) {
    const Vec3<Ned>& at = state.position_m;
    const RoutePiece& piece = leg_[piece_];
    const double n = at.north - piece.north_m, e = at.east - piece.east_m;
    const double off = piece.kind == PathKind::line ? piece.unit_north_ratio * e - piece.unit_east_ratio * n
                                                    : std::hypot(n, e) - piece.radius_m;
    const bool moved =
        std::hypot(at.north - joined_from_.north_m, at.east - joined_from_.east_m) > route.radius_m();
    if (std::abs(off) > p.rejoin_distance && moved) begin_join(route, state, item_);
  }
  if (mode_ == Mode::leg) widen(route, state, p.fillet_bank);
  constexpr int pieces_per_step = 8;  // short ones are passed at once
  for (int i = 0; i < pieces_per_step && mode_ != Mode::orbit; ++i) {
    measure(state);
    if (along_m_ < leg_[piece_].length_m) return;
    along_m_ = 0;
    if (piece_ + 1 < leg_.count) {
      begin_piece(route, piece_ + 1);
    } else {
      reach(route, state);
    }
  }
  if (mode_ != Mode::orbit) measure(state);
}

inline void Manager::measure(const VehicleState& state) {
  const Vec3<Ned>& at = state.position_m;
  const RoutePiece& piece = leg_[piece_];
  const double s = piece.along(at.north, at.east);
  along_m_ =
      piece.kind == PathKind::line ? s : along_m_ + piece.radius_m * wrap_pi((s - along_m_) / piece.radius_m);
  const double n = at.north - leg_.end.north_m, e = at.east - leg_.end.east_m;
  if (piece_ + 1 == leg_.count) end_square_m2_ = std::min(end_square_m2_, n * n + e * e);
}

/// A circuit is complete when the waypoint at which it began is reached again, whatever was put in and taken
/// out meanwhile.
inline void Manager::count_lap(const Route& route) {
  const std::uint32_t id = route.id(item_);
  if (lap_.begun && (id != 0 ? id == lap_.id : item_ == lap_.item)) {
    if (lap_.legs > 0) ++progress_.circuits;
    lap_.legs = 0;
  } else if (lap_.begun) {
    ++lap_.legs;
  } else {
    lap_ = {true, id, item_, 0};
  }
}

inline void Manager::reach(const Route& route, const VehicleState& state) {
  ++progress_.reached;
  progress_.miss_m = std::sqrt(end_square_m2_);
  count_lap(route);
  if (!route.closed() && item_ + 1 == route.size()) {
    if (!progress_.finished) ++progress_.circuits;
    progress_.finished = true;
    lap_ = {};
    begin_orbit(route.final_orbit());
    on_orbit_ = true;
    azimuth_rad_ = std::atan2(state.position_m.east - orbit_.east_m, state.position_m.north - orbit_.north_m);
    return;
  }
  const RouteLeg leg = next_leg_;
  begin_leg(route, leg, Mode::leg, route.after(item_), 0);
}

/// On the final orbit, around a single waypoint, or around nothing. Around a single waypoint of a circuit
/// each full circle counts.
inline void Manager::circle(const Route& route, const VehicleState& state) {
  const double n = state.position_m.north - orbit_.north_m, e = state.position_m.east - orbit_.east_m,
               d = std::hypot(n, e);
  const double azimuth = std::atan2(e, n);
  if (on_orbit_) {
    swept_rad_ += sign_of(orbit_.turn) * wrap_pi(azimuth - azimuth_rad_);
  } else if (route.size() > 0 && std::abs(d - orbit_.radius_m) < 0.1 * orbit_.radius_m) {
    on_orbit_ = true;
    ++progress_.reached;
    progress_.miss_m = std::abs(d - orbit_.radius_m);
    progress_.finished = !route.closed();
    if (progress_.finished) ++progress_.circuits;
  }
  azimuth_rad_ = azimuth;
  if (swept_rad_ > 2 * std::numbers::pi && route.size() > 0 && route.closed()) {
    swept_rad_ -= 2 * std::numbers::pi;
    ++progress_.circuits;
  }
}

inline void Manager::fill(const Route& route, const Plan& plan, const VehicleState& state) {
  if (mode_ == Mode::orbit) {
    path_.turn = orbit_.turn;
    path_.origin_m = {orbit_.north_m, orbit_.east_m, -orbit_.height_m};
    path_.radius_m = orbit_.radius_m;
    path_.airspeed_mps =
        route.size() > 0 ? route.airspeed_mps(std::min(item_, route.size() - 1)) : plan.airspeed_mps;
    path_.next_curvature_ratio = sign_of(orbit_.turn) / orbit_.radius_m;
  } else {
    const RoutePiece& piece = leg_[piece_];
    path_.remaining_m = piece.length_m - along_m_ + after_m_;
    if (piece.kind == PathKind::orbit) {  // the height is given where the aircraft is: no doubt about turns
                                          // more than half a circle
      const double s = std::clamp(along_m_, 0.0, piece.length_m);
      path_.start_rad = wrap_pi(piece.start_rad + sign_of(piece.turn) * s / piece.radius_m);
      path_.origin_m.down = -piece.height_at(s);
    }
    from_ = plan.waypoints[route.before(item_)].position_m;
    target_ = plan.waypoints[item_].position_m;
  }
  progress_.item = item_;
  progress_.joining = mode_ == Mode::join;
  const Vec3<Ned> goal = route.size() > 0 ? plan.waypoints[std::min(item_, route.size() - 1)].position_m
                                          : Vec3<Ned>{orbit_.north_m, orbit_.east_m, 0};
  progress_.distance_m = std::hypot(goal.north - state.position_m.north, goal.east - state.position_m.east);
}

}  // namespace fulmar::path
