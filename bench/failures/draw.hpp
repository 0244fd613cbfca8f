// SPDX-License-Identifier: BSD-3-Clause
// Random cases of bench_failures and failures_test: a shipped mission and a failure in it.
#pragma once
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "fulmar/msg/fault_request.hpp"

namespace fulmar::failing_flights {

/// A live parameter of the simulated aircraft, with its values before and after.
struct Setting {
  std::string name;
  double value[3] = {0, 0, 0};
  double back[3] = {0, 0, 0};
};

struct Drawn {
  std::string mission;               ///< the name of a shipped one
  std::string group, failure;        ///< "sensor", "baro stuck"
  std::vector<std::string> names{};  ///< a matching reason contains one of these
  FaultRequest fault{};              ///< kind none: `settings` count
  std::vector<Setting> settings{};
  double at_s = 0, lasts_s = 0;  ///< since the lift-off; lasts 0: permanent
  double grows_s = 0;            ///< time in which the first setting grows from zero to its value
};

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double between(double a, double b) { return a + (b - a) * unit(); }
  bool one_in(double n) { return unit() * n < 1; }
  template <class T>
  const T& one_of(const std::vector<T>& list) {
    return list[std::min(list.size() - 1,
                         static_cast<std::size_t>(unit() * static_cast<double>(list.size())))];
  }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::mt19937_64 random_;
};

struct Part {
  FaultTarget what;
  const char* name;
  std::vector<std::string> names;  ///< parts of a reason that name it, as a sentence or a code
};

inline const std::vector<Part>& sensors() {
  using T = FaultTarget;
  static const std::vector<std::string> inertial{"gyro", "accelerometer", "attitude", "inertial_wrong",
                                                 "estimator_failed"},
      satellites{"GNSS", "position lost", "no position", "position_lost", "gnss_lost"};
  static const std::vector<Part> list{{T::gyro, "gyro", inertial},
                                      {T::accel, "accel", inertial},
                                      {T::gnss_position, "gnss_position", satellites},
                                      {T::gnss_velocity, "gnss_velocity", satellites},
                                      {T::mag, "mag", {"magnetometer"}},
                                      {T::baro, "baro", {"barometer"}},
                                      {T::pitot, "pitot", {"pitot", "airspeed"}}};
  return list;
}
inline const std::vector<Part>& surfaces() {
  using T = FaultTarget;
  static const std::vector<Part> list{
      {T::aileron, "aileron", {"aileron", "excessive attitude", "attitude_excessive", "bank_off"}},
      {T::elevator,
       "elevator",
       {"elevator", "excessive attitude", "attitude_excessive", "pitch_off", "control of height"}},
      {T::rudder, "rudder", {"rudder", "excessive attitude", "attitude_excessive"}}};
  return list;
}

inline void draw_sensor(Drawn& d, Chance& chance) {
  static const std::vector<std::pair<FaultKind, const char*>> kinds{
      {FaultKind::off, "off"},   {FaultKind::stuck, "stuck"}, {FaultKind::wrong, "wrong"},
      {FaultKind::slow, "slow"}, {FaultKind::noisy, "noisy"}, {FaultKind::jumping, "jumping"}};
  static const std::vector<double> full{0.1, 4, 60, 8, 4e-5, 400, 80};  // offsets, in each sensor's unit
  const Part& part = chance.one_of(sensors());
  const auto& [kind, word] = chance.one_of(kinds);
  d.group = "sensor";
  d.failure = part.name + std::string(" ") + word;
  d.names = part.names;
  d.fault.what = part.what;
  d.fault.kind = kind;
  const double strength = chance.between(0.3, 1);
  if (kind == FaultKind::wrong || kind == FaultKind::jumping)
    d.fault.size_ratio = strength * full[static_cast<std::size_t>(part.what)];
  if (kind == FaultKind::noisy) d.fault.size_ratio = 20 * strength;
  if (kind == FaultKind::slow) d.fault.size_ratio = 3 * strength;
  if (chance.one_in(2)) d.lasts_s = chance.between(2, 60);
}

