// SPDX-License-Identifier: BSD-3-Clause
// The pattern against IAMSAR volume II, 5.3; the edits to the planner, and the reactions to its results.
#include <doctest/doctest.h>

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>
#include <set>

#include "expanding_square.hpp"

namespace {

using Search = ExpandingSquare;

Waypoint waypoint(double north_m, double east_m, std::uint32_t id) {
  Waypoint w;
  w.position_m = {north_m, east_m, -70};
  w.id = id;
  return w;
}

struct Flight {
  Bench<Search> bench;
  Plan plan;
  Progress progress;
  VehicleState state;
  std::vector<PlanEdit> edits;

  Flight() {
    plan.revision = 1;
    for (std::uint32_t i = 0; i < 4; ++i) plan.waypoints.push_back(waypoint(400.0 * i, 0, i + 1));
    progress.items = 4;
    progress.plan_revision = 1;
    state.position_m = {1000, 2000, -65};
    state.position_valid = true;
    bench.params.corners.value = 4;
  }

  Status step(const std::vector<PlanEditResult>& results = {}) {
    bench.set(bench.in.plan, plan);
    bench.set(bench.in.progress, progress);
    bench.set(bench.in.state, state);
    for (const PlanEditResult& result : results) bench.push(bench.in.results, result);
    Status status = Status::failed;
    REQUIRE(allocations([&] { status = bench.step(0.1); }) == 0);
    REQUIRE(bench.validation_error() == "");
    REQUIRE(bench.out.edits.lost == 0);
    edits.clear();
    const auto& out = bench.out.edits;
    edits.assign(out.items.begin(), out.items.begin() + out.count);
    return status;
  }

  /// Emulates the planner: the corners are inserted before waypoint 3, with the ids 11 to 14.
  std::vector<PlanEditResult> put_in() {
    plan.waypoints.clear();
    plan.waypoints.push_back(waypoint(0, 0, 1));
    plan.waypoints.push_back(waypoint(400, 0, 2));
    std::vector<PlanEditResult> results;
    for (const PlanEdit& edit : edits) {
      PlanEditResult result;
      result.id = edit.id;
      result.group = edit.group;
      result.accepted = true;
      if (edit.kind == PlanEditKind::insert) {
        result.waypoint_id = static_cast<std::uint32_t>(11 + results.size());
        plan.waypoints.push_back(
            waypoint(edit.waypoint.position_m.north, edit.waypoint.position_m.east, result.waypoint_id));
      }
      results.push_back(result);
    }
    results.back().in_force = true;
    results.back().revision = plan.revision = 2;
    plan.waypoints.push_back(waypoint(800, 0, 3));
    plan.waypoints.push_back(waypoint(1200, 0, 4));
    progress.items = plan.waypoints.count;
    progress.plan_revision = 2;
    return results;
  }
  void begin() {
    progress.reached = 2;
    progress.item = 2;
    step();
    REQUIRE(edits.size() == 5);
  }
};

}  // namespace

TEST_CASE("legs are 1, 1, 2, 2, 3, 3 spacings long, and each turns by 90 deg the way that is asked for") {
  for (const bool left : {false, true})
    for (const double chi : {0.0, 0.7, -2.0}) {
      Search::Params p;
      p.spacing.value = 100;
      p.first_leg.value = chi;
      p.left.value = left;
      Vec3<Ned> from;
      double course = 0;
      for (std::int64_t k = 0; k < 12; ++k) {
        const Vec3<Ned> to = Search::corner(k, p), leg = to - from;
        CHECK(std::hypot(leg.north, leg.east) == doctest::Approx(100.0 * static_cast<double>(k / 2 + 1)));
        CHECK(leg.down == 0);
        const double now = std::atan2(leg.east, leg.north);
        const double turn = std::remainder(now - (k == 0 ? chi : course), 2 * std::numbers::pi);
        CHECK(turn == doctest::Approx(k == 0 ? 0 : (left ? -1 : 1) * std::numbers::pi / 2));
        course = now;
        from = to;
      }
    }
}

TEST_CASE("tracks along the first leg are one spacing apart: nothing between them is left out") {
  Search::Params p;
  p.spacing.value = 100;
  std::set<long> easts;
  for (std::int64_t k = 0; k < 12; ++k) easts.insert(std::lround(Search::corner(k, p).east));
  CHECK(easts == std::set<long>{-300, -200, -100, 0, 100, 200, 300});
}

TEST_CASE("the whole search is asked for at once, as a group, from where the aircraft is") {
  Flight flight;
  flight.progress.reached = 1;
  CHECK(flight.step() == Status::ok);
  CHECK(flight.edits.empty());
  flight.begin();
  for (const PlanEdit& edit : flight.edits) {
    CHECK(edit.group != 0);
    CHECK(edit.group_size == 5);
  }
  CHECK(flight.edits[0].kind == PlanEditKind::insert);
  CHECK(flight.edits[0].waypoint_id == 3);  // before the active waypoint, whatever its index is then
  CHECK(flight.edits[0].waypoint.position_m == Vec3<Ned>{1120, 2000, -70});
  CHECK(flight.edits[4].kind == PlanEditKind::set_current);
  CHECK(flight.edits[4].index == 2);
  flight.step();
  CHECK(flight.edits.empty());  // once
}

TEST_CASE("corners are counted by their ids; after the last one all are taken out, and it is over") {
  Flight flight;
  flight.begin();
  flight.step(flight.put_in());
  CHECK(flight.bench.out.corners_ratio.value == 0);
  for (std::uint32_t k = 0; k < 4; ++k) {
    flight.progress.item = 2 + k;
    flight.step();
    CHECK(flight.bench.out.corners_ratio.value == k);
    CHECK(flight.edits.empty());
  }
  flight.progress.item = 6;  // the plan continues
  flight.step();
  CHECK(flight.bench.out.corners_ratio.value == 4);
  REQUIRE(flight.edits.size() == 4);
  for (std::uint32_t k = 0; k < 4; ++k) {
    CHECK(flight.edits[k].kind == PlanEditKind::remove);
    CHECK(flight.edits[k].waypoint_id == 11 + k);
    CHECK(flight.edits[k].group_size == 4);
  }
  PlanEditResult done;
  done.id = flight.edits[3].id;
  done.accepted = done.in_force = true;
  done.revision = 3;
  CHECK(flight.step({done}) == Status::ok);
  flight.progress.reached = 40;
  flight.step();
  CHECK(flight.edits.empty());
}

TEST_CASE(
    "a rejection has its reason, and the plan stays unchanged; results for other components are ignored") {
  Flight flight;
  flight.begin();
  PlanEditResult others;
  others.id = 3;
  others.reason = "not ours";
  CHECK(flight.step({others}) == Status::ok);
  PlanEditResult refused;
  refused.id = 1001;
  const char* const reason = "less than 1 m from the waypoint before it";
  refused.reason = reason;
  CHECK(flight.step({refused}) == Status::degraded);
  std::string reported;
  const auto& notices = flight.bench.out.notices;
  for (std::uint32_t i = 0; i < notices.count; ++i) reported += notices.items[i].text.view();
  CHECK(reported == std::string("search refused: ") + reason);
  flight.progress.item = 3;
  CHECK(flight.step() == Status::degraded);
  CHECK(flight.edits.empty());
}

TEST_CASE("without a plan or a position it waits") {
  Flight flight;
  flight.progress.reached = 5;
  flight.state.position_valid = false;
  flight.step();
  CHECK(flight.edits.empty());
  flight.state.position_valid = true;
  flight.plan.waypoints.clear();
  flight.step();
  CHECK(flight.edits.empty());
}
