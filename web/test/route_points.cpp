// SPDX-License-Identifier: BSD-3-Clause
// The routes of plans as points, as path/Manager flies them, for words_test.mjs, which holds what the page
// draws to them. In, for each plan: "circuit|orbit RADIUS COUNT", then of each waypoint "NORTH EAST COURSE",
// where `-` is no course. Out: "leg TO", its points, one in a metre of each piece; of the last orbit "orbit
// NORTH EAST RADIUS"; "end".
#include <cstdio>
#include <iostream>
#include <string>

#include "fulmar/flight/path/route.hpp"

int main() {
  using namespace fulmar;
  std::string end, course;
  for (std::uint32_t count = 0; std::cin >> end;) {
    Plan plan;
    plan.end = end == "orbit" ? PlanEnd::orbit : PlanEnd::circuit;
    std::cin >> plan.turn_radius_m >> count;
    for (std::uint32_t i = 0; i < count; ++i) {
      Waypoint w;
      std::cin >> w.position_m.north >> w.position_m.east >> course;
      w.has_course = course != "-";
      if (w.has_course) w.course_rad = std::stod(course);
      plan.waypoints.push_back(w);
    }
    const Route route(plan);
    for (std::uint32_t i = route.closed() ? 0 : 1; i < route.size(); ++i) {
      const RouteLeg leg = route.leg(i);
      std::printf("leg %u\n", i);
      for (std::uint32_t k = 0; k < leg.count; ++k) {
        const int steps = 1 + static_cast<int>(leg[k].length_m);
        for (int s = 0; s <= steps; ++s) {
          const Pose at = leg[k].pose_at(leg[k].length_m * s / steps);
          std::printf("%.9g %.9g\n", at.north_m, at.east_m);
        }
      }
    }
    if (!route.closed()) {
      const RouteOrbit orbit = route.final_orbit();
      std::printf("orbit %.9g %.9g %.9g\n", orbit.north_m, orbit.east_m, orbit.radius_m);
    }
    std::printf("end\n");
  }
}
