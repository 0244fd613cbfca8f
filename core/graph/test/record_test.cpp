// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/record.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <ctime>

#include "core/graph/test/shelf.hpp"
#include "core/graph/test/shelf_types.hpp"
#include "core/sanitized.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/plan.hpp"

using namespace fulmar;
using namespace fulmar::core;
using namespace fulmar::core::test;

namespace record_test {

enum class Colour : std::uint8_t { red, green };
struct Sample {
  std::int64_t time_ns = 5;
  std::uint64_t big = 0;
  std::int32_t small = 0;
  std::uint8_t byte = 0;
  float narrow_m = 0;
  std::array<double, 3> gains_ratio{1, 2, 3};
  List<double, 2> few_m;
  Text<8> text{"as is"};
  Colour colour = Colour::red;
  double range_m = 0, range_s = 0;
};

}  // namespace record_test
using namespace record_test;

namespace {

template <class T>
struct Read {
  T value{};
  std::string faults;
};

template <class T>
Read<T> read(const std::string& yaml) {
  Read<T> result;
  Report report;
  const Node node =
      parse_yaml(std::make_shared<SourceFile>(SourceFile{"folder/file.yaml", "file.yaml", yaml}), report);
  fill_record(*type_of<T>(), node, reinterpret_cast<std::byte*>(&result.value), "", report);
  result.faults = report.text();
  return result;
}

}  // namespace

TEST_CASE("an airframe file fills nested structs, and fields that it omits stay") {
  const auto read_ = read<Airframe>(
      "name: Anaconda\nmass: 4.5 kg\nwing: {area_m2: 0.55, span: 2900 mm, stall_alpha: 15 deg, oswald: 0.8}\n"
      "aileron: {limit_rad: 0.3, reversed: true}\naero:\n  lift: {alpha: 5.6}\n");
  CHECK(read_.faults == "");
  const Airframe& airframe = read_.value;
  CHECK(airframe.name.view() == "Anaconda");
  CHECK(airframe.mass_kg == 4.5);
  CHECK(airframe.wing.area_m2 == 0.55);
  CHECK(airframe.wing.span_m == doctest::Approx(2.9).epsilon(1e-15));
  CHECK(airframe.wing.stall_alpha_rad == doctest::Approx(0.261799387799).epsilon(1e-11));
  CHECK(airframe.wing.oswald_ratio == 0.8);
  CHECK(airframe.wing.chord_m == Wing{}.chord_m);
  CHECK(airframe.aileron.limit_rad == 0.3);
  CHECK(airframe.aileron.reversed);
  CHECK_FALSE(airframe.elevator.reversed);
  CHECK(airframe.aero.lift.alpha_ratio == 5.6);
}

TEST_CASE("an incomplete record is reported with all missing fields") {
  const auto missing = [](const std::string& yaml) {
    Report report;
    return join(missing_in_record(*type_of<Airframe>(), parse_yaml(make_source(yaml, "file"), report)));
  };
  CHECK(missing(anaconda) == "none");
  const std::string part = "mass: 5 kg\nwing: {span: 2 m}\naero: {lift: {alpha: 5}, drag: {beta: 1}}\n";
  CHECK(missing(part) ==
        "inertia.xx, inertia.yy, inertia.zz, wing.area, wing.chord, aero.pitch.alpha, propulsion.ct0, "
        "aileron.limit, elevator.limit, rudder.limit");
  CHECK(missing("mass_kg: 5\ninertia: 3\nwing: []\naero:\npropulsion: {ct0_ratio: 1}\naileron: {limit_rad: 1}"
                "\nelevator: {limit: 1}\nrudder: {limit: 1}\n") ==
        "none");  // other faults are reported elsewhere
  const std::string but_motor =
      "mass: 5\ninertia: 3\nwing: []\naero:\naileron: {limit: 1}\nelevator: {limit: 1}"
      "\nrudder: {limit: 1}\npropulsion: ";
  CHECK(missing(but_motor + "{battery: 12 V}") == "propulsion.ct0");
  const std::string disc = "{disc: {area_m2: 0.1, exit_speed: 37 m/s, speed: 800 rad/s}}";
  CHECK(missing(but_motor + disc) == "none");
  CHECK(missing(but_motor + "{disc: {area_m2: 0.1}}") == "propulsion.disc.exit_speed, propulsion.disc.speed");
  const auto refused = [](const std::string& yaml) { return read<Airframe>(yaml).faults; };
  CHECK(refused("mass: -5 kg") == "file.yaml:1: mass: graph.value_out_of_range(-5 kg, 0.0001, 1e+06,  kg, )");
  for (const char* yaml : {"wing: {area_m2: -1}", "wing: {span: 0 m}", "wing: {chord: -1 cm}",
                           "inertia: {yy_kgm2: -1}", "rudder: {limit: -1 deg}"})
    CHECK(refused(yaml).find("graph.value_out_of_range(") != std::string::npos);
}

