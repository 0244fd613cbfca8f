// SPDX-License-Identifier: BSD-3-Clause
// Follows the route of the plan piece by piece: join, legs, final orbit. Beard & McLain, Small Unmanned
// Aircraft (2012), chapter 11. Fillets and Dubins paths are pieces whose end is a length along them, so that
// no half-plane can be missed.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "circling.hpp"
#include "circuits.hpp"
#include "first_item.hpp"
#include "flown_leg.hpp"
#include "fulmar/flight/path/route.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "leg_ends.hpp"
#include "reckoning.hpp"
#include "wide_corners.hpp"

namespace fulmar::path {

struct Manager {
  static constexpr const char* doc =
      "The active piece of the route of the plan, and the progress of the flight.";
  struct Inputs {
    In<VehicleState> state;
    In<Plan> plan;
  };
  struct Outputs {
    Out<Path> path;  // silent until the position is known
    Progress progress;
  };
  struct Params {
    Param hold_height{50, "m", 0, 10000, "minimum height of the orbit that is flown while the plan is empty"};
    Count first_item{0, 0, 65535,
                     "index of the first waypoint; a change in flight selects that waypoint at once"};
    Param rejoin_distance{25, "m", 5, 1000,
                          "distance from the path beyond which a new path to the plan starts"};
    Param fillet_bank{
        0.72, "rad", 0, 1.4,
        "largest bank in a fillet with the present wind; beyond it the fillet is wider; 0: off"};
    Param reckon_std{50, "m", 0, 1000,
                     "largest standard deviation of the position for the plan without a fix"};
    Param reckon_time{115, "s", 0, 3600,
                      "largest time of the plan after the position became invalid, 5 s after the last fix"};
  };

  void configure(const Params& p) { retune(p); }
  void retune(const Params& p) {
    if (!first_item_.change(p.first_item)) return;
    progress_.item = static_cast<std::uint32_t>(p.first_item);
    mode_ = Mode::idle;
  }
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out);
  Status activate(const Tick&, const Inputs&, const Params&, const Outputs&) {
    mode_ = Mode::idle;  // resume the plan from the position at that time, at the same waypoint
    return Status::ok;
  }

 private:
  enum class Mode : std::uint8_t { idle, join, leg, orbit };

  void adopt(const Route& route, const Plan& plan, const VehicleState& state, const Params& p);
  void adopt_empty(const Route& route, const VehicleState& state, bool was_empty, double hold_height_m);
  void adopt_point(const Route& route, const Plan& plan, const VehicleState& state, bool jump);
  void keep_or_join(const Route& route, const Plan& plan, const VehicleState& state);
  void begin_orbit(const RouteOrbit& orbit);
  void begin_join(const Route& route, const VehicleState& state, std::uint32_t item);
  void begin_leg(const Route& route, const RouteLeg& leg, Mode mode, std::uint32_t item, std::size_t piece);
  void fly(const Route& route, const VehicleState& state, const Params& p);
  void reach(const Route& route, const VehicleState& state);
  void circle(const Route& route, const VehicleState& state);
  void fill(const Route& route, const Plan& plan, const VehicleState& state);

  Mode mode_ = Mode::idle;
  std::uint32_t item_ = 0;
  std::uint32_t jumps_ = 0, revision_ = 0;  // of the adopted plan
  FirstItem first_item_;
  LegEnds ends_;
  WideCorners wide_;
  FlownLeg leg_;
  Circling circling_;
  Circuits circuits_;
  Pose joined_from_;
  Reckoning reckoning_;
  Path path_;
  Progress progress_;
};

inline Pose pose_of(const VehicleState& state) {
  return {state.position_m.north, state.position_m.east, state.course_rad};
}

inline Status Manager::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const VehicleState& state = *in.state;
  const Plan& plan = *in.plan;
  const Route route(plan, wide_);
  // The progress is unknown: the last path stays in force.
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

