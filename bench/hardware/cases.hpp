// SPDX-License-Identifier: BSD-3-Clause
// Cases of bench_hardware: missions, failures in flight, and the required behaviour.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace fulmar::hardware_bench {

/// One change, with a delay after the begin of a phase, after "landed", or after the first command: "start".
struct Event {
  std::string when;
  double after_s = 0;
  std::string param;   ///< of the controller's script; with `lasts_s` its name without _from and _until
  double lasts_s = 0;  ///< 0: `value` is set
  double value = 0;
};

struct Case {
  std::string mission = "return_home", name = "as planned";
  double height_off_m = 0;  ///< error of the height of the runway in the mission, upwards
  std::vector<std::pair<std::string, std::string>> set;
  std::vector<Event> events;
  std::vector<std::string> phases;    ///< required phases, in this order
  std::vector<std::string> never;     ///< excluded phases
  std::vector<std::string> reported;  ///< parts of required lines, soon after the last event; a|b: either
  double reported_within_s = 15;
  double watch_s = 30;  ///< time of the evaluation after the landing
  bool tunes = false;   ///< the autotune must finish
};

inline constexpr double for_ever_s = 1e8;

/// A failure in cruise, its report, and a landing in spite of it.
inline Case in_cruise(const std::string& mission, const std::string& name, const std::string& fails,
                      double lasts_s, std::vector<std::string> reported) {
  Case c;
  c.mission = mission;
  c.name = name;
  c.set = {{"craft.fails", fails}};
  c.events = {{"cruise", 20, "fails", lasts_s}};
  c.reported = std::move(reported);
  c.never = {"glide"};
  return c;
}

inline std::vector<Case> landings(const std::string& mission) {
  std::vector<Case> all;
  for (const double off : {0.0, 4.0, -4.0, 6.0, -6.0}) {
    Case c;
    c.mission = mission;
    c.height_off_m = off;
    c.never = {"wait", "glide"};
    if (off != 0) c.name = "runway given " + std::to_string(static_cast<int>(off)) + " m off";
    all.push_back(c);
  }
  const auto ground = [&](const char* name, Event event) {
    Case c;
    c.mission = mission;
    c.name = name;
    c.events = {std::move(event)};
    c.never = {"wait", "glide"};
    all.push_back(c);
  };
  ground("no fix for 20 s, 5 s after the landing", {"landed", 5, "no_fix", 20});
  ground("no fix for 3 s in the take-off run", {"start", 6, "no_fix", 3});
  Case late;
  late.mission = mission;
  late.name = "armed 60 s after the start";
  late.set = {{"craft.arm_at", "60 s"}};
  all.push_back(late);
  return all;
}

/// The motor works, but does not get the commanded throttle.
inline std::vector<Case> motor_is_whole(const std::string& mission) {
  std::vector<Case> all;
  const auto add = [&](const char* name, Event event) {
    Case c;
    c.mission = mission;
    c.name = name;
    c.events = {std::move(event)};
    c.never = {"glide"};
    c.set = {{"craft.pilot_throttle", "0"}};
    all.push_back(c);
  };
  add("the pilot flies for 5 s with closed throttle", {"cruise", 20, "pilot", 5});
  add("radio lost for 5 s, flagged", {"cruise", 20, "rc_lost", 5});
  add("radio silent for 3 s", {"cruise", 20, "rc_silent", 3});
  return all;
}

inline std::vector<Case> sensors(const std::string& mission) {
  const char* calls_pilot = "take over|safety.attitude_unreliable|safety.inertial_wrong";
  return {in_cruise(mission, "inertial unit stuck for 3 s", "imu_stuck", 3, {calls_pilot}),
          in_cruise(mission, "inertial unit zero for 2 s", "imu_zero", 2, {calls_pilot}),
          in_cruise(mission, "magnetometer silent", "mag_silent", for_ever_s,
                    {"magnetometer silent|magnetometer, safety.silent"}),
          in_cruise(mission, "barometer silent", "baro_silent", for_ever_s,
                    {"barometer silent|barometer, safety.silent"}),
          in_cruise(mission, "barometer stuck", "baro_stuck", for_ever_s, {"barometer"}),
          in_cruise(mission, "barometer 22 m too high", "baro_step", for_ever_s, {"barometer"}),
          in_cruise(mission, "pitot tube silent", "pitot_silent", for_ever_s, {"pitot tube"}),
          in_cruise(mission, "pitot tube stuck", "pitot_stuck", for_ever_s, {"pitot tube"}),
          in_cruise(mission, "pitot tube 120 Pa too high", "pitot_step", for_ever_s, {"pitot tube"})};
}