TEST_CASE("the points of a table rise, and an item of a list is complete") {
  const auto table = [](const std::string& at) {
    return read<Airframe>("aero:\n  tables:\n    - {coefficient: pitch, over: alpha, at: " + at +
                          ", values: [1, 2, 3]}\n");
  };
  const auto good = table("[-0.1, 0, 0.1]");
  CHECK(good.faults == "");
  REQUIRE(good.value.aero.tables.count == 1);
  CHECK(good.value.aero.tables[0].coefficient == Coefficient::pitch);
  CHECK(good.value.aero.tables[0].at_ratio[2] == 0.1);
  CHECK(good.value.aero.tables[0].values_ratio[2] == 3);
  CHECK(table("[-0.1, 0.1, 0]").faults ==
        "file.yaml:3: aero.tables[0].at[2]: graph.list_not_rising(0,  comes after 0.1)");
  CHECK(table("[0, 0, 0.1]").faults ==
        "file.yaml:3: aero.tables[0].at[1]: graph.list_not_rising(0,  is there twice)");
  // an item with a fault is not compared with its neighbours
  for (const auto& [at, item] : {std::pair{"[-5 deg, 0, 1]", "at[0]"}, {"[0, 5 deg, 3]", "at[1]"}}) {
    const std::string faults = table(at).faults;
    CHECK(faults.starts_with("file.yaml:3: aero.tables[0]." + std::string(item) +
                             ": graph.dimension_differs("));
    CHECK(faults.find("graph.list_not_rising") == std::string::npos);
  }
  CHECK(table("[0, 5 deg, 3 deg]").faults.find("graph.list_not_rising") == std::string::npos);
  CHECK(read<Airframe>("aero:\n  tables:\n    - {over: alpha, at: [1], values: [1]}\n").faults ==
        "file.yaml:3: aero.tables[0]: graph.item_incomplete(CoefficientTable, coefficient)");
}

TEST_CASE("a plan's list is counted and vectors are lists or maps") {
  const auto plan = read<Plan>(hourglass_plan);
  CHECK(plan.faults == "");
  REQUIRE(plan.value.waypoints.count == 3);
  CHECK(plan.value.waypoints[0].position_m == Vec3<Ned>{400, -250, -70});
  CHECK(plan.value.waypoints[1].position_m == Vec3<Ned>{-400, -50, -70});
  CHECK(plan.value.waypoints[2].position_m == Vec3<Ned>{-400, -250, -70});
  CHECK(plan.value.waypoints[2].course_rad == doctest::Approx(1.5707963267949));
  CHECK(plan.value.end == PlanEnd::circuit);
}

TEST_CASE("numbers of every kind are exact") {
  const auto sample = read<Sample>(
      "time: 100 ms\nbig: 18446744073709551615\nsmall: -2147483648\nbyte: 255\nnarrow_m: 0.5\ngains: [4, "
      "5.5, 6e1]\nfew: [1 cm]\ntext: "
      "seven77\ncolour: green\n");
  CHECK(sample.faults == "");
  CHECK(sample.value.time_ns == 100'000'000);
  CHECK(sample.value.big == 18446744073709551615u);
  CHECK(sample.value.small == -2147483648);
  CHECK(sample.value.byte == 255);
  CHECK(sample.value.narrow_m == 0.5f);
  CHECK(sample.value.gains_ratio == std::array<double, 3>{4, 5.5, 60});
  CHECK(sample.value.few_m.count == 1);
  CHECK(sample.value.few_m[0] == 0.01);
  CHECK(sample.value.text.view() == "seven77");
  CHECK(sample.value.colour == Colour::green);
  CHECK(read<Sample>("time_ns: 9007199254740993\n").value.time_ns ==
        9007199254740993);  // 2^53 + 1 is no double
  CHECK(read<Sample>("narrow_m: 1e39\n").faults.find("graph.value_exceeds_field(1e39)") != std::string::npos);
  CHECK(read<Sample>("narrow_m: -3e38\n").faults == "");
}

TEST_CASE("every fault of a record is reported at once, with the line of its own file") {
  CHECK(read<Sample>("big: -1\nsmall: 2147483648\nbyte: 1.5\nnarrow: 0.5\ngains: [1, 2]\nfew: [1 m, 2 m, 3 "
                     "m]\ntext: eight888\ncolour: "
                     "gren\nrange: 3 m\n"
                     "bigg: 3\ngains_ratio: 7\ntime: [1]\n")
            .faults ==
        "file.yaml:1: big: graph.integer_out_of_range(-1, 0, 18446744073709551615)\nfile.yaml:2: small: "
        "graph.integer_out_of_range(2147483648, -2147483648, 2147483647)\nfile.yaml:3: byte: "
        "graph.integer_invalid(1.5)\nfile.yaml:4: narrow: graph.unit_missing(0.5, graph.unit_examples(a "
        "length, m, cm, mm, km, ft, in, nmi))\nfile.yaml:5: gains: graph.item_count_invalid(2,  items, "
        "exactly 3)\nfile.yaml:6: few: graph.item_count_invalid(3,  items, at most 2)\nfile.yaml:7: text: "
        "graph.text_too_long(8, 7)\nfile.yaml:8: colour: graph.choice_unknown(gren,  [green] red, "
        "green)\nfile.yaml:9: graph.field_ambiguous(, range, range_m, range_s)\nfile.yaml:10: "
        "graph.field_unknown(, bigg, Sample,  Did you mean 'big'? [] time_ns, big, small, byte, narrow_m, "
        "gains_ratio, few_m, text, colour, range_m, range_s)\nfile.yaml:11: gains_ratio: "
        "graph.field_repeated(gains, file.yaml:5)\nfile.yaml:11: gains_ratio: graph.value_not_valid(a list "
        "of exactly 3, "
        "'7')\nfile.yaml:12: time: graph.value_not_valid(a whole number, a list)");
}

