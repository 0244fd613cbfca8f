// SPDX-License-Identifier: BSD-3-Clause
// The true state of the aircraft, in the form of an estimate.
#pragma once
#include <algorithm>
#include <cmath>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/origin.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/sim/plant.hpp"
#include "sensors.hpp"

namespace fulmar::sim {

inline VehicleState truth_of(const Plant& plant, const Sensors& sensors, const Origin& origin) {
  const RigidBody& x = plant.seen();
  const AirData air(plant.air_velocity_b());
  const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
  VehicleState s;
  s.position_m = from_eigen<Ned>(plant.state().p_n);
  s.velocity_mps = from_eigen<Ned>(x.v_n);
  s.attitude = from_eigen(x.q_nb);
  s.roll_rad = std::atan2(R(2, 1), R(2, 2));
  s.pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  s.yaw_rad = std::atan2(R(1, 0), R(0, 0));
  s.rate_radps = from_eigen<Body>(x.omega_b);
  s.specific_force_mps2 = from_eigen<Body>(plant.specific_force());
  s.height_m = -x.p_n.z();
  s.climb_rate_mps = -x.v_n.z();
  s.ground_speed_mps = std::hypot(x.v_n.x(), x.v_n.y());
  s.course_rad = s.ground_speed_mps > 0.1 ? std::atan2(x.v_n.y(), x.v_n.x()) : s.yaw_rad;
  s.airspeed_mps = air.Va;
  if (air.Va > 0.5) {  // at almost no airspeed the angles have no meaning
    s.alpha_rad = air.alpha;
    s.beta_rad = air.beta;
  }
  s.wind_mps = from_eigen<Ned>(plant.wind_n());
  s.gyro_bias_radps = from_eigen<Body>(sensors.gyro_bias());
  s.accel_bias_mps2 = from_eigen<Body>(sensors.accel_bias());
  s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {};
  s.airspeed_std_mps = 0;
  s.origin_latitude_deg = origin.lat_deg;
  s.origin_longitude_deg = origin.lon_deg;
  s.origin_altitude_m = origin.alt_msl_m;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  return s;
}

}  // namespace fulmar::sim
