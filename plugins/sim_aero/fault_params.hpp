// SPDX-License-Identifier: BSD-3-Clause
// The faults as live parameters: what fails and how, and the sizes of the faults. README.md has the table.
#pragma once
#include <cstdint>

#include "fulmar/plugin.hpp"

namespace fulmar::sim {

enum class SensorFault : std::uint8_t { none, off, stuck, wrong, slow, noisy, jumping };
enum class SurfaceFault : std::uint8_t {
  none,
  stuck,
  hardover_positive,
  hardover_negative,
  slow,
  free,
  lost
};
enum class EngineFault : std::uint8_t { none, off, weak };
enum class BatteryFault : std::uint8_t { none, empty };

struct SensorFaultParams {
  Choice<SensorFault> gyro_fault{SensorFault::none, "of the gyroscopes"};
  Vector<Body> gyro_fault_size{{0.05, 0, 0}, "rad/s", -20, 20, "offset when wrong; bound of a jump"};
  Param gyro_fault_scale{1, "", -10, 10, "factor when wrong"};
  Choice<SensorFault> accel_fault{SensorFault::none, "of the accelerometers"};
  Vector<Body> accel_fault_size{{1, 0, 0}, "m/s2", -200, 200, "offset when wrong; bound of a jump"};
  Param accel_fault_scale{1, "", -10, 10, "factor when wrong"};
  Choice<SensorFault> gnss_position_fault{SensorFault::none, "of the receiver's position; off: no fix"};
  Vector<Ned> gnss_position_fault_size{{50, 0, 0}, "m", -1e5, 1e5, "offset when wrong; bound of a jump"};
  Param gnss_position_fault_scale{1, "", -10, 10, "factor when wrong, of the way from the origin"};
  Choice<SensorFault> gnss_velocity_fault{SensorFault::none, "of the receiver's velocity; off: 0, unknown"};
  Vector<Ned> gnss_velocity_fault_size{{5, 0, 0}, "m/s", -200, 200, "offset when wrong; bound of a jump"};
  Param gnss_velocity_fault_scale{1, "", -10, 10, "factor when wrong"};
  Choice<SensorFault> mag_fault{SensorFault::none, "of the magnetometer"};
  Vector<Body> mag_fault_size{{2e-5, 0, 0}, "T", -1e-3, 1e-3, "offset when wrong; bound of a jump"};
  Param mag_fault_scale{1, "", -10, 10, "factor when wrong"};
  Choice<SensorFault> baro_fault{SensorFault::none, "of the barometer"};
  Param baro_fault_size{240, "Pa", -1e5, 1e5, "offset when wrong; bound of a jump; 240 Pa is 20 m too low"};
  Param baro_fault_scale{1, "", -10, 10, "factor when wrong"};
  Choice<SensorFault> pitot_fault{SensorFault::none, "of the pitot tube"};
  Param pitot_fault_size{50, "Pa", -1e4, 1e4, "offset when wrong; bound of a jump"};
  Param pitot_fault_scale{1, "", -10, 10, "factor when wrong"};
  Param fault_noise{10, "", 1, 1000, "of every noisy sensor: its deviation, times"};
  Param fault_time{2, "s", 0.001, 3600, "of every slow sensor: lag; of every jumping one: between two jumps"};
  Param fault_ramp{0, "s", 0, 3600, "a fault grows to its size within this time"};
};

struct BodyFaultParams {
  Choice<SurfaceFault> aileron_fault{SurfaceFault::none, "of the ailerons and their servo"};
  Choice<SurfaceFault> elevator_fault{SurfaceFault::none, "of the elevator and its servo"};
  Choice<SurfaceFault> rudder_fault{SurfaceFault::none, "of the rudder and its servo"};
  Param fault_speed{0.1, "", 0.001, 1, "of every slow servo: its speed, times"};
  Choice<EngineFault> engine_fault{EngineFault::none, "of the motor and its controller"};
  Param engine_fault_share{0.5, "", 0, 1, "of the voltage that a weak motor gets"};
  Choice<BatteryFault> battery_fault{BatteryFault::none, "its voltage fades to nothing"};
  Param battery_fault_time{30, "s", 0.1, 36000, "in which an empty battery's voltage fades"};
  Param icing_rate{0, "1/s", -1, 1, "ice that grows on wing and tail; below 0: it melts; 0: it stays"};
  Param icing_lift{0.7, "", 0.1, 1, "of all ice: slope of the lift, times"};
  Param icing_drag{2.3, "", 1, 20, "of all ice: parasite drag, times"};
  Param icing_stall{0.7, "", 0.1, 1, "of all ice: angle of attack of the stall, times"};
  Param icing_control{0.7, "", 0.1, 1, "of all ice: effect of the surfaces, times"};
};

struct FaultParams {
  SensorFaultParams sensors_that_fail;
  BodyFaultParams body_that_fails;
};

}  // namespace fulmar::sim
