// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace fulmar::core::test {

inline constexpr double pi = 3.14159265358979323846;

/// The hourglass at another height, with the fillets of the planner.
class Hourglass {
 public:
  Hourglass() {
    constexpr std::array<std::array<double, 2>, 4> corner{
        {{400, -250}, {-400, -50}, {-400, -250}, {400, -50}}};
    for (std::size_t i = 0; i < 4; ++i)
      leg(corner[(i + 3) % 4], corner[i], corner[(i + 1) % 4], corner[(i + 2) % 4]);
  }
  double distance_m(double north, double east) const {
    double least = 1e9;
    for (const auto& p : points_) least = std::min(least, std::hypot(north - p[0], east - p[1]));
    return least;
  }
  static std::string text(double height_m) {
    std::string plan = "name: hourglass\nend: circuit\nairspeed: 17 m/s\nturn_radius: 50 m\nwaypoints:\n";
    for (const char* at : {"north: 400 m, east: -250 m", "north: -400 m, east: -50 m",
                           "north: -400 m, east: -250 m", "north: 400 m, east: -50 m"})
      plan += std::string("  - {") + at + ", up: " + std::to_string(height_m) + " m}\n";
    return plan;
  }

 private:
  using Point = std::array<double, 2>;
  static constexpr double radius_m = 50;
  struct Corner {
    Point in, out, centre;  ///< start and end of the arc
  };
  static Corner fillet(const Point& a, const Point& b, const Point& c) {
    const auto towards = [&b](const Point& p) {
      const double n = p[0] - b[0], e = p[1] - b[1], l = std::hypot(n, e);
      return Point{n / l, e / l};
    };
    const Point u = towards(a), v = towards(c);
    const double half = 0.5 * std::acos(u[0] * v[0] + u[1] * v[1]), along = radius_m / std::tan(half);
    const double m = std::hypot(u[0] + v[0], u[1] + v[1]), d = radius_m / std::sin(half);
    return {{b[0] + along * u[0], b[1] + along * u[1]},
            {b[0] + along * v[0], b[1] + along * v[1]},
            {b[0] + d * (u[0] + v[0]) / m, b[1] + d * (u[1] + v[1]) / m}};
  }
  /// The straight from b to c, and the arc at c.
  void leg(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Corner from = fillet(a, b, c), to = fillet(b, c, d);
    const double length = std::hypot(to.in[0] - from.out[0], to.in[1] - from.out[1]);
    for (double s = 0; s < length; s += 1)
      points_.push_back({from.out[0] + s / length * (to.in[0] - from.out[0]),
                         from.out[1] + s / length * (to.in[1] - from.out[1])});
    const double begin = std::atan2(to.in[1] - to.centre[1], to.in[0] - to.centre[0]),
                 end = std::atan2(to.out[1] - to.centre[1], to.out[0] - to.centre[0]);
    const double turn = std::remainder(end - begin, 2 * pi);
    for (double s = 0; s < 1; s += 0.01)
      points_.push_back({to.centre[0] + radius_m * std::cos(begin + s * turn),
                         to.centre[1] + radius_m * std::sin(begin + s * turn)});
  }
  std::vector<Point> points_;
};

}  // namespace fulmar::core::test