/// Adopts a new or changed plan. The target waypoint stays the same if it still exists.
inline void Manager::adopt(const Route& route, const Plan& plan, const VehicleState& state, const Params& p) {
  const std::optional<std::uint32_t> first = first_item_.take();
  const bool was_empty = progress_.items == 0,
             jump = first || plan.jumps != jumps_ || was_empty || revision_ == 0;
  // The waypoint at the begin of the circuit was removed: the circuit begins at the next one.
  if (circuits_.begun_at() != 0 && find_id(plan, circuits_.begun_at()) == plan.waypoints.count)
    circuits_ = {};
  wide_.fit(route, plan);
  revision_ = plan.revision;
  jumps_ = plan.jumps;
  progress_.items = route.size();
  progress_.plan_revision = plan.revision;
  if (route.size() == 0) return adopt_empty(route, state, was_empty, p.hold_height);
  if (route.is_point()) return adopt_point(route, plan, state, jump);
  if (jump) {
    circuits_ = {};
    progress_.finished = false;
    begin_join(route, state, std::min(first.value_or(plan.jump_item), route.size() - 1));
  } else if (mode_ == Mode::idle) {
    begin_join(route, state, std::min(item_, route.size() - 1));
  } else {
    keep_or_join(route, plan, state);
  }
}

inline void Manager::adopt_empty(const Route& route, const VehicleState& state, bool was_empty,
                                 double hold_height_m) {
  if (was_empty && mode_ != Mode::idle) return circling_.resize(route.radius_m());  // keep the orbit
  item_ = 0;
  circuits_ = {};
  progress_.finished = false;
  const double height_m = std::max(state.height_m, hold_height_m);
  begin_orbit({state.position_m.north, state.position_m.east, height_m, route.radius_m(), Turn::right});
}

/// All waypoints are in one place.
inline void Manager::adopt_point(const Route& route, const Plan& plan, const VehicleState& state, bool jump) {
  const Vec3<Ned>& point = plan.waypoints[0].position_m;
  const bool same = !jump && mode_ == Mode::orbit && ends_.ends_at(point);
  if (!same) progress_.finished = false;
  item_ = 0;
  ends_.remember_point(point);
  RouteOrbit orbit{point.north, point.east, route.height_m(0), route.radius_m(), circling_.orbit().turn};
  if (same) return circling_.change(orbit);
  orbit.turn = min_turning(pose_of(state), orbit.north_m, orbit.east_m, orbit.radius_m);
  begin_orbit(orbit);
}

/// Piece of a leg that is nearest to a point.
inline std::size_t nearest_piece(const RouteLeg& leg, const Vec3<Ned>& at) {
  double best_m = unknown_std;
  std::size_t piece = 0;
  for (std::size_t i = 0; i < leg.count; ++i) {
    RouteLeg one;
    one.count = 1;
    one.pieces[0] = leg[i];
    const double d = nearest(one, at.north, at.east).distance_m;
    if (d < best_m - 1e-6) {
      best_m = d;
      piece = i;
    }
  }
  return piece;
}

inline void Manager::keep_or_join(const Route& route, const Plan& plan, const VehicleState& state) {
  const std::uint32_t n = route.size(), k = ends_.find_target(plan, item_);
  if (k == n) return begin_join(route, state, std::min(item_, n - 1));
  if (mode_ == Mode::orbit) {  // the end of the plan was reached; flight continues if waypoints were added
    if (!route.closed() && k + 1 == n) {
      item_ = k;
      return circling_.change(route.final_orbit());
    }
    progress_.finished = false;
    return begin_join(route, state, route.after(k));
  }
  if (mode_ == Mode::join) {
    const Pose end = route.passage(k).middle;
    const bool same = end.north_m == leg_.end().north_m && end.east_m == leg_.end().east_m &&
                      end.course_rad == leg_.end().course_rad;
    if (!same) return begin_join(route, state, k);
    item_ = k;
    path_ = leg_.keep(route, k);
    return;
  }
  if (!ends_.begins_at(plan.waypoints[route.before(k)].position_m)) return begin_join(route, state, k);
  const RouteLeg leg = route.leg(k);
  begin_leg(route, leg, Mode::leg, k, nearest_piece(leg, state.position_m));
}

