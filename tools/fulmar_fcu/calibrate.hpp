// SPDX-License-Identifier: BSD-3-Clause
// The controller's own calibrations: started by a command, done some seconds later, told by a text and by
// changed parameters. What the firmware does and says: rosflight_firmware 2.0, sensors.cpp and
// controller.cpp.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/params.hpp"

namespace fulmar::fcu {

struct Calibration {
  const char* name;
  Command command;
  const char* prepare;              ///< what the pilot sees to first
  std::vector<std::string> params;  ///< what it sets
  std::vector<std::string> about;   ///< a text about this one has one of these; none: any text
  std::vector<std::string> good;    ///< parts of the texts that say it is done
  std::vector<std::string> bad;     ///< ... that it failed
  int usual_s, limit_s;
  bool zeroes;   ///< it begins by setting `params` to zero: nonzero ones are its result
  bool repeats;  ///< after a failure it begins again by itself
};

/// imu, gyro, rc, baro, airspeed. nullptr: no such one.
const Calibration* find_calibration(const std::string& name);

struct Calibrated {
  std::vector<Param> before, after;
};
/// It failed, and what was set before could not be put back.
struct BiasesLost : Error {
  BiasesLost(const Diagnostic& text, std::vector<Param> what) : Error(text), former(std::move(what)) {}
  std::vector<Param> former;
};
/// Runs it to its end. Throws Error: armed, refused, failed (with the firmware's words), or no sign of its
/// end within the limit. A failed calibration of gyroscope or accelerometer leaves biases of zero, and the
/// mean of whatever was done to the aircraft: the former ones are put back, or thrown as BiasesLost.
Calibrated calibrate(Client& client, const Calibration& what,
                     const std::function<void(double elapsed_s)>& progress = {});

}  // namespace fulmar::fcu
