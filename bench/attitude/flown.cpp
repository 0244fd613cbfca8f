// SPDX-License-Identifier: BSD-3-Clause
// Simulation and laws are compiled only here, for the bench and for its test.
#include "bench/attitude/flown.hpp"

#include <yaml-cpp/yaml.h>

#include <fulmar/eigen.hpp>
#include <fulmar/sim/simulation.hpp>
#include <fulmar/testing.hpp>

#include "plugins/control_slc/airspeed.hpp"
#include "plugins/control_slc/inner.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace fulmar::attitude {
namespace {

const Airframe& x8(Limits limits = Limits::suite) {
  static const Airframe file = test::airframe_file("x8");
  static const Airframe fast = [] {
    Airframe a = file;
    a.limits.airspeed_max_mps = suite_airspeed_max_mps;
    return a;
  }();
  return limits == Limits::file ? file : fast;
}

VehicleState seen(const sim::Simulation& sim) {
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
  s.airspeed_mps = air.Va;
  s.alpha_rad = air.alpha;
  s.beta_rad = air.beta;
  s.wind_mps = from_eigen<Ned>(sim.plant().wind_n());
  s.origin_altitude_m = -300;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  return s;
}

/// 300 m above the ground, which is 300 m below sea level: the air density of the publication.
sim::Simulation begun(const Airframe& a, const Episode& e, Turbulence turbulence) {
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

struct Params {
  slc::Airspeed::Params airspeed;
  slc::Inner::Params inner;
};

/// Sets the parameter of that name. The numbers of the file are in SI.
template <class P>
bool set_one(P& params, const std::string& name, double value) {
  using Table = detail::ParamTable<P>;
  std::size_t i = 0;
  bool found = false;
  auto one = [&](auto& param) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(param)>, Param>) {
      if (name == Table::table[i].name) {
        if (!(value >= param.min && value <= param.max))
          throw Wrong(name + " is " + sim::shown(value) + " and must be in [" + sim::shown(param.min) + ", " +
                      sim::shown(param.max) + "]");
        param.value = value;
        found = true;
      }
    }
    ++i;
  };
  detail::for_each_param(params, one);
  return found;
}

Params params_of(const Gains& gains) {
  Params params;
  for (const Setting& s : gains) {
    const bool found = s.component == "Inner"      ? set_one(params.inner, s.name, s.value)
                       : s.component == "Airspeed" ? set_one(params.airspeed, s.name, s.value)
                                                   : false;
    if (!found)
      throw Wrong("there is no parameter " + s.component + "." + s.name + "; components: Airspeed, Inner");
  }
  return params;
}

/// The shipped components, stepped as by the host.
struct ShippedLaw {
  Bench<slc::Airspeed> airspeed;
  Bench<slc::Inner> inner;
  bool begun = false;

  ShippedLaw(const Airframe& a, const Params& params) {
    airspeed.params = params.airspeed;
    inner.params = params.inner;
    airspeed.params.airframe.value = inner.params.airframe.value = a;
  }
  Actuators step(const VehicleState& state, const Target& target) {
    GuidanceCommand command;
    command.airspeed_mps = target.airspeed_mps;
    // the samples have the time of the step that follows
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

template <class Law>
Result fly(const Airframe& a, Law law, const Episode& e, Turbulence turbulence) {
  sim::Simulation sim = begun(a, e, turbulence);
  Target target = e.target;
  Streak streak;
  Variation variation;
  Result result;
  VehicleState state = seen(sim);
  while (!result.success && streak.steps < max_steps) {
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

}  // namespace

Beginning beginning(const Episode& e, Turbulence turbulence) {
  const sim::Simulation sim = begun(x8(), e, turbulence);
  return {seen(sim), sim.plant().air_velocity_b().z(), sim.plant().propeller_radps(),
          sim.plant().air().density_kgm3};
}

Gains shipped_gains() {
  Gains gains;
  const YAML::Node params = YAML::LoadFile(FULMAR_SOURCE_DIR "/configs/airframes/x8.yaml")["params"];
  for (const char* component : {"Airspeed", "Inner"})
    for (const auto& entry : params[std::string("control_slc/") + component])
      gains.push_back({component, entry.first.as<std::string>(), std::stod(entry.second.as<std::string>())});
  return gains;
}

void check(const Gains& gains) { params_of(gains); }

Result fly_shipped(const Gains& gains, const Episode& e, Turbulence turbulence, Limits limits) {
  return fly(x8(limits), ShippedLaw(x8(limits), params_of(gains)), e, turbulence);
}

Result fly_published(const Episode& e, Turbulence turbulence) {
  return fly(x8(), PublishedPid{}, e, turbulence);
}

}  // namespace fulmar::attitude
