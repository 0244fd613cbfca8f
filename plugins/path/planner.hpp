// SPDX-License-Identifier: BSD-3-Clause
// Keeps the list of waypoints: from a file, and from edits in flight. A bad edit is answered with a reason
// and has no effect.
#pragma once
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "fulmar/eigen.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/notice.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/plan_edit.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "messages.hpp"
#include "plan_file.hpp"
#include "plan_limits.hpp"

namespace fulmar::path {

struct Planner {
  static constexpr const char* doc = "The list of waypoints, from a file and from edits in flight.";
  struct Inputs {
    Optional<VehicleState> state;  // for its origin
    Queue<PlanEdit> edits;         // answered by `results` alone
    Request<PlanEdit> edit;        // also answered at once
  };
  struct Outputs {
    Out<Plan> plan;
    Probe refused_ratio;  // edits rejected or lost since the start
    OutQueue<PlanEditResult, 64> results;
    OutQueue<Notice, 4> notices;  // reports of rejected edits
  };
  struct Params {
    Record<PlanFile> plan{"waypoints; without it the plan is empty"};
    Record<Origin> origin{"origin of the local frame"};
    Record<Airframe> airframe{"airframe with airspeeds and bank for the checks; without it no check"};
    Record<safety::Fence> fence{"geofence with corners, floor and ceiling; waypoints outside are rejected"};
    Param lowest{
        1,    "m", -1e4, 1e4, "minimum height of a waypoint above the origin; less where the ground is lower",
        setup};
  };

  void configure(const Params& p);
  Status step(const Tick&, const Inputs& in, const Params&, Outputs& out);

 private:
  static constexpr double closest_m = 1;     // closer waypoints are one place for the route
  static constexpr double farthest_m = 1e5;  // limit of a local tangent plane

  /// Edits that take effect together, made in a copy of the plan.
  struct Group {
    std::uint32_t number = 0, size = 0, taken = 0;  // number 0: none is open
    std::uint32_t last_id = 0;                      // of the last edit
    std::uint64_t changes = 0;                      // of the plan, at the begin of the group
    bool refused = false, by_request = false;
    Plan plan;
  };

  using Reason = std::optional<Text<80>>;  // reason of a rejection; empty: none

  Reason take(const Tick& tick, const PlanEdit& edit, bool by_request, Outputs& out);
  Reason take_into_group(const PlanEdit& edit, PlanEditResult& result);
  Reason commit();
  void begin_group(const Tick& tick, const PlanEdit& edit, bool by_request, Outputs& out);
  void drop_group(const Tick& tick, const char* reason, Outputs& out);
  void report(const Tick& tick, const PlanEditResult& result, Outputs& out);
  Text<96> words_of(const PlanEditResult& result) const;  // text of a rejection
  Reason apply(Plan& plan, PlanEdit edit, bool alone, std::uint32_t& waypoint_id);
  Reason set(Plan& plan, const PlanEdit& edit) const;
  void put(Plan& plan, const PlanEdit& edit, const Waypoint& w) const;
  Reason fault_of(const Waypoint& w) const;
  Reason fault_of_neighbours(const Waypoint& w, const Waypoint* before, const Waypoint* after) const;
  bool close(const Waypoint& a, const Waypoint& b) const;
  Reason fault_of_spacing(const Plan& plan) const;
  void resolve(Waypoint& w) const;
  bool resolved() const;
  void know_origin(double lat_deg, double lon_deg, double alt_m);

  void report_unflyable(const Tick& tick, Outputs& out);
  void report_doubts(const Tick& tick, const Params& p, Outputs& out);

