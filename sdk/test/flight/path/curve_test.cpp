// SPDX-License-Identifier: BSD-3-Clause
// A curve against de Casteljau's construction, dense samples and finite differences.
#include "fulmar/flight/path/curve.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "fulmar/flight/math/angles.hpp"
#include "fulmar/random.hpp"

namespace curve_test {

using namespace fulmar;
using doctest::Approx;

namespace {

const Curve bend{{Vec3<Ned>{0, 0, -70}, {100, 10, -70}, {180, 90, -80}, {190, 200, -90}}};

Vec3<Ned> halfway(const Vec3<Ned>& a, const Vec3<Ned>& b, double u) { return a + u * (b - a); }
Vec3<Ned> de_casteljau(const Curve& c, double u) {
  const auto a = halfway(c.p[0], c.p[1], u), b = halfway(c.p[1], c.p[2], u), d = halfway(c.p[2], c.p[3], u);
  return halfway(halfway(a, b, u), halfway(b, d, u), u);
}

}  // namespace

TEST_CASE("a point of a curve is that of de Casteljau's construction, slope and bend are its differences") {
  constexpr double h = 1e-4;
  for (const double u : {0.0, 0.13, 0.5, 0.86, 1.0}) {
    CAPTURE(u);
    const Vec3<Ned> at = bend.point(u), want = de_casteljau(bend, u);
    CHECK(std::hypot(at.north - want.north, at.east - want.east, at.down - want.down) < 1e-9);
    const Vec3<Ned> before = de_casteljau(bend, u - h), after = de_casteljau(bend, u + h);
    const Vec3<Ned> slope = (1 / (2 * h)) * (after - before),
                    second = (1 / (h * h)) * ((after - want) - (want - before));
    CHECK(std::hypot(bend.slope(u).north - slope.north, bend.slope(u).east - slope.east) < 1e-4);
    CHECK(std::abs(bend.slope(u).down - slope.down) < 1e-4);
    CHECK(std::hypot(bend.bend(u).north - second.north, bend.bend(u).east - second.east) < 1e-3);
  }
}

TEST_CASE("curvature is the change of course per metre, right positive, and length the sum of chords") {
  constexpr double du = 1e-4;
  for (const double u : {0.1, 0.4, 0.7, 0.95}) {
    const double dchi = angle_difference(bend.course_rad(u + du), bend.course_rad(u - du));
    CHECK(bend.curvature(u) / (dchi / (2 * du * bend.speed(u))) == Approx(1).epsilon(1e-5));
  }
  CHECK(bend.curvature(0.5) > 0);  // from north to east
  Curve left = bend;
  for (auto& p : left.p) p.east = -p.east;
  CHECK(left.curvature(0.5) == Approx(-bend.curvature(0.5)).scale(0));
  double length = 0, part = 0;
  constexpr int chords = 20000;
  for (int i = 0; i < chords; ++i) {
    const auto a = de_casteljau(bend, static_cast<double>(i) / chords),
               b = de_casteljau(bend, (i + 1.0) / chords);
    length += std::hypot(b.north - a.north, b.east - a.east);
    if (i >= chords / 4) part += std::hypot(b.north - a.north, b.east - a.east);
  }
  CHECK(bend.length_m() / length == Approx(1).epsilon(1e-7));
  CHECK(bend.length_m(0.25, 1) / part == Approx(1).epsilon(1e-7));
}

TEST_CASE("the closest point of a curve is that of a dense search") {
  Random random(5);
  for (int k = 0; k < 60; ++k) {
    const double north = random.uniform(-100, 300), east = random.uniform(-100, 300);
    double least = 1e9;
    for (int i = 0; i <= 100000; ++i) {
      const auto at = de_casteljau(bend, i / 1e5);
      least = std::min(least, std::hypot(at.north - north, at.east - east));
    }
    const auto at = bend.point(bend.closest(north, east));
    CHECK(std::abs(std::hypot(at.north - north, at.east - east) - least) < 1e-5);
  }
}

TEST_CASE("a Hermite curve has its ends and its slopes, and a coinciding handle no nan") {
  const Vec3<Ned> a{10, 20, -50}, ta{60, 0, -3}, b{100, 80, -60}, tb{0, 90, 6};
  const Curve c = Curve::hermite(a, ta, b, tb);
  CHECK(c.point(0) == a);
  CHECK(c.point(1) == b);
  CHECK(c.slope(0).north == Approx(60));
  CHECK(c.slope(1).east == Approx(90));
  CHECK(c.climb_ratio(0) / 0.05 == Approx(1));
  CHECK(c.climb_ratio(1) / (-6.0 / 90) == Approx(1));
  const Curve cusp{{a, a, b, b}}, dot{{a, a, a, a}};
  CHECK(cusp.course_rad(0) == Approx(std::atan2(60, 90)));
  CHECK(std::isfinite(cusp.curvature(0)));
  CHECK(std::isfinite(dot.course_rad(0.5)));
  CHECK(dot.length_m() == 0);
}

TEST_CASE("a curve is published beside the circle that touches it, for those who know circles alone") {
  for (const double mirror : {1.0, -1.0}) {
    Curve c = bend;
    for (auto& p : c.p) p.east *= mirror;
    const double u = 0.6;
    Path path;
    set_curve(path, c, u);
    CHECK(path.is_curve);
    REQUIRE(path.kind == PathKind::orbit);
    CHECK(path.turn == (mirror > 0 ? Turn::right : Turn::left));
    for (const double v : {u - 0.002, u, u + 0.002}) {  // third order: a small deviation from the curve
      const auto at = c.point(v);
      CHECK(std::hypot(at.north - path.origin_m.north, at.east - path.origin_m.east) / path.radius_m ==
            Approx(1).epsilon(1e-6));
    }
    const auto at = c.point(u);
    CHECK(std::abs(wrap_pi(std::atan2(at.east - path.origin_m.east, at.north - path.origin_m.north) -
                           path.start_rad)) < 1e-9);
    CHECK(path.origin_m.down == Approx(at.down));
  }
  const Curve straight{{Vec3<Ned>{0, 0, -70}, {0, 50, -75}, {0, 100, -80}, {0, 150, -85}}};
  Path path;
  set_curve(path, straight, 0.5);
  CHECK(path.kind == PathKind::line);
  CHECK(path.direction_ratio.east / std::cos(0.1) == Approx(1).epsilon(1e-3));
  CHECK(path.direction_ratio.down < 0);
  CHECK(path.remaining_m == Approx(75));
}

}  // namespace curve_test
