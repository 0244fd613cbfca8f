// SPDX-License-Identifier: BSD-3-Clause
// The faults as live parameters: kinds and sizes. README.md has the table.
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
  Choice<SensorFault> gyro_fault{SensorFault::none, "fault of the gyroscopes"};
  Vector<Body> gyro_fault_size{
      {0.05, 0, 0}, "rad/s", -20, 20, "offset of the fault `wrong`; largest jump of `jumping`"};
  Param gyro_fault_scale{1, "", -10, 10, "scale factor of the fault `wrong`"};
  Choice<SensorFault> accel_fault{SensorFault::none, "fault of the accelerometers"};
  Vector<Body> accel_fault_size{
      {1, 0, 0}, "m/s2", -200, 200, "offset of the fault `wrong`; largest jump of `jumping`"};
  Param accel_fault_scale{1, "", -10, 10, "scale factor of the fault `wrong`"};
  Choice<SensorFault> gnss_position_fault{SensorFault::none, "fault of the receiver's position; off: no fix"};
  Vector<Ned> gnss_position_fault_size{
      {50, 0, 0}, "m", -1e5, 1e5, "offset of the fault `wrong`; largest jump of `jumping`"};
  Param gnss_position_fault_scale{1, "", -10, 10,
                                  "scale factor of the fault `wrong`, on the distance from the origin"};
  Choice<SensorFault> gnss_velocity_fault{SensorFault::none,
                                          "fault of the receiver's velocity; off: 0, unknown"};
  Vector<Ned> gnss_velocity_fault_size{
      {5, 0, 0}, "m/s", -200, 200, "offset of the fault `wrong`; largest jump of `jumping`"};
  Param gnss_velocity_fault_scale{1, "", -10, 10, "scale factor of the fault `wrong`"};
  Choice<SensorFault> mag_fault{SensorFault::none, "fault of the magnetometer"};
  Vector<Body> mag_fault_size{
      {2e-5, 0, 0}, "T", -1e-3, 1e-3, "offset of the fault `wrong`; largest jump of `jumping`"};
  Param mag_fault_scale{1, "", -10, 10, "scale factor of the fault `wrong`"};
  Choice<SensorFault> baro_fault{SensorFault::none, "fault of the barometer"};
  Param baro_fault_size{240, "Pa", -1e5, 1e5,
                        "offset of the fault `wrong`; largest jump of `jumping`; 240 Pa is 20 m too low"};
  Param baro_fault_scale{1, "", -10, 10, "scale factor of the fault `wrong`"};
  Choice<SensorFault> pitot_fault{SensorFault::none, "fault of the pitot"};
  Param pitot_fault_size{50, "Pa", -1e4, 1e4, "offset of the fault `wrong`; largest jump of `jumping`"};
  Param pitot_fault_scale{1, "", -10, 10, "scale factor of the fault `wrong`"};
  Param fault_noise{10, "", 1, 1000,
                    "factor on the standard deviation of the noise of a sensor with the fault `noisy`"};
  Param fault_time{2, "s", 0.001, 3600,
                   "time constant of the fault `slow`; time between two jumps of `jumping`"};
  Param fault_ramp{0, "s", 0, 3600, "rise time of a fault to its size"};
};

struct BodyFaultParams {
  Choice<SurfaceFault> aileron_fault{SurfaceFault::none, "fault of the ailerons and their servo"};
  Choice<SurfaceFault> elevator_fault{SurfaceFault::none, "fault of the elevator and its servo"};
  Choice<SurfaceFault> rudder_fault{SurfaceFault::none, "fault of the rudder and its servo"};
  Param fault_speed{0.1, "", 0.001, 1, "factor on the speed of a servo with the fault `slow`"};
  Choice<EngineFault> engine_fault{EngineFault::none, "fault of the motor and its controller"};
  Param engine_fault_share{0.5, "", 0, 1, "share of the voltage of a motor with the fault `weak`"};
  Choice<BatteryFault> battery_fault{BatteryFault::none,
                                     "fault of the battery; empty: the voltage falls to zero"};
  Param battery_fault_time{30, "s", 0.1, 36000, "duration of the voltage fall of an empty battery"};
  Param icing_rate{0, "1/s", -1, 1, "growth rate of the ice on wing and tail; below 0: melting"};
  Param icing_lift{0.7, "", 0.1, 1, "factor on the lift slope with full ice"};
  Param icing_drag{2.3, "", 1, 20, "factor on the parasite drag with full ice"};
  Param icing_stall{0.7, "", 0.1, 1, "factor on the stall angle of attack with full ice"};
  Param icing_control{0.7, "", 0.1, 1, "factor on the surface effectiveness with full ice"};
};

struct FaultParams {
  SensorFaultParams sensors_that_fail;
  BodyFaultParams body_that_fails;
};

}  // namespace fulmar::sim
