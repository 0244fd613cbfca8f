// SPDX-License-Identifier: BSD-3-Clause
// The search against geometry and the wind triangle.
#include "rrt_star.hpp"

#include <doctest/doctest.h>

namespace rrt_star_test {

using namespace fulmar;
using namespace fulmar::slow_planner;

namespace {

Search search_of(std::initializer_list<Zone> zones, std::int64_t samples) {
  Search s;
  for (const Zone& z : zones) s.zones.zones.push_back(z);
  s.keep_off_m = 10;
  s.samples = samples;
  return s;
}

double min_clearance(const Search& s, const std::vector<Point>& way) {
  double least = 1e9;
  for (std::size_t i = 1; i < way.size(); ++i)
    least = std::min(least, clearance(s.zones, way[i - 1], way[i]));
  return least;
}

}  // namespace

TEST_CASE("distances of lines from points and rims") {
  CHECK(line_distance({0, 0}, {100, 0}, {50, 30}) == doctest::Approx(30));
  CHECK(line_distance({0, 0}, {100, 0}, {130, 40}) == doctest::Approx(50));
  CHECK(line_distance({7, 7}, {7, 7}, {10, 11}) == doctest::Approx(5));
  const Search s = search_of({{50, 30, 10}, {50, -300, 100}}, 0);
  CHECK(clearance(s.zones, {0, 0}, {100, 0}) == doctest::Approx(20));
  CHECK(clearance(Zones{}, {0, 0}, {1, 0}) == unknown_std);
}

TEST_CASE("time of flight follows the wind triangle") {
  Search s;
  s.airspeed_mps = 15;
  CHECK(flight_time(s, {0, 0}, {0, 300}) == doctest::Approx(20));
  s.wind_east_mps = 9;                                               // 15, 9, 12
  CHECK(flight_time(s, {0, 0}, {1200, 0}) == doctest::Approx(100));  // across
  CHECK(flight_time(s, {0, 0}, {0, 240}) == doctest::Approx(10));    // with it
  CHECK(flight_time(s, {0, 0}, {0, -60}) == doctest::Approx(10));    // against it
  s.wind_east_mps = 16;
  CHECK(std::isinf(flight_time(s, {0, 0}, {1200, 0})));
  CHECK(std::isinf(flight_time(s, {0, 0}, {0, -60})));
}

TEST_CASE("the way round one zone is within two percent of tangent, arc, tangent") {
  const Search s = search_of({{0, 0, 90}}, 2000);  // clearance 10 m: a circle of 100 m
  Random random(1);
  const std::vector<Point> way = RrtStar(s, {-300, 0}, {300, 0}, random).run();
  REQUIRE(way.size() > 2);
  CHECK(min_clearance(s, way) >= 10);
  const double shortest =
      2 * std::sqrt(300.0 * 300 - 100.0 * 100) + 100 * (std::numbers::pi - 2 * std::acos(100.0 / 300));
  CHECK(flight_time(s, way) * 15 > shortest);
  CHECK(flight_time(s, way) * 15 < 1.02 * shortest);
}

TEST_CASE("of two gaps the nearer one is taken, and a way between many zones keeps clear of all") {
  const Search s = search_of({{0, -150, 120}, {0, 130, 120}, {200, -20, 40}, {-200, 30, 40}},
                             3000);  // a gap of 40 m at east -10
  Random random(2);
  const std::vector<Point> way = RrtStar(s, {-500, 0}, {500, 0}, random).run();
  REQUIRE(way.size() > 2);
  CHECK(min_clearance(s, way) >= 10);
  double sideways = 0;
  for (const Point& p : way) sideways = std::max(sideways, std::abs(p.east_m));
  CHECK(sideways < 150);  // not around the outside
}

TEST_CASE("where there is no way none is found") {
  const Search s = search_of({{0, 0, 90}}, 500);
  Random random(1);
  CHECK(RrtStar(s, {-300, 0}, {20, 0}, random).run().empty());
}

TEST_CASE("the same random numbers give the same way") {
  const Search s = search_of({{0, 0, 90}}, 1000);
  const auto run = [&](std::uint64_t seed) {
    Random random(seed);
    return RrtStar(s, {-300, 0}, {300, 0}, random).run();
  };
  const auto a = run(4), b = run(4), c = run(5);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK((a[i].north_m == b[i].north_m && a[i].east_m == b[i].east_m));
  CHECK((a.size() != c.size() || a[1].north_m != c[1].north_m));
}

}  // namespace rrt_star_test
