// SPDX-License-Identifier: BSD-3-Clause
// Keeps the list of waypoints: from a file, and from edits that come in flight. A bad edit is answered with a
// reason and changes nothing.
#pragma once
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/geodesy.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "plan_file.hpp"

namespace fulmar::path {

struct Planner {
  static constexpr const char* doc = "The list of waypoints, from a file and from edits in flight.";
  struct Inputs {
    Optional<VehicleState> state;  // for its origin
    Queue<PlanEdit> edits;         // applied without an answer
    Request<PlanEdit> edit;        // answered
  };
  struct Outputs {
    Out<Plan> plan;
    Probe refused_ratio;  // edits refused or lost since the start
  };
  struct Params {
    Record<PlanFile> plan{"waypoints; without it the plan begins empty"};
    Record<Origin> origin{"of the local frame"};
  };

  void configure(const Params& p);
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out);

 private:
  static constexpr double closest_m = 1;     // closer waypoints are one place to the route
  static constexpr double farthest_m = 1e5;  // a local tangent plane ends somewhere

  const char* apply(const PlanEdit& edit);
  const char* fault_of(const Waypoint& w) const;
  const char* fault_of_neighbours(const Waypoint& w, const Waypoint* before, const Waypoint* after) const;
  void resolve(Waypoint& w) const;
  bool resolved() const;
  void know_origin(double lat_deg, double lon_deg, double alt_m);

  Plan plan_;
  LocalFrame frame_;
  bool origin_known_ = false;
  bool changed_ = true;  // the plan has not been published as it is now
  std::uint32_t refused_ = 0;
};

namespace detail {

inline bool given(double x) { return x != not_given; }

/// Throws a sentence that names the waypoint, counted from 1 as a reader counts.
inline Waypoint waypoint_of(const PlanFileWaypoint& f, std::size_t number) {
  const bool local = given(f.north_m) || given(f.east_m) || given(f.up_m);
  const bool geodetic = given(f.lat_deg) || given(f.lon_deg) || given(f.alt_msl_m);
  const std::string who = "waypoint " + std::to_string(number) + " of the plan ";
  if (local == geodetic) throw std::runtime_error(who + "needs either north, east, up or lat, lon, alt_msl");
  if (local && !(given(f.north_m) && given(f.east_m) && given(f.up_m)))
    throw std::runtime_error(who + "needs north, east and up");
  if (geodetic && !(given(f.lat_deg) && given(f.lon_deg) && given(f.alt_msl_m)))
    throw std::runtime_error(who + "needs lat, lon and alt_msl");
  Waypoint w;
  if (local) {
    w.position_m = {f.north_m, f.east_m, -f.up_m};
  } else {
    w.frame = WaypointFrame::geodetic;
    w.latitude_deg = f.lat_deg;
    w.longitude_deg = f.lon_deg;
    w.altitude_m = f.alt_msl_m;
  }
  w.has_course = given(f.course_rad);
  if (w.has_course) w.course_rad = f.course_rad;
  if (given(f.airspeed_mps)) w.airspeed_mps = f.airspeed_mps;
  return w;
}

}  // namespace detail

