// SPDX-License-Identifier: BSD-3-Clause
// All that bench_safety and safety_flights_test fly: what fails, what the aircraft does, where it ends.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "fulmar/msg/safety_state.hpp"

namespace fulmar::safety_flights {

/// Where a flight ends.
enum class End : std::uint8_t { on_ground, broken, aloft, stood };
inline const char* word(End end) {
  static constexpr std::array words{"on the ground, whole", "broken", "in the air", "did not take off"};
  return words[static_cast<std::size_t>(end)];
}

struct Row {
  std::string airframe{}, name{}, does{};  ///< action of the aircraft
  std::string failing{};                   ///< parameters of the plugin `failing`
  std::string sim{}, watch{};              ///< parameters of the aircraft and of the monitor
  bool relayed = false;                    ///< status and state reach the monitor through `failing`
  bool SafetyState::*cause = nullptr;      ///< required report; null: no report is allowed
  double reported_within_s = 10;
  double at_s = 60;
  bool may_leave = false;  ///< the fence; the reason is given with the row
  End end = End::on_ground;
  std::vector<std::string> phases{};  ///< required phases, in this order
  double south_m = 0, up_m = 0;       ///< side and ceiling of the fence, if not the usual ones
  double below_m = 0;                 ///< the failure occurs below this height of the landing, not at a time
  bool may_be_reported = false;       ///< a report is optional: it lands before
};

/// Before the take-off, in it, on final, and on the way back.
inline std::vector<Row> rows_of_takeoff_and_final(const std::string& a) {
  using S = SafetyState;
  return {
      {.airframe = a,
       .name = "motor, before the take-off",
       .does = "closes the throttle after 3 s",
       .failing = "what: engine, kind: off, at: 0",
       .end = End::stood,
       .phases = {"takeoff", "grounded"}},
      {.airframe = a,
       .name = "stands outside the fence",
       .does = "keeps the throttle closed",
       .sim = "start_north: 900 m",
       .end = End::stood,
       .phases = {"grounded"}},
      {.airframe = a,
       .name = "head wind of 10 m/s, standing",
       .does = "keeps the throttle closed",
       .sim = "wind_ned: [7.07, -7.07, 0]",
       .end = End::stood,
       .phases = {"grounded"}},
      {.airframe = a,
       .name = "pitot tube stuck, from before the take-off",
       .does = "returns home without it, lands",
       .failing = "what: pitot, kind: stuck, at: 0",
       .cause = &S::pitot_lost,
       .reported_within_s = 12,
       .at_s = 0,
       .phases = {"home", "fast_approach", "fast_flare", "roll_out"}},
      {.airframe = a,
       .name = "position, in the climb",
       .does = "flies home by reckoning, circles, descends without motor",
       .failing = "what: gnss_position, kind: off, at: 4",
       .cause = &S::gnss_lost,
       .at_s = 4,
       .phases = {"wait", "descend", "roll_out"}},
      {.airframe = a,
       .name = "position, in 7 m/s of wind",
       .does = "flies home by reckoning, circles, descends without motor",
       .failing = "what: gnss_position, kind: off",
       .sim = "wind_ned: [4.95, -4.95, 0]",
       .cause = &S::gnss_lost,
       .phases = {"wait", "descend", "roll_out"}},
      {.airframe = a,
       .name = "position and motor at once",
       .does = "glides",
       .failing = "what: gnss_position, kind: off, then_what: engine, then_kind: off, then_at: 60",
       .cause = &S::engine_failed,
       .phases = {"glide", "roll_out"}},
      {.airframe = a,
       .name = "radio, then the pitot tube while returning",
       .does = "returns home, lands without airspeed",
       .failing = "what: radio, kind: off, then_what: pitot, then_kind: off, then_at: 75",
       .cause = &S::pitot_lost,
       .reported_within_s = 20,
       .phases = {"home", "fast_approach", "fast_flare", "roll_out"}},
      {.airframe = a,
       .name = "radio, then the position while returning",
       .does = "returns home, by reckoning, descends in a circle without motor",
       .failing = "what: radio, kind: off, then_what: gnss_position, then_kind: off, then_at: 75",
       .cause = &S::gnss_lost,
       .reported_within_s = 20,
       .phases = {"home", "wait", "descend", "roll_out"}},
      {.airframe = a,
       .name = "position, below 11 m on final",
       .does = "finishes the landing",
       .failing = "what: gnss_position, kind: off, below: 11",
       .cause = &S::gnss_lost,
       .phases = {"approach", "flare", "roll_out"},
       .below_m = 11,
       .may_be_reported = true},
      {.airframe = a,
       .name = "radio and pitot tube, below 25 m on final",
       .does = "finishes the landing",
       .failing = "what: radio, kind: off, then_what: pitot, then_kind: off, then_at: 0.1, below: 25",
       .cause = &S::pitot_lost,
       .phases = {"approach", "flare", "roll_out"},
       .below_m = 25,
       .may_be_reported = true},
      {.airframe = a,
       .name = "motor, below 20 m on final",
       .does = "lands, short of the runway or on it",
       .failing = "what: engine, kind: off, below: 20",
       .cause = &S::engine_failed,
       .phases = {"approach", "roll_out"},
       .below_m = 20,
       .may_be_reported = true},
  };
}

inline std::vector<Row> rows_of(const std::string& a) {
  using S = SafetyState;
  const bool big = a != "anaconda", x8 = a == "x8";
  const std::string near = big ? "fence: {corners: [{north: 1200 m, east: -1300 m}, {north: 1200 m, east: "
                                 "600 m}, {north: -440 m, east: 600 m}, {north: -440 m, east: -1300 m}]}"
                               : "fence: {corners: [{north: 600 m, east: -700 m}, {north: 600 m, east: 350 "
                                 "m}, {north: -340 m, east: 350 m}, {north: -340 m, east: -700 m}]}";
  const std::string low = big ? "fence.ceiling: 90 m" : "fence.ceiling: 65 m";
  const std::string gale = x8    ? "wind_ned: [8.3, -8.3, 0]"
                           : big ? "wind_ned: [11.3, -11.3, 0]"
                                 : "wind_ned: [7.8, -7.8, 0]";
  std::vector<Row> rows{
      {.airframe = a,
       .name = "nothing",
       .does = "flies its circuit, lands",
       .phases = {"approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "moderate turbulence",
       .does = "flies its circuit",
       .sim = std::string("turbulence: moderate") + (x8 ? ", start_height: 100 m" : ""),
       .end = End::aloft,
       .phases = {"cruise"}},
      {.airframe = a,
       .name = "fence",
       .does = "turns back before it, circles at home, lands after 2 min",
       .watch = near,
       .cause = &S::fence,
       .reported_within_s = 1e9,
       .at_s = 0,
       .phases = {"home", "approach", "flare", "roll_out"},
       .south_m = big ? 440.0 : 340.0},
      {.airframe = a,
       .name = "ceiling",
       .does = "returns home and circles there, lands after 2 min",
       .watch = low,
       .cause = &S::fence,
       .reported_within_s = 1e9,
       .at_s = 0,
       .phases = {"home", "approach", "flare", "roll_out"},
       .up_m = big ? 90.0 : 65.0},
      {.airframe = a,
       .name = "position",
       .does = "circles for 2 min, descends in a circle without motor",
       .failing = "what: gnss_position, kind: off",
       .cause = &S::gnss_lost,
       .phases = {"wait", "descend", "roll_out"}},
      {.airframe = a,
       .name = "position, for 30 s",
       .does = "circles until it is back, flies on, lands",
       .failing = "what: gnss_position, kind: off, lasts: 30",
       .cause = &S::gnss_lost,
       .phases = {"wait", "cruise", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "pitot tube",
       .does = "returns home without it, lands",
       .failing = "what: pitot, kind: off",
       .cause = &S::pitot_lost,
       .phases = {"home", "fast_approach", "fast_flare", "roll_out"}},
      {.airframe = a,
       .name = "radio",
       .does = "returns home, circles there, lands after 2 min",
       .failing = "what: radio, kind: off",
       .cause = &S::radio_lost,
       .phases = {"home", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "radio, for 20 s",
       .does = "turns home, flies on when it is back, lands",
       .failing = "what: radio, kind: off, lasts: 20",
       .cause = &S::radio_lost,
       .phases = {"home", "cruise", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "link",
       .does = "returns home, circles there, lands after 2 min",
       .failing = "silent_at: 60",
       .relayed = true,
       .cause = &S::link_lost,
       .reported_within_s = 2,
       .phases = {"home", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "link, for 20 s",
       .does = "turns home, flies on when it is back, lands",
       .failing = "silent_at: 60, silent_for: 20",
       .relayed = true,
       .cause = &S::link_lost,
       .reported_within_s = 2,
       .phases = {"home", "cruise", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "attitude not valid, for 3 s",
       .does = "wings level, flies on, lands",
       .failing = "invalid_at: 60, invalid_for: 3",
       .relayed = true,
       .cause = &S::estimator_failed,
       .reported_within_s = 2,
       .phases = {"level", "cruise", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "battery, within 5 min",
       .does = "returns home and lands; empty on the way, it glides",
       .failing = "what: battery, kind: empty, size: 300",
       .cause = &S::battery_low,
       .reported_within_s = 60,
       .phases = {"home", "roll_out"}},
      {.airframe = a,
       .name = "motor",
       .does = "glides to the nearest place or into the wind",
       .failing = "what: engine, kind: off",
       .cause = &S::engine_failed,
       .reported_within_s = x8 ? 15.0 : 5.0,  // low thrust and low sink hide the failure
       .phases = {"glide", "roll_out"}},
      {.airframe = a,
       .name = "motor, in the climb",
       .does = "glides straight on, or into the wind",
       .failing = std::string("what: engine, kind: off, at: ") + (a == "aerosonde" ? "20" : "10"),
       .cause = &S::engine_failed,
       .reported_within_s = x8 ? 15.0 : 5.0,
       .at_s = a == "aerosonde" ? 20.0 : 10.0,
       .may_leave = a == "aerosonde",  // too low for a turn, and the fence ends 600 m ahead
       .phases = {"glide", "roll_out"}},
      {.airframe = a,
       .name = x8 ? "an elevon hard over, 1 s" : "ailerons hard over, 1 s",
       .does = "wings level, flies on, lands",
       .failing =
           std::string("what: aileron, lasts: 1, kind: ") + (x8 ? "hardover_negative" : "hardover_positive"),
       .cause = &S::attitude_excessive,
       .reported_within_s = 2,
       .phases = {"level", "cruise", "approach", "flare", "roll_out"}},
      {.airframe = a,
       .name = "too much wind",
       .does = "returns home, settles into the wind without motor",
       .sim = gale + (big ? ", start_height: 100 m" : ", start_height: 70 m"),
       .cause = &S::wind_excessive,
       .reported_within_s = 60,
       .at_s = 0,
       .phases = {"home", "settle", "roll_out"}},
  };
  rows.push_back({.airframe = a,
                  .name = "weak motor",
                  .does = "returns home and lands with what it still gives; without, it glides",
                  .failing = "what: engine, kind: weak",
                  .cause = &S::engine_weak,
                  .reported_within_s = 60,
                  .phases = big ? std::vector<std::string>{"cruise"} : std::vector<std::string>{"home"},
                  .may_be_reported = big});
  if (big) return rows;
  for (Row& row : rows_of_takeoff_and_final(a)) rows.push_back(std::move(row));
  // Two failures at once: the answer is that of the graver one.
  rows.push_back({.airframe = a,
                  .name = "radio, then the motor",
                  .does = "turns home, then glides",
                  .failing = "what: radio, kind: off, then_what: engine, then_kind: off, then_at: 70",
                  .cause = &S::engine_failed,
                  .reported_within_s = 15,
                  .phases = {"home", "glide", "roll_out"}});
  rows.push_back({.airframe = a,
                  .name = "pitot tube, then position",
                  .does = "turns home, then circles, descends in a circle without motor",
                  .failing = "what: pitot, kind: off, then_what: gnss_position, then_kind: off, then_at: 64",
                  .cause = &S::gnss_lost,
                  .reported_within_s = 12,
                  .phases = {"home", "wait", "descend", "roll_out"}});
  rows.push_back({.airframe = a,
                  .name = "fence, then the battery",
                  .does = "turns back before it, lands; empty on the way, it glides",
                  .failing = "what: battery, kind: empty, size: 450, at: 20",
                  .watch = near,
                  .cause = &S::battery_low,
                  .reported_within_s = 120,
                  .at_s = 20,
                  .phases = {"home", "roll_out"},
                  .south_m = 340.0});
  return rows;
}

}  // namespace fulmar::safety_flights