inline void draw_actuator(Drawn& d, Chance& chance) {
  static const std::vector<std::pair<FaultKind, const char*>> kinds{
      {FaultKind::stuck, "stuck"},
      {FaultKind::hardover_positive, "hardover_positive"},
      {FaultKind::hardover_negative, "hardover_negative"},
      {FaultKind::slow, "slow"},
      {FaultKind::free, "free"},
      {FaultKind::lost, "lost"}};
  d.group = "actuator";
  const double which = chance.between(0, 6);
  if (which < 3) {
    const Part& part = chance.one_of(surfaces());
    const auto& [kind, word] = chance.one_of(kinds);
    d.failure = part.name + std::string(" ") + word;
    d.names = part.names;
    d.fault.what = part.what;
    d.fault.kind = kind;
    if (chance.one_in(3)) d.lasts_s = chance.between(0.5, 10);
  } else if (which < 4.5) {
    const bool off = chance.one_in(2);
    d.failure = off ? "engine off" : "engine weak";
    d.names = {"motor", "thrust", "engine_"};
    d.fault.what = FaultTarget::engine;
    d.fault.kind = off ? FaultKind::off : FaultKind::weak;
    if (!off) d.fault.size_ratio = chance.between(0.2, 0.8);
  } else if (which < 5.5) {
    d.failure = "battery empty";
    d.names = {"battery", "motor", "thrust", "engine_"};
    d.fault.what = FaultTarget::battery;
    d.fault.kind = FaultKind::empty;
    d.fault.size_ratio = chance.between(10, 300);
  } else {
    d.failure = "icing";
    d.names = {"ice. ", "engine_weak", "stall", "control of height"};
    d.fault.what = FaultTarget::icing;
    d.fault.kind = FaultKind::growing;
    d.fault.size_ratio = chance.between(0.005, 0.05);
  }
}

inline void draw_link(Drawn& d, Chance& chance) {
  d.group = "link";
  if (chance.one_in(2)) {
    d.failure = "radio off";
    d.names = {"radio"};
    d.fault.what = FaultTarget::radio;
    d.fault.kind = FaultKind::off;
    if (chance.one_in(2)) d.lasts_s = chance.between(2, 60);
    return;
  }
  d.failure = "gap of all samples";
  d.names = {"gyro", "accelerometer", "attitude", "inertial_wrong", "estimator_failed"};
  for (const char* works : {"imu_works", "gnss_works", "mag_works", "baro_works", "pitot_works"})
    d.settings.push_back({works, {0, 0, 0}, {1, 0, 0}});
  d.lasts_s = chance.between(0.2, 6);
}

inline void draw_wind(Drawn& d, Chance& chance) {
  d.group = "wind";
  const double to = chance.between(0, 6.283);
  if (chance.one_in(3)) {
    const double peak = chance.between(5, 16);
    d.failure = "gust";
    d.names = {"above the limit",    "wind_excessive",  "stall",    "excessive attitude",
               "attitude_excessive", "off its command", "bank_off", "pitch_off"};
    d.settings.push_back({"gust", {0, peak * std::cos(to), peak * std::sin(to)}, {0, 0, 0}});
    d.settings.push_back({"gust_now", {1, 0, 0}, {0, 0, 0}});
    d.lasts_s = 20;
    return;
  }
  const double speed = chance.between(8, 22);
  d.failure = "wind";
  d.names = {"m/s, above the limit",
             "wind_excessive",
             "too much wind",
             "the top airspeed",
             "drift",
             "wind of",
             "crosswind"};
  d.settings.push_back({"wind_ned", {speed * std::cos(to), speed * std::sin(to), 0}, {3.5355, -3.5355, 0}});
  d.grows_s = chance.between(5, 20);
  if (chance.one_in(2)) d.lasts_s = chance.between(20, 120);
}

inline void draw_pilot(Drawn& d, Chance& chance) {
  d.group = "pilot";
  d.failure = "takes over";
  d.names = {"the pilot flies", "pilot_flies"};
  for (const char* stick : {"stick_roll", "stick_pitch"})
    d.settings.push_back({stick, {chance.between(-0.2, 0.2), 0, 0}, {0, 0, 0}});
  d.settings.push_back({"stick_throttle", {chance.between(0, 1), 0, 0}, {0, 0, 0}});
  d.settings.push_back({"pilot_flies", {1, 0, 0}, {0, 0, 0}});
  d.lasts_s = chance.between(1, 12);
}

inline Drawn draw(unsigned seed) {
  static const std::vector<std::string> missions{
      "hourglass",   "orbit",       "return_home", "runway_to_runway",
      "hand_launch", "two_schemes", "lla",         "two_filters"};
  Chance chance(seed);
  Drawn d;
  d.mission = chance.one_of(missions);
  const double which = chance.between(0, 10);
  if (which < 4)
    draw_sensor(d, chance);
  else if (which < 7)
    draw_actuator(d, chance);
  else if (which < 8)
    draw_link(d, chance);
  else if (which < 9)
    draw_wind(d, chance);
  else
    draw_pilot(d, chance);
  d.at_s = chance.between(1, 90);
  return d;
}

}  // namespace fulmar::failing_flights