inline void Manager::begin_orbit(const RouteOrbit& orbit) {
  mode_ = Mode::orbit;
  circling_.begin(orbit);
  path_ = {};
  path_.kind = PathKind::orbit;
}

inline void Manager::begin_join(const Route& route, const VehicleState& state, std::uint32_t item) {
  joined_from_ = pose_of(state);
  begin_leg(route, route.join(joined_from_, state.height_m, item), Mode::join, item, 0);
}

inline void Manager::begin_leg(const Route& route, const RouteLeg& leg, Mode mode, std::uint32_t item,
                               std::size_t piece) {
  mode_ = mode;
  item_ = item;
  wide_.begin_leg(route, item);
  path_ = leg_.begin(route, leg, item, piece);
}

inline void Manager::fly(const Route& route, const VehicleState& state, const Params& p) {
  if (mode_ == Mode::join) {
    const Vec3<Ned>& at = state.position_m;
    const double off = leg_.off_piece_m(at);
    const bool moved =
        std::hypot(at.north - joined_from_.north_m, at.east - joined_from_.east_m) > route.radius_m();
    if (std::abs(off) > p.rejoin_distance && moved) begin_join(route, state, item_);
  }
  if (mode_ == Mode::leg && wide_.widen(route, leg_, item_, state, p.fillet_bank))
    path_ = leg_.widen(route, item_);
  constexpr int pieces_per_step = 8;  // short ones are passed at once
  for (int i = 0; i < pieces_per_step && mode_ != Mode::orbit; ++i) {
    leg_.measure(state);
    if (!leg_.past_piece()) return;
    if (leg_.on_last_piece()) {
      reach(route, state);
    } else {
      path_ = leg_.begin_next_piece(route);
    }
  }
  if (mode_ != Mode::orbit) leg_.measure(state);
}

inline void Manager::reach(const Route& route, const VehicleState& state) {
  ++progress_.reached;
  progress_.miss_m = leg_.miss_m();
  if (circuits_.reach(route.id(item_), item_)) ++progress_.circuits;
  if (!route.closed() && item_ + 1 == route.size()) {
    if (!progress_.finished) ++progress_.circuits;
    progress_.finished = true;
    circuits_ = {};
    begin_orbit(route.final_orbit());
    return circling_.enter(state);
  }
  const RouteLeg leg = leg_.next();
  begin_leg(route, leg, Mode::leg, route.after(item_), 0);
}

/// On the final orbit, around a single waypoint, or with an empty plan. Around a single waypoint of a circuit
/// each full circle counts.
inline void Manager::circle(const Route& route, const VehicleState& state) {
  circling_.advance(state);
  if (route.size() == 0) return;
  if (circling_.arrives(state)) {
    ++progress_.reached;
    progress_.miss_m = circling_.miss_m(state);
    progress_.finished = !route.closed();
    if (progress_.finished) ++progress_.circuits;
  }
  if (route.closed() && circling_.complete()) ++progress_.circuits;
}

inline void Manager::fill(const Route& route, const Plan& plan, const VehicleState& state) {
  if (mode_ == Mode::orbit) {
    circling_.put_into(path_);
    path_.airspeed_mps =
        route.size() > 0 ? route.airspeed_mps(std::min(item_, route.size() - 1)) : plan.airspeed_mps;
  } else {
    leg_.put_progress_into(path_);
    ends_.remember(route, plan, item_);
  }
  progress_.item = item_;
  progress_.joining = mode_ == Mode::join;
  const RouteOrbit& orbit = circling_.orbit();
  const Vec3<Ned> goal = route.size() > 0 ? plan.waypoints[std::min(item_, route.size() - 1)].position_m
                                          : Vec3<Ned>{orbit.north_m, orbit.east_m, 0};
  progress_.distance_m = std::hypot(goal.north - state.position_m.north, goal.east - state.position_m.east);
}

}  // namespace fulmar::path
