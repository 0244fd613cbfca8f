// SPDX-License-Identifier: BSD-3-Clause
// Data for a 3-D panel and a map: the position of the aircraft, in the world and on the Earth, the route of
// its plan, and the markers. World ENU, body FLU (REP 103, 105).
#pragma once
#include <cstring>

#include "convert.hpp"
#include "fulmar/flight/earth/geodesy.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "scene_markers.hpp"
#include "scene_route.hpp"
#include "standard.hpp"

namespace fulmar::ros_bridge {

struct Scene {
  static constexpr const char* doc =
      "Scene for 3-D panels and maps: pose and geographic position of the aircraft, route of the plan, "
      "markers of aircraft and waypoints.";
  struct Inputs {
    Optional<VehicleState> state;
    Optional<Gnss> gnss;  // for the map, while the state has no position on the Earth
    Optional<Plan> plan;
  };
  struct Outputs {
    Out<RosTf> tf;
    Out<RosPoseStamped> pose;
    Out<RosNavSatFix> fix;
    Out<RosRoute> route;          // of the plan, with fillets, arcs and orbit; when it changes
    Out<RosMarkerArray> markers;  // aircraft and waypoints; when the plan changes
  };
  struct Params {
    TextParam<48> world{"map", "name of the frame of positions, ENU"};
    TextParam<48> base{"base_link", "name of the body frame, FLU"};
    Count epoch{1767225600, 0, 4102444800, "UTC of flight time 0 in seconds since 1970, as in the log",
                setup};
    Param geoid_separation{0, "m", -120, 100,
                           "height of mean sea level above the ellipsoid, added to altitudes"};
    Param repeat{60, "s", 10, 3600, "period of repeated route and markers, for late subscribers"};
    Param magnify{5, "ratio", 0.1, 100, "scale of the drawn aircraft"};
    Param waypoint_size{6, "m", 0.1, 1000, "diameter of a waypoint marker"};
    Record<Airframe> airframe{"airframe with the wing span"};
  };

  void configure(const Params& p) {
    world_ = p.world.view();
    base_ = p.base.view();
    epoch_ns_ = p.epoch * second_ns;
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out);

 private:
  RosHeader header(std::int64_t flight_ns, const RosText& frame) const {
    return {ros_time(epoch_ns_ + flight_ns), frame};
  }
  void publish_pose(const Inputs& in, const Params& p, Outputs& out);
  void publish_place(const VehicleState& s, std::int64_t at_ns, const Params& p, Outputs& out);
  void publish_route(const Tick& tick, const Inputs& in, bool again, Outputs& out);
  void publish_markers(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) const;

  std::int64_t epoch_ns_ = 0;
  RosText world_, base_;
  LocalFrame frame_;
  VehicleState origin_;  // the state that `frame_` was made from
  RouteDrawing drawing_;
  std::uint64_t drawn_ = 0;  // hash of the plan that was drawn
  std::int64_t reported_ns_ = 0;
  bool reported_ = false;
};

namespace detail {

/// FNV-1a of the drawn parts of a plan. Revisions are not unique after another planner has taken over.
inline std::uint64_t content_of(const Plan& plan) {
  std::uint64_t h = 0xcbf29ce484222325U;
  const auto add = [&](double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    h = (h ^ bits) * 0x100000001b3U;
    h ^= h >> 32;  // whole words are hashed, so the high bits must reach the low ones
  };
  add(plan.end == PlanEnd::circuit ? 1 : 0);
  add(plan.turn_radius_m);
  add(plan.waypoints.count);
  for (const Waypoint& w : plan.waypoints) {
    add(w.position_m.north);
    add(w.position_m.east);
    add(w.position_m.down);
    add(w.has_course ? w.course_rad : 10);
  }
  return h;
}

}  // namespace detail

inline Status Scene::step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
  const bool placed = in.state && in.state.fresh() && detail::placed(*in.state);
  if (placed) publish_pose(in, p, out);
  if (!out.fix.written && in.gnss && in.gnss.fresh())
    out.fix.publish(fix_of(*in.gnss, header(in.gnss.valid_at_ns(), base_), p.geoid_separation),
                    in.gnss.valid_at_ns());
  bool again = !reported_ || tick.now_ns - reported_ns_ >= static_cast<std::int64_t>(p.repeat * 1e9);
  if (in.plan && (in.plan.fresh() || !reported_)) {
    const std::uint64_t content = detail::content_of(*in.plan);
    if (content != drawn_) again = true;
    drawn_ = content;
  }
  publish_route(tick, in, again, out);
  if (again) {
    publish_markers(tick, in, p, out);
    reported_ = true;
    reported_ns_ = tick.now_ns;
  }
  return Status::ok;
}

inline void Scene::publish_pose(const Inputs& in, const Params& p, Outputs& out) {
  const VehicleState& s = *in.state;
  const std::int64_t at = in.state.valid_at_ns();
  const RosHeader head = header(at, world_);
  const RosPose pose{enu_point(s.position_m), enu_flu(s.attitude)};
  out.pose.publish({head, pose}, at);
  RosTf tf;
  tf.transforms.push_back(
      {head, base_, {{pose.position.x, pose.position.y, pose.position.z}, pose.orientation}});
  out.tf.publish(tf, at);
  if (s.origin_valid && std::abs(s.origin_latitude_deg) <= 90) publish_place(s, at, p, out);
}

inline void Scene::publish_place(const VehicleState& s, std::int64_t at, const Params& p, Outputs& out) {
  if (!origin_.origin_valid || s.origin_latitude_deg != origin_.origin_latitude_deg ||
      s.origin_longitude_deg != origin_.origin_longitude_deg ||
      s.origin_altitude_m != origin_.origin_altitude_m) {
    frame_ = LocalFrame(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
    origin_ = s;
  }
  const LocalFrame::Geodetic g = frame_.from_ned(eigen(s.position_m));
  RosNavSatFix m;
  m.header = header(at, base_);
  m.status.status = 0;
  m.latitude = g.lat_deg;
  m.longitude = g.lon_deg;
  m.altitude = g.alt_m + p.geoid_separation;
  if (s.position_std_m.north < unknown_std && s.position_std_m.down < unknown_std) {
    m.position_covariance_type = 2;
    put_block(m.position_covariance, 3, 0, enu_covariance(s.position_std_m));
  }
  out.fix.publish(m, at);
}

/// Publishes the route when it is complete: for a long plan some steps later.
inline void Scene::publish_route(const Tick& tick, const Inputs& in, bool again, Outputs& out) {
  if (!in.plan) return;
  if (again) drawing_.begin(out.route.value, header(tick.now_ns, world_));
  if (!drawing_.busy() || !drawing_.go_on(*in.plan, out.route.value)) return;
  out.route.valid_at_ns = tick.now_ns;
  out.route.written = out.route.dated = true;
}

inline void Scene::publish_markers(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) const {
  RosMarkerArray& m = out.markers.value;
  clear_scene(header(tick.now_ns, world_), m);
  add_aircraft(header(tick.now_ns, base_), p.airframe->wing, p.magnify, m);
  if (in.plan) add_waypoints(header(tick.now_ns, world_), *in.plan, p.waypoint_size, m);
  out.markers.valid_at_ns = tick.now_ns;
  out.markers.written = out.markers.dated = true;
}

}  // namespace fulmar::ros_bridge
