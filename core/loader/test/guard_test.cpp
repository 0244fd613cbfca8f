// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/types/type.hpp"
#include "tables.hpp"

namespace guard_test {

using namespace fulmar::core;
using namespace tables;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

Route good() {
  Route r{};
  r.airspeed_mps = 17;
  r.throttle_frac = 0.5;
  r.waypoints.count = 3;
  return r;
}

// Changes a good message and returns the guard's message: "" when it passes.
template <class Change>
std::string words(const Change& change) {
  static const Guard guard(*copy_type(route));
  Route message = good();
  change(message);
  const std::string text = guard.explain(bytes(message));
  CHECK(guard.check(bytes(message)) == text.empty());
  return text;
}

}  // namespace

TEST_CASE("a good message passes, extreme but finite numbers too") {
  CHECK(words([](Route&) {}) == "");
  CHECK(words([](Route& r) { r.airspeed_mps = std::numeric_limits<double>::max(); }) == "");
  CHECK(words([](Route& r) { r.airspeed_mps = -std::numeric_limits<double>::denorm_min(); }) == "");
  CHECK(words([](Route& r) { r.throttle_frac = 1; }) == "");
  CHECK(words([](Route& r) { r.serial = std::numeric_limits<std::uint64_t>::max(); }) == "");
}

TEST_CASE("each invalid value is named") {
  CHECK(words([](Route& r) { r.airspeed_mps = not_a_number; }) ==
        "types.value_not_finite(airspeed_mps, nan)");
  CHECK(words([](Route& r) { r.airspeed_mps = -not_a_number; }) ==
        "types.value_not_finite(airspeed_mps, nan)");
  CHECK(words([](Route& r) { r.airspeed_mps = inf; }) == "types.value_not_finite(airspeed_mps, inf)");
  CHECK(words([](Route& r) { r.position_m.east = -inf; }) == "types.value_not_finite(position_m.east, -inf)");
  CHECK(words([](Route& r) { r.throttle_frac = 1.25; }) ==
        "types.value_out_of_range(throttle_frac, 1.25, 0, 1)");
  CHECK(words([](Route& r) { r.throttle_frac = not_a_number; }) ==
        "types.value_not_finite(throttle_frac, nan)");
  CHECK(words([](Route& r) { r.heading_rad = std::numeric_limits<float>::infinity(); }) ==
        "types.value_not_finite(heading_rad, inf)");
  CHECK(words([](Route& r) { r.lap = 10; }) == "types.value_out_of_range(lap, 10, -2, 9)");
  CHECK(words([](Route& r) { r.gains_ratio[2] = not_a_number; }) ==
        "types.value_not_finite(gains_ratio[2], nan)");
  CHECK(words([](Route& r) { r.mode = 3; }) == "types.label_value_invalid(mode, 3)");
  CHECK(words([](Route& r) { r.valid = 2; }) == "types.flag_value_invalid(valid, 2)");
  CHECK(words([](Route& r) { std::memset(r.label, 'x', sizeof r.label); }) ==
        "types.field_not_terminated(label)");
  CHECK(words([](Route& r) { r.waypoints.count = 6; }) == "types.too_many_items(waypoints, 6, 5)");
  CHECK(words([](Route& r) { r.waypoints.items[2].position_m.down = not_a_number; }) ==
        "types.value_not_finite(waypoints[2].position_m.down, nan)");
  CHECK(words([](Route& r) { r.waypoints.items[2].hold = 7; }) ==
        "types.flag_value_invalid(waypoints[2].hold, 7)");
  CHECK(words([](Route& r) { r.corners_m[1].north = not_a_number; }) ==
        "types.value_not_finite(corners_m[1].north, nan)");
}

TEST_CASE("list items beyond the count have no effect") {
  CHECK(words([](Route& r) { r.waypoints.items[3].airspeed_mps = not_a_number; }) == "");
  CHECK(words([](Route& r) {
          r.waypoints.count = 0;
          r.waypoints.items[0].hold = 9;
        }) == "");
}

TEST_CASE("padding is not checked") {
  const Guard guard(*copy_type(waypoint));
  Waypoint message{};
  std::memset(reinterpret_cast<char*>(&message) + offsetof(Waypoint, hold) + 1, 0xff, 7);
  CHECK(guard.check(bytes(message)));
}

TEST_CASE("any bit pattern in a run of doubles is judged like the mathematics library does") {
  constexpr std::size_t n = 23;  // not a multiple of the unrolled loop
  const std::vector<fulmar_field> rows{array(real("x_m", "m", 0), n)};
  const Guard guard(*copy_type(type("Run", rows, n * 8)));
  std::mt19937_64 random(1);
  int refused = 0;
  for (int k = 0; k < 20000; ++k) {
    double x[n];
    bool finite = true;
    for (double& v : x) {
      std::uint64_t bits = random();
      if (random() % 64 == 0) bits |= 0x7ff0000000000000u;
      std::memcpy(&v, &bits, sizeof v);
      finite = finite && std::isfinite(v);
    }
    refused += finite ? 0 : 1;
    REQUIRE(guard.check(reinterpret_cast<const std::byte*>(x)) == finite);
  }
  CHECK(refused > 1000);
}

TEST_CASE("large arrays of structs are checked to the last item") {
  constexpr std::uint32_t n = 200;
  const std::vector<fulmar_field> rows{array(nested("path", "", waypoint, 0), n)};
  const Guard guard(*copy_type(type("Path", rows, n * sizeof(Waypoint))));
  std::vector<Waypoint> message(n);
  const auto* data = reinterpret_cast<const std::byte*>(message.data());
  CHECK(guard.check(data));
  message[n - 1].hold = 2;
  CHECK_FALSE(guard.check(data));
  CHECK(guard.explain(data) == "types.flag_value_invalid(path[199].hold, 2)");
}

TEST_CASE("a one-sided range leaves the other side open but finite") {
  const std::vector<fulmar_field> rows{in_range(real("mass_kg", "kg", 0), 0, INFINITY)};
  const Guard guard(*copy_type(type("Mass", rows, 8)));
  const auto check = [&](double x) { return guard.check(bytes(x)); };
  CHECK(check(1e300));
  CHECK(check(0));
  CHECK_FALSE(check(-1e-300));
  CHECK_FALSE(check(inf));
  CHECK_FALSE(check(not_a_number));
}

TEST_CASE("an explanation never writes beyond its room") {
  const Guard guard(*copy_type(route));
  Route message = good();
  message.waypoints.items[2].position_m.down = not_a_number;
  for (std::size_t size = 1; size < 50; ++size) {
    char text[64];
    std::memset(text, '#', sizeof text);
    guard.explain_to(bytes(message), text, size);
    CHECK(std::strlen(text) < size);
    CHECK(text[size] == '#');
  }
}

}  // namespace guard_test
