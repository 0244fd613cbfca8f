// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/envelope.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/fulmar_aero/flight_model.hpp"

namespace fulmar::aero {
namespace {

/// Straight flight with the propeller speed at this throttle. Newton's method finds angle of attack, elevator
/// and flight path angle for zero acceleration along x, z and in pitch. `fly` has the thrust as an unknown;
/// but a braking propeller has one thrust at two speeds, and only this one is possible.
double rate_at_throttle(const AircraftModel& m, double airspeed, double throttle) {
  const Airframe& a = m.airframe();
  const double Omega = m.propeller().steady_speed(throttle, airspeed, detail::density_of(m));
  const auto left = [&](const Eigen::Vector3d& z) -> Eigen::Vector3d {
    model::StateVector<double> x = model::StateVector<double>::Zero();
    x.segment<3>(model::u) = air_velocity<double>(airspeed, z[0], 0);
    x(model::pitch) = z[0] + z[2];
    const model::StateVector<double> rate = m.rate_at<double>(x, {0, z[1], 0, m.flap_rad()}, Omega);
    return {rate(model::u), rate(model::w), rate(model::q)};
  };
  const detail::SteadyEquations::Vector<double> level = detail::steady_guess(m, {.airspeed_mps = airspeed});
  Eigen::Vector3d z(level(detail::SteadyEquations::alpha), level(detail::SteadyEquations::elevator), 0);
  Eigen::Vector3d r = left(z);
  for (int i = 0; i < 60 && r.norm() > 1e-9; ++i) {
    Eigen::Matrix3d J;
    for (int k = 0; k < 3; ++k) J.col(k) = (left(z + 1e-6 * Eigen::Vector3d::Unit(k)) - r) / 1e-6;
    const Eigen::Vector3d step = J.inverse() * r;
    if (!step.allFinite()) break;
    z -= step * std::min(1.0, 0.2 / step.norm());
    r = left(z);
  }
  const bool flown = r.norm() <= 1e-9 && std::abs(z[0]) <= a.wing.stall_alpha_rad &&
                     std::abs(z[1]) <= a.elevator.limit_rad && std::abs(z[2]) < 0.5 * std::numbers::pi;
  return flown ? airspeed * std::sin(z[2]) : std::nan("");
}

}  // namespace

double stall_speed(const AircraftModel& m) {
  const Airframe& a = m.airframe();
  const double CL = max_lift(a).coefficient;
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

double climb_rate(const AircraftModel& m, double airspeed) { return rate_at_throttle(m, airspeed, 1); }
double glide_rate(const AircraftModel& m, double airspeed) { return rate_at_throttle(m, airspeed, 0); }

}  // namespace fulmar::aero
