// SPDX-License-Identifier: BSD-3-Clause
// An aircraft whose faults are set by name, and its sensor outputs, for the tests of faults.
#pragma once
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "fly.hpp"
#include "fulmar/flight/earth/geodesy.hpp"

namespace fulmar::sim {

inline const Actuators level{0.57, 0.0041, 0.1212, 0};

inline std::unique_ptr<Bench<Aircraft>> airborne(SensorSet set, std::uint64_t seed = 1) {
  auto b = std::make_unique<Bench<Aircraft>>(seed);
  b->params.airframe.value = anaconda();
  b->params.start.start_height.value = 300;
  b->params.sensors.value = set;
  b->params.settle.value = 0;
  arm(*b);
  return b;
}

inline const std::vector<FaultTarget> all_sensors{
    FaultTarget::gyro, FaultTarget::accel, FaultTarget::gnss_position, FaultTarget::gnss_velocity,
    FaultTarget::mag,  FaultTarget::baro,  FaultTarget::pitot};

inline void set_fault(Bench<Aircraft>& b, FaultTarget target, SensorFault kind) {
  SensorFaultParams& p = b.params.faults.sensors_that_fail;
  switch (target) {
    case FaultTarget::gyro: p.gyro_fault.value = kind; break;
    case FaultTarget::accel: p.accel_fault.value = kind; break;
    case FaultTarget::gnss_position: p.gnss_position_fault.value = kind; break;
    case FaultTarget::gnss_velocity: p.gnss_velocity_fault.value = kind; break;
    case FaultTarget::mag: p.mag_fault.value = kind; break;
    case FaultTarget::baro: p.baro_fault.value = kind; break;
    default: p.pitot_fault.value = kind;
  }
}

inline bool spoke(const Aircraft::Outputs& out, FaultTarget target) {
  switch (target) {
    case FaultTarget::gyro:
    case FaultTarget::accel: return out.imu.written;
    case FaultTarget::gnss_position:
    case FaultTarget::gnss_velocity: return out.gnss.written;
    case FaultTarget::mag: return out.mag.written;
    case FaultTarget::baro: return out.baro.written;
    default: return out.pitot.written;
  }
}

/// Output of the sensor; the position from the default origin, a scalar in x.
inline Eigen::Vector3d sensed(const Aircraft::Outputs& out, FaultTarget target) {
  const Gnss& g = out.gnss.value;
  switch (target) {
    case FaultTarget::gyro: return eigen(out.imu.value.rate_radps);
    case FaultTarget::accel: return eigen(out.imu.value.specific_force_mps2);
    case FaultTarget::gnss_position:
      return LocalFrame(40.2463724, -111.6474138, 1387).to_ned(g.latitude_deg, g.longitude_deg, g.altitude_m);
    case FaultTarget::gnss_velocity: return eigen(g.velocity_mps);
    case FaultTarget::mag: return eigen(out.mag.value.field_tesla);
    case FaultTarget::baro: return {out.baro.value.pressure_pa, 0, 0};
    default: return {out.pitot.value.pressure_pa, 0, 0};
  }
}

/// The faults of these parameters, as they are when their ramp is over.
inline Faults in_force(const FaultParams& p) {
  Faults faults;
  faults.set(p, 0);
  faults.advance(0);
  return faults;
}

}  // namespace fulmar::sim
