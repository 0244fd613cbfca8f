// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/envelope.hpp"

#include <cmath>

#include "tools/fulmar_aero/flight_model.hpp"

namespace fulmar::aero {
namespace {

double rate_at_limit(const AircraftModel& m, double airspeed, TrimLimit wanted) {
  constexpr double step = 0.05, steepest = 1.2;
  const double way = wanted == TrimLimit::throttle_high ? step : -step;
  const auto limit = [&](double climb) {
    return fly(m, {.airspeed_mps = airspeed, .climb_rad = climb}).limit;
  };
  // from level flight, or from the first descent (climb) that there is where level flight takes more than
  // that
  double inside = 0;
  while (limit(inside) == wanted && std::abs(inside) < steepest) inside -= way;
  if (limit(inside) != TrimLimit::none) return std::nan("");
  double outside = inside + way;
  TrimLimit at = limit(outside);
  while (at == TrimLimit::none && std::abs(outside) < steepest) {
    inside = outside;
    outside += way;
    at = limit(outside);
  }
  if (at != wanted) return std::nan("");
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (inside + outside);
    (limit(middle) == TrimLimit::none ? inside : outside) = middle;
  }
  return airspeed * std::sin(inside);
}

}  // namespace

double stall_speed(const AircraftModel& m) {
  const Airframe& a = m.airframe();
  const double CL = most_lift(a).coefficient;
  return CL > 0 ? std::sqrt(2 * a.mass_kg * isa::g0 / (detail::density_of(m) * a.wing.area_m2 * CL)) : 0;
}

LevelSpeeds level_speeds(const AircraftModel& m, double inside) {
  const auto end = [&](double found, double missing, TrimLimit& why) {
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (found + missing);
      const TrimLimit limit = fly(m, {middle}).limit;
      if (limit != TrimLimit::none) why = limit;
      (limit == TrimLimit::none ? found : missing) = middle;
    }
    return found;
  };
  LevelSpeeds speeds;
  speeds.slowest_mps = end(inside, 0.3 * inside, speeds.below);
  speeds.fastest_mps = end(inside, 4 * inside, speeds.above);
  return speeds;
}

double climb_rate(const AircraftModel& m, double airspeed) {
  return rate_at_limit(m, airspeed, TrimLimit::throttle_high);
}
double glide_rate(const AircraftModel& m, double airspeed) {
  return rate_at_limit(m, airspeed, TrimLimit::throttle_low);
}

}  // namespace fulmar::aero
