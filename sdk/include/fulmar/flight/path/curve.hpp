// SPDX-License-Identifier: BSD-3-Clause
// A cubic Bezier curve as a piece of a path, horizontal with heights. Every cubic spline - Hermite,
// Catmull-Rom, B-spline - is a chain of these. Source: Farin, Curves and Surfaces for CAGD (2002), chapters 4
// and 5.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "fulmar/msg/path.hpp"

namespace fulmar {

/// One cubic Bezier curve p(u), u from 0 to 1, NED.
struct Curve {
  std::array<Vec3<Ned>, 4> p;  ///< begin, two handles, end, in metres

  /// Curve from `from` to `to`, with these derivatives by u at its ends, metres per unit of u.
  static Curve hermite(const Vec3<Ned>& from, const Vec3<Ned>& slope, const Vec3<Ned>& to,
                       const Vec3<Ned>& slope_to) {
    return {{from, from + (1.0 / 3) * slope, to - (1.0 / 3) * slope_to, to}};
  }

  /// Point at u, from 0 to 1, NED, m.
  Vec3<Ned> point(double u) const {
    const double v = 1 - u;
    return v * v * v * p[0] + 3 * v * v * u * p[1] + 3 * v * u * u * p[2] + u * u * u * p[3];
  }
  Vec3<Ned> slope(double u) const {  // dp/du
    const double v = 1 - u;
    return 3 * v * v * (p[1] - p[0]) + 6 * v * u * (p[2] - p[1]) + 3 * u * u * (p[3] - p[2]);
  }
  Vec3<Ned> bend(double u) const {  // d2p/du2
    return 6 * (1 - u) * (p[2] - 2 * p[1] + p[0]) + 6 * u * (p[3] - 2 * p[2] + p[1]);
  }
  /// Horizontal speed, metres per unit of u. It is 0 where a handle lies on its end.
  double speed(double u) const {
    const Vec3<Ned> d = slope(u);
    return std::hypot(d.north, d.east);
  }
  double course_rad(double u) const {
    Vec3<Ned> d = slope(u);
    if (std::hypot(d.north, d.east) < 1e-6) d = u < 0.5 ? p[2] - p[0] : p[3] - p[1];
    if (std::hypot(d.north, d.east) < 1e-6) d = p[3] - p[0];
    return std::atan2(d.east, d.north);
  }
  /// Curvature, 1/m, right positive, limited to +-1.
  double curvature(double u) const {
    const Vec3<Ned> d = slope(u), b = bend(u);
    const double v = std::hypot(d.north, d.east);
    if (v < 1e-6) return 0;
    return std::clamp((d.north * b.east - d.east * b.north) / (v * v * v), -1.0, 1.0);
  }
  /// Climb, metres up per metre along.
  double climb_ratio(double u) const {
    const double v = speed(u);
    return v < 1e-6 ? 0 : std::clamp(-slope(u).down / v, -1.0, 1.0);
  }
  /// Horizontal length between two u, m. Gauss-Legendre, five points in each of eight parts.
  double length_m(double from = 0, double to = 1) const {
    constexpr std::array<double, 5> at{0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                       -0.9061798459386640},
        weight{0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
               0.2369268850561891};
    constexpr int parts = 8;
    const double half = (to - from) / (2 * parts);
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      for (std::size_t k = 0; k < at.size(); ++k)
        sum += half * weight[k] * speed(from + half * (2 * i + 1 + at[k]));
    return sum;
  }
  /// u of the closest point, horizontally: the best of 33 points, then bisection between its neighbours to
  /// less than a millionth of the curve.
  double closest(double north_m, double east_m) const {
    constexpr int places = 32;
    const auto square = [&](double u) {
      const Vec3<Ned> at = point(u);
      return (at.north - north_m) * (at.north - north_m) + (at.east - east_m) * (at.east - east_m);
    };
    int best = 0;
    double least = square(0);
    for (int i = 1; i <= places; ++i) {
      const double d = square(static_cast<double>(i) / places);
      if (d < least) {
        least = d;
        best = i;
      }
    }
    double from = std::max(best - 1, 0) / double{places}, to = std::min(best + 1, places) / double{places};
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < 40; ++i) {
      const double a = to - golden * (to - from), b = from + golden * (to - from);
      if (square(a) < square(b))
        to = b;
      else
        from = a;
    }
    return (from + to) / 2;
  }
};

/// The curve of a path whose `is_curve` is set.
inline Curve curve_of(const Path& path) { return {path.control_m}; }

/// Publishes a curve for an aircraft whose closest point is `u`. Readers without curves get the osculating
/// line or orbit at that point.
inline void set_curve(Path& path, const Curve& curve, double u) {
  const Vec3<Ned> at = curve.point(u);
  const double chi = curve.course_rad(u), kappa = curve.curvature(u), climb = curve.climb_ratio(u);
  path.is_curve = true;
  path.control_m = curve.p;
  path.remaining_m = curve.length_m(u, 1);
  if (std::abs(kappa) < 1e-5) {
    const double norm = 1 / std::sqrt(1 + climb * climb);
    path.kind = PathKind::line;
    path.origin_m = at;
    path.direction_ratio = {std::cos(chi) * norm, std::sin(chi) * norm, -climb * norm};
    path.climb_ratio = 0;
    return;
  }
  const double side = kappa > 0 ? 1 : -1, R = 1 / std::abs(kappa);
  path.kind = PathKind::orbit;
  path.turn = kappa > 0 ? Turn::right : Turn::left;
  path.radius_m = R;
  path.start_rad = std::atan2(-side * std::cos(chi), side * std::sin(chi));  // normal to the course
  path.origin_m = {at.north - R * std::cos(path.start_rad), at.east - R * std::sin(path.start_rad), at.down};
  path.climb_ratio = climb;
}

}  // namespace fulmar
