// SPDX-License-Identifier: BSD-3-Clause
// One simulated aircraft without host, mission and sensors: the model of `sim_aero`, for model-based control,
// learning and tests.
//
//   Simulation sim(read_airframe("fulmar:airframes/anaconda.yaml"), {.origin_altitude_m = 1387}, 7);
//   sim.fly({0, 0, -100}, 0, 17);                         // north, east, down; heading; airspeed
//   Simulation what_if = sim;                             // a copy is a fork: it flies on by itself
//   Actuators command = sim.trim();
//   command.aileron_rad += 0.05;
//   sim.step(command, 0.0025);
//   sim.body().v_n;
//
// A value type: no pointer, no thread, no allocation in a step. Equal seeds, starts and commands give equal
// flights to the bit. Only `step` and `set` throw (std::invalid_argument), and then change nothing. An
// aircraft that has crashed or left the model (departure.hpp) stays so until `reset`, `stand`, `fly` or
// `set`. Suffixes of frames (_n, _b): fulmar/flight/math/attitude.hpp.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>

#include "fulmar/sim/messages.hpp"
#include "fulmar/sim/plant.hpp"

namespace fulmar::sim {

/// A number in a message.
inline std::string shown(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

/// Surroundings of the aircraft; defaults are still standard air over flat ground at sea level.
struct SimulationOptions {
  double origin_altitude_m = 0;  ///< altitude of height 0 above mean sea level
  Weather weather{};
  Earth earth{};
};

/// Initial state of a roll-out, without gusts and gear springs: only a copy keeps those.
struct FlightState {
  RigidBody body;
  Deflections deflections;
  double propeller_radps = 0;
};

/// One aircraft, see above. Positions and velocities in NED from the origin, SI units.
class Simulation {
 public:
  static constexpr double max_s = 0.1;  ///< limit for the short period of small aircraft

  /// At rest on the ground, heading north.
  explicit Simulation(const Airframe& a, const SimulationOptions& options = {}, std::uint64_t seed = 1)
      : airframe_(a), options_(options), plant_(made(seed)) {}

  /// Restores the initial state, with this seed.
  void reset(std::uint64_t seed) {
    plant_ = made(seed);
    time_s_ = 0;
  }
  void stand(double north_m, double east_m, double heading_rad) {
    plant_.stand(north_m, east_m, heading_rad);
  }
  /// Sets steady level flight. `p_n` is north, east, minus the height. Returns false without such a flight at
  /// this airspeed; then the state stays.
  bool fly(const Eigen::Vector3d& p_n, double heading_rad, double Va) {
    return plant_.fly(p_n, heading_rad, Va);
  }

  /// Command of the steady flight of the last `fly`.
  Actuators trim() const {
    const Trim& t = plant_.trim();
    return {t.throttle_frac, t.deflections.aileron, t.deflections.elevator, t.deflections.rudder};
  }

  FlightState state() const { return {plant_.state(), plant_.deflections(), plant_.propeller_radps()}; }
  void set(const FlightState& s) {
    if (const std::string wrong = validation_error(s); !wrong.empty()) throw std::invalid_argument(wrong);
    plant_.set_drives(s.deflections, s.propeller_radps);
    plant_.set_state(s.body);
  }

  /// One step of the plant. Deflections and throttle are limited to their range, as servos do.
  void step(const Actuators& command, double dt_s) {
    if (const std::string wrong = validation_error(command); !wrong.empty())
      throw std::invalid_argument(wrong);
    demand_step(dt_s);
    if (plant_.departure() == Departure::none) plant_.advance(command, 1, dt_s);
    time_s_ += dt_s;
  }

  double time_s() const { return time_s_; }
  const RigidBody& body() const { return plant_.state(); }
  AirData air_data() const { return AirData(plant_.air_velocity_b()); }
  const Plant& plant() const { return plant_; }
  Plant& plant() { return plant_; }  ///< wind, faults, icing
  const Airframe& airframe() const { return airframe_; }

  /// Error of a command or a state; "" if it is valid.
  static std::string validation_error(const Actuators& c) {
    const std::array<std::pair<const char*, double>, 4> all{{{"throttle_frac", c.throttle_frac},
                                                             {"aileron_rad", c.aileron_rad},
                                                             {"elevator_rad", c.elevator_rad},
                                                             {"rudder_rad", c.rudder_rad}}};
    for (const auto& [name, value] : all)
      if (!std::isfinite(value)) return sim_messages::command_not_finite(name, shown(value));
    return "";
  }
  static std::string validation_error(const FlightState& s) {
    if (!s.body.p_n.allFinite() || !s.body.v_n.allFinite() || !s.body.omega_b.allFinite() ||
        !std::isfinite(s.deflections.aileron + s.deflections.elevator + s.deflections.rudder) ||
        !std::isfinite(s.propeller_radps))
      return sim_messages::state_not_finite();
    if (!(std::abs(s.body.q_nb.norm() - 1) < 1e-6)) return sim_messages::state_not_normalised();
    if (diverged(s.body)) return sim_messages::state_beyond_model();
    return "";
  }

  /// Throws if a step of this length is not permitted.
  static void demand_step(double dt_s) {
    if (!(dt_s > 0 && dt_s <= max_s))
      throw std::invalid_argument(sim_messages::step_invalid(shown(dt_s)).line());
  }

 private:
  Plant made(std::uint64_t seed) const {
    return Plant(airframe_, options_.weather, options_.origin_altitude_m, seed, options_.earth);
  }

  Airframe airframe_;
  SimulationOptions options_;
  Plant plant_;
  double time_s_ = 0;
};

/// Columns of a row of a flight, for arrays. on_ground and crashed are 0 or 1, departed is a Departure.
inline constexpr char row_names[] =
    "north_m east_m down_m v_north_mps v_east_mps v_down_mps q_w q_x q_y q_z p_radps q_radps r_radps "
    "airspeed_mps alpha_rad beta_rad f_x_mps2 f_y_mps2 f_z_mps2 aileron_rad elevator_rad rudder_rad "
    "propeller_radps on_ground crashed departed";
inline constexpr char action_names[] = "throttle_frac aileron_rad elevator_rad rudder_rad";
inline constexpr std::size_t row_columns = 26;
inline constexpr std::size_t action_columns = 4;

/// Writes the `row_columns` values of `row_names`.
inline void write_row(const Simulation& sim, double* row) {
  const RigidBody& x = sim.body();
  const AirData air = sim.air_data();
  const Eigen::Vector3d f = sim.plant().specific_force();
  const Deflections d = sim.plant().deflections();
  const std::array<double, row_columns> all{x.p_n.x(),
                                            x.p_n.y(),
                                            x.p_n.z(),
                                            x.v_n.x(),
                                            x.v_n.y(),
                                            x.v_n.z(),
                                            x.q_nb.w(),
                                            x.q_nb.x(),
                                            x.q_nb.y(),
                                            x.q_nb.z(),
                                            x.omega_b.x(),
                                            x.omega_b.y(),
                                            x.omega_b.z(),
                                            air.Va,
                                            air.alpha,
                                            air.beta,
                                            f.x(),
                                            f.y(),
                                            f.z(),
                                            d.aileron,
                                            d.elevator,
                                            d.rudder,
                                            sim.plant().propeller_radps(),
                                            sim.plant().on_ground() ? 1.0 : 0.0,
                                            sim.plant().crashed() ? 1.0 : 0.0,
                                            static_cast<double>(sim.plant().departure())};
  std::copy(all.begin(), all.end(), row);
}

/// The inverse of `write_row`, for a FlightState: the first 13 columns, surfaces and propeller.
inline FlightState state_of_row(const double* row) {
  FlightState s;
  s.body.p_n = {row[0], row[1], row[2]};
  s.body.v_n = {row[3], row[4], row[5]};
  s.body.q_nb = Eigen::Quaterniond(row[6], row[7], row[8], row[9]);
  s.body.omega_b = {row[10], row[11], row[12]};
  s.deflections = {row[19], row[20], row[21]};
  s.propeller_radps = row[22];
  return s;
}

}  // namespace fulmar::sim
