// SPDX-License-Identifier: BSD-3-Clause
// The fastest route between two points around the zones, in wind. It needs much time and memory. The same
// number of samples and the same random generator give the same result. Sources: Karaman & Frazzoli,
// "Sampling-based algorithms for optimal motion planning" (2011), RRT*; Gammell, Srinivasa & Barfoot,
// "Informed RRT*" (2014), for the rejection of samples that cannot improve the result.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "fulmar/flight/earth/wind_triangle.hpp"
#include "fulmar/random.hpp"
#include "zones.hpp"

namespace fulmar::slow_planner {

struct Search {
  Zones zones;
  double keep_off_m = 0;  ///< clearance from the rims of the zones
  double spare_m = 0;  ///< additional clearance while the tree grows; the shortcuts use it up and so have few
                       ///< corners, far from each other
  double airspeed_mps = 15;
  double wind_north_mps = 0, wind_east_mps = 0;
  std::int64_t samples = 1000;
};

/// Flight time along a straight line, s; infinite if the wind permits no such flight.
inline double flight_time(const Search& s, const Point& a, const Point& b) {
  const double d = distance(a, b);
  if (d == 0) return 0;
  const double c_n = (b.north_m - a.north_m) / d, c_e = (b.east_m - a.east_m) / d;
  const double along = c_n * s.wind_north_mps + c_e * s.wind_east_mps,
               across = c_n * s.wind_east_mps - c_e * s.wind_north_mps;
  const double forward = s.airspeed_mps * s.airspeed_mps - across * across;  // wind triangle, B&M section 2.4
  const double Vg = along + std::sqrt(std::max(forward, 0.0));
  return forward > 0 && Vg > 0 ? d / Vg : std::numeric_limits<double>::infinity();
}

inline double flight_time(const Search& s, const std::vector<Point>& way) {
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += flight_time(s, way[i - 1], way[i]);
  return sum;
}

/// Flight time along a leg of a route, with its fillets and turns: arcs in chords of about 5 m.
inline double flight_time(const Search& s, const RouteLeg& leg) {
  double sum = 0;
  for (std::size_t i = 0; i < leg.count; ++i) {
    const RoutePiece& piece = leg[i];
    const int chords = piece.kind == PathKind::line ? 1 : 1 + static_cast<int>(piece.length_m / 5);
    const auto at = [&](int k) {
      const Pose pose = piece.pose_at(piece.length_m * k / chords);
      return Point{pose.north_m, pose.east_m};
    };
    for (int k = 0; k < chords; ++k) sum += flight_time(s, at(k), at(k + 1));
  }
  return sum;
}

class RrtStar {
 public:
  RrtStar(const Search& search, const Point& from, const Point& to, Random& random)
      : s_(search), to_(to), random_(random), scale_(distance(from, to)) {
    const auto room = [&](const Point& p) { return clearance(s_.zones, p, p) - s_.keep_off_m; };
    grown_off_m_ = s_.keep_off_m + std::clamp(std::min(room(from), room(to)), 0.0,
                                              s_.spare_m);  // also at the ends
    nodes_.push_back({from, 0, 0, {}});
    low_ = {std::min(from.north_m, to.north_m), std::min(from.east_m, to.east_m)};
    high_ = {std::max(from.north_m, to.north_m), std::max(from.east_m, to.east_m)};
    for (const Zone& z : s_.zones.zones) {  // room for a route around each zone near the straight line
      const double r = z.radius_m + 2 * grown_off_m_ + 100;
      if (line_distance(from, to, {z.north_m, z.east_m}) > r) continue;
      low_ = {std::min(low_.north_m, z.north_m - r), std::min(low_.east_m, z.east_m - r)};
      high_ = {std::max(high_.north_m, z.north_m + r), std::max(high_.east_m, z.east_m + r)};
    }
    step_m_ = std::clamp(scale_ / 8, 20.0, 100.0);
  }

