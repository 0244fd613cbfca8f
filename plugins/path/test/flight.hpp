// SPDX-License-Identifier: BSD-3-Clause
// Flies a plan in a closed loop: manager, vector field, kinematic aircraft. Checks every output of every
// step.
#pragma once
#include <doctest/doctest.h>

#include <functional>
#include <initializer_list>
#include <vector>

#include "fulmar/testing.hpp"
#include "plugins/path/manager.hpp"
#include "plugins/path/test/kinematic.hpp"
#include "plugins/path/vector_field.hpp"

namespace fulmar::test {

inline Waypoint point(double north, double east, double up = 70) {
  Waypoint w;
  w.position_m = {north, east, -up};
  return w;
}

inline Plan plan_of(std::initializer_list<Waypoint> waypoints, PlanEnd end = PlanEnd::circuit) {
  Plan plan;
  plan.revision = 1;
  plan.jumps = 1;
  plan.airspeed_mps = 17;
  plan.end = end;
  for (const Waypoint& w : waypoints) plan.waypoints.push_back(w);
  return plan;
}

inline Plan hourglass() {
  return plan_of({point(400, -250), point(-400, -50), point(-400, -250), point(400, -50)});
}

struct Flight {
  Bench<path::Manager> manager;
  Bench<path::VectorField> field;
  Kinematic aircraft;
  double time_s = 0;
  bool finite = true;                               // every output so far
  std::vector<std::uint32_t> passed;                // waypoints, in the order in which they were reached
  double rms_north = 0, rms_east = 0, worst_m = 0;  // off the route, while on it

  explicit Flight(const Plan& plan) { change(plan); }

  void change(const Plan& plan) {
    plan_ = plan;
    manager.set(manager.in.plan, plan);
  }
  const Plan& plan() const { return plan_; }
  const Path& path() const { return manager.out.path.value; }
  const Progress& progress() const { return manager.out.progress; }
  double distance_to(double north, double east) const {
    return std::hypot(aircraft.north - north, aircraft.east - east);
  }

  void step(double dt_s = 0.01) {
    const Progress before = manager.out.progress;
    const VehicleState state = aircraft.state();
    manager.set(manager.in.state, state);
    REQUIRE(manager.step(dt_s) == Status::ok);
    REQUIRE(manager.out.path.written);
    field.set(field.in.state, state);
    field.set(field.in.path, path());
    REQUIRE(field.step(dt_s) == Status::ok);
    for (std::uint32_t k = 0; k < progress().reached - before.reached; ++k)
      passed.push_back((before.item + k) % std::max(progress().items, 1u));
    check();
    aircraft.step(field.out.command, dt_s);
    time_s += dt_s;
  }

  /// Until a condition holds; false when it did not within the time.
  bool fly(
      double seconds, const std::function<bool()>& until = [] { return false; }) {
    for (const double end = time_s + seconds; time_s < end;) {
      step();
      if (++steps_ % 10 == 0) measure();
      if (until()) return true;
    }
    return false;
  }

  double rms(double sum) const { return count_ > 0 ? std::sqrt(sum / count_) : 0; }

 private:
  void check() {
    const Path& p = path();
    const GuidanceCommand& c = field.out.command;
    for (const double x :
         {p.origin_m.north, p.origin_m.east, p.origin_m.down, p.direction_ratio.north, p.direction_ratio.east,
          p.direction_ratio.down, p.radius_m, p.climb_ratio, p.start_rad, p.airspeed_mps, p.remaining_m,
          p.next_curvature_ratio, c.course_rad, c.height_m, c.climb_rate_mps, c.airspeed_mps,
          c.roll_feedforward_rad, progress().distance_m, progress().miss_m}) {
      finite = finite && std::isfinite(x);
    }
    finite = finite && p.airspeed_mps > 0 && p.radius_m >= 1;
  }

  void measure() {
    if (progress().joining || progress().finished || progress().reached == 0 || progress().items < 2) return;
    const Route route(plan_);
    const std::uint32_t item = progress().item;
    RoutePoint best;
    for (const std::uint32_t i : {item, route.before(item), route.after(item)}) {
      if (!route.closed() && i == 0) continue;
      const RoutePoint point = nearest(route.leg(i), aircraft.north, aircraft.east);
      if (point.distance_m < best.distance_m) best = point;
    }
    rms_north += std::pow(best.north_m - aircraft.north, 2);
    rms_east += std::pow(best.east_m - aircraft.east, 2);
    worst_m = std::max(worst_m, best.distance_m);
    ++count_;
  }

  Plan plan_;
  double count_ = 0;
  int steps_ = 0;
};

}  // namespace fulmar::test