/// Missions that end in the air: the pilot takes over and lands.
inline Case of_pilot_landing(const std::string& mission, const std::string& name) {
  Case c;
  c.mission = mission;
  c.name = name;
  c.set = {{"craft.pilot_lands", "true"}};
  return c;
}

inline std::vector<Case> experiments() {
  std::vector<Case> all;
  Case tune = of_pilot_landing("autotune", "tunes, the pilot lands");
  tune.events = {{"level", 20, "pilot", for_ever_s}};
  tune.phases = {"takeoff", "cruise", "tune", "level"};
  tune.tunes = true;
  all.push_back(tune);
  Case taken = of_pilot_landing("autotune", "the pilot takes over while it tunes, and lands");
  taken.events = {{"tune", 5, "pilot", for_ever_s}};
  taken.phases = {"takeoff", "cruise", "tune"};
  taken.reported = {"old gains"};
  all.push_back(taken);
  Case excite = of_pilot_landing("excitation", "all four signals, the pilot lands");
  excite.events = {{"level", 20, "pilot", for_ever_s}};
  excite.phases = {"hold",       "takeoff",       "cruise",      "pitch_doublet",
                   "roll_chirp", "elevator_3211", "height_step", "level"};
  all.push_back(excite);
  Case broken = of_pilot_landing("excitation", "the pilot takes over in the chirp, and lands");
  broken.events = {{"roll_chirp", 10, "pilot", for_ever_s}};
  broken.phases = {"takeoff", "cruise", "pitch_doublet", "roll_chirp", "level"};
  broken.never = {"elevator_3211", "height_step"};
  all.push_back(broken);
  return all;
}

/// All positions of the three switches, 15 s each, and back; the pilot weaves.
inline std::vector<Case> by_stick() {
  Case c = of_pilot_landing("manual", "each level of the sticks, the pilot lands");
  c.set.push_back({"craft.manual", "true"});
  const std::vector<std::pair<const char*, double>> moves{{"aux2", 0}, {"aux2", 1},  {"aux3", 0}, {"aux3", 1},
                                                          {"aux1", 1}, {"aux2", -1}, {"aux1", -1}};
  double at_s = 25;
  for (const auto& [aux, to] : moves) {
    c.events.push_back({"cruise", at_s, aux, 0, to});
    at_s += 15;
  }
  c.events.push_back({"cruise", at_s, "pilot", for_ever_s});
  c.phases = {"takeoff", "cruise", "increments", "angles", "rates", "surfaces", "research", "cruise"};
  Case silent = of_pilot_landing("manual", "radio lost for 3 s while he flies angles");
  silent.set.push_back({"craft.manual", "true"});
  silent.events = {{"cruise", 25, "aux2", 0, 1},
                   {"cruise", 35, "rc_lost", 3},
                   {"cruise", 45, "aux2", 0, -1},
                   {"cruise", 55, "pilot", for_ever_s}};
  silent.phases = {"takeoff", "cruise", "angles", "cruise"};
  return {c, silent};
}

inline Case without_fix(const std::string& mission, double lasts_s) {
  Case c;
  c.mission = mission;
  c.name = "no fix for " + std::to_string(static_cast<int>(lasts_s)) + " s in the circuit";
  c.events = {{"cruise", 20, "no_fix", lasts_s}};
  c.reported = {"position"};
  c.reported_within_s = lasts_s;
  c.never = {"glide"};
  return c;
}

inline std::vector<Case> all_cases() {
  std::vector<Case> all;
  const auto add = [&](const std::vector<Case>& more) { all.insert(all.end(), more.begin(), more.end()); };
  for (const char* mission : {"runway_to_runway", "return_home", "safe"}) {
    add(landings(mission));
    add(motor_is_whole(mission));
  }
  for (const char* mission : {"runway_to_runway", "safe"}) add(sensors(mission));
  all.push_back(without_fix("runway_to_runway", 150));
  all.push_back(without_fix("safe", 60));
  add(experiments());
  add(by_stick());
  return all;
}

}  // namespace fulmar::hardware_bench