  /// Points of the route with its ends; empty if none was found.
  std::vector<Point> run() {
    for (std::int64_t i = 0; i < s_.samples; ++i) grow();
    if (goal_parent_ == none) return {};
    std::vector<Point> way{to_};
    for (std::size_t k = goal_parent_; k != 0; k = nodes_[k].parent) way.push_back(nodes_[k].at);
    way.push_back(nodes_[0].at);
    std::reverse(way.begin(), way.end());
    return pulled_tight(way);
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  struct Node {
    Point at;
    double time_s = 0;  // from the start
    std::size_t parent = 0;
    std::vector<std::size_t> children;
  };

  bool free(const Point& a, const Point& b) const { return clearance(s_.zones, a, b) >= grown_off_m_; }
  double best_s() const {
    return goal_parent_ == none ? std::numeric_limits<double>::infinity()
                                : nodes_[goal_parent_].time_s + flight_time(s_, nodes_[goal_parent_].at, to_);
  }

  void grow() {
    Point x{random_.uniform(low_.north_m, high_.north_m), random_.uniform(low_.east_m, high_.east_m)};
    if (random_.uniform() < 0.05) x = to_;
    if (flight_time(s_, nodes_[0].at, x) + flight_time(s_, x, to_) > best_s()) return;  // cannot be better
    const std::size_t next = nearest_node(x);
    const double d = distance(nodes_[next].at, x);
    if (d < 1) return;
    if (d > step_m_) {
      const Point& p = nodes_[next].at;
      x = {p.north_m + (x.north_m - p.north_m) * step_m_ / d, p.east_m + (x.east_m - p.east_m) * step_m_ / d};
    }
    if (!free(nodes_[next].at, x)) return;
    add(x, next);
  }

  std::size_t nearest_node(const Point& x) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double n = nodes_[i].at.north_m - x.north_m, e = nodes_[i].at.east_m - x.east_m,
                   square = n * n + e * e;
      if (square < least) {
        least = square;
        best = i;
      }
    }
    return best;
  }

  /// Connects a new node to the parent with the least time; then rewires its neighbours if it is faster for
  /// them.
  void add(const Point& x, std::size_t next) {
    const double n = static_cast<double>(nodes_.size() + 1);
    const double radius = std::min(2 * scale_ * std::sqrt(std::log(n) / n), 3 * step_m_);
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (distance(nodes_[i].at, x) <= radius) near.push_back(i);
    }
    std::size_t parent = next;
    double time_s = nodes_[next].time_s + flight_time(s_, nodes_[next].at, x);
    for (const std::size_t i : near) {
      const double t = nodes_[i].time_s + flight_time(s_, nodes_[i].at, x);
      if (t < time_s && free(nodes_[i].at, x)) {
        time_s = t;
        parent = i;
      }
    }
    const std::size_t added = nodes_.size();
    nodes_.push_back({x, time_s, parent, {}});
    nodes_[parent].children.push_back(added);
    for (const std::size_t i : near) {
      const double t = time_s + flight_time(s_, x, nodes_[i].at);
      if (t < nodes_[i].time_s && free(x, nodes_[i].at)) lead_over(i, added, t);
    }
    if (distance(x, to_) <= 3 * step_m_ && time_s + flight_time(s_, x, to_) < best_s() && free(x, to_))
      goal_parent_ = added;
  }

  void lead_over(std::size_t i, std::size_t parent, double time_s) {
    auto& old = nodes_[nodes_[i].parent].children;
    old.erase(std::find(old.begin(), old.end(), i));
    nodes_[parent].children.push_back(i);
    nodes_[i].parent = parent;
    const double gain = nodes_[i].time_s - time_s;
    std::vector<std::size_t> below{i};
    while (!below.empty()) {
      Node& node = nodes_[below.back()];
      below.pop_back();
      node.time_s -= gain;
      below.insert(below.end(), node.children.begin(), node.children.end());
    }
  }

  /// Shortcuts: from each point straight to the farthest reachable point, which removes the kinks of the
  /// tree.
  std::vector<Point> pulled_tight(const std::vector<Point>& way) const {
    std::vector<Point> tight{way.front()};
    for (std::size_t i = 0; i + 1 < way.size();) {
      std::size_t far = i + 1;
      for (std::size_t k = way.size() - 1; k > i + 1; --k) {
        if (clearance(s_.zones, way[i], way[k]) < s_.keep_off_m) continue;
        far = k;
        break;
      }
      tight.push_back(way[far]);
      i = far;
    }
    return tight;
  }

  const Search& s_;
  Point to_;
  Random& random_;
  double scale_, step_m_ = 50, grown_off_m_;
  Point low_, high_;
  std::vector<Node> nodes_;
  std::size_t goal_parent_ = none;
};

}  // namespace fulmar::slow_planner
