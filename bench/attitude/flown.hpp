// SPDX-License-Identifier: BSD-3-Clause
// An episode of the attitude benchmark, flown by the shipped components: control_slc/Airspeed, which adds the
// throttle to the attitude wanted, and control_slc/Inner. True state.
#pragma once
#include <fulmar/eigen.hpp>
#include <fulmar/sim/simulation.hpp>
#include <fulmar/testing.hpp>
#include <vector>

#include "bench/attitude/suite.hpp"
#include "plugins/control_slc/airspeed.hpp"
#include "plugins/control_slc/inner.hpp"

namespace fulmar::attitude {

inline VehicleState seen(const sim::Simulation& sim) {
  const RigidBody& x = sim.body();
  const AirData air = sim.air_data();
  const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
  VehicleState s;
  s.position_m = from_eigen<Ned>(x.p_n);
  s.velocity_mps = from_eigen<Ned>(x.v_n);
  s.attitude = from_eigen(x.q_nb);
  s.roll_rad = std::atan2(R(2, 1), R(2, 2));
  s.pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  s.yaw_rad = std::atan2(R(1, 0), R(0, 0));
  s.rate_radps = from_eigen<Body>(x.omega_b);
  s.specific_force_mps2 = from_eigen<Body>(sim.plant().specific_force());
  s.height_m = -x.p_n.z();
  s.climb_rate_mps = -x.v_n.z();
  s.ground_speed_mps = std::hypot(x.v_n.x(), x.v_n.y());
  s.course_rad = std::atan2(x.v_n.y(), x.v_n.x());
  s.airspeed_mps = air.Va, s.alpha_rad = air.alpha, s.beta_rad = air.beta;
  s.wind_mps = from_eigen<Ned>(sim.plant().wind_n());
  s.origin_altitude_m = -300;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  return s;
}

/// 300 m above the ground, which is as much below the sea: the density of the publication.
inline sim::Simulation begun(const Airframe& a, const Episode& e, Turbulence turbulence) {
  sim::SimulationOptions options;
  options.origin_altitude_m = -300;
  options.weather.turbulence = turbulence;
  options.weather.fixed_height_m = turbulence_height_m;
  options.weather.gust_airspeed_mps = turbulence_airspeed_mps;
  options.weather.gust_span_m = a.wing.span_m;
  sim::Simulation sim(a, options, e.seed);
  const Start& s = e.start;
  sim::FlightState state;
  state.body.p_n = {0, 0, -300};
  state.body.q_nb = Eigen::AngleAxisd(s.pitch_rad, Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(s.roll_rad, Eigen::Vector3d::UnitX());
  const double u = std::sqrt(s.airspeed_mps * s.airspeed_mps - s.v_mps * s.v_mps - s.w_mps * s.w_mps);
  state.body.v_n = state.body.q_nb * Eigen::Vector3d(u, s.v_mps, s.w_mps);
  state.body.omega_b = {s.rate_radps[0], s.rate_radps[1], s.rate_radps[2]};
  sim.set(state);
  return sim;
}

struct Gains {
  slc::Airspeed::Params airspeed;
  slc::Inner::Params inner;
};

/// The shipped components, stepped as the host does.
struct ShippedLaw {
  Bench<slc::Airspeed> airspeed;
  Bench<slc::Inner> inner;
  bool begun = false;

  ShippedLaw(const Airframe& a, const Gains& gains) {
    airspeed.params = gains.airspeed, inner.params = gains.inner;
    airspeed.params.airframe.value = inner.params.airframe.value = a;
  }
  Actuators step(const VehicleState& state, const Target& target) {
    GuidanceCommand command;
    command.airspeed_mps = target.airspeed_mps;
    // the samples are of the time of the step to come
    airspeed.set(airspeed.in.state, state, -dt_s);
    airspeed.set(airspeed.in.wanted, AttitudeCommand{target.roll_rad, target.pitch_rad, 0}, -dt_s);
    airspeed.set(airspeed.in.command, command, -dt_s);
    if (!begun) airspeed.activate();
    airspeed.step(dt_s);
    inner.set(inner.in.state, state, -dt_s);
    inner.set(inner.in.attitude, airspeed.out.attitude, -dt_s);
    if (!begun) inner.activate();
    inner.step(dt_s);
    begun = true;
    return inner.out.actuators;
  }
};

/// The PID of the publication, its gains and limits: what its figures are compared with.
struct PublishedPid {
  double airspeed_integral = 0, pitch_integral = 0;

  Actuators step(const VehicleState& s, const Target& target) {
    const double e_V = target.airspeed_mps - s.airspeed_mps, e_phi = target.roll_rad - s.roll_rad;
    const double e_theta = target.pitch_rad - s.pitch_rad;
    airspeed_integral += dt_s * e_V, pitch_integral += dt_s * e_theta;
    Actuators u;
    u.throttle_frac = std::clamp(0.5 * e_V + 0.1 * airspeed_integral, 0.0, 1.0);
    u.aileron_rad = std::clamp(e_phi - 0.5 * s.rate_radps.x, -30 * deg, 30 * deg);
    u.elevator_rad =
        std::clamp(-4 * e_theta - 0.75 * pitch_integral + 0.1 * s.rate_radps.y, -30 * deg, 35 * deg);
    return u;
  }
};

template <class Law>
Result fly(const Airframe& a, Law&& law, const Episode& e, Turbulence turbulence) {
  sim::Simulation sim = begun(a, e, turbulence);
  Target target = e.target;
  Streak streak;
  Variation variation;
  Result result;
  VehicleState state = seen(sim);
  while (!result.success && streak.steps < longest_steps) {
    const Actuators u = law.step(state, target);
    variation.step({u.elevator_rad, u.aileron_rad, u.throttle_frac});
    sim.step(u, dt_s);
    state = seen(sim);
    result.success =
        streak.step(wrap_pi(target.roll_rad - state.roll_rad), target.pitch_rad - state.pitch_rad,
                    target.airspeed_mps - state.airspeed_mps);
    target.airspeed_mps = next_airspeed(target);
  }
  result.steps = streak.steps;
  result.variation_per_s = variation.per_s();
  return result;
}

inline Row summary(const std::vector<Result>& results) {
  Row row;
  for (const Result& r : results) {
    row.success_percent += r.success ? 100 : 0;
    row.settling_steps += r.success ? r.steps : longest_steps;
    row.variation_per_s += r.variation_per_s;
  }
  const double n = static_cast<double>(std::max<std::size_t>(results.size(), 1));
  return {row.success_percent / n, row.settling_steps / n, row.variation_per_s / n};
}

}  // namespace fulmar::attitude
