// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/safety/fence.hpp"

#include "kit.hpp"

namespace fence_test {

using namespace fulmar;
using namespace fulmar::safety;

namespace {

Fence fence_of(std::initializer_list<std::pair<double, double>> corners) {
  Fence f;
  for (const auto& [north, east] : corners) {
    FencePoint p;
    p.north_m = north;
    p.east_m = east;
    f.corners.push_back(p);
  }
  return f;
}
Polygon polygon(std::initializer_list<std::pair<double, double>> corners) {
  Polygon p;
  p.set(fence_of(corners), {});
  return p;
}
std::string refusal(const Fence& f, const Origin& origin = {}) {
  Polygon p;
  try {
    p.set(f, origin);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}
TurnBack flying(double north, double east, double course, double Vg = 20) {
  TurnBack t;
  t.north_m = north;
  t.east_m = east;
  t.v_north_mps = Vg * std::cos(course);
  t.v_east_mps = Vg * std::sin(course);
  t.roll_rad = 0.5;
  t.reaction_s = 1;
  return t;
}

}  // namespace

TEST_CASE("room is the distance to the nearest side, negative outside, whichever way the corners go round") {
  for (const Polygon& p : {polygon({{100, -50}, {100, 50}, {-100, 50}, {-100, -50}}),
                           polygon({{-100, -50}, {-100, 50}, {100, 50}, {100, -50}})}) {
    CHECK(p.room_m(0, 0) == doctest::Approx(50));
    CHECK(p.room_m(80, 10) == doctest::Approx(20));
    CHECK(p.room_m(0, 60) == doctest::Approx(-10));
    CHECK(p.room_m(103, 54) == doctest::Approx(-5));
  }
  const Polygon notched = polygon({{100, 0}, {100, 100}, {0, 100}, {60, 50}, {0, 0}});
  CHECK(notched.room_m(40, 50) < 0);
  CHECK(notched.room_m(70, 50) == doctest::Approx(10));
  CHECK(notched.room_m(60, 80) == doctest::Approx(20));
}

TEST_CASE("what is no fence is refused in one sentence that names the corner") {
  CHECK(refusal(fence_of({{0, 0}, {100, 0}})).find("fence.corners: flight.fence_corners_few(2)") == 0);
  CHECK(refusal(fence_of({{0, 0}, {100, 100}, {100, 0}, {0, 100}})).find("flight.fence_sides_cross(") !=
        std::string::npos);
  CHECK(refusal(fence_of({{0, 0}, {100, 0}, {50, 0}, {50, 100}})).find("flight.fence_sides_cross(") !=
        std::string::npos);
  CHECK(refusal(fence_of({{0, 0}, {100, 0}, {100, 100}, {0, 100}})) == "");
  Fence f = fence_of({{0, 0}, {100, 0}, {100, 100}});
  f.floor_m = 100;
  f.ceiling_m = 50;
  CHECK(refusal(f).find("fence.floor_m: flight.fence_floor_high(100, 50)") == 0);
  f = fence_of({{0, 0}, {100, 0}, {100, 100}});
  f.corners[1].lat_deg = 40;
  f.corners[1].lon_deg = 10;
  CHECK(refusal(f).find("fence.corners[1]: flight.place_given_twice") == 0);
  f.corners[1] = {};
  CHECK(refusal(f).find("fence.corners[1]: flight.place_missing") == 0);
  f.corners[1].lat_deg = 40;
  f.corners[1].lon_deg = 10;
  CHECK(refusal(f).find("fence.corners[1]: flight.origin_missing") == 0);
}

TEST_CASE("latitude and longitude are metres from the origin") {
  // Length of a degree at 40 deg: 111132.95 - 559.85 cos 2 phi + 1.175 cos 4 phi, and 111412.88 cos phi
  // - 93.5 cos 3 phi (Snyder, Map Projections, 1987), at sea level.
  Origin origin;
  origin.lat_deg = 40;
  origin.lon_deg = -111;
  origin.given = true;
  FencePoint p;
  p.lat_deg = 40.001;
  p.lon_deg = -110.998;
  const Spot at = spot_of(p, origin, "it");
  const double phi = 40 * kit::deg;
  CHECK(at.north_m == doctest::Approx(111.13295 - 0.55985 * std::cos(2 * phi)).epsilon(0.0005));
  CHECK(at.east_m ==
        doctest::Approx(2 * (111.41288 * std::cos(phi) - 0.0935 * std::cos(3 * phi))).epsilon(0.0005));
}

TEST_CASE("in still air the turn back takes the reaction's way and the radius Vg^2 / (g tan phi)") {
  const Polygon wide = polygon({{500, -2000}, {500, 2000}, {-2000, 2000}, {-2000, -2000}});
  const double R = 20 * 20 / (9.80665 * std::tan(0.5));
  const Spot home{-1000, 0, 0};
  for (const double side : {-1.0, 1.0}) {
    CHECK(room_of_turn(wide, flying(300, 0, 0), home, side) == doctest::Approx(200 - 20 - R).epsilon(0.01));
    // 60 deg to the side: 60 deg of turn towards it, 120 the other way
    const double off = side * 60 * kit::deg;
    CHECK(room_of_turn(wide, flying(300, 0, off), home, side) ==
          doctest::Approx(200 - 20 * 0.5 - R * (1 - std::sin(60 * kit::deg))).epsilon(0.01));
    CHECK(room_of_turn(wide, flying(300, 0, off), home, -side) ==
          doctest::Approx(200 - 20 * 0.5 - R * (1 + std::sin(60 * kit::deg))).epsilon(0.01));
  }
  const Polygon east = polygon({{2000, 500}, {-2000, 500}, {-2000, -2000}, {2000, -2000}});
  CHECK(room_of_turn(east, flying(0, 300, 90 * kit::deg), {0, -1000, 0}, 1) ==
        doctest::Approx(200 - 20 - R).epsilon(0.01));
}

TEST_CASE("with the wind behind it takes as much more as a fine integration of the turn says") {
  const Polygon wide = polygon({{500, -2000}, {500, 2000}, {-2000, 2000}, {-2000, -2000}});
  for (const double wind : {8.0, -8.0}) {
    TurnBack t = flying(200, 0, 0, 20 + wind);
    t.w_north_mps = wind;
    double n = 200 + (20 + wind) * 1, most = n, psi = 0;
    const double omega = 9.80665 * std::tan(0.5) / 20;
    for (double now = 0; now < std::numbers::pi / omega; now += 1e-3) {
      psi += omega * 1e-3;
      n += (20 * std::cos(psi) + wind) * 1e-3;
      most = std::max(most, n);
    }
    CHECK(room_of_turn(wide, t, {-1000, 0, 0}, 1) == doctest::Approx(500 - most).epsilon(0.01));
  }
}

TEST_CASE("the turn ends when the track over the ground points home, not the nose") {
  const Polygon wide = polygon({{2000, 200}, {-2000, 200}, {-2000, -2000}, {2000, -2000}});
  TurnBack t = flying(0, 100, 0, 20);
  t.v_east_mps = t.w_east_mps = 10;  // the nose is north
  const Spot home{10000, 10100, 0};
  double e = 100 + 10, psi = 0;
  const double omega = 9.80665 * std::tan(0.5) / 20;
  while (std::atan2(20 * std::sin(psi) + 10, 20 * std::cos(psi)) < 45 * kit::deg) {
    psi += omega * 1e-3;
    e += (20 * std::sin(psi) + 10) * 1e-3;
  }
  CHECK(std::abs(room_of_turn(wide, t, home, 1) - (200 - e)) < 8);
}

TEST_CASE("the short turn is taken as long as it leaves room, the other one when it does not") {
  const Polygon lane = polygon({{2000, -200}, {2000, 40}, {-2000, 40}, {-2000, -200}});
  const Spot home{-1000, 30, 0};  // behind, to the right: the short turn crosses the near side
  const WayBack way = way_back(lane, flying(0, 0, 0), home, 20);
  CHECK(way.side == -1);
  CHECK(way.room_m > 20);
  CHECK(way_back(lane, flying(0, -120, 0), home, 20).side == 1);
}

TEST_CASE("a place that is named twice is refused, one that lies a metre off is another") {
  Places places;
  const auto refused = [&](double north, double east) {
    places.places.clear();
    places.places.push_back({9, 0});
    places.places.push_back({0, 0});
    places.places.push_back({north, east});
    try {
      return std::to_string(places_of(places, {}).size());
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
  };
  CHECK(refused(9.5, 0.5) == "places.places[2]: flight.places_equal(0)");
  CHECK(refused(9, 1.1) == "3");
  CHECK(refused(9, -1.1) == "3");
  CHECK(refused(0, 0) == "places.places[2]: flight.places_equal(1)");
}

TEST_CASE("height: what the reaction and the pull-out take") {
  CHECK(room_of_height(100, 0, 20, 150, 2, 1) == doctest::Approx(50));
  CHECK(room_of_height(100, 4, 20, 150, 2, 1) == doctest::Approx(50 - 4 - 4));
  CHECK(room_of_height(40, -4, 20, 150, 2, 1) == doctest::Approx(20 - 4 - 4));
  CHECK(room_of_height(40, 4, 20, 150, 2, 1) == doctest::Approx(20));
}

}  // namespace fence_test
