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

/// Five ports with samples that a test sets; absent until then.
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

TEST_CASE("the flight time is a number in seconds that a condition can look at") {
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
  CHECK(refused("time").find("'time' is not true or false") == 0);
  CHECK(refused("time > 3 m") == "'time': 3 m is a length, not a time");
  CHECK(refused("time == cruise") == "'time' is a number and cannot be compared with 'cruise'");
  CHECK(refused("time > nav.state.height_m").find("'time' is in s and ") == 0);
  CHECK(refused("manage.path.kind == time").find("'manage.path.kind' is never 'time'.") == 0);
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

TEST_CASE("comparisons compare, at the limit too") {
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

TEST_CASE("words of an enum are compared by name") {
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

TEST_CASE("a condition lists each port that it looks at once") {
  const auto condition = Condition::compile(
      "nav.state.height_m > 3 m and nav.state.roll_rad < 1 or vehicle.status.armed", World::find);
  CHECK(condition->ports().size() == 2);
  CHECK(condition->text() == "nav.state.height_m > 3 m and nav.state.roll_rad < 1 or vehicle.status.armed");
}

TEST_CASE("a wrong condition is refused with a sentence") {
  CHECK(refused("") == "the condition is empty");
  CHECK(refused("nav.state.height_m <") == "the condition ends where a field or a number is expected");
  CHECK(refused("nav.state.height_m < and") == "expected a field or a number before 'and'");
  CHECK(refused("(vehicle.status.armed") == "a ')' is missing");
  CHECK(refused("vehicle.status.armed)") == "a ')' without its '('");
  CHECK(refused("vehicle.status.armed vehicle.status.override") ==
        "expected 'and' or 'or' before 'vehicle.status.override'");
  CHECK(refused("nav.state.height_m = 3") == "'=' is not understood; write == to compare");
  CHECK(refused("vehicle.status.armed && vehicle.status.override") == "'&&' is not understood; write and");
  CHECK(refused("!vehicle.status.armed") == "'!' is not understood; write not");
  CHECK(refused("nav.state.height_m > 3 $") == "'$' is not understood");
  CHECK(refused("1 < nav.state.height_m < 3") == "a comparison has two sides; join two of them with 'and'");
  CHECK(refused("3 < 4") == "'3 < 4' looks at no field");
  CHECK(refused("armed") == "'armed' is not a field; a field is written like nav.state.height_m");
  CHECK(refused("nav.state.height_m") ==
        "'nav.state.height_m' is not true or false; compare it with something");
  CHECK(refused("nav.state > 3")
            .starts_with("'nav.state' is a whole VehicleState; name a field of it. Valid: position_m, "));
  CHECK(refused("nav.state.position_m > 3") ==
        "'nav.state.position_m' is a Vec3Ned, not a number, a word or true or false");
  CHECK(refused("nav.state.height_m < 3 s") == "'nav.state.height_m': 3 s is a time, not a length");
  CHECK(refused("nav.state.height_m < nav.state.roll_rad") ==
        "'nav.state.height_m' is in m and 'nav.state.roll_rad' in rad");
  CHECK(refused("nav.state.height_m == low") ==
        "'nav.state.height_m' is a number and cannot be compared with 'low'");
  CHECK(refused("manage.path.kind == obrit") ==
        "'manage.path.kind' is never 'obrit'. Did you mean 'orbit'? Valid: line, orbit.");
  CHECK(refused("manage.path.kind < orbit") == "'manage.path.kind' has no order; compare it with == or !=");
  CHECK(refused("manage.path.kind == 1") ==
        "'manage.path.kind' is compared with a word. Valid: line, orbit.");
  CHECK(refused("manage.path.kind == manage.path.turn") ==
        "'manage.path.kind' and 'manage.path.turn' have different words");
  CHECK(refused("vehicle.status.armed == 1") == "'vehicle.status.armed' is true or false, not 1");
  CHECK(refused("vehicle.status.armed == yes") == "'vehicle.status.armed' is true or false, not 'yes'");
  CHECK(refused("vehicle.status.armed == vehicle.status.health") ==
        "'vehicle.status.armed' and 'vehicle.status.health' cannot be compared");
  CHECK(refused("law.roll_error_rad.x > 3") == "'law.roll_error_rad' is a probe: one number, without fields");
  CHECK(refused("law.roll_error_rad > 3 m") == "'law.roll_error_rad': 3 m is a length, not an angle");
  CHECK(refused("nav.stat.height_m > 3") == "there is no port nav.stat");
  CHECK(refused("plan.plan.waypoints.airspeed_mps > 3") ==
        "'waypoints' is a list of at most 1024: say waypoints[0].");
  CHECK(refused(std::string(200, '(') + "vehicle.status.armed") == "the condition is nested too deep");
}

TEST_CASE("fields of two units are compared as what they are") {
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
