// SPDX-License-Identifier: BSD-3-Clause
// Reroutes a plan around no-fly zones, between planner and manager. A step takes a tenth of a second and much
// memory, and needs `run: async`. See README.md.
#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/progress.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "rrt_star.hpp"

namespace fulmar::slow_planner {

inline constexpr std::size_t no_leg = static_cast<std::size_t>(-1);

struct Detour {
  static constexpr const char* doc =
      "Detours of a plan around no-fly zones, fastest in the present wind. Needs `run: async`.";
  struct Inputs {
    In<VehicleState> state;  // its wind is used
    In<Plan> plan;
    Optional<Progress> progress;  // of the published plan: the active leg keeps its shape
  };
  struct Outputs {
    Out<Plan> plan;     // silent until the whole plan is clear of the zones
    Probe clearance_m;  // of the plan published last
    Probe flight_s;     // one round of that plan, in the wind at that time
  };
  struct Params {
    Record<Zones> zones{"no-fly zones", required};
    Param margin{20, "m", 0, 1000, "minimum distance of the path from the border of a zone", setup};
    Count iterations{8000, 100, 100000, "number of samples per search; one search per step", setup};
    Count improvements{4, 0, 1000, "number of further searches per leg after the first plan", setup};
  };

  explicit Detour(std::uint64_t seed) : seed_(seed) {}
  static std::string radius_missing(std::size_t zone) {
    return "no-fly zone " + std::to_string(zone) + " requires a radius above 0";
  }
  void configure(const Params& p);
  Status step(const Tick&, const Inputs& in, const Params& p, Outputs& out);

 private:
  struct Leg {  // to a waypoint of the original plan, from the one before it
    Point from, to;
    double airspeed_mps = 15;
    bool blocked = false, solved = true;
    std::int64_t searches = 0;
    double extra_m = 0;  // additional clearance: grows while fillets cut into the margin
    std::vector<Point> between;
  };

  void adopt(const Plan& plan, const Params& p);
  void search(std::size_t i, const Params& p);
  std::size_t choose(const Inputs& in, const Params& p) const;
  bool flown(std::size_t leg, const Progress& progress) const;
  Plan& assemble();
  bool touches(std::uint32_t k, std::size_t leg, const Route& route) const;
  double time_of(const Plan& plan, std::size_t leg) const;
  double clearance_of(const Plan& plan) const;

  std::uint64_t seed_, searches_ = 0;
  Zones zones_;
  std::unique_ptr<Plan> original_, result_;
  std::vector<Leg> legs_;
  std::vector<std::size_t> leg_of_;  // leg of each waypoint of the published plan
  std::uint32_t revision_ = 0;       // of the published plan
  double wind_north_ = 0, wind_east_ = 0;
  bool changed_ = false;
};

inline void Detour::configure(const Params& p) {
  zones_ = *p.zones;
  for (std::size_t i = 0; i < zones_.zones.size(); ++i) {
    if (!(zones_.zones[i].radius_m > 0)) throw std::runtime_error(radius_missing(i + 1));
  }
  original_.reset();
  legs_.clear();
}

inline Status Detour::step(const Tick&, const Inputs& in, const Params& p, Outputs& out) {
  if (!original_ || original_->revision != in.plan->revision) adopt(*in.plan, p);
  const VehicleState& state = *in.state;
  wind_north_ = state.wind_valid ? state.wind_mps.north : 0;
  wind_east_ = state.wind_valid ? state.wind_mps.east : 0;
  if (const std::size_t i = choose(in, p); i != no_leg) search(i, p);
  bool solved = true;
  for (const Leg& leg : legs_) solved = solved && leg.solved;
  if (!solved) return Status::degraded;
  if (!changed_) return Status::ok;
  changed_ = false;
  Plan& plan = assemble();
  const double clear_m = clearance_of(plan);
  if (clear_m < p.margin - 0.1) return Status::degraded;  // the last orbit, or a leg without a detour
  plan.revision = ++revision_;
  out.plan.publish(plan);
  out.clearance_m = clear_m;
  out.flight_s = std::min(time_of(plan, no_leg), unknown_std);
  return Status::ok;
}

/// Cuts a new plan into legs, and finds those too close to a zone.
inline void Detour::adopt(const Plan& plan, const Params& p) {
  original_ = std::make_unique<Plan>(plan);
  result_ = std::make_unique<Plan>();
  legs_.assign(plan.waypoints.size(), {});
  const Route route(*original_);
  for (std::uint32_t i = 0; i < route.size(); ++i) {
    Leg& leg = legs_[i];
    const Vec3<Ned>&a = plan.waypoints[route.before(i)].position_m, &b = plan.waypoints[i].position_m;
    leg.from = {a.north, a.east};
    leg.to = {b.north, b.east};
    leg.airspeed_mps = route.airspeed_mps(i);
    if (route.before(i) == i || route.is_point()) continue;
    leg.blocked =
        clearance(zones_, leg.from, leg.to) < p.margin || clearance(zones_, route.leg(i)) < p.margin;
    leg.solved = !leg.blocked;
  }
  leg_of_.clear();
  changed_ = true;
}

/// The leg to search for now: first a leg without a route, then the leg searched least, unless it is active.
inline std::size_t Detour::choose(const Inputs& in, const Params& p) const {
  std::size_t best = no_leg;
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    if (!legs_[i].solved) return i;
    if (!legs_[i].blocked || legs_[i].searches > p.improvements) continue;
    if (in.progress && flown(i, *in.progress)) continue;
    if (best == no_leg || legs_[i].searches < legs_[best].searches) best = i;
  }
  return best;
}

