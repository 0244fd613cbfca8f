// SPDX-License-Identifier: BSD-3-Clause
// The loops that the laws close around an aircraft, broken one at a time with all others closed.
#pragma once
#include <string>
#include <vector>

#include "fulmar/flight/math/margins.hpp"
#include "fulmar/flight/model/linear_model.hpp"
#include "fulmar/flight/model/steady_flight.hpp"
#include "tools/fulmar_aero/laws.hpp"

namespace fulmar::aero {

/// An aircraft in steady flight, with its lags and the delay of computation and measurement.
struct Plant {
  Airframe airframe;
  LinearModel linear;
  SteadyFlight flight;
  double altitude_m = 0;
  double step_s = 0.01;  ///< of the laws: commands are held for this time
  double delay_s = 0;    ///< of estimator, computer and link, in addition

  LawPoint point() const {
    return {&airframe, flight.condition.airspeed_mps, flight.density_kgm3, flight.x(model::pitch), step_s};
  }
  /// From deflections and throttle to the sensors, without lags.
  Eigen::Matrix<Complex, sensor::count, model::inputs> response(Complex s) const;
  /// From a command to the deflection or throttle.
  Eigen::Vector4<Complex> lag(Complex s) const;
  /// Equivalent delay of the lag at low frequency, s.
  double lag_s(int input) const;
  double thrust_newton() const;  ///< per unit of throttle
};

enum class OuterScheme : std::uint8_t { none, slc, tecs };

/// All signals of the closed loop in sequence: sensors, commands, deflections.
namespace signals {
enum : int {
  sensors = 0,
  commands = sensor::count,
  inputs = commands + command::count,
  count = inputs + model::inputs
};
}
using LoopMatrix = Eigen::Matrix<Complex, signals::count, signals::count>;

/// w = G(s) w: response of each signal to each other.
LoopMatrix loops(const Plant& plant, const Laws& laws, OuterScheme scheme, Complex s);

struct LoopFigures {
  std::string name;              ///< "roll", "TECS height"
  std::string actuator, sensor;  ///< place of the cut: "aileron", "roll"
  Margins at_actuator, at_sensor;
  double bandwidth_radps = 0;  ///< of the response to the command, -3 dB; of a damper, the crossover
  // of a second-order system with this resonance, 0.71 without one; of a damper, of the Dutch roll
  double damping_ratio = 0;
  double min_gain_db() const { return std::min(at_actuator.min_gain_db(), at_sensor.min_gain_db()); }
  double min_phase_rad() const { return std::min(at_actuator.phase_rad, at_sensor.phase_rad); }
  double min_delay_s() const { return std::min(at_actuator.delay_s, at_sensor.delay_s); }
};

struct LoopReport {
  int unstable = 0;  ///< poles of the closed loop
  std::vector<LoopFigures> loops;
};

/// Damping of the Dutch roll with the damper alone, without lags; 1 when it does not oscillate.
double dutch_roll_damping(const Plant& plant, const InnerLaw& inner);

/// Without an outer law: roll, pitch and yaw damper. With one: these and course, height and airspeed.
LoopReport evaluate(const Plant& plant, const Laws& laws, OuterScheme scheme);

}  // namespace fulmar::aero
