// SPDX-License-Identifier: BSD-3-Clause
// Progress of the plan, distance to its waypoints, and duration of its circuits.
#pragma once
#include <algorithm>
#include <cstdint>

#include "fulmar/msg/progress.hpp"
#include "score_messages.hpp"

namespace fulmar::score {

/// `progress` is null without a connection.
class PlanFigures {
 public:
  /// Begins the scored part of the flight.
  void begin(const Progress* progress, std::int64_t now_ns) {
    lap_began_ns_ = now_ns;
    published_ns_ = now_ns;
    if (!progress) return;
    first_reached_ = reached_ = progress->reached;
    circuits_ = progress->circuits;
  }
  void count(const Progress& progress, std::int64_t now_ns) {
    figures_.waypoints_reached = progress.reached;
    if (progress.reached > first_reached_)
      miss_max_m_ = miss_max_m_ == unknown_std ? progress.miss_m : std::max(miss_max_m_, progress.miss_m);
    if (progress.circuits == circuits_) return;
    figures_.lap_time_s = 1e-9 * static_cast<double>(now_ns - lap_began_ns_);
    lap_began_ns_ = now_ns;
  }
  /// True once a second and at each change of the progress: a flight that ends at a waypoint then has the
  /// figures of that time.
  bool due(const Progress* progress, std::int64_t now_ns) {
    bool news = now_ns - published_ns_ >= 1'000'000'000;
    if (progress && (progress->reached != reached_ || progress->circuits != circuits_)) {
      reached_ = progress->reached;
      circuits_ = progress->circuits;
      news = true;
    }
    if (news) published_ns_ = now_ns;
    return news;
  }
  Figures figures() const {
    Figures figures = figures_;
    figures.miss_distance_max_m = miss_max_m_;
    return figures;
  }

 private:
  Figures figures_;
  double miss_max_m_ = unknown_std;
  std::int64_t lap_began_ns_ = 0, published_ns_ = 0;
  std::uint32_t first_reached_ = 0, reached_ = 0, circuits_ = 0;
};

/// Detects that the aircraft is under way: a waypoint was reached since it stood on the ground.
class UnderWay {
 public:
  bool step(bool stands, const Progress* progress) {
    const std::uint32_t reached = progress ? progress->reached : 0;
    if (stands) {
      under_way_ = !progress;
      reached_on_ground_ = reached;
    }
    under_way_ = under_way_ || reached > reached_on_ground_;
    return under_way_;
  }

 private:
  bool under_way_ = true;
  std::uint32_t reached_on_ground_ = 0;
};

}  // namespace fulmar::score
