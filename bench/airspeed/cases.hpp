// SPDX-License-Identifier: BSD-3-Clause
// Lost sensors in the flights of bench_airspeed, and the bounds of the airspeed meanwhile.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace fulmar::lost_airspeed {

struct Case {
  std::string name{}, words{};
  double lost_s = 60;  ///< duration of the loss of the pitot
  double from_s = 85;  ///< time since arming
  bool gnss = true;    ///< the receiver is available
  // time from the loss to a motor failure, which lasts as long as the loss; -1: never
  double engine_s = -1;
  double engine_for_s = 1e9;
  double ramp_s = 0;      ///< transition time
  double left_ratio = 0;  ///< remaining share of the voltage
  std::string turbulence = "light";
  // With the model, m/s and shares of the time:
  double rms_mps = 0.8, max_mps = 3.5, within_2 = 0.9;
  bool modelled = true;     ///< expected for at least 0.95 of the time
  double max_modelled = 1;  ///< share of the time, at most
};

inline std::vector<Case> cases() {
  std::vector<Case> c;
  c.push_back({.name = "both_60", .words = "tube and receiver, 60 s"});
  c.push_back({.name = "both_120", .words = "tube and receiver, 120 s", .lost_s = 120});
  c.push_back({.name = "moderate_120",
               .words = "the same in moderate turbulence",
               .lost_s = 120,
               .turbulence = "moderate"});
  c.push_back({.name = "tube_120", .words = "the tube alone, 120 s", .lost_s = 120, .gnss = false});
  c.push_back({.name = "after_start",
               .words = "both, 12 s after arming, 60 s: nothing is learnt yet",
               .from_s = 12,
               .rms_mps = 2,
               .max_mps = 6,
               .modelled = false,
               .max_modelled = 0});
  c.push_back({.name = "motor_off",
               .words = "both, and 10 s later the motor stops for 15 s",
               .lost_s = 30,
               .engine_s = 10,
               .engine_for_s = 15,
               .rms_mps = 1.5,
               .max_mps = 5,
               .modelled = false,
               .max_modelled = 0.36});
  c.push_back({.name = "motor_off_at_once",
               .words = "both, 30 s, and the motor at the same time, 15 s",
               .lost_s = 30,
               .engine_s = 0,
               .engine_for_s = 15,
               .rms_mps = 1.5,
               .max_mps = 5,
               .modelled = false,
               .max_modelled = 0.05});
  c.push_back({.name = "motor_weak",
               .words = "both, and from 10 s on the motor gets 0.7 of its voltage",
               .engine_s = 10,
               .ramp_s = 0.1,
               .left_ratio = 0.7,
               .rms_mps = 2,
               .max_mps = 8,
               .within_2 = 0.92,
               .modelled = false,
               .max_modelled = 0.5});
  c.push_back({.name = "motor_fades",
               .words = "both, and from 10 to 20 s it falls to 0.7",
               .engine_s = 10,
               .ramp_s = 10,
               .left_ratio = 0.7,
               .rms_mps = 2,
               .max_mps = 8,
               .within_2 = 0.92,
               .modelled = false});
  c.push_back({.name = "motor_a_little_weak",
               .words = "both, and from 10 to 20 s it falls to 0.9",
               .engine_s = 10,
               .ramp_s = 10,
               .left_ratio = 0.9,
               .rms_mps = 1.3,
               .max_mps = 3.5,
               .within_2 = 0.85,
               .modelled = false});
  return c;
}

inline Case case_of(const std::string& name) {
  std::string valid;
  for (const Case& c : cases()) {
    if (c.name == name) return c;
    valid += (valid.empty() ? "" : ", ") + c.name;
  }
  throw std::runtime_error("no case '" + name + "'; valid: " + valid);
}

}  // namespace fulmar::lost_airspeed