inline void Planner::configure(const Params& p) {
  if (p.plan->given && p.plan->waypoints.size() == 0)
    throw std::runtime_error(
        "the plan has no waypoints; to change one thing in a plan, name it, as in plan.turn_radius");
  auto plan = std::make_unique<Plan>();
  plan->revision = plan_.revision;
  plan->jumps = plan_.jumps + 1;
  plan->end = p.plan->end;
  plan->airspeed_mps = p.plan->airspeed_mps;
  plan->turn_radius_m = p.plan->turn_radius_m;
  if (!(plan->airspeed_mps > 0 && plan->airspeed_mps < 1000))
    throw std::runtime_error("the plan's airspeed must be positive");
  if (!(plan->turn_radius_m >= 1 && plan->turn_radius_m < 1e5))
    throw std::runtime_error("the plan's turn_radius must be at least 1 m");
  if (p.origin->given) know_origin(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
  for (std::size_t i = 0; i < p.plan->waypoints.size(); ++i) {
    Waypoint w = detail::waypoint_of(p.plan->waypoints[i], i + 1);
    resolve(w);
    const char* fault = fault_of(w);
    if (!fault) fault = fault_of_neighbours(w, i > 0 ? &plan->waypoints[i - 1] : nullptr, nullptr);
    if (fault) throw std::runtime_error("waypoint " + std::to_string(i + 1) + " of the plan: " + fault);
    plan->waypoints.push_back(w);
  }
  if (plan->waypoints.size() == 1 && plan->end == PlanEnd::circuit)
    throw std::runtime_error("the plan has one waypoint, which makes no circuit: give more, or end: orbit");
  plan_ = *plan;
  changed_ = true;
}

inline Status Planner::step(const Tick&, const Inputs& in, const Params&, Outputs& out) {
  if (!origin_known_ && in.state && in.state->origin_valid) {
    know_origin(in.state->origin_latitude_deg, in.state->origin_longitude_deg, in.state->origin_altitude_m);
  }
  refused_ += in.edits.lost();
  for (const auto& sample : in.edits) {
    if (apply(sample.value)) ++refused_;
  }
  for (const auto request : in.edit) {
    if (const char* reason = apply(request.value())) {
      ++refused_;
      request.refuse(reason);
    } else {
      request.accept();
    }
  }
  out.refused_ratio = refused_;
  if (!changed_) return Status::ok;
  if (!resolved()) return Status::degraded;  // geodetic waypoints wait for the origin
  ++plan_.revision;
  out.plan.publish(plan_);
  changed_ = false;
  return Status::ok;
}

/// Nullptr when done, else why not; then nothing has changed.
inline const char* Planner::apply(const PlanEdit& edit) {
  auto& list = plan_.waypoints;
  const std::uint32_t i = edit.index, n = list.count;
  const bool adds = edit.kind == PlanEditKind::append || edit.kind == PlanEditKind::insert;
  const bool at_existing = edit.kind == PlanEditKind::replace || edit.kind == PlanEditKind::remove ||
                           edit.kind == PlanEditKind::set_current;
  if (edit.kind > PlanEditKind::set_current) return "no such kind of edit";
  if (adds && list.full()) return "the plan is full: 1024 waypoints";
  if (at_existing && i >= n)
    return n == 0 ? "the plan has no waypoints" : "there is no waypoint of this index; the first is 0";
  if (edit.kind == PlanEditKind::insert && i > n) return "the index is beyond the end of the plan";

  Waypoint w = edit.waypoint;
  const std::uint32_t at = edit.kind == PlanEditKind::append ? n : i;
  if (adds || edit.kind == PlanEditKind::replace) {
    if (w.frame == WaypointFrame::geodetic) w.position_m = {};
    resolve(w);
    if (const char* fault = fault_of(w)) return fault;
    const std::uint32_t next = adds ? at : at + 1;
    if (const char* fault =
            fault_of_neighbours(w, at > 0 ? &list[at - 1] : nullptr, next < n ? &list[next] : nullptr))
      return fault;
  }
  switch (edit.kind) {
    case PlanEditKind::append:
    case PlanEditKind::insert:
      for (std::uint32_t k = n; k > at; --k) list[k] = list[k - 1];
      list[at] = w;
      ++list.count;
      if (at <= plan_.jump_item && at < n) ++plan_.jump_item;
      break;
    case PlanEditKind::replace: list[i] = w; break;
    case PlanEditKind::remove:
      for (std::uint32_t k = i; k + 1 < n; ++k) list[k] = list[k + 1];
      --list.count;
      if (i < plan_.jump_item) --plan_.jump_item;
      break;
    case PlanEditKind::clear:
      list.clear();
      ++plan_.jumps;
      plan_.jump_item = 0;
      break;
    case PlanEditKind::set_current:
      ++plan_.jumps;
      plan_.jump_item = i;
      break;
  }
  changed_ = true;
  return nullptr;
}

inline const char* Planner::fault_of(const Waypoint& w) const {
  if (w.frame > WaypointFrame::geodetic) return "no such kind of waypoint";
  const bool geodetic = w.frame == WaypointFrame::geodetic;
  if (geodetic) {
    if (!std::isfinite(w.latitude_deg) || !std::isfinite(w.longitude_deg) || !std::isfinite(w.altitude_m))
      return "a coordinate is not finite";
    if (std::abs(w.latitude_deg) > 90) return "the latitude is beyond 90 degrees";
    if (std::abs(w.longitude_deg) > 360) return "the longitude is beyond 360 degrees";
  }
  const Vec3<Ned>& p = w.position_m;
  if (!std::isfinite(p.north) || !std::isfinite(p.east) || !std::isfinite(p.down))
    return "a coordinate is not finite";
  if (std::hypot(p.north, p.east) > farthest_m || std::abs(p.down) > farthest_m)
    return "more than 100 km from the origin";
  if (!std::isfinite(w.course_rad)) return "the course is not finite";
  if (!(w.airspeed_mps >= 0 && w.airspeed_mps < 1000)) return "the airspeed is negative or not finite";
  return nullptr;
}

inline const char* Planner::fault_of_neighbours(const Waypoint& w, const Waypoint* before,
                                                const Waypoint* after) const {
  const auto close = [&](const Waypoint* other) {
    if (!other ||
        (!origin_known_ && (w.frame != WaypointFrame::local || other->frame != WaypointFrame::local)))
      return false;
    return std::hypot(w.position_m.north - other->position_m.north,
                      w.position_m.east - other->position_m.east) < closest_m;
  };
  if (close(before)) return "less than 1 m from the waypoint before it";
  if (close(after)) return "less than 1 m from the waypoint after it";
  return nullptr;
}

inline void Planner::resolve(Waypoint& w) const {
  if (w.frame == WaypointFrame::geodetic && origin_known_ && std::abs(w.latitude_deg) <= 90 &&
      std::isfinite(w.longitude_deg)) {
    w.position_m = from_eigen<Ned>(frame_.to_ned(w.latitude_deg, w.longitude_deg, w.altitude_m));
  }
}

inline bool Planner::resolved() const {
  for (const Waypoint& w : plan_.waypoints) {
    if (w.frame == WaypointFrame::geodetic && (!origin_known_ || fault_of(w))) return false;
  }
  return true;
}

inline void Planner::know_origin(double lat_deg, double lon_deg, double alt_m) {
  frame_ = LocalFrame(lat_deg, lon_deg, alt_m);
  origin_known_ = true;
  for (Waypoint& w : plan_.waypoints) resolve(w);
}

}  // namespace fulmar::path
