// SPDX-License-Identifier: BSD-3-Clause
// Dubins paths against closed forms, against numerical integration, and against the solutions of an
// independent implementation if available.
#include "fulmar/flight/path/dubins.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "fulmar/random.hpp"

namespace dubins_test {

using namespace fulmar;

namespace {

constexpr double pi = std::numbers::pi;

/// Integrates the word in small steps of the unicycle model, independent of circle geometry.
Pose integrate(Pose pose, const DubinsPath& path, double radius_m) {
  constexpr int steps = 4000;
  for (int part = 0; part < 3; ++part) {
    const double ds = path.parts[static_cast<std::size_t>(part)] * radius_m / steps;
    const double kappa = dubins_turn(path.word, part) / radius_m;
    for (int i = 0; i < steps; ++i) {
      const double middle = pose.course_rad + kappa * ds / 2;
      pose = {pose.north_m + ds * std::cos(middle), pose.east_m + ds * std::sin(middle),
              pose.course_rad + kappa * ds};
    }
  }
  return pose;
}

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

DubinsWord mirrored(DubinsWord word) {
  switch (word) {
    case DubinsWord::rsr: return DubinsWord::lsl;
    case DubinsWord::rsl: return DubinsWord::lsr;
    case DubinsWord::lsr: return DubinsWord::rsl;
    case DubinsWord::lsl: return DubinsWord::rsr;
    case DubinsWord::rlr: return DubinsWord::lrl;
    default: return DubinsWord::rlr;
  }
}

DubinsWord word_of(const std::string& text) {
  static const std::array<std::string, 6> names{"RSR", "RSL", "LSR", "LSL", "RLR", "LRL"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return dubins_words[i];
  }
  FAIL("unknown word " << text);
  return DubinsWord::rsr;
}

}  // namespace

TEST_CASE("a Dubins path straight ahead is a straight line") {
  const DubinsPath path =
      dubins({10, 20, 0.3}, {10 + 500 * std::cos(0.3), 20 + 500 * std::sin(0.3), 0.3}, 50);
  CHECK(path.length() * 50 == doctest::Approx(500));
  CHECK(path.parts[0] + path.parts[2] < 1e-6);
}

TEST_CASE("a Dubins path to the same pose has no length") {
  CHECK(dubins({1, 2, 3}, {1, 2, 3}, 50).length() < 1e-6);
}

TEST_CASE("a U-turn onto a parallel course two radii to the right is a half circle") {
  const DubinsPath path = dubins({0, 0, 0}, {0, 100, pi}, 50);
  CHECK(path.length() == doctest::Approx(pi));
  CHECK(path.word == DubinsWord::rsr);
}

TEST_CASE(
    "turning back over the same point takes seven sixths of a circle, the middle arc the long way round") {
  const DubinsPath path = dubins({0, 0, 0}, {0, 0, pi}, 50);
  CHECK(path.length() == doctest::Approx(7 * pi / 3));
  CHECK(path.parts[0] == doctest::Approx(pi / 3));
  CHECK(path.parts[1] == doctest::Approx(5 * pi / 3));
  CHECK(path.parts[2] == doctest::Approx(pi / 3));
}

TEST_CASE("every word that exists ends where it should when it is flown, and the best is the shortest") {
  Random rng(11);
  int words = 0;
  for (int i = 0; i < 300; ++i) {
    const double radius_m = 20 + 80 * rng.uniform(), reach = i % 2 == 0 ? 100 : 1000;
    const Pose from{reach * rng.normal(), reach * rng.normal(), 7 * rng.normal()},
        to{reach * rng.normal(), reach * rng.normal(), 7 * rng.normal()};
    const double n = to.north_m - from.north_m, e = to.east_m - from.east_m, theta = std::atan2(e, n);
    const DubinsPath best = dubins(from, to, radius_m);
    REQUIRE(best.exists);
    for (const DubinsWord word : dubins_words) {
      const DubinsPath path =
          dubins_word(word, from.course_rad - theta, to.course_rad - theta, std::hypot(n, e) / radius_m);
      if (!path.exists) continue;
      ++words;
      CHECK(best.length() <= path.length() + 1e-8);
      const Pose end = integrate(from, path, radius_m);
      CHECK(std::hypot(end.north_m - to.north_m, end.east_m - to.east_m) < 1e-3);
      CHECK(angle_between(end.course_rad, to.course_rad) < 1e-6);
    }
  }
  CHECK(words > 1000);
}

TEST_CASE("a Dubins path is as long mirrored and flown backwards") {
  Random rng(5);
  for (int i = 0; i < 500; ++i) {
    const Pose from{100 * rng.normal(), 100 * rng.normal(), 6 * rng.uniform()},
        to{100 * rng.normal(), 100 * rng.normal(), 6 * rng.uniform()};
    const double length = dubins(from, to, 50).length();
    const auto mirror = [](const Pose& p) { return Pose{p.north_m, -p.east_m, -p.course_rad}; };
    const auto reverse = [](const Pose& p) { return Pose{p.north_m, p.east_m, p.course_rad + pi}; };
    CHECK(dubins(mirror(from), mirror(to), 50).length() == doctest::Approx(length).epsilon(1e-9));
    CHECK(dubins(reverse(to), reverse(from), 50).length() == doctest::Approx(length).epsilon(1e-9));
  }
}

TEST_CASE("all six words agree with 216 solutions of an independent implementation") {
  std::ifstream file(FULMAR_REFERENCE_DATA "/dubins/dubins_words_reference.csv");
  if (!file) {
    MESSAGE("skipped: no " FULMAR_REFERENCE_DATA "/dubins/dubins_words_reference.csv");
    return;
  }
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream row(line);
    std::string name;
    double alpha = 0, beta = 0, d = 0, t = 0, p = 0, q = 0, total = 0;
    int fault = 0;
    row >> name >> alpha >> beta >> d >> fault >> t >> p >> q >> total;
    REQUIRE(static_cast<bool>(row));
    ++rows;
    // a left turn is positive there: mirror the word
    for (const bool mirror : {false, true}) {
      const DubinsWord word = mirror ? word_of(name) : mirrored(word_of(name));
      const DubinsPath path =
          mirror ? dubins_word(word, -alpha, -beta, d) : dubins_word(word, alpha, beta, d);
      CAPTURE(line);
      CHECK(path.exists == (fault == 0));
      if (fault != 0 || !path.exists) continue;
      CHECK(angle_between(path.parts[0], t) < 1e-9);
      CHECK(path.parts[1] == doctest::Approx(p).epsilon(1e-9));
      CHECK(angle_between(path.parts[2], q) < 1e-9);
      CHECK(path.length() == doctest::Approx(total).epsilon(1e-9));
    }
  }
  CHECK(rows == 216);
}

}  // namespace dubins_test
