// SPDX-License-Identifier: BSD-3-Clause
// Start of the flight: on the ground, in the hand or on the catapult, or in trimmed level flight.
#pragma once
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/plugin.hpp"
#include "fulmar/sim/plant.hpp"
#include "launch.hpp"
#include "messages.hpp"
#include "refusals.hpp"
#include "wind_params.hpp"

namespace fulmar::sim {

struct StartParams {
  Param start_north{0, "m", -1e5, 1e5, "north position at flight time 0", setup};
  Param start_east{0, "m", -1e5, 1e5, "east position at flight time 0", setup};
  Param start_height{
      0, "m", 0, 5000, "height at flight time 0; 0: on the ground; above: trimmed level flight", setup};
  Param start_heading{0,    "rad", -full_turn, full_turn, "heading at flight time 0, from north, clockwise",
                      setup};
  Param start_airspeed{
      0, "m/s", 0, 100, "airspeed of a start in the air; 0: cruise airspeed of the airframe", setup};
};

/// Lifts a standing aircraft into the hand or onto the catapult.
inline void lift(Plant& plant, double height_m, double pitch_rad) {
  RigidBody x = plant.state();
  x.p_n.z() -= height_m;
  x.q_nb = x.q_nb * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY());
  plant.set_state(x);
}

/// Throws if the aircraft is in the ground. Its height is normal to a slope, and `start_height` is vertical.
inline void refuse_below_ground(Plant& plant, double least_m, double start_height_m) {
  const double height_m = plant.height_above_ground();
  if (height_m >= least_m) return;
  lift(plant, 1, 0);
  const double gain = plant.height_above_ground() - height_m;
  const double start_m = std::ceil(start_height_m + (least_m - height_m) / gain);
  throw std::runtime_error(located("start_height", sim_aero_messages::start_below_ground(
                                                       figures(start_height_m, 6), figures(start_m, 6)))
                               .line());
}

/// `now_ns`: time of the position, before flight time 0.
inline void place(Plant& plant, const Airframe& a, double origin_alt_m, const StartParams& p,
                  const LaunchParams& launching, std::int64_t now_ns) {
  const Launch launch(launching);
  const bool in_air = p.start_height > 0, own = in_air && p.start_airspeed > 0;
  const double Va = own ? p.start_airspeed : a.limits.airspeed_cruise_mps;
  const SteadyFlight flight = steady_flight(AircraftModel(a, origin_alt_m + p.start_height), {Va});
  if (in_air && launch.given())
    throw std::runtime_error(located("launch", sim_aero_messages::launch_in_air()).line());
  if (!in_air && flight.found()) {
    plant.stand(p.start_north, p.start_east, p.start_heading);
    if (launch.given()) lift(plant, launch.height_m(), launching.launch_pitch);
    return;
  }
  if (!in_air || !plant.fly({p.start_north, p.start_east, -p.start_height}, p.start_heading, Va))
    throw std::runtime_error(
        trim_words(a, flight, own ? "start_airspeed" : "airframe.limits.airspeed_cruise"));
  refuse_below_ground(plant, a.gear.height_m, p.start_height);
  plant.shift(1e-9 * static_cast<double>(now_ns));
}

}  // namespace fulmar::sim
