// SPDX-License-Identifier: BSD-3-Clause
// A flight with a truth from kinematics alone: rest, take-off run, climb, straight legs and banked turns in
// both directions, in wind and gusts; and the sensor readings of two qualities on it.
#pragma once
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/earth/geodesy.hpp>
#include <fulmar/flight/earth/magnetic_model.hpp>
#include <fulmar/flight/math/attitude.hpp>
#include <fulmar/msg/baro.hpp>
#include <fulmar/msg/gnss.hpp>
#include <fulmar/msg/imu.hpp>
#include <fulmar/msg/mag.hpp>
#include <fulmar/msg/pitot.hpp>
#include <fulmar/random.hpp>
#include <numbers>
#include <optional>
#include <vector>

namespace synthetic {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace fulmar;

struct Plan {
  double duration_s = 150, rate_hz = 400, rest_s = 5, speed_mps = 17, bank_rad = 0.6,
         initial_course_rad = 0.4, start_mps2 = 4, start_radps = 2.5;
  double lat_deg = 40.2463724, lon_deg = -111.6474138, alt_m = 1387;
  Vector3d wind{3, -4, 0};
  double gust_mps = 0.8, gust_time_s = 5;
  std::uint64_t seed = 1;
};

struct Truth {
  double t = 0;
  Vector3d p_n, v_n, a_n, wind_n, omega_b, f_b;
  Quaterniond q_nb;
  double airspeed() const { return (v_n - wind_n).norm(); }
};

/// Second-order low-pass, critically damped: commands become smooth motion.
struct Smooth {
  double value = 0, rate = 0, natural = 2.5;
  void step(double command, double dt) {
    rate += dt * natural * (natural * (command - value) - 2 * rate);
    value += dt * rate;
  }
};

inline double bank_command(const Plan& plan, double t) {
  const double since = t - plan.rest_s - 20;
  if (since < 0) return 0;
  const double phase = std::fmod(since, 40);  // right 10 s, straight 10 s, left 10 s, straight 10 s
  return phase < 10 ? plan.bank_rad : phase < 20 ? 0 : phase < 30 ? -plan.bank_rad : 0;
}

inline std::vector<Truth> fly(const Plan& plan) {
  constexpr double g = 9.80665;
  const double dt = 1 / plan.rate_hz;
  const auto n = static_cast<std::size_t>(plan.duration_s * plan.rate_hz);
  std::vector<Truth> flight(n);
  Random random(plan.seed);
  Smooth speed, climb, bank, lift;
  speed.natural = plan.start_radps;
  climb.natural = 1.2;
  double course = plan.initial_course_rad;
  Vector3d p = Vector3d::Zero(), gust = Vector3d::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    Truth& x = flight[k];
    x.t = static_cast<double>(k) * dt;
    const double since = x.t - plan.rest_s;
    speed.step(since > 0 ? std::min(plan.speed_mps, plan.start_mps2 * since) : 0, dt);
    lift.step(since > 5.5 ? 1 : 0, dt);
    climb.step(since > 6 && since < 30 ? 0.17 : since > 60 ? 0.05 * std::sin(0.3 * since) : 0, dt);
    bank.step(since > 0 ? bank_command(plan, x.t) : 0, dt);
    const double V = speed.value, gamma = climb.value * (since > 0 ? 1 : 0);
    const double course_rate = V > 5 ? g * std::tan(bank.value) / V : 0;
    course += course_rate * dt;
    x.v_n = V * Vector3d(std::cos(gamma) * std::cos(course), std::cos(gamma) * std::sin(course),
                         -std::sin(gamma));
    p += x.v_n * dt;
    x.p_n = p;
    const double phi = std::exp(-dt / plan.gust_time_s), kick = plan.gust_mps * std::sqrt(1 - phi * phi);
    gust = phi * gust + kick * Vector3d(random.normal(), random.normal(), 0.5 * random.normal());
    x.wind_n = plan.wind + gust;
    const Vector3d u = x.v_n - plan.wind;  // the nose points into the mean air, gusts come from any side
    const double crab = wrap_pi(std::atan2(u.y(), u.x()) - course);
    const double alpha = lift.value * (0.03 + 0.08 * (1 / std::cos(bank.value) - 0.6));
    x.q_nb = quaternion_from({bank.value, gamma + alpha * std::cos(bank.value),
                              course + lift.value * crab + alpha * std::sin(bank.value)});
  }
  for (std::size_t k = 0; k < n; ++k) {
    const Truth &a = flight[k > 0 ? k - 1 : 0], &b = flight[k + 1 < n ? k + 1 : k];
    const double span = b.t - a.t;
    flight[k].a_n = (b.v_n - a.v_n) / span;
    flight[k].omega_b = log_map(a.q_nb.conjugate() * b.q_nb) / span;
    flight[k].f_b = flight[k].q_nb.conjugate() * (flight[k].a_n - Vector3d(0, 0, g));
  }
  return flight;
}

/// Exponentially correlated noise with the standard deviation `std`.
struct Markov {
  double std = 0, time_s = 1, value = 0;
  double step(double dt, Random& random) {
    const double phi = std::exp(-dt / time_s);
    return value = phi * value + std * std::sqrt(1 - phi * phi) * random.normal();
  }
};

