// SPDX-License-Identifier: BSD-3-Clause
// Calibrations of the controller. A command starts them, they take some seconds, and a text and changed
// parameters show their end. Firmware: rosflight_firmware 2.0, sensors.cpp and controller.cpp.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/params.hpp"

namespace fulmar::fcu {

struct Calibration {
  const char* name;
  Command command;
  const char* prepare;              ///< preparation by the user
  std::vector<std::string> params;  ///< parameters of the result
  std::vector<std::string> about;   ///< a text about this calibration has one of these; none: any text
  std::vector<std::string> good;    ///< parts of the texts of a success
  std::vector<std::string> bad;     ///< ... of a failure
  int usual_s, limit_s;
  bool zeroes;   ///< it begins with zero in `params`: other values are its result
  bool repeats;  ///< after a failure it restarts by itself
};

/// imu, gyro, rc, baro, airspeed. nullptr for other names.
const Calibration* find_calibration(const std::string& name);

struct Calibrated {
  std::vector<Param> before, after;
};
/// The calibration failed, and the former values could not be restored.
struct BiasesLost : Error {
  BiasesLost(const Diagnostic& text, std::vector<Param> what) : Error(text), former(std::move(what)) {}
  std::vector<Param> former;
};
/// Runs a calibration to its end. Throws Error: armed, rejected, failed (with the text of the firmware), or
/// no end within the limit. After a failure of gyroscope or accelerometer the firmware leaves biases of zero
/// or a wrong mean: the former ones are restored, or reported in BiasesLost.
Calibrated calibrate(Client& client, const Calibration& what,
                     const std::function<void(double elapsed_s)>& progress = {});

}  // namespace fulmar::fcu
