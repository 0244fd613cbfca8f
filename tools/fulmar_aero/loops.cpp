// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/loops.hpp"

#include <Eigen/LU>

#include "tools/fulmar_aero/flight_model.hpp"

namespace fulmar::aero {
namespace {

using Samples = std::vector<LoopSample>;

Complex servo_lag(const Surface& surface, Complex s) {
  const double w = surface.natural_frequency_radps;
  if (w > 0) return w * w / (s * s + 2.0 * surface.damping_ratio * w * s + w * w);
  return 1.0 / (1.0 + surface.time_constant_s * s);
}
double servo_lag_s(const Surface& surface) {
  const double w = surface.natural_frequency_radps;
  return w > 0 ? 2 * surface.damping_ratio / w : surface.time_constant_s;
}

/// The surfaces that a mixer makes of two servos: their common properties.
std::array<std::array<const Surface*, 2>, 3> servos_of(const Airframe& a) {
  const Surface &x = a.aileron, &y = a.elevator, &z = a.rudder;
  if (a.mixer == Mixer::elevons) return {{{&x, &y}, {&x, &y}, {&z, &z}}};
  if (a.mixer == Mixer::v_tail) return {{{&x, &x}, {&y, &z}, {&y, &z}}};
  return {{{&x, &x}, {&y, &y}, {&z, &z}}};
}

/// A loop: the place where it is broken, and its command and response.
struct LoopPlace {
  const char *name, *actuator, *sensor;
  int at_actuator, at_sensor;
  int goal;  ///< -1: none
};
constexpr int sensor_at(int i) { return signals::sensors + i; }
constexpr int command_at(int i) { return signals::commands + i; }
constexpr int input_at(int i) { return signals::inputs + i; }

std::vector<LoopPlace> places(const Airframe& a, OuterScheme scheme) {
  std::vector<LoopPlace> all{
      {"roll", "aileron", "roll", input_at(model::aileron), sensor_at(sensor::roll), -1},
      {"pitch", "elevator", "pitch", input_at(model::elevator), sensor_at(sensor::pitch), -1}};
  if (a.rudder.limit_rad > 0 && rudder_acts(a))
    all.push_back({"yaw damper", "rudder", "yaw rate", input_at(model::rudder), sensor_at(sensor::r), -1});
  if (scheme == OuterScheme::none) return all;
  const bool tecs = scheme == OuterScheme::tecs;
  if (!tecs)
    all.push_back({"course", "roll command", "course", command_at(command::roll), sensor_at(sensor::course),
                   goal::course});
  all.push_back({tecs ? "TECS height" : "height", "pitch command", "height", command_at(command::pitch),
                 sensor_at(sensor::height), goal::height});
  all.push_back({tecs ? "TECS airspeed" : "airspeed", "throttle", "airspeed", input_at(model::throttle),
                 sensor_at(sensor::airspeed), goal::airspeed});
  return all;
}

/// Commands as a function of the goals of guidance.
Eigen::Matrix<Complex, command::count, goal::count> of_goals(const Plant& plant, const Laws& laws,
                                                             OuterScheme scheme, Complex s) {
  const Complex z = std::exp(s * plant.step_s);
  if (scheme == OuterScheme::tecs) return response(laws.tecs, plant.point(), z).of_goals;
  return response(laws.slc, plant.point(), z).of_goals;
}

std::vector<double> frequencies(const Plant& plant) {
  const double first = 3e-3, last = 0.98 * std::numbers::pi / plant.step_s;
  constexpr int n = 600;
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(first * std::pow(last / first, i / (n - 1.0)));
  return all;
}

LoopMatrix difference_inverse(const LoopMatrix& G) { return (LoopMatrix::Identity() - G).inverse(); }

/// -3 dB of a response, relative to its value at low frequency.
double bandwidth_of(const std::vector<double>& w, const std::vector<double>& T) {
  for (std::size_t i = 0; i < T.size(); ++i)
    if (T[i] < T.front() / std::numbers::sqrt2) return w[i];
  return w.back();
}

/// Damping of the second-order system whose response L/(1 + L) has the same peak, |T|max = 1/(2 z sqrt(1 -
/// z^2)): Åström & Murray, Feedback Systems (2008), section 6.3.
double damping_of(const Samples& loop) {
  double M = 1;
  for (const LoopSample& one : loop) M = std::max(M, std::abs(one.gain / (1.0 + one.gain)));
  return std::sqrt(0.5 * (1 - std::sqrt(1 - 1 / (M * M))));
}

/// Poles right of the line. Position, heading and height add poles at 0.
int open_loop_poles(const Plant& plant, double line) {
  int count = 0;
  for (const Mode& mode : modes_in(plant.linear))
    if (mode.eigenvalue.real() > line) count += mode.oscillates() ? 2 : 1;
  return count;
}

}  // namespace

Eigen::Matrix<Complex, sensor::count, model::inputs> Plant::response(Complex s) const {
  const double Va = flight.condition.airspeed_mps;
  Eigen::Matrix<Complex, model::states, model::states> M = -linear.A.cast<Complex>();
  M.diagonal().array() += s;
  const Eigen::Matrix<Complex, model::states, model::inputs> x =
      M.partialPivLu().solve(linear.B.cast<Complex>().eval());
  Eigen::Matrix<Complex, sensor::count, model::inputs> y;
  y.row(sensor::roll) = x.row(model::roll);
  y.row(sensor::pitch) = x.row(model::pitch);
  y.row(sensor::p) = x.row(model::p);
  y.row(sensor::q) = x.row(model::q);
  y.row(sensor::r) = x.row(model::r);
  y.row(sensor::course) = s * x.row(model::east) / Va;  // heading is north, the air still
  y.row(sensor::height) = -x.row(model::down);
  y.row(sensor::climb) = -s * x.row(model::down);
  y.row(sensor::airspeed) =
      flight.x.segment<3>(model::u).cast<Complex>().transpose() * x.middleRows<3>(model::u) / Va;
  y.row(sensor::acceleration) = s * y.row(sensor::airspeed);
  y.row(sensor::sideslip) = x.row(model::v) / Va;
  return y;
}

Eigen::Vector4<Complex> Plant::lag(Complex s) const {
  const Complex held = (1.0 - std::exp(-s * step_s)) / (s * step_s), late = std::exp(-s * delay_s);
  Eigen::Vector4<Complex> out;
  const auto servos = servos_of(airframe);
  for (int i = 0; i < 3; ++i)
    out(i) = 0.5 * (servo_lag(*servos[std::size_t(i)][0], s) + servo_lag(*servos[std::size_t(i)][1], s));
  out(model::throttle) = 1.0 / (1.0 + airframe.propulsion.time_constant_s * s);
  return out * held * late;
}

double Plant::lag_s(int input) const {
  const double computed = 0.5 * step_s + delay_s;
  if (input == model::throttle) return computed + airframe.propulsion.time_constant_s;
  const auto servos = servos_of(airframe)[std::size_t(input)];
  return computed + 0.5 * (servo_lag_s(*servos[0]) + servo_lag_s(*servos[1]));
}

double Plant::thrust_newton() const {
  const Eigen::Vector3d v = flight.x.segment<3>(model::u);
  return airframe.mass_kg * linear.B.col(model::throttle).segment<3>(model::u).dot(v) / v.norm();
}

LoopMatrix loops(const Plant& plant, const Laws& laws, OuterScheme scheme, Complex s) {
  const Complex z = std::exp(s * plant.step_s);
  const LawPoint at = plant.point();
  LoopMatrix G = LoopMatrix::Zero();
  G.block<sensor::count, model::inputs>(signals::sensors, signals::inputs) =
      plant.response(s) * plant.lag(s).asDiagonal();
  const InnerResponse inner = response(laws.inner, at, z);
  G.block<model::inputs, sensor::count>(signals::inputs, signals::sensors) = inner.of_sensors;
  G.block<model::inputs, command::count>(signals::inputs, signals::commands) = inner.of_commands;
  if (scheme == OuterScheme::none) return G;
  G.block<command::count, sensor::count>(signals::commands, signals::sensors) =
      scheme == OuterScheme::tecs ? response(laws.tecs, at, z).of_sensors
                                  : response(laws.slc, at, z).of_sensors;
  return G;
}

double dutch_roll_damping(const Plant& plant, const InnerLaw& inner) {
  LinearModel m = plant.linear;
  const LawPoint at = plant.point();
  const double ratio = plant.airframe.limits.airspeed_cruise_mps / at.Va_mps;
  const double gain =
      std::clamp(ratio * ratio, 1 / inner.scale_limit, inner.scale_limit.value) * inner.yaw_kd;
  m.A.col(model::r) += gain * m.B.col(model::rudder);
  m.A.col(model::roll) -= gain * isa::g0 / at.Va_mps * std::cos(at.pitch_rad) * m.B.col(model::rudder);
  for (const Mode& mode : modes_in(m))
    if (mode.kind == ModeKind::dutch_roll) return mode.oscillates() ? mode.damping_ratio() : 1;
  return 1;
}

LoopReport evaluate(const Plant& plant, const Laws& laws, OuterScheme scheme) {
  const std::vector<LoopPlace> all = places(plant.airframe, scheme);
  const std::vector<double> w = frequencies(plant);
  std::vector<Samples> at_actuator(all.size()), at_sensor(all.size());
  std::vector<std::vector<double>> T(all.size());
  for (const double omega : w) {
    const Complex s(0, omega);
    const LoopMatrix closed = difference_inverse(loops(plant, laws, scheme, s)),
                     inner = difference_inverse(loops(plant, laws, OuterScheme::none, s));
    const auto goals = of_goals(plant, laws, scheme, s);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const LoopPlace& at = all[i];
      // one loop with all others closed: (I - G)^-1 has 1/(1 + L) on its diagonal
      at_actuator[i].push_back({omega, 1.0 / closed(at.at_actuator, at.at_actuator) - 1.0});
      at_sensor[i].push_back({omega, 1.0 / closed(at.at_sensor, at.at_sensor) - 1.0});
      const Complex T_i =
          at.goal >= 0
              ? (closed.row(at.at_sensor).segment<command::count>(signals::commands) * goals.col(at.goal))(0)
              : inner(at.at_sensor,
                      command_at(at.at_sensor == sensor_at(sensor::pitch) ? command::pitch : command::roll));
      T[i].push_back(std::abs(T_i));
    }
  }
  LoopReport report;
  // Without an outer law a slow mode of height or speed may be unstable: the inner law does not control it.
  const double line = scheme == OuterScheme::none ? 0.1 : 2e-3;
  report.unstable = unstable_poles(
      [&](Complex s) { return (LoopMatrix::Identity() - loops(plant, laws, scheme, s)).determinant(); },
      open_loop_poles(plant, line), line, 20 * std::numbers::pi / plant.step_s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    LoopFigures f{all[i].name, all[i].actuator, all[i].sensor, margins_of(at_actuator[i]),
                  margins_of(at_sensor[i])};
    if (all[i].at_sensor == sensor_at(sensor::r)) {
      f.bandwidth_radps = f.at_actuator.crossover_radps;
      f.damping_ratio = dutch_roll_damping(plant, laws.inner);
    } else {
      f.bandwidth_radps = bandwidth_of(w, T[i]);
      f.damping_ratio = damping_of(at_sensor[i]);
    }
    report.loops.push_back(std::move(f));
  }
  return report;
}

}  // namespace fulmar::aero
