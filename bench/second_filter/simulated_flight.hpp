// SPDX-License-Identifier: BSD-3-Clause
// For tests: a filter whose slow states are known as after some minutes of flight, and a flight whose errors
// are those of its model.
#pragma once
#include <cmath>
#include <tuple>

#include "bench/second_filter/measurements.hpp"
#include "fulmar/random.hpp"

namespace fulmar::second_filter::simulated {

inline constexpr double g = 9.80665, density = 1.2;

inline Vector3d normal(Random& r) { return {r.normal(), r.normal(), r.normal()}; }

inline Filter filter_at(const Nominal& n) {
  Filter f;
  for (const Block& b : {Block{.first = wind, .count = 2, .std = 0.5, .walk = 0.01},
                         {.first = gust, .count = 2, .std = 0.5, .time_s = 15},
                         {.first = fix_pos, .count = 3, .std = 2, .time_s = 150},
                         {.first = fix_vel, .count = 3, .std = 0.1, .time_s = 2},
                         {.first = baro_bias, .count = 1, .std = 1, .walk = 0.06},
                         {.first = tube_scale, .count = 1, .std = 0.01}})
    f.add_block(b);
  Eigen::Matrix<double, 15, 1> std;
  std << Vector3d::Constant(0.01), Vector3d::Constant(0.2), Vector3d::Constant(1), Vector3d::Constant(1e-3),
      Vector3d::Constant(0.02);
  f.reset(n, std, 0);
  return f;
}

/// Coordinated flight at 20 m/s through air at rest: straight, or with turns and climbs.
struct Path {
  bool turns = false;

  Vector3d v_n(double t) const {
    const double yaw = turns ? 1.2 * std::sin(0.5 * t) : 0, climb = turns ? 0.15 * std::sin(0.7 * t) : 0;
    return 20 * Vector3d(std::cos(climb) * std::cos(yaw), std::cos(climb) * std::sin(yaw), -std::sin(climb));
  }
  Vector3d a_n(double t) const { return (v_n(t + 1e-4) - v_n(t - 1e-4)) / 2e-4; }
  /// The nose along the velocity, no specific force along the wing.
  Matrix3d R_nb(double t) const {
    Matrix3d R;
    R.col(0) = v_n(t).normalized();
    R.col(1) = -R.col(0).cross(a_n(t) - Vector3d(0, 0, g)).normalized();
    R.col(2) = R.col(0).cross(R.col(1));
    return R;
  }
  Vector3d rate_b(double t) const {
    return log_map(Quaterniond(Matrix3d(R_nb(t - 1e-3).transpose() * R_nb(t + 1e-3)))) / 2e-3;
  }
  Vector3d force_b(double t) const { return R_nb(t).transpose() * (a_n(t) - Vector3d(0, 0, g)); }
};

/// Measurements at 10 Hz, an inertial unit at 50 Hz; one without turns at 10 Hz.
struct Flight {
  Random r;
  Path path;
  Nominal truth;
  Filter f;
  double outlier_m = 0;                   ///< of the next barometer sample
  bool judge_unit = true;                 ///< see Filter::find_fault
  Vector3d accel_off = Vector3d::Zero();  ///< m/s2, body: jump of the accelerometers
  double time_s = 0;

  explicit Flight(std::uint64_t seed, bool turns = false) : r(seed), path{turns} {
    truth.q_nb = Quaterniond(path.R_nb(0));
    truth.x.segment<3>(vel) = path.v_n(0);
    f = filter_at(truth);
    Vector dx;
    for (int i = 0; i < size; ++i) dx(i) = f.std(i) * r.normal();
    truth.x.tail<size - wind>() = dx.tail<size - wind>();
    dx.tail<size - wind>().setZero();
    f.restart(truth.plus(dx), 0);
    for (int i = wind; i < size; ++i) f.correct(i, -truth.x(i));
  }
  /// The wind carries the aircraft: its air velocity is that of the path minus the wind of the truth.
  void step() {
    constexpr double dt = 0.1, baro_std = 0.3, pitot_std = 0.2, fix_std = 0.1, place_std = 0.6;
    const int parts = path.turns ? 5 : 1;
    for (int k = 0; k < parts; ++k) {
      const double T = dt / parts;
      truth.x.segment<3>(pos) += T * path.v_n(time_s + 0.5 * T);
      time_s += T;
      f.predict(path.rate_b(time_s) + f.unit.gyro / std::sqrt(T) * normal(r),
                path.force_b(time_s) + accel_off + f.unit.accel / std::sqrt(T) * normal(r), T);
    }
    truth.q_nb = Quaterniond(path.R_nb(time_s));
    truth.x.segment<3>(vel) = path.v_n(time_s);
    for (const auto& [first, count, std, correlation_s] :
         {std::tuple{+gust, 2, 0.5, 15.0}, {+fix_pos, 3, 2.0, 150.0}, {+fix_vel, 3, 0.1, 2.0}})
      for (int i = first; i < first + count; ++i) {
        const double keep = std::exp(-dt / correlation_s);
        truth.x(i) = keep * truth.x(i) + std * std::sqrt(1 - keep * keep) * r.normal();
      }
    for (int i = 0; i < 2; ++i) truth.x(wind + i) += 0.01 * std::sqrt(dt) * r.normal();
    truth.x(baro_bias) += 0.06 * std::sqrt(dt) * r.normal();
    const auto fuse = [&](const Scalar& z, double std) { f.fuse(z, std * std, 5, Vector::Ones()); };
    const double height = -truth.x(pos + 2) + truth.x(baro_bias) + baro_std * r.normal() + outlier_m;
    fuse(baro_height(f, standard_air(height).pressure_pa, 0, true), baro_std);
    outlier_m = 0;
    const double speed = (1 + truth.x(tube_scale)) * truth.through_air_n().norm() + pitot_std * r.normal();
    fuse(tube_pressure(f, 0.5 * density * speed * speed + truth.x(tube_bias), density, 1),
         pitot_std * density * 20);
    for (int i = 0; i < 3; ++i) {
      const Past now = f.at(f.time_s());
      fuse(fix_velocity(f, now, i, truth.x(vel + i) + truth.x(fix_vel + i) + fix_std * r.normal(), 0),
           fix_std);
      fuse(fix_position(f, now, i, truth.x(pos + i) + truth.x(fix_pos + i) + place_std * r.normal()),
           place_std);
    }
  }
  Fault fly(double seconds, double drift_per_s = 0, double least = 60) {
    for (int k = 0; k < std::lround(10 * seconds); ++k) {
      truth.x(baro_bias) += 0.1 * drift_per_s;
      step();
      const Fault fault = f.find_fault(least, judge_unit);
      if (fault.first >= 0) return fault;
    }
    return {};
  }
};

}  // namespace fulmar::second_filter::simulated
