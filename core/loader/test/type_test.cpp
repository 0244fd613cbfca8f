// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/type.hpp"

#include <doctest/doctest.h>

#include <string>

#include "core/error.hpp"
#include "tables.hpp"

namespace type_test {

using namespace fulmar::core;
using namespace tables;

namespace {

std::string fault_of(const fulmar_type& type) {
  try {
    copy_type(type);
    return "accepted";
  } catch (const Error& e) {
    return e.what();
  }
}

std::string fault_with(const std::vector<fulmar_field>& fields, std::size_t size, std::size_t align = 8) {
  return fault_of(type("T", fields, size, align));
}

std::uint64_t route_hash_with(void (*change)(fulmar_field&)) {
  auto fields = route_fields();
  change(fields[1]);
  return copy_type(type("Route", fields, sizeof(Route)))->hash;
}

}  // namespace

TEST_CASE("a table is copied completely") {
  const TypePtr copy = copy_type(route);
  CHECK(copy->name == "Route");
  CHECK(copy->size == sizeof(Route));
  REQUIRE(copy->fields.size() == 12);
  const Field* throttle = copy->find("throttle_frac");
  REQUIRE(throttle != nullptr);
  CHECK(throttle->offset == 8);
  CHECK(throttle->min == 0);
  CHECK(throttle->max == 1);
  CHECK(copy->find("mode")->labels == std::vector<std::string>{"idle", "glide", "climb"});
  CHECK(copy->find("position_m")->type->frame == "ned");
  CHECK(copy->find("waypoints")->count == 5);
  CHECK(copy->find("nothing") == nullptr);
}

TEST_CASE("the hash distinguishes any two tables that differ anywhere but in a range") {
  const std::uint64_t same = route_hash_with([](fulmar_field&) {});
  CHECK(copy_type(route)->hash == same);
  CHECK(route_hash_with([](fulmar_field& f) { f.max = 1.5; }) == same);  // a range does not change the layout
  CHECK(route_hash_with([](fulmar_field& f) { f.unit = "m"; }) != same);
  CHECK(route_hash_with([](fulmar_field& f) { f.name = "throttle_ratio"; }) != same);
  CHECK(route_hash_with([](fulmar_field& f) { f.kind = FULMAR_I64; }) != same);
  const fulmar_type other_frame = type("Vec3", vec_fields, sizeof(Vec), 8, "body");
  auto fields = route_fields();
  fields[2].type = &other_frame;
  CHECK(copy_type(type("Route", fields, sizeof(Route)))->hash != same);
  CHECK(copy_type(type("Rout", route_table, sizeof(Route)))->hash != same);
}

TEST_CASE("tables that contradict themselves are rejected by name") {
  CHECK(fault_with({real("a", "", 0), real("b", "", 8)}, 16) == "accepted");
  CHECK(fault_with({real("a", "", 0), real("b", "", 0)}, 16) == "type 'T': loader.fields_overlap(a, b)");
  CHECK(fault_with({real("a", "", 0), real("b", "", 4)}, 16) ==
        "loader.field_not_aligned(type 'T': field 'b')");
  CHECK(fault_with({real("a", "", 0), real("b", "", 16)}, 16) == "type 'T': loader.field_outside_struct(b)");
  CHECK(fault_with({real("a", "", 4294967288u)}, 16) == "type 'T': loader.field_outside_struct(a)");
  CHECK(fault_with({real("a", "", 0), real("a", "", 8)}, 16) == "loader.field_repeated(type 'T', a)");
  CHECK(fault_with({real("a b", "", 0)}, 8) == "type 'T': loader.field_name_invalid(a b)");
  CHECK(fault_with({field("a", "", 97, 0, 8)}, 8) == "loader.port_kind_unknown(type 'T': field 'a', 97)");
  CHECK(fault_with({array(real("a", "", 0), 3)}, 16) == "type 'T': loader.field_outside_struct(a)");
  CHECK(fault_with({array(real("a", "", 0), 0)}, 16) == "loader.field_without_elements(type 'T': field 'a')");
  CHECK(fault_with({list(real("a", "", 0), 1, 0)}, 16) == "loader.items_overlap_count(type 'T': field 'a')");
  CHECK(fault_with({field("a", "", FULMAR_F64, 0, 4)}, 8) == "loader.elements_overlap(type 'T': field 'a')");
  CHECK(fault_with({in_range(real("a", "", 0), 2, 1)}, 8) == "loader.range_empty(type 'T': field 'a')");
  CHECK(fault_with({in_range(real("a", "", 0), NAN, 1)}, 8) == "loader.range_empty(type 'T': field 'a')");
  CHECK(fault_with({real("a", "", 0)}, 8, 4) == "type 'T': loader.field_alignment_invalid(a)");
  CHECK(fault_with({real("a", "", 0)}, 12, 8) == "loader.struct_alignment_invalid(type 'T', 8, 12)");
  CHECK(fault_with({}, 0) == "loader.struct_size_invalid(type 'T', 0)");
  CHECK(fault_with({}, 1, 1) == "accepted");  // a request without arguments
  CHECK(fault_with({field("a", "", FULMAR_ENUM, 0, 1)}, 8) ==
        "loader.label_count_invalid(type 'T': field 'a', 0)");
  CHECK(fault_with({field("a", "", FULMAR_STRUCT, 0, 8)}, 8) == "loader.type_missing(type 'T': field 'a')");
}

TEST_CASE("invalid pointers are rejected, not followed") {
  const auto* nowhere = reinterpret_cast<const char*>(std::uintptr_t{16});
  CHECK(fault_with({real(nowhere, "", 0)}, 8) == "loader.text_outside_memory(type 'T': the name of a field)");
  fulmar_type wild = type("T", vec_fields, 24);
  wild.fields = reinterpret_cast<const fulmar_field*>(std::uintptr_t{64});
  CHECK(fault_of(wild) == "loader.table_outside_memory(type 'T': the fields)");
  wild = type("T", vec_fields, 24);
  wild.field_stride = 8;
  CHECK(fault_of(wild) == "loader.table_stride_invalid(type 'T': the fields, 8, " +
                              std::to_string(size_in_1_0<fulmar_field>) + ")");
}

TEST_CASE("a type that contains itself is rejected") {
  std::vector<fulmar_field> fields{field("inside", "", FULMAR_STRUCT, 0, 8)};
  const fulmar_type loop = type("Loop", fields, 8);
  fields[0].type = &loop;
  CHECK(fault_of(loop) == "loader.type_too_deep(type 'Loop': field 'inside', 16)");
}

TEST_CASE("a table from a newer minor version, with longer rows, is read") {
  struct Longer {
    fulmar_field known;
    std::uint64_t news;
  };
  const Longer rows[] = {{real("a", "m", 0), 1}, {real("b", "m", 8), 2}};
  fulmar_type newer = type("T", {}, 16);
  newer.fields = &rows[0].known;
  newer.field_count = 2;
  newer.field_stride = sizeof(Longer);
  const TypePtr copy = copy_type(newer);
  CHECK(copy->fields[1].name == "b");
  CHECK(copy->fields[1].offset == 8);
}

TEST_CASE("a field is found by its dotted name") {
  const TypePtr t = copy_type(route);
  const FieldRef north = resolve_field(*t, "position_m.north");
  CHECK(north.offset == offsetof(Route, position_m.north));
  CHECK(north.unit == "m");  // of the vector
  CHECK(north.items.empty());
  const FieldRef speed = resolve_field(*t, "waypoints[3].airspeed_mps");
  CHECK(speed.offset ==
        offsetof(Route, waypoints.items) + 3 * sizeof(Waypoint) + offsetof(Waypoint, airspeed_mps));
  CHECK(speed.unit == "m/s");
  CHECK(resolve_field(*t, "gains_ratio[2]").offset == offsetof(Route, gains_ratio) + 16);
  CHECK(resolve_field(*t, "corners_m[1].down").offset == offsetof(Route, corners_m) + sizeof(Vec) + 16);
  const FieldRef count = resolve_field(*t, "waypoints.count");
  CHECK(count.field->kind == FULMAR_U32);
  CHECK(count.offset == offsetof(Route, waypoints));
}

TEST_CASE("the number of a field is read from the message") {
  const TypePtr t = copy_type(route);
  Route message{};
  message.position_m.down = -70.5;
  message.heading_rad = 0.5f;
  message.lap = -2;
  message.mode = 2;
  message.valid = 1;
  message.serial = 1ull << 40;
  message.waypoints.count = 2;
  message.waypoints.items[1].airspeed_mps = 17;
  const auto number = [&](const char* name) {
    const FieldRef ref = resolve_field(*t, name);
    return number_at(*ref.field, bytes(message) + ref.offset);
  };
  CHECK(number("position_m.down") == -70.5);
  CHECK(number("heading_rad") == 0.5);
  CHECK(number("lap") == -2);
  CHECK(number("mode") == 2);
  CHECK(number("valid") == 1);
  CHECK(number("serial") == 1099511627776.0);
  CHECK(number("waypoints.count") == 2);
  CHECK(number("waypoints[1].airspeed_mps") == 17);
  CHECK(std::isnan(number("label")));
  CHECK(resolve_field(*t, "waypoints[1].hold").present(bytes(message)));
  CHECK_FALSE(resolve_field(*t, "waypoints[2].hold").present(bytes(message)));
  CHECK(resolve_field(*t, "lap").present(bytes(message)));
}

TEST_CASE("an unknown name is reported with the valid ones") {
  const TypePtr t = copy_type(route);
  const auto fault = [&](const char* name) -> std::string {
    try {
      resolve_field(*t, name);
      return "found";
    } catch (const Error& e) {
      return e.what();
    }
  };
  CHECK(fault("position_m.noth") == "types.name_unknown_in(Vec3, field, noth,  [north] north, east, down)");
  CHECK(fault("lap.count") == "types.field_not_struct(lap, lap.count)");
  CHECK(fault("gains_ratio") == "types.index_missing(gains_ratio, ' is an array of 4, gains_ratio)");
  CHECK(fault("waypoints") == "types.index_missing(waypoints, ' is a list of at most 5, waypoints)");
  CHECK(fault("waypoints[5].hold") ==
        "types.index_out_of_range(waypoints, 5, waypoints, ' is a list of at most 5)");
  CHECK(fault("lap[0]") == "types.index_not_allowed(lap)");
  for (const char* bad : {"gains_ratio[", "gains_ratio[]", "gains_ratio[x]", "gains_ratio[1",
                          "gains_ratio[-1]", "gains_ratio[99999999999]"})
    CHECK(fault(bad) == "types.index_invalid(" + std::string(bad) + ", " + bad + ")");
  for (const char* bad : {"", ".", "lap.", "[0]", "position_m..north"}) CHECK(fault(bad) != "found");
}

}  // namespace type_test
