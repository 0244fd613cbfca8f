// SPDX-License-Identifier: BSD-3-Clause
// Dubins paths: the shortest path of bounded curvature between two poses, for all six words. Sources: Dubins
// (1957); Shkel & Lumelsky, "Classification of the Dubins set" (2001); Beard & McLain, section 11.2 for the
// centres.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace fulmar {

/// Horizontal position and course. Course is clockwise from north, so that a right turn is positive.
struct Pose {
  double north_m = 0, east_m = 0, course_rad = 0;
};

/// Right, straight and left parts in their order: "rsl" is right, straight, left.
enum class DubinsWord : std::uint8_t { rsr, rsl, lsr, lsl, rlr, lrl };
inline constexpr std::array dubins_words{DubinsWord::rsr, DubinsWord::rsl, DubinsWord::lsr,
                                         DubinsWord::lsl, DubinsWord::rlr, DubinsWord::lrl};

/// Three parts in units of the turn radius: arcs in radians, the straight part in radii.
struct DubinsPath {
  DubinsWord word = DubinsWord::rsr;
  bool exists = false;
  std::array<double, 3> parts{};
  double length() const { return parts[0] + parts[1] + parts[2]; }
};

/// Curvature sign of a word's part: +1 right, -1 left, 0 straight.
constexpr int dubins_turn(DubinsWord word, int part) {
  constexpr std::array<std::array<int, 3>, 6> turns{
      {{1, 0, 1}, {1, 0, -1}, {-1, 0, 1}, {-1, 0, -1}, {1, -1, 1}, {-1, 1, -1}}};
  return turns[static_cast<std::size_t>(word)][static_cast<std::size_t>(part)];
}

/// Angle in [0, 2 pi). A value within rounding of a full turn is 0: otherwise a straight path would start
/// with a loop.
inline double positive_angle(double angle_rad) {
  constexpr double full = 2 * std::numbers::pi;
  const double a = angle_rad - full * std::floor(angle_rad / full);
  return a > full - 1e-9 ? 0 : a;
}

/// One word of the normalised problem: from (0, 0) with course `alpha` to (d, 0) with course `beta`, turn
/// radius 1.
inline DubinsPath dubins_word(DubinsWord word, double alpha, double beta, double d) {
  const int first = dubins_turn(word, 0), last = dubins_turn(word, 2);
  // centres lie a radius to the right (+) or left (-) of the poses: B&M (11.5), (11.6)
  const double n = d - last * std::sin(beta) + first * std::sin(alpha);
  const double e = last * std::cos(beta) - first * std::cos(alpha);
  const double l = std::hypot(n, e);
  DubinsPath path{word, true, {}};
  if (dubins_turn(word, 1) !=
      0) {  // the middle circle touches both; it exists while they are at most two diameters apart
    path.exists = l <= 4;
    if (!path.exists) return path;
    const double theta = l > 1e-9 ? std::atan2(e, n) : alpha;
    const double gamma = std::acos(l / 4);
    const double course_1 =
        theta +
        first * (gamma + std::numbers::pi / 2);  // point where the first circle touches the middle one
    const double middle =
        std::numbers::pi + 2 * gamma;  // the longer direction: the shorter one is never optimal
    path.parts = {positive_angle(first * (course_1 - alpha)), middle,
                  positive_angle(first * (beta - course_1) + middle)};
    return path;
  }
  double straight = l;
  double course = l > 1e-9 ? std::atan2(e, n) : alpha;
  if (first != last) {  // inner tangent
    const double p2 = l * l - 4;
    path.exists = p2 >= 0;
    if (!path.exists) return path;
    straight = std::sqrt(p2);
    course += first * std::atan2(2, straight);
  }
  path.parts = {positive_angle(first * (course - alpha)), straight, positive_angle(last * (beta - course))};
  return path;
}

/// The shortest of the six words; one always exists. Of words with equal length within rounding, the first
/// one.
inline DubinsPath dubins(const Pose& from, const Pose& to, double radius_m) {
  const double n = to.north_m - from.north_m, e = to.east_m - from.east_m;
  const double theta = std::atan2(e, n);
  const double alpha = from.course_rad - theta, beta = to.course_rad - theta, d = std::hypot(n, e) / radius_m;
  DubinsPath best;
  for (const DubinsWord word : dubins_words) {
    const DubinsPath path = dubins_word(word, alpha, beta, d);
    if (path.exists && (!best.exists || path.length() < best.length() - 1e-9)) best = path;
  }
  return best;
}

}  // namespace fulmar
