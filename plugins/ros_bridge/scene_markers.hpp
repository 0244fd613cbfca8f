// SPDX-License-Identifier: BSD-3-Clause
// Markers that are fixed in their frame: the aircraft in that of the body, the waypoints in that of the
// world.
#pragma once
#include <array>
#include <charconv>

#include "convert.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/plan.hpp"
#include "ros_markers.hpp"

namespace fulmar::ros_bridge {

inline constexpr std::size_t labelled_waypoints = 32;

/// An aircraft of triangles in its body frame, forward, left, up; the origin is the centre of gravity. The
/// wing has the span and chord of the airframe, the rest is in proportion.
inline void draw_aircraft(const Wing& wing, double times, List<RosPoint, 128>& to) {
  const double b = wing.span_m * times, c = wing.chord_m * times;
  const auto triangle = [&](const RosPoint& p, const RosPoint& q, const RosPoint& r) {
    to.push_back(p);
    to.push_back(q);
    to.push_back(r);
  };
  const double nose = 0.3 * b, tail = -0.45 * b, half = 0.05 * b;
  const std::array<RosPoint, 4> ring{{{0, half, 0}, {0, 0, half}, {0, -half, 0}, {0, 0, -half}}};
  for (std::size_t i = 0; i < ring.size(); ++i) {  // the body: two pyramids
    const RosPoint &p = ring[i], &q = ring[(i + 1) % ring.size()];
    triangle({nose, 0, 0}, p, q);
    triangle({tail, 0, 0}, q, p);
  }
  const auto panel = [&](double front, double back, double left) {  // to either side
    for (const double y : {left, -left}) {
      triangle({front, 0, 0}, {front, y, 0}, {back, y, 0});
      triangle({front, 0, 0}, {back, y, 0}, {back, 0, 0});
    }
  };
  panel(0.25 * c, -0.75 * c, b / 2);
  panel(tail + 0.5 * c, tail, 0.18 * b);
  triangle({tail + 0.6 * c, 0, 0}, {tail, 0, 0.15 * b}, {tail, 0, 0});  // fin
}

namespace detail {

inline RosMarker& next_marker(RosMarkerArray& to, const RosHeader& header, std::string_view ns,
                              std::int32_t id, std::int32_t type) {
  RosMarker& m = to.markers.items[to.markers.count++];  // the caller has checked the room
  m = {};
  m.header = header;
  m.ns = ns;
  m.id = id;
  m.type = type;
  return m;
}

}  // namespace detail

/// Removes the markers of the plan before, so that no old waypoint stays.
inline void clear_scene(const RosHeader& header, RosMarkerArray& to) {
  to.markers.clear();
  detail::next_marker(to, header, "", 0, 0).action = marker::delete_all;
}

/// In the frame of `body`: the markers move with it.
inline void add_aircraft(const RosHeader& body, const Wing& wing, double times, RosMarkerArray& to) {
  RosMarker& m = detail::next_marker(to, body, "aircraft", 0, marker::triangle_list);
  m.frame_locked = true;
  m.color = {0.95F, 0.55F, 0.1F, 1};
  draw_aircraft(wing, times, m.points);
}

/// Spheres, in lists of the marker's capacity, with the index next to the first ones.
inline void add_waypoints(const RosHeader& world, const Plan& plan, double size_m, RosMarkerArray& to) {
  RosMarker* balls = nullptr;
  std::int32_t lists = 0;
  for (const Waypoint& w : plan.waypoints) {
    if (!balls || balls->points.full()) {
      balls = &detail::next_marker(to, world, "waypoints", lists++, marker::sphere_list);
      balls->scale = {size_m, size_m, size_m};
      balls->color = {0.2F, 0.5F, 1, 1};
    }
    balls->points.push_back(enu_point(w.position_m));
  }
  for (std::size_t i = 0; i < std::min(plan.waypoints.size(), labelled_waypoints); ++i) {
    RosMarker& m =
        detail::next_marker(to, world, "labels", static_cast<std::int32_t>(i), marker::text_facing_viewer);
    m.pose.position = enu_point(plan.waypoints[i].position_m);
    m.pose.position.z += 1.5 * size_m;
    m.scale = {1, 1, 1.5 * size_m};
    m.color = {1, 1, 1, 1};
    std::to_chars(m.text.bytes.data(), m.text.bytes.data() + m.text.bytes.size() - 1, i);
  }
}

static_assert(List<RosMarker, 48>::capacity() >= 2 + 1024 / 128 + labelled_waypoints,
              "markers for every plan");

}  // namespace fulmar::ros_bridge