TEST_CASE("faults in nested fields have their path") {
  CHECK(read<Airframe>(
            "wing:\n  span: 3 kg\n  are: 1 m^2\naileron: [1]\nelevator: {reversed: maybe}\nmass_kg: .nan\n")
            .faults ==
        "file.yaml:2: wing.span: graph.dimension_differs(3 kg, a mass, , a length)\nfile.yaml:3: "
        "graph.field_unknown(wing: , are, Wing,  Did you mean 'area'? [] area_m2, span_m, chord_m, "
        "oswald_ratio, stall_alpha_rad, stall_sharpness_ratio)\nfile.yaml:4: aileron: "
        "graph.record_map_expected(Surface, a list)\nfile.yaml:5: elevator.reversed: "
        "graph.flag_expected('maybe')\nfile.yaml:6: mass_kg: graph.number_not_finite(.nan)");
  CHECK(read<Plan>("waypoints:\n  - {position_m: [1, 2]}\n  - {position: [1, 2, 3]}\n  - 7\n").faults ==
        "file.yaml:2: waypoints[0].position_m: graph.number_count_invalid(3, north, east, down, "
        "2)\nfile.yaml:3: "
        "waypoints[1].position.north: graph.unit_missing(1, graph.unit_examples(a length, m, cm, mm, km, ft, "
        "in, nmi))\nfile.yaml:3: waypoints[1].position.east: graph.unit_missing(2, graph.unit_examples(a "
        "length, m, cm, mm, km, ft, in, nmi))\nfile.yaml:3: waypoints[1].position.down: "
        "graph.unit_missing(3, graph.unit_examples(a length, m, cm, mm, km, ft, in, nmi))\nfile.yaml:4: "
        "waypoints[2]: graph.record_map_expected(Waypoint, '7')");
}

TEST_CASE("a fraction outside -1 .. 1 is rejected") {
  CHECK(read<Actuators>("throttle: 150 %\n").faults ==
        "file.yaml:1: throttle: graph.value_out_of_range(150 %, -100, 100,  %, )");
  CHECK(read<Actuators>("throttle_frac: 0.5\n").value.throttle_frac == 0.5);
}

TEST_CASE("of many faults a hundred are reported, and that there are more") {
  std::string yaml;
  for (int i = 0; i < 1000; ++i) yaml += "unknown_" + std::to_string(i) + ": 1\n";
  const std::string faults = read<Actuators>(yaml).faults;
  CHECK(std::count(faults.begin(), faults.end(), '\n') == 100);
  CHECK(faults.find("file.yaml:1: graph.field_unknown(, unknown_0, Actuators,  [] throttle_frac, "
                    "aileron_rad, elevator_rad, rudder_rad)") == 0);
  CHECK(faults.find("file.yaml:100: graph.field_unknown(, unknown_99, Actuators,  [] throttle_frac, "
                    "aileron_rad, elevator_rad, rudder_rad)") != std::string::npos);
  CHECK(faults.ends_with("\nfile.yaml: graph.more_faults(100)"));
  Report again;  // the same fault does not count twice
  for (int k = 0; k < 3; ++k)
    for (int i = 1; i <= 100; ++i) again.add({"file.yaml", i}, "no");
  CHECK(again.text().ends_with("\nfile.yaml:100: no"));
}

TEST_CASE("the time for a text grows with its length, for any content") {
  std::string keys, twice;
  for (int i = 0; i < 100'000; ++i) keys += (i > 0 ? ", k" : "{k") + std::to_string(i) + ": 1";
  for (int i = 0; i < 25'000; ++i) twice += (i > 0 ? ", k" : "{k") + std::to_string(i / 2) + ": 1";
  const std::clock_t begin = std::clock();
  Report report;
  const Node node = parse_yaml(make_source(keys + "}", "keys"), report);
  CHECK(node.entries.size() == 100'000);
  CHECK(report.empty());
  CHECK(parse_yaml(make_source(twice + "}", "twice"), report).entries.size() == 12'500);
  CHECK(report.text().find("graph.key_repeated(k0, 0)") != std::string::npos);
  // 1.5 s of CPU time on a slow machine; a comparison of each with all before it takes a minute
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 10 * sanitizer_slowdown);
}
