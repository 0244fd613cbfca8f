// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cstring>

#include "core/error.hpp"
#include "core/types/type.hpp"
#include "tables.hpp"

namespace copy_plan_test {

using namespace fulmar::core;
using namespace tables;

namespace {

// The reader's message from an earlier version: other order, other capacities, some fields only.
struct OldWaypoint {
  double airspeed_mps;
  Vec position_m;
};
struct OldRoute {
  std::uint8_t mode;
  char label[20];
  struct {
    std::uint32_t count;
    OldWaypoint items[8];
  } waypoints;
  Vec position_m;
  double airspeed_mps;
};

TypePtr old_route() {
  static const std::vector<fulmar_field> waypoint_rows{real("airspeed_mps", "m/s", 0),
                                                       nested("position_m", "m", vec, 8)};
  static const fulmar_type old_waypoint = type("OldWaypoint", waypoint_rows, sizeof(OldWaypoint));
  static const std::vector<fulmar_field> rows{
      labelled("mode", modes, offsetof(OldRoute, mode)),
      field("label", "", FULMAR_TEXT, offsetof(OldRoute, label), 20),
      list(nested("waypoints", "", old_waypoint, offsetof(OldRoute, waypoints)), 8,
           offsetof(OldRoute, waypoints.items) - offsetof(OldRoute, waypoints)),
      nested("position_m", "m", vec, offsetof(OldRoute, position_m)),
      real("airspeed_mps", "m/s", offsetof(OldRoute, airspeed_mps))};
  return copy_type(type("OldRoute", rows, sizeof(OldRoute)));
}

Route sample() {
  Route r{};
  r.airspeed_mps = 17.25;
  r.position_m = {1, 2, -70};
  r.mode = 2;
  std::strcpy(r.label, "north leg");
  r.waypoints.count = 2;
  r.waypoints.items[0] = {{400, -250, -70}, 17, 1};
  r.waypoints.items[1] = {{-400, -50, -70}, 18, 0};
  return r;
}

std::string verdict(const std::vector<fulmar_field>& reader, const std::vector<fulmar_field>& writer,
                    std::size_t size = 64) {
  return incompatibility(*copy_type(type("W", writer, size)), *copy_type(type("R", reader, size)));
}

}  // namespace

TEST_CASE("equal tables are copied at once") {
  const TypePtr a = copy_type(route), b = copy_type(route);
  CHECK(incompatibility(*a, *b) == "");
  const CopyPlan plan = copy_plan(*a, *b);
  CHECK(plan.whole);
  CHECK(plan.size == sizeof(Route));
  const Route from = sample();
  Route to{};
  plan.run(bytes(from), reinterpret_cast<std::byte*>(&to));
  CHECK(std::memcmp(&from, &to, sizeof from) == 0);
}

TEST_CASE("a reader with fewer fields, in another order, gets its fields") {
  const CopyPlan plan = copy_plan(*copy_type(route), *old_route());
  CHECK_FALSE(plan.whole);
  const Route from = sample();
  OldRoute to{};
  plan.run(bytes(from), reinterpret_cast<std::byte*>(&to));
  CHECK(to.airspeed_mps == 17.25);
  CHECK(to.position_m.down == -70);
  CHECK(to.mode == 2);
  CHECK(std::string(to.label) == "north leg");
  REQUIRE(to.waypoints.count == 2);
  CHECK(to.waypoints.items[0].airspeed_mps == 17);
  CHECK(to.waypoints.items[1].airspeed_mps == 18);
  CHECK(to.waypoints.items[1].position_m.north == -400);
  CHECK(to.waypoints.items[1].position_m.east == -50);
}

TEST_CASE("a copy plan stays inside both messages") {
  const TypePtr from = copy_type(route), to = old_route();
  for (const CopyPlan::Move& move : copy_plan(*from, *to).moves) {
    CHECK(move.from + move.bytes <= from->size);
    CHECK(move.to + move.bytes <= to->size);
  }
}

TEST_CASE("a field appended by the writer leaves one move for the rest") {
  const std::vector<fulmar_field> reader{real("a_m", "m", 0), real("b_m", "m", 8),
                                         field("flag", "", FULMAR_BOOL, 16, 1), real("c_m", "m", 24)};
  std::vector<fulmar_field> writer = reader;
  writer.push_back(real("d_m", "m", 32));
  const CopyPlan plan = copy_plan(*copy_type(type("W", writer, 40)), *copy_type(type("R", reader, 32)));
  CHECK_FALSE(plan.whole);
  REQUIRE(plan.moves.size() == 1);
  CHECK(plan.moves[0].bytes == 32);
}

TEST_CASE("an appended field of the reader may be missing, and is then zero for every previous content") {
  // 4 bytes of padding in the writer have the offset of the reader's new field: they must not be copied
  std::vector<fulmar_field> older{real("a_m", "m", 0), field("flag", "", FULMAR_U32, 8, 4),
                                  real("b_m", "m", 16)};
  std::vector<fulmar_field> newer = older;
  newer.insert(newer.begin() + 2, field("id", "", FULMAR_U32, 12, 4));
  newer.push_back(array(real("c_m", "m", 24), 2));
  for (const std::size_t i : {2u, 4u}) newer[i].flags = FULMAR_FIELD_APPENDED;
  const CopyPlan plan = copy_plan(*copy_type(type("W", older, 24)), *copy_type(type("R", newer, 40)));
  CHECK_FALSE(plan.whole);
  struct {
    double a = 1;
    std::uint32_t flag = 2, padding = 77;
    double b = 3;
  } from;
  struct {
    double a = 0;
    std::uint32_t flag = 0, id = 9;
    double b = 0, c[2] = {5, 6};
  } to;
  plan.run(bytes(from), reinterpret_cast<std::byte*>(&to));
  CHECK(to.a == 1);
  CHECK(to.flag == 2);
  CHECK(to.b == 3);
  CHECK(to.id == 0);
  CHECK(to.c[0] == 0);
  CHECK(to.c[1] == 0);
  newer[2].flags = 0;
  CHECK(verdict(newer, older) == "types.writer_field_missing(, id)");
}

TEST_CASE("items of a longer list are filled one by one") {
  struct Item {
    double x = 0;
    std::uint32_t id = 0;
  };
  const std::vector<fulmar_field> old_item{real("x_m", "m", 0)};
  std::vector<fulmar_field> new_item{real("x_m", "m", 0), field("id", "", FULMAR_U32, 8, 4)};
  new_item[1].flags = FULMAR_FIELD_APPENDED;
  const fulmar_type before = type("Item", old_item, 8), after = type("Item", new_item, 16);
  const std::vector<fulmar_field> writer{list(nested("items", "", before, 0), 2, 8)},
      reader{list(nested("items", "", after, 0), 2, 8)};
  const CopyPlan plan = copy_plan(*copy_type(type("W", writer, 24)), *copy_type(type("R", reader, 40)));
  const struct {
    std::uint32_t count = 2, padding = 0;
    double items[2] = {1.5, 2.5};
  } from;
  struct {
    std::uint32_t count = 0, padding = 0;
    Item items[2] = {{0, 8}, {0, 9}};
  } to;
  plan.run(bytes(from), reinterpret_cast<std::byte*>(&to));
  CHECK(to.items[0].x == 1.5);
  CHECK(to.items[1].x == 2.5);
  CHECK(to.items[0].id == 0);
  CHECK(to.items[1].id == 0);
}

TEST_CASE("a wider range or one more label changes no byte") {
  static const char* const fewer[] = {"idle", "glide"};
  const std::vector<fulmar_field> reader{in_range(real("a_m", "m", 0), 0, 5), labelled("mode", modes, 8)};
  const std::vector<fulmar_field> writer{in_range(real("a_m", "m", 0), 0, 2), labelled("mode", fewer, 8)};
  CHECK(copy_plan(*copy_type(type("W", writer, 16)), *copy_type(type("R", reader, 16))).whole);
}

TEST_CASE("an incompatible type is rejected, naming the first field that differs") {
  const fulmar_type body = type("Vec3", vec_fields, sizeof(Vec), 8, "body");
  static const char* const others[] = {"idle", "climb", "glide"};
  CHECK(verdict({real("airspeed_mps", "m/s", 0)}, {real("airspeed_mps", "km/h", 0)}) ==
        "airspeed_mps: types.reader_differs(unit , m/s, km/h)");
  CHECK(verdict({real("x", "m", 0)}, {real("x", "", 0)}) == "x: types.reader_differs(unit , m, none)");
  CHECK(verdict({real("beta_rad", "rad", 0)}, {real("alpha_rad", "rad", 0)}) ==
        "types.writer_field_missing(, beta_rad)");
  CHECK(verdict({nested("p_m", "m", vec, 0)}, {nested("p_m", "m", body, 0)}) ==
        "p_m: types.reader_differs(frame , ned, body)");
  CHECK(verdict({real("x", "", 0)}, {field("x", "", FULMAR_F32, 0, 4)}) ==
        "x: types.reader_differs(kind , f64, f32)");
  CHECK(verdict({array(real("x", "", 0), 3)}, {array(real("x", "", 0), 4)}) ==
        "x: types.reader_differs(, types.array_shape(3), types.array_shape(4))");
  CHECK(verdict({real("x", "", 0)}, {array(real("x", "", 0), 4)}) ==
        "x: types.reader_differs(, one value, types.array_shape(4))");
  CHECK(verdict({list(real("x", "", 0), 3, 8)}, {list(real("x", "", 0), 4, 8)}) ==
        "x: types.reader_differs(, types.list_shape(3), types.list_shape(4))");
  CHECK(verdict({list(real("x", "", 0), 4, 8)}, {list(real("x", "", 0), 3, 8)}) == "");
  CHECK(verdict({field("t", "", FULMAR_TEXT, 0, 8)}, {field("t", "", FULMAR_TEXT, 0, 16)}) ==
        "t: types.reader_differs(room for , 8 bytes, 16)");
  CHECK(verdict({labelled("mode", others, 0)}, {labelled("mode", modes, 0)}) ==
        "mode: types.reader_differs(labels , idle, climb, glide, idle, glide, climb)");
}

TEST_CASE("a difference inside a nested struct is reported with its path") {
  auto fields = waypoint_fields;
  fields[1].unit = "km/h";
  const fulmar_type other = type("Waypoint", fields, sizeof(Waypoint));
  CHECK(verdict({nested("next", "", waypoint, 0)}, {nested("next", "", other, 0)}) ==
        "next.airspeed_mps: types.reader_differs(unit , m/s, km/h)");
  fields.erase(fields.begin() + 1);
  const fulmar_type fewer = type("Waypoint", fields, sizeof(Waypoint));
  CHECK(verdict({nested("next", "", waypoint, 0)}, {nested("next", "", fewer, 0)}) ==
        "types.writer_field_missing(next., airspeed_mps)");
}

TEST_CASE("no plan is made for incompatible tables") {
  CHECK_THROWS_WITH_AS(copy_plan(*old_route(), *copy_type(route)),
                       "types.writer_field_missing(, throttle_frac)", Error);
}

}  // namespace copy_plan_test
