// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/condition.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "core/graph/test/shelf.hpp"
#include "core/graph/test/shelf_types.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"

namespace condition_test {

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

/// Five ports with samples that a test sets; without a sample until then.
struct World : SampleReader {
  VehicleState state;
  VehicleStatus status;
  Path path;
  Plan plan;
  double probe = 0;
  std::int64_t time_ns = 0;
  bool has_state = true, has_status = true, has_path = true, has_plan = true;

  const std::byte* sample(const Source& source) const noexcept override {
    const auto bytes = [](const auto& value, bool there) {
      return there ? reinterpret_cast<const std::byte*>(&value) : nullptr;
    };
    switch (source.index) {
      case 0: return bytes(state, has_state);
      case 1: return bytes(status, has_status);
      case 2: return bytes(path, has_path);
      case 3: return bytes(plan, has_plan);
      default: return bytes(probe, true);
    }
  }
  std::int64_t now_ns() const noexcept override { return time_ns; }
  static std::pair<Source, TypePtr> find(const std::string& owner, const std::string& port) {
    const std::string name = owner + "." + port;
    if (name == "nav.state") return {{Source::Kind::role, 0, 0}, type_of<VehicleState>()};
    if (name == "vehicle.status") return {{Source::Kind::role, 1, 0}, type_of<VehicleStatus>()};
    if (name == "manage.path") return {{Source::Kind::component, 2, 0}, type_of<Path>()};
    if (name == "plan.plan") return {{Source::Kind::component, 3, 0}, type_of<Plan>()};
    if (name == "law.roll_error_rad") return {{Source::Kind::component, 4, 0}, nullptr};
    throw Error("there is no port " + name);
  }
  bool operator()(const std::string& text) const { return Condition::compile(text, find)->holds(*this); }
};

std::string refused(const std::string& text) {
  try {
    Condition::compile(text, World::find);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the flight time is a number in seconds for a condition") {
  World world;
  world.time_ns = 60'000'000'000;
  CHECK(world("time >= 60 s"));
  CHECK(world("time >= 60"));
  CHECK_FALSE(world("time > 60 s"));
  CHECK(world("1 min <= time"));
  CHECK(world("time == 60000 ms"));
  world.state.height_m = 20;
  CHECK(world("time > 59.9975 s and nav.state.height_m > 10 m"));
  world.has_state = false;
  CHECK_FALSE(world("time > 59.9975 s or nav.state.height_m > 10 m"));
  world.time_ns = -2'500'000;  // before a simulated aircraft is armed
  CHECK(world("time < 0 s"));
  CHECK(Condition::compile("time > 1 s", World::find)->ports().empty());
  CHECK(refused("time").find("graph.operand_not_boolean(time)") == 0);
  CHECK(refused("time > 3 m") ==
        "graph.operand_fault(time, graph.dimension_differs(3 m, a length, , a time))");
  CHECK(refused("time == cruise") == "graph.number_compared_to_label(time, cruise)");
  CHECK(refused("time > nav.state.height_m").find("graph.units_differ(time, s, nav.state.height_m, m)") == 0);
  CHECK(refused("manage.path.kind == time")
            .find("graph.label_unknown(manage.path.kind, time,  [line] line, orbit)") == 0);
}

TEST_CASE("and, or and not follow their truth tables and their precedence") {
  World world;
  for (const bool a : {false, true})
    for (const bool b : {false, true})
      for (const bool c : {false, true}) {
        world.status.armed = a;
        world.status.override = b;
        world.status.failsafe = c;
        const std::string A = "vehicle.status.armed", B = "vehicle.status.override",
                          C = "vehicle.status.failsafe";
        CHECK(world(A + " and " + B) == (a && b));
        CHECK(world(A + " or " + B) == (a || b));
        CHECK(world("not " + A) == !a);
        CHECK(world("not not " + A) == a);
        CHECK(world(A + " or " + B + " and " + C) == (a || (b && c)));
        CHECK(world("(" + A + " or " + B + ") and " + C) == ((a || b) && c));
        CHECK(world("not " + A + " and " + B) == (!a && b));
        CHECK(world("not (" + A + " and " + B + ") or " + C) == (!(a && b) || c));
        CHECK(world(A + " == true") == a);
        CHECK(world(A + " != " + B) == (a != b));
      }
}

TEST_CASE("comparisons are exact at their limits") {
  World world;
  world.state.height_m = 30;
  CHECK_FALSE(world("nav.state.height_m < 30 m"));
  CHECK(world("nav.state.height_m <= 30 m"));
  CHECK_FALSE(world("nav.state.height_m > 30 m"));
  CHECK(world("nav.state.height_m >= 30 m"));
  CHECK(world("nav.state.height_m == 30 m"));
  CHECK_FALSE(world("nav.state.height_m != 30 m"));
  CHECK(world("20 m < nav.state.height_m"));
  CHECK_FALSE(world("20 m >= nav.state.height_m"));
  CHECK(world("nav.state.height_m > -1.5e1"));
  CHECK(world("nav.state.height_m>29 m and nav.state.height_m<31"));
}

TEST_CASE("units of a condition are converted to those of the field") {
  World world;
  world.state.height_m = 100;
  world.state.roll_rad = 0.8;
  CHECK(world("nav.state.height_m > 328 ft"));        // 328 ft = 99.97 m
  CHECK_FALSE(world("nav.state.height_m > 329 ft"));  // 329 ft = 100.28 m
  CHECK(world("nav.state.roll_rad > 45 deg"));        // 0.785 rad
  CHECK_FALSE(world("nav.state.roll_rad > 46 deg"));  // 0.803 rad
  world.state.airspeed_mps = 10;
  CHECK(world("nav.state.airspeed_mps > 19 kt and nav.state.airspeed_mps < 36.1 km/h"));
}

TEST_CASE("fields are compared with fields, elements of vectors and lists too") {
  World world;
  world.state.airspeed_mps = 12;
  world.path.airspeed_mps = 13;
  CHECK(world("nav.state.airspeed_mps < manage.path.airspeed_mps"));
  world.state.position_m.north = 5;
  CHECK(world("nav.state.position_m.north > 4 m"));
  world.plan.waypoints.count = 2;
  world.plan.waypoints[1].airspeed_mps = 9;
  CHECK(world("plan.plan.waypoints[1].airspeed_mps == 9 m/s"));
  CHECK_FALSE(world("plan.plan.waypoints[2].airspeed_mps == 0"));  // there is no such waypoint
  CHECK(world("plan.plan.waypoints.count == 2"));
  world.probe = 0.5;
  CHECK(world("law.roll_error_rad > 28 deg"));
  CHECK_FALSE(world("law.roll_error_rad > 29 deg"));
}

TEST_CASE("labels of an enum are compared by name") {
  World world;
  world.path.kind = PathKind::orbit;
  CHECK(world("manage.path.kind == orbit"));
  CHECK_FALSE(world("manage.path.kind == line"));
  CHECK(world("manage.path.kind != line"));
  world.status.health = Health::degraded;
  CHECK(world("vehicle.status.health == degraded"));
}

TEST_CASE("a condition is false while any of its ports has no sample, a negated one too") {
  World world;
  world.status.armed = true;
  world.has_state = false;
  CHECK_FALSE(world("nav.state.height_m < 3 m"));
  CHECK_FALSE(world("not nav.state.height_m < 3 m"));
  CHECK_FALSE(world("vehicle.status.armed or nav.state.height_m < 3 m"));
  CHECK(world("vehicle.status.armed"));
}

TEST_CASE("a condition lists each port that it reads once") {
  const auto condition = Condition::compile(
      "nav.state.height_m > 3 m and nav.state.roll_rad < 1 or vehicle.status.armed", World::find);
  CHECK(condition->ports().size() == 2);
  CHECK(condition->text() == "nav.state.height_m > 3 m and nav.state.roll_rad < 1 or vehicle.status.armed");
}

TEST_CASE("a wrong condition is rejected with a sentence") {
  CHECK(refused("") == "graph.condition_empty");
  CHECK(refused("nav.state.height_m <") == "graph.operand_missing");
  CHECK(refused("nav.state.height_m < and") == "graph.operand_expected(and)");
  CHECK(refused("(vehicle.status.armed") == "graph.parenthesis_unclosed");
  CHECK(refused("vehicle.status.armed)") == "graph.parenthesis_unopened");
  CHECK(refused("vehicle.status.armed vehicle.status.override") ==
        "graph.conjunction_expected(vehicle.status.override)");
  CHECK(refused("nav.state.height_m = 3") == "graph.operator_invalid(=, write '==' to compare)");
  CHECK(refused("vehicle.status.armed && vehicle.status.override") ==
        "graph.operator_invalid(&&, write 'and')");
  CHECK(refused("!vehicle.status.armed") == "graph.operator_invalid(!, write 'not')");
  CHECK(refused("nav.state.height_m > 3 $") == "graph.condition_text_invalid($)");
  CHECK(refused("1 < nav.state.height_m < 3") == "graph.comparison_chained");
  CHECK(refused("3 < 4") == "graph.comparison_without_field(3, <, 4)");
  CHECK(refused("armed") == "graph.operand_not_field(armed)");
  CHECK(refused("nav.state.height_m") == "graph.operand_not_boolean(nav.state.height_m)");
  CHECK(
      refused("nav.state > 3")
          .starts_with(
              "graph.field_name_missing(nav.state, VehicleState, position_m, velocity_mps, attitude, "
              "roll_rad, pitch_rad, yaw_rad, rate_radps, specific_force_mps2, height_m, climb_rate_mps, "
              "ground_speed_mps, course_rad, airspeed_mps, alpha_rad, beta_rad, wind_mps, gyro_bias_radps, "
              "accel_bias_mps2, position_std_m, velocity_std_mps, attitude_std_rad, wind_std_mps, "
              "airspeed_std_mps, origin_latitude_deg, origin_longitude_deg, origin_altitude_m, origin_valid, "
              "attitude_valid, velocity_valid, position_valid, height_valid, airspeed_valid, wind_valid, "
              "reset_count, reset_position_m, reset_velocity_mps, reset_yaw_rad, airspeed_from_model)"));
  CHECK(refused("nav.state.position_m > 3") == "graph.operand_not_scalar(nav.state.position_m, a Vec3Ned)");
  CHECK(refused("nav.state.height_m < 3 s") ==
        "graph.operand_fault(nav.state.height_m, graph.dimension_differs(3 s, a time, , a length))");
  CHECK(refused("nav.state.height_m < nav.state.roll_rad") ==
        "graph.units_differ(nav.state.height_m, m, nav.state.roll_rad, rad)");
  CHECK(refused("nav.state.height_m == low") == "graph.number_compared_to_label(nav.state.height_m, low)");
  CHECK(refused("manage.path.kind == obrit") ==
        "graph.label_unknown(manage.path.kind, obrit,  [orbit] line, orbit)");
  CHECK(refused("manage.path.kind < orbit") == "graph.operand_unordered(manage.path.kind)");
  CHECK(refused("manage.path.kind == 1") == "graph.label_expected(manage.path.kind, line, orbit)");
  CHECK(refused("manage.path.kind == manage.path.turn") ==
        "graph.labels_differ(manage.path.kind, manage.path.turn)");
  CHECK(refused("vehicle.status.armed == 1") == "graph.flag_compared_to_number(vehicle.status.armed, 1)");
  CHECK(refused("vehicle.status.armed == yes") == "graph.flag_compared_to_label(vehicle.status.armed, yes)");
  CHECK(refused("vehicle.status.armed == vehicle.status.health") ==
        "graph.operands_incomparable(vehicle.status.armed, vehicle.status.health)");
  CHECK(refused("law.roll_error_rad.x > 3") == "graph.probe_without_fields(law, roll_error_rad)");
  CHECK(refused("law.roll_error_rad > 3 m") ==
        "graph.operand_fault(law.roll_error_rad, graph.dimension_differs(3 m, a length, , an angle))");
  CHECK(refused("nav.stat.height_m > 3") == "there is no port nav.stat");
  CHECK(refused("plan.plan.waypoints.airspeed_mps > 3") ==
        "types.index_missing(waypoints, ' is a list of at most 1024, waypoints)");
  const std::string deep = std::string(200, '(') + "vehicle.status.armed";
  CHECK(refused(deep) == "graph.condition_too_deep(50)");
}

TEST_CASE("fields of two units are converted for a comparison") {
  World world;
  world.state.roll_rad = 0.8;
  world.state.origin_latitude_deg = 40;  // 0.698 rad
  CHECK(world("nav.state.roll_rad > nav.state.origin_latitude_deg"));
  CHECK_FALSE(world("nav.state.origin_latitude_deg > nav.state.roll_rad"));
  world.state.roll_rad = 0.6;
  CHECK_FALSE(world("nav.state.roll_rad > nav.state.origin_latitude_deg"));
  CHECK(world("nav.state.origin_latitude_deg > nav.state.roll_rad"));
}

}  // namespace condition_test