/// The active leg and the next one keep their shape, since the corner between them is already active.
inline bool Detour::flown(std::size_t leg, const Progress& progress) const {
  if (progress.plan_revision != revision_ || leg_of_.empty()) return true;  // unknown
  const std::size_t now = leg_of_[std::min<std::size_t>(progress.item, leg_of_.size() - 1)];
  return leg == now || leg == (now + 1) % legs_.size();
}

inline void Detour::search(std::size_t i, const Params& p) {
  Leg& leg = legs_[i];
  const Search s{zones_,      p.margin + leg.extra_m + 1, 8, leg.airspeed_mps, wind_north_, wind_east_,
                 p.iterations};
  Random random(mix_seed(seed_, ++searches_));
  ++leg.searches;
  const std::vector<Point> way = RrtStar(s, leg.from, leg.to, random).run();
  if (way.empty()) {
    leg.extra_m = 0;
    return;
  }
  const double before_s = time_of(assemble(), i);
  const std::vector<Point> before = std::exchange(leg.between, {way.begin() + 1, way.end() - 1});
  const Plan& plan = assemble();
  const Route route(plan);
  double clear_m = unknown_std;
  for (std::uint32_t k = 0; k < route.size(); ++k) {
    if (touches(k, i, route)) clear_m = std::min(clear_m, clearance(zones_, route.leg(k)));
  }
  const bool clear = clear_m >= p.margin - 0.1;
  if (!clear) leg.extra_m += 5;
  constexpr double worth_s = 0.05;  // a smaller gain is not worth a change of the plan
  if (clear && (!leg.solved || time_of(plan, i) < before_s - worth_s)) {
    leg.solved = changed_ = true;
  } else {
    leg.between = before;
  }
}

/// Legs that change with the detour of an original leg: this leg, and those that share a corner with it.
inline bool Detour::touches(std::uint32_t k, std::size_t leg, const Route& route) const {
  return leg_of_[k] == leg || leg_of_[route.before(k)] == leg || leg_of_[route.after(k)] == leg;
}

/// Flight time of the assembled plan in the present wind; of one original leg with its corners, or of all.
inline double Detour::time_of(const Plan& plan, std::size_t leg) const {
  const Route route(plan);
  Search s;
  s.wind_north_mps = wind_north_;
  s.wind_east_mps = wind_east_;
  double sum = 0;
  for (std::uint32_t k = route.closed() ? 0 : 1; k < route.size(); ++k) {
    if (route.is_point() || (leg != no_leg && !touches(k, leg, route))) continue;
    s.airspeed_mps = route.airspeed_mps(k);
    sum += flight_time(s, route.leg(k));
  }
  return sum;
}

/// The original plan with its detours. A jump to a waypoint becomes a jump to the first point of the detour
/// of its leg.
inline Plan& Detour::assemble() {
  Plan& plan = *result_;
  plan = *original_;
  plan.waypoints.clear();
  leg_of_.clear();
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    const Waypoint& end = original_->waypoints[i];
    const Waypoint& start = original_->waypoints[i > 0 ? i - 1 : legs_.size() - 1];
    const Leg& leg = legs_[i];
    double length_m = 0, along_m = 0;
    Point last = leg.from;
    for (const Point& point : leg.between) length_m += distance(std::exchange(last, point), point);
    length_m += distance(last, leg.to);
    last = leg.from;
    for (const Point& point : leg.between) {
      along_m += distance(std::exchange(last, point), point);
      Waypoint w;
      w.position_m = {
          point.north_m, point.east_m,
          start.position_m.down + (end.position_m.down - start.position_m.down) * along_m / length_m};
      w.airspeed_mps = end.airspeed_mps;
      if (plan.waypoints.push_back(w)) leg_of_.push_back(i);
    }
    if (original_->jump_item == i) plan.jump_item = static_cast<std::uint32_t>(plan.waypoints.size());
    if (plan.waypoints.push_back(end)) leg_of_.push_back(i);
  }
  return plan;
}

inline double Detour::clearance_of(const Plan& plan) const {
  const Route route(plan);
  double least = unknown_std;
  if (route.size() == 0) return least;
  for (std::uint32_t i = route.closed() ? 0 : 1; i < route.size(); ++i) {
    if (!route.is_point()) least = std::min(least, clearance(zones_, route.leg(i)));
  }
  if (route.closed() && !route.is_point()) return least;
  const RouteOrbit orbit = route.final_orbit();
  for (const Zone& z : zones_.zones) {
    const double d = std::hypot(z.north_m - orbit.north_m, z.east_m - orbit.east_m);
    least = std::min(least, std::abs(d - orbit.radius_m) - z.radius_m);
  }
  return least;
}

}  // namespace fulmar::slow_planner