struct Quality {
  double gnss_hz, mag_hz, baro_hz, pitot_hz;
  double accel, accel_bias, gyro, gyro_bias, mag_ratio, mag_tau, baro_pa, baro_bias_pa, pitot_pa;
  double position_walk_m, position_tau, height_walk_m, velocity, position_white, latency_s;
  double reported_horizontal, reported_vertical, reported_speed;
  bool pitot_along_x;
};
/// Noise of the ROSflight simulator; receiver of the u-blox class on a small airframe.
inline constexpr Quality rosflight{10,   50,  100,  100, 0.2,  0.6, 0.00226, 0.25, 0.0024, 0.14, 4,   500,
                                   1.15, 1.5, 1100, 3,   0.01, 0,   0,       0.21, 0.4,    0.01, true};
inline constexpr Quality ublox{5, 50,  50, 50,  0.1,  0.15, 0.003, 0.01, 0.01, 5,    3,    300,
                               2, 0.8, 60, 1.5, 0.06, 0.2,  0.15,  1.2,  2.0,  0.25, false};

struct Samples {
  Imu imu;
  std::optional<Gnss> gnss;
  double gnss_age_s = 0;
  std::optional<Mag> mag;
  std::optional<Baro> baro;
  std::optional<Pitot> pitot;
};

class Sensors {
 public:
  Sensors(const Quality& quality, const Plan& plan, std::uint64_t seed)
      : q(quality),
        plan_(plan),
        random(seed),
        frame_(plan.lat_deg, plan.lon_deg, plan.alt_m),
        field_(magnetic_field_ned(plan.lat_deg, plan.lon_deg, plan.alt_m, 2026.0)) {
    const auto any = [&](double range) {
      return Vector3d(random.uniform(-range, range), random.uniform(-range, range),
                      random.uniform(-range, range));
    };
    accel_bias = any(q.accel_bias);
    gyro_bias = any(q.gyro_bias);
    baro_bias_ = random.uniform(-q.baro_bias_pa, q.baro_bias_pa);
    for (std::size_t i = 0; i < 3; ++i) {
      position_[i] = {i < 2 ? q.position_walk_m : q.height_walk_m, q.position_tau, 0};
      mag_[i] = {q.mag_ratio * field_.norm(), q.mag_tau, 0};
    }
  }

  Samples at(const std::vector<Truth>& flight, std::size_t k) {
    const Truth& x = flight[k];
    Samples s;
    s.imu.specific_force_mps2 = from_eigen<Body>(Vector3d(x.f_b + accel_bias + q.accel * normal()));
    s.imu.rate_radps = from_eigen<Body>(Vector3d(x.omega_b + gyro_bias + q.gyro * normal()));
    if (due(k, q.mag_hz)) {
      Vector3d m = x.q_nb.conjugate() * field_;
      for (int i = 0; i < 3; ++i) m(i) += mag_[static_cast<std::size_t>(i)].step(1 / q.mag_hz, random);
      s.mag = Mag{from_eigen<Body>(m)};
    }
    const Air air = standard_air(plan_.alt_m - x.p_n.z());
    if (due(k, q.baro_hz)) s.baro = Baro{air.pressure_pa + baro_bias_ + q.baro_pa * random.normal(), 300};
    if (due(k, q.pitot_hz)) {
      const Vector3d u_b = x.q_nb.conjugate() * (x.v_n - x.wind_n);
      const double V = q.pitot_along_x ? std::max(u_b.x(), 0.0) : u_b.norm();
      s.pitot = Pitot{0.5 * air.density_kgm3 * V * V + q.pitot_pa * random.normal(), 0, 300};
    }
    if (due(k, q.gnss_hz)) gnss(flight, k, s);
    return s;
  }

  Quality q;
  Vector3d accel_bias, gyro_bias, position_error = Vector3d::Zero();

 private:
  bool due(std::size_t k, double hz) const {
    const auto every = static_cast<std::size_t>(plan_.rate_hz / hz + 0.5);
    return k % every == 0;
  }
  Vector3d normal() { return {random.normal(), random.normal(), random.normal()}; }
  void gnss(const std::vector<Truth>& flight, std::size_t k, Samples& s) {
    const auto late = static_cast<std::size_t>(q.latency_s * plan_.rate_hz + 0.5);
    if (k < late) return;
    const Truth& x = flight[k - late];
    for (int i = 0; i < 3; ++i)
      position_error(i) = position_[static_cast<std::size_t>(i)].step(1 / q.gnss_hz, random) +
                          q.position_white * random.normal();
    const auto g = frame_.from_ned(x.p_n + position_error);
    Gnss fix;
    fix.latitude_deg = g.lat_deg;
    fix.longitude_deg = g.lon_deg;
    fix.altitude_m = g.alt_m;
    fix.velocity_mps = from_eigen<Ned>(Vector3d(x.v_n + q.velocity * normal()));
    fix.horizontal_std_m = q.reported_horizontal;
    fix.vertical_std_m = q.reported_vertical;
    fix.speed_std_mps = q.reported_speed;
    fix.utc_ns = 1767225600'000'000'000;  // 2026-01-01
    fix.fix = FixType::fix_3d;
    fix.satellites = 15;
    s.gnss = fix;
    s.gnss_age_s = q.latency_s;
  }

  Plan plan_;
  Random random;
  LocalFrame frame_;
  Vector3d field_;
  double baro_bias_ = 0;
  std::array<Markov, 3> position_, mag_;
};

}  // namespace synthetic
