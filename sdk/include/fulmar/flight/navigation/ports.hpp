// SPDX-License-Identifier: BSD-3-Clause
// The ports of the shipped estimator (estimator.hpp): groups in those of a component that holds it.
#pragma once
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/baro.hpp"
#include "fulmar/msg/controller_attitude.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/imu.hpp"
#include "fulmar/msg/mag.hpp"
#include "fulmar/msg/navigation_health.hpp"
#include "fulmar/msg/pitot.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/msg/vehicle_status.hpp"
#include "fulmar/plugin.hpp"

namespace fulmar::navigation {

/// Input ports; only the inertial unit is required.
struct Inputs {
  In<Imu> imu;
  Optional<Gnss> gnss;
  Optional<Mag> mag;
  Optional<Baro> baro;
  Optional<Pitot> pitot;
  Optional<VehicleStatus> status;
  Optional<ControllerAttitude> attitude;
  Optional<Actuators> commands;  ///< active commands: their throttle gives the airspeed without a pitot
};
/// Output ports. The probes are states and innovations of the filter.
struct Outputs {
  Out<VehicleState> state;
  Out<FilterCheck> check;        // for consistency tests
  Out<NavigationHealth> health;  // at 5 Hz
  Probe horizontal_ratio, height_ratio, velocity_ratio, baro_ratio, pitot_ratio, sideslip_ratio,
      heading_ratio;    ///< innovations in standard deviations
  Probe refused_ratio;  ///< measurements rejected by their gates so far
  Probe gust_mps, gust_north_mps, gust_east_mps, baro_bias_m, static_port_ratio, heading_deviation_rad,
      gnss_delay_s;
};

}  // namespace fulmar::navigation