  Plan plan_;
  Group group_;
  double lowest_m_ = 0;
  PlanFence fence_;
  LocalFrame frame_;
  bool origin_known_ = false;
  bool doubtful_ = true;       // the plan has not been checked against the airframe
  bool changed_ = true;        // the plan has changed since its last publication
  std::uint64_t changes_ = 0;  // edits in force
  std::uint32_t next_id_ = 1;
  std::uint32_t refused_ = 0, unreported_ = 0;
  std::int64_t reported_ns_ = 0;
  Text<80> reported_reason_;  // the last one
};

namespace detail {

inline bool given(double x) { return x != not_given; }

inline bool radius_in_range(double radius_m) { return radius_m >= 1 && radius_m <= 1e5; }
inline bool airspeed_in_range(double airspeed_mps) { return airspeed_mps >= 3 && airspeed_mps <= 300; }

/// Throws a message located at `path`, the waypoint in the file.
inline Waypoint waypoint_of(const PlanFileWaypoint& f, const std::string& path) {
  const bool local = given(f.north_m) || given(f.east_m) || given(f.up_m);
  const bool geodetic = given(f.lat_deg) || given(f.lon_deg) || given(f.alt_msl_m);
  if (local && geodetic) refuse(path, path_messages::waypoint_placed_twice());
  if (!local && !geodetic) refuse(path, path_messages::waypoint_without_place());
  if (local && !(given(f.north_m) && given(f.east_m) && given(f.up_m)))
    refuse(path, path_messages::waypoint_place_missing("north, east and up"));
  if (geodetic && !(given(f.lat_deg) && given(f.lon_deg) && given(f.alt_msl_m)))
    refuse(path, path_messages::waypoint_place_missing("lat, lon and alt_msl"));
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
  if (p.plan->given && p.plan->waypoints.size() == 0) refuse("plan", path_messages::plan_empty());
  lowest_m_ = p.lowest;
  auto plan = std::make_unique<Plan>();
  plan->revision = plan_.revision;
  plan->jumps = plan_.jumps + 1;
  plan->end = p.plan->end;
  plan->airspeed_mps = p.plan->airspeed_mps;
  plan->turn_radius_m = p.plan->turn_radius_m;
  if (!detail::airspeed_in_range(plan->airspeed_mps))
    refuse("plan.airspeed", path_messages::airspeed_out_of_range(plan->airspeed_mps));
  if (!detail::radius_in_range(plan->turn_radius_m))
    refuse("plan.turn_radius", path_messages::turn_radius_out_of_range(plan->turn_radius_m));
  if (p.origin->given) know_origin(p.origin->lat_deg, p.origin->lon_deg, p.origin->alt_msl_m);
  fence_ = {};
  if (p.fence.given()) fence_.set(*p.fence, *p.origin);
  for (std::size_t i = 0; i < p.plan->waypoints.size(); ++i) {
    Waypoint w = detail::waypoint_of(p.plan->waypoints[i], path_of_waypoint(i));
    resolve(w);
    Reason fault = fault_of(w);
    if (!fault) fault = fault_of_neighbours(w, i > 0 ? &plan->waypoints[i - 1] : nullptr, nullptr);
    if (fault) refuse(path_of_waypoint(i), Diagnostic(std::string(fault->view())));
    w.id = next_id_++;
    plan->waypoints.push_back(w);
  }
  if (plan->waypoints.size() == 1 && plan->end == PlanEnd::circuit)
    refuse("plan.waypoints", path_messages::circuit_of_one());
  plan_ = *plan;
  changed_ = doubtful_ = true;
}

inline void Planner::report_doubts(const Tick& tick, const Params& p, Outputs& out) {
  doubtful_ = false;
  if (!p.airframe.given()) return;
  for (const auto& words :
       {airspeed_doubt(plan_, p.airframe->limits), radius_doubt(plan_, p.airframe->limits)}) {
    if (words[0] == 0) continue;
    Notice notice;
    notice.severity = Severity::warning;
    notice.text = words.data();
    out.notices.push(notice, tick.now_ns);
  }
}

inline Status Planner::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  if (doubtful_) report_doubts(tick, p, out);
  if (!origin_known_ && in.state && in.state->origin_valid) {
    know_origin(in.state->origin_latitude_deg, in.state->origin_longitude_deg, in.state->origin_altitude_m);
    report_unflyable(tick, out);
  }
  refused_ += in.edits.lost();
  if (in.edits.lost() > 0 && !group_.by_request) drop_group(tick, path_messages::edits_lost.c_str(), out);
  for (const auto& sample : in.edits) take(tick, sample.value, false, out);
  for (const auto request : in.edit) {
    if (const Reason reason = take(tick, request.value(), true, out)) {
      request.refuse(reason->view());
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

}  // namespace fulmar::path

#include "planner_impl.hpp"
