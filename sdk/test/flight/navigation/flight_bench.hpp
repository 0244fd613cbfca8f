// SPDX-License-Identifier: BSD-3-Clause
// Runs the component through a synthetic flight: a test may change the input samples, and check the output
// states.
#pragma once
#include <fulmar/testing.hpp>
#include <functional>

#include "fulmar/flight/navigation/estimator.hpp"
#include "synthetic_flight.hpp"

namespace synthetic {

using fulmar::navigation::Ekf;

struct Errors {
  Vector3d body_velocity, position, gnss, euler;  ///< RMS; metres, m/s, radians
  double course = 0, airspeed = 0;
  int samples = 0;
};

/// One flight. `alter` changes the samples before the component, `watch` receives the outputs.
struct Flown {
  Plan plan{};
  Quality quality = rosflight;
  double from_s = 0, judge_from_s = 40;
  bool origin_given = true, status = true;
  std::function<void(const Truth&, Samples&)> alter{};
  std::function<void(const Truth&, const VehicleState&, Status)> watch{};
  std::function<void(Ekf::Params&)> set{};
  std::function<double(const Truth&)> throttle{};  ///< input of the component; empty: not connected
  std::optional<double> first_s{};                 ///< time of the first state
  VehicleState last{};
  Truth last_truth{};
  NavigationHealth health{};
  double gnss_delay_s = 0;  ///< estimated delay

  Errors run() {
    const std::vector<Truth> flight = fly(plan);
    Sensors sensors(quality, plan, plan.seed + 100);
    Bench<Ekf> bench;
    if (origin_given) {
      bench.params.origin.value = {plan.lat_deg, plan.lon_deg, plan.alt_m, true};
      bench.params.origin.is_given = true;
    }
    if (set) set(bench.params);
    Errors e{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    for (std::size_t k = 0; k < flight.size(); ++k) {
      const Truth& x = flight[k];
      Samples s = sensors.at(flight, k);
      if (x.t < from_s) continue;
      if (alter) alter(x, s);
      feed(bench, x, s);
      const Status result = bench.step(1 / plan.rate_hz);
      if (bench.out.health.written) health = bench.out.health.value;
      if (!bench.out.state.written) continue;
      last = bench.out.state.value;
      gnss_delay_s = bench.out.gnss_delay_s.value;
      last_truth = x;
      if (!first_s) first_s = x.t;
      if (watch) watch(x, last, result);
      if (x.t > judge_from_s) judge(x, sensors.position_error, e);
    }
    const double n = std::max(e.samples, 1);
    for (Vector3d* v : {&e.body_velocity, &e.position, &e.gnss, &e.euler}) *v = (*v / n).cwiseSqrt();
    e.course = std::sqrt(e.course / n);
    e.airspeed = std::sqrt(e.airspeed / n);
    return e;
  }

 private:
  void feed(Bench<Ekf>& bench, const Truth& x, const Samples& s) const {
    bench.set(bench.in.imu, s.imu);
    if (s.gnss) bench.set(bench.in.gnss, *s.gnss, s.gnss_age_s);
    if (s.mag) bench.set(bench.in.mag, *s.mag);
    if (s.baro) bench.set(bench.in.baro, *s.baro);
    if (s.pitot) bench.set(bench.in.pitot, *s.pitot);
    if (throttle) bench.set(bench.in.commands, Actuators{throttle(x), 0, 0, 0});
    if (!status) return;
    VehicleStatus v;
    v.armed = x.t > plan.rest_s - 0.2;
    v.on_ground = x.t < plan.rest_s + 5;
    bench.set(bench.in.status, v);
  }
  void judge(const Truth& x, const Vector3d& gnss, Errors& e) const {
    ++e.samples;
    const Vector3d v_b = x.q_nb.conjugate() * x.v_n,
                   estimated = eigen(last.attitude).conjugate() * eigen(last.velocity_mps);
    const Euler truth = euler_from(x.q_nb);
    e.body_velocity += (estimated - v_b).cwiseAbs2();
    e.position += (eigen(last.position_m) - x.p_n).cwiseAbs2();
    e.gnss += gnss.cwiseAbs2();
    e.euler += Vector3d(wrap_pi(last.roll_rad - truth.roll_rad), wrap_pi(last.pitch_rad - truth.pitch_rad),
                        wrap_pi(last.yaw_rad - truth.yaw_rad))
                   .cwiseAbs2();
    e.course += std::pow(wrap_pi(last.course_rad - std::atan2(x.v_n.y(), x.v_n.x())), 2);
    e.airspeed += std::pow(last.airspeed_mps - x.airspeed(), 2);
  }
};

inline double attitude_error(const VehicleState& s, const Truth& x) {
  return eigen(s.attitude).angularDistance(x.q_nb);
}

/// False if an output is not finite.
inline bool all_finite(const VehicleState& s) {
  return eigen(s.position_m).allFinite() && eigen(s.velocity_mps).allFinite() &&
         eigen(s.attitude).coeffs().allFinite() && eigen(s.rate_radps).allFinite() &&
         eigen(s.specific_force_mps2).allFinite() && eigen(s.wind_mps).allFinite() &&
         std::isfinite(s.roll_rad + s.pitch_rad + s.yaw_rad + s.height_m + s.course_rad + s.airspeed_mps +
                       s.alpha_rad + s.beta_rad) &&
         eigen(s.position_std_m).allFinite() && eigen(s.velocity_std_mps).allFinite() &&
         eigen(s.attitude_std_rad).allFinite() && eigen(s.wind_std_mps).allFinite() &&
         std::isfinite(s.airspeed_std_mps);
}

}  // namespace synthetic
