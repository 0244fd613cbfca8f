// SPDX-License-Identifier: BSD-3-Clause
// An episode of the attitude benchmark, flown by the shipped components: control_slc/Airspeed, which adds the
// throttle to the attitude wanted, and control_slc/Inner; or by the PID of the publication. The Skywalker X8,
// true state.
#pragma once
#include <fulmar/msg/actuators.hpp>
#include <fulmar/msg/vehicle_state.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/attitude/suite.hpp"

namespace fulmar::attitude {

/// Initial measurements of the law, and properties of air and motor that it does not measure.
struct Beginning {
  VehicleState seen;
  double w_mps = 0, propeller_radps = 0, density_kgm3 = 0;
};
Beginning beginning(const Episode& e, Turbulence turbulence);

struct Wrong : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A parameter of Airspeed or Inner, in SI.
struct Setting {
  std::string component, name;
  double value = 0;
};
/// Of two for the same parameter the later one counts.
using Gains = std::vector<Setting>;

/// The gains of configs/airframes/x8.yaml.
Gains shipped_gains();
/// Throws Wrong for an unknown parameter or a value out of its range.
void check(const Gains& gains);

/// The PID of the publication with its gains and limits, as a reference.
struct PublishedPid {
  double airspeed_integral = 0, pitch_integral = 0;

  Actuators step(const VehicleState& s, const Target& target) {
    const double e_V = target.airspeed_mps - s.airspeed_mps, e_phi = target.roll_rad - s.roll_rad;
    const double e_theta = target.pitch_rad - s.pitch_rad;
    airspeed_integral += dt_s * e_V;
    pitch_integral += dt_s * e_theta;
    Actuators u;
    u.throttle_frac = std::clamp(0.5 * e_V + 0.1 * airspeed_integral, 0.0, 1.0);
    u.aileron_rad = std::clamp(e_phi - 0.5 * s.rate_radps.x, -30 * deg, 30 * deg);
    u.elevator_rad =
        std::clamp(-4 * e_theta - 0.75 * pitch_integral + 0.1 * s.rate_radps.y, -30 * deg, 35 * deg);
    return u;
  }
};

/// Descents of the suite exceed the largest airspeed of the airframe's file. `suite` raises airspeed_max to
/// suite_airspeed_max_mps, the only setting that differs from the file.
enum class Limits { suite, file };
inline constexpr double suite_airspeed_max_mps = 40;

Result fly_shipped(const Gains& gains, const Episode& e, Turbulence turbulence,
                   Limits limits = Limits::suite);
Result fly_published(const Episode& e, Turbulence turbulence);

inline Row summary(const std::vector<Result>& results) {
  Row row;
  for (const Result& r : results) {
    row.success_percent += r.success ? 100 : 0;
    row.settling_steps += r.success ? r.steps : max_steps;
    row.variation_per_s += r.variation_per_s;
  }
  const double n = static_cast<double>(std::max<std::size_t>(results.size(), 1));
  return {row.success_percent / n, row.settling_steps / n, row.variation_per_s / n};
}

}  // namespace fulmar::attitude
