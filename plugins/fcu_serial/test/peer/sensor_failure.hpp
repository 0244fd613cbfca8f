// SPDX-License-Identifier: BSD-3-Clause
// One sensor of the board that fails for a while: silent, stuck, zero, or off by a step.
#pragma once
#include <cstdint>

#include "firmware.hpp"

namespace fulmar::fcu::peer {

enum class Failing : std::uint8_t {
  none,
  imu_stuck,
  imu_zero,
  mag_silent,
  baro_silent,
  baro_stuck,
  baro_step,
  pitot_silent,
  pitot_stuck,
  pitot_step
};

class SensorFailure {
 public:
  static constexpr double baro_step_pa = -240, pitot_step_pa = 120;  ///< 22 m higher, 5 m/s faster

  /// Before the sensors are read: a sensor that has no new sample keeps its own last one.
  void undo(Inputs& in) {
    in.baro_pa -= baro_pa_;
    in.pitot_pa -= pitot_pa_;
    baro_pa_ = pitot_pa_ = 0;
  }
  /// After it.
  void act(Failing what, bool now, Inputs& in) {
    if (!now) {
      held_ = in;
      return;
    }
    switch (what) {
      case Failing::none: break;
      case Failing::imu_stuck:
        in.accel = held_.accel;
        in.gyro = held_.gyro;
        break;
      case Failing::imu_zero: in.accel = in.gyro = {}; break;
      case Failing::mag_silent: in.mag_works = false; break;
      case Failing::baro_silent: in.baro_works = false; break;
      case Failing::baro_stuck: baro_pa_ = held_.baro_pa - in.baro_pa; break;
      case Failing::baro_step: baro_pa_ = baro_step_pa; break;
      case Failing::pitot_silent: in.pitot_works = false; break;
      case Failing::pitot_stuck: pitot_pa_ = held_.pitot_pa - in.pitot_pa; break;
      case Failing::pitot_step: pitot_pa_ = pitot_step_pa; break;
    }
    in.baro_pa += baro_pa_;
    in.pitot_pa += pitot_pa_;
  }

 private:
  Inputs held_;
  double baro_pa_ = 0, pitot_pa_ = 0;
};

}  // namespace fulmar::fcu::peer
