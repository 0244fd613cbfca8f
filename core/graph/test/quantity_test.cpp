// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/quantity.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "core/test/refusal.hpp"

namespace quantity_test {

using namespace fulmar::core;
using fulmar::core::test::refusal;

namespace {

double in(const char* text, const char* unit) { return quantity_in(text, unit, UnitRule::optional); }

std::string refused(const char* text, const char* unit, UnitRule rule = UnitRule::optional) {
  return refusal([&] { quantity_in(text, unit, rule); });
}

}  // namespace

// Reference values: SI brochure (9th edition) and ISO 80000; 1 nautical mile = 1852 m, 1 ft = 0.3048 m,
// standard gravity 9.80665 m/s2.
TEST_CASE("quantities are converted into the declared unit") {
  CHECK(in("180 deg", "rad") == doctest::Approx(3.14159265358979).epsilon(1e-14));
  CHECK(in("90deg", "rad") == doctest::Approx(1.5707963267949).epsilon(1e-13));
  CHECK(in("17 m/s", "m/s") == 17);
  CHECK(in("50 km/h", "m/s") == doctest::Approx(13.8888888889).epsilon(1e-11));
  CHECK(in("10 kt", "m/s") == doctest::Approx(5.14444444444).epsilon(1e-11));
  CHECK(in("500 ft/min", "m/s") == doctest::Approx(2.54).epsilon(1e-12));
  CHECK(in("4551 ft", "m") == doctest::Approx(1387.1448).epsilon(1e-12));
  CHECK(in("1.5 km", "m") == 1500);
  CHECK(in("200 ms", "s") == doctest::Approx(0.2).epsilon(1e-15));
  CHECK(in("0.5 s", "ns") == doctest::Approx(5e8).epsilon(1e-15));
  CHECK(in("400 Hz", "Hz") == 400);
  CHECK(in("0.4 kHz", "1/s") == doctest::Approx(400));
  CHECK(in("1013.25 hPa", "Pa") == doctest::Approx(101325));
  CHECK(in("3 g", "m/s2") == doctest::Approx(29.41995).epsilon(1e-14));
  CHECK(in("4500 g", "kg") == doctest::Approx(4.5).epsilon(1e-15));
  CHECK(in("15 degC", "K") == doctest::Approx(288.15).epsilon(1e-15));
  CHECK(in("288.15 K", "degC") == doctest::Approx(15));
  CHECK(in("6000 rpm", "rad/s") == doctest::Approx(628.318530718).epsilon(1e-11));
  CHECK(in("50 uT", "T") == doctest::Approx(5e-5));
  CHECK(in("80 %", "") == doctest::Approx(0.8));
  CHECK(in("2 deg/(m/s)", "rad/(m/s)") == doctest::Approx(0.0349065850399).epsilon(1e-11));
  CHECK(in("10 deg/s^2", "rad/s2") == doctest::Approx(0.174532925199).epsilon(1e-11));
  CHECK(in("100 cm^2", "m2") == doctest::Approx(0.01));
  CHECK(in("2 lb ft^2", "kg m2") == doctest::Approx(0.0842802202).epsilon(1e-8));
  CHECK(in("1 s/km", "s/m") == doctest::Approx(1e-3));
  CHECK(in("0.7 rad", "deg") == doctest::Approx(40.1070456592).epsilon(1e-11));
  CHECK(in("600 fpm", "m/s") == doctest::Approx(3.048).epsilon(1e-14));
  CHECK(in("60 mph", "m/s") == doctest::Approx(26.8224).epsilon(1e-14));
  CHECK(in("90 kmh", "m/s") == doctest::Approx(25).epsilon(1e-14));
  CHECK(in("10 kn", "m/s") == doctest::Approx(5.14444444444).epsilon(1e-11));
  CHECK(in("2 nmi", "m") == doctest::Approx(3704).epsilon(1e-14));
  CHECK(in("2 mi", "m") == doctest::Approx(3218.688).epsilon(1e-14));
  CHECK(in("7 in", "m") == doctest::Approx(0.1778).epsilon(1e-14));
  CHECK(in("12 mm", "m") == doctest::Approx(0.012).epsilon(1e-14));
  CHECK(in("2 h", "s") == doctest::Approx(7200).epsilon(1e-14));
  CHECK(in("3 min", "s") == doctest::Approx(180).epsilon(1e-14));
  CHECK(in("5 us", "s") == doctest::Approx(5e-6).epsilon(1e-14));
  CHECK(in("2 rev", "rad") == doctest::Approx(12.5663706143592).epsilon(1e-13));
  CHECK(in("5 mrad", "rad") == doctest::Approx(0.005).epsilon(1e-14));
  CHECK(in("10 lb", "kg") == doctest::Approx(4.5359237).epsilon(1e-14));
  CHECK(in("1013 mbar", "Pa") == doctest::Approx(101300).epsilon(1e-14));
  CHECK(in("2 bar", "Pa") == doctest::Approx(2e5).epsilon(1e-14));
  CHECK(in("3 kPa", "Pa") == doctest::Approx(3000).epsilon(1e-14));
  CHECK(in("5200 mAh", "Ah") == doctest::Approx(5.2).epsilon(1e-14));
  CHECK(in("12 mV", "V") == doctest::Approx(0.012).epsilon(1e-14));
  CHECK(in("30 mohm", "ohm") == doctest::Approx(0.03).epsilon(1e-14));
  CHECK(in("48000 nT", "T") == doctest::Approx(4.8e-5).epsilon(1e-13));
  CHECK(in("0.5 gauss", "T") == doctest::Approx(5e-5).epsilon(1e-14));
  CHECK(in("-3e-2", "m") == -0.03);
  CHECK(in("+5 m", "m") == 5);
  CHECK(in(" .5 ", "") == 0.5);
}

TEST_CASE("an unusual declared unit is accepted only as written") {
  CHECK(in("5 steps", "steps") == 5);
  CHECK(in("5", "steps") == 5);
  CHECK(refused("5 m", "steps") == "5 m: graph.unit_not_accepted(steps)");
}

TEST_CASE("a wrong quantity is rejected with a sentence") {
  CHECK(refused("5 kg", "m") == "graph.dimension_differs(5 kg, a mass, , a length)");
  CHECK(refused("5 deg", "") == "graph.dimension_differs(5 deg, an angle, , a plain number)");
  CHECK(refused("5 m", "m/s") == "graph.dimension_differs(5 m, a length, , a speed)");
  CHECK(refused("5 Hz", "rad/s") == "graph.dimension_differs(5 Hz, a frequency, , an angular rate)");
  CHECK(refused("5 m^5", "m") == "graph.dimension_differs(5 m^5, , a length)");
  CHECK(refused("5 m", "rad s/m") == "graph.dimension_differs(5 m, a length, , in rad s/m)");
  CHECK(refused("3 sec", "s") ==
        "3 sec: graph.unit_unknown(sec, ; graph.unit_examples(a time, s, ms, us, ns, min, h))");
  CHECK(refused("3 m/", "m/s") ==
        "3 m/: graph.unit_unknown(m/, ; graph.unit_examples(a speed, m/s, km/h, kt, ft/s))");
  CHECK(refused("abc", "m") == "graph.number_invalid(abc)");
  CHECK(refused("", "m") == "graph.number_invalid()");
  CHECK(refused("- 3", "m") == "graph.number_invalid(- 3)");
  CHECK(refused(".nan", "m") == "graph.number_not_finite(.nan)");
  CHECK(refused("-.inf", "m") == "graph.number_not_finite(-.inf)");
  CHECK(refused("NaN", "m") == "graph.number_not_finite(NaN)");
  CHECK(refused("1e999", "m") == "graph.number_not_representable(1e999)");
  CHECK(refused("1e308 km", "m") == "graph.number_too_large(1e308 km)");
}

TEST_CASE(
    "where a unit is required a bare number is refused, but for plain numbers and degrees of latitude") {
  CHECK(refused("5", "m", UnitRule::required) ==
        "graph.unit_missing(5, graph.unit_examples(a length, m, cm, mm, km, ft, in, nmi))");
  CHECK(refused("5", "rad", UnitRule::required) ==
        "graph.unit_missing(5, graph.unit_examples(an angle, deg, rad))");
  CHECK(quantity_in("0.9", "", UnitRule::required) == 0.9);
  CHECK(quantity_in("40.25", "deg", UnitRule::required) == 40.25);
}

TEST_CASE("a range is reported in the written unit") {
  const auto outside = [](const char* text, const char* unit, double min, double max) {
    return refusal([&] {
      const Quantity quantity = parse_quantity(text);
      check_range(quantity, convert(quantity, unit, UnitRule::optional), unit, min, max);
    });
  };
  constexpr double inf = std::numeric_limits<double>::infinity();
  CHECK(outside("9", "rad/rad", 0, 2) == "graph.value_out_of_range(9, 0, 2,  rad/rad, )");
  CHECK(outside("200 deg", "rad", -3.14159265358979, 3.14159265358979) ==
        "graph.value_out_of_range(200 deg, -180, 180,  deg, )");
  CHECK(outside("-1 cm", "m", 0, inf) == "graph.value_too_small(-1 cm, 0,  cm, )");
  CHECK(outside("31 degC", "K", -inf, 303.15) == "graph.value_too_large(31 degC, 30,  degC, )");
  CHECK(outside("180 deg", "rad", -3.1416, 3.1416) == "");
  CHECK(outside("2", "", 0, 2) == "");  // the ends are valid
  CHECK(outside("0", "", 0, 2) == "");
}

TEST_CASE("the unit suffix of a field is split off") {
  CHECK(split_suffix("stall_alpha_rad")->name == "stall_alpha");
  CHECK(split_suffix("stall_alpha_rad")->unit == "rad");
  CHECK(split_suffix("airspeed_mps")->unit == "m/s");
  CHECK(split_suffix("throttle_frac")->unit == "");
  CHECK_FALSE(split_suffix("satellites"));
  CHECK_FALSE(split_suffix("has_course"));
  CHECK_FALSE(split_suffix("_m"));
}

}  // namespace quantity_test
