// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::path_messages {

inline constexpr MessageText airspeed_beyond_airframe{
    "path.airspeed_beyond_airframe",
    {"airspeed", "lowest", "highest"},
    "{airspeed} m/s is beyond the airframe's {lowest} to {highest} m/s, flown at the limit"};
inline constexpr MessageText airspeed_not_valid{"path.airspeed_not_valid",
                                                "the airspeed is negative or not finite"};
inline constexpr MessageText airspeed_out_of_range{"path.airspeed_out_of_range", "airspeed is 3 to 300 m/s"};
inline constexpr MessageText circuit_of_one{
    "path.circuit_of_one", "the plan has one waypoint, which makes no circuit: give more, or end: orbit"};
inline constexpr MessageText coordinate_not_finite{"path.coordinate_not_finite",
                                                   "a coordinate is not finite"};
inline constexpr MessageText course_not_finite{"path.course_not_finite", "the course is not finite"};
inline constexpr MessageText crosswind_landing{
    "path.crosswind_landing", {"wind"}, "crosswind of {wind} m/s is beyond the limit: landing all the same"};
inline constexpr MessageText crosswind_waiting{
    "path.crosswind_waiting", {"wind"}, "crosswind of {wind} m/s is beyond the limit: circling, take over"};
inline constexpr MessageText edit_kind_unknown{"path.edit_kind_unknown", "no such kind of edit"};
inline constexpr MessageText edit_refused{
    "path.edit_refused", {"id", "reason"}, "plan edit {id} refused: {reason}"};
inline constexpr MessageText edit_refused_again{"path.edit_refused_again",
                                                {"id", "reason", "count"},
                                                "plan edit {id} refused: {reason} (and {count} before)"};
inline constexpr MessageText edit_without_id_refused{
    "path.edit_without_id_refused", {"reason"}, "plan edit refused: {reason}"};
inline constexpr MessageText edit_without_id_refused_again{
    "path.edit_without_id_refused_again",
    {"reason", "count"},
    "plan edit refused: {reason} (and {count} before)"};
inline constexpr MessageText edits_lost{"path.edits_lost", "edits were lost on the way"};
inline constexpr MessageText end_unknown{"path.end_unknown", "no such end of a plan"};
inline constexpr MessageText final_approach{"path.final_approach", "the final approach"};
inline constexpr MessageText glide_slope_steep{
    "path.glide_slope_steep",
    {"slope", "airspeed", "sink", "limit", "most"},
    "{slope} rad at the {airspeed} m/s of the approach sinks by {sink} m/s in still air, and the airframe's "
    "limits.sink_rate_max is {limit} m/s; at most {most} rad"};
inline constexpr MessageText go_around_commanded{
    "path.go_around_commanded", {"height"}, "go-around at {height} m, as commanded"};
inline constexpr MessageText go_around_cross_track{
    "path.go_around_cross_track", {"distance"}, "go-around: {distance} m off the centre line"};
inline constexpr MessageText go_around_flare{
    "path.go_around_flare", {"time"}, "go-around: no touch-down in {time} s of flare, the height is wrong"};
inline constexpr MessageText go_around_position{
    "path.go_around_position", {"height"}, "go-around: no valid position or height at {height} m"};
inline constexpr MessageText go_around_slope{
    "path.go_around_slope", {"height"}, "go-around: off the glide slope at {height} m"};
inline constexpr MessageText group_incomplete{"path.group_incomplete",
                                              "its group was not complete when another began"};
inline constexpr MessageText group_outdated{"path.group_outdated",
                                            "the plan was changed while its group came"};
inline constexpr MessageText group_refused{"path.group_refused", "another edit of its group was refused"};
inline constexpr MessageText group_size_missing{"path.group_size_missing",
                                                "an edit of a group says of how many: group_size"};
inline constexpr MessageText group_sizes_differ{"path.group_sizes_differ",
                                                "the edits of its group differ in group_size"};
inline constexpr MessageText index_beyond_end{"path.index_beyond_end",
                                              "the index is beyond the end of the plan"};
inline constexpr MessageText landing_above_ceiling{
    "path.landing_above_ceiling",
    {"height", "ceiling"},
    "the circle onto the final approach is {height} m high, the ceiling {ceiling} m"};
inline constexpr MessageText landing_circle{"path.landing_circle", "the circle onto the final approach"};
inline constexpr MessageText landing_near_fence{
    "path.landing_near_fence",
    {"part", "north", "east", "distance", "margin"},
    "{part}, {north} m north, {east} m east, leaves {distance} m to the fence, of {margin} m; move the "
    "fence, or set final_length, circle_radius, circle"};
inline constexpr MessageText landing_outside_fence{
    "path.landing_outside_fence",
    {"part", "north", "east", "distance"},
    "{part}, {north} m north, {east} m east, lies {distance} m outside of the fence; move the fence, or set "
    "final_length, circle_radius, circle"};
inline constexpr MessageText latitude_out_of_range{"path.latitude_out_of_range",
                                                   "the latitude is beyond 90 degrees"};
inline constexpr MessageText longitude_out_of_range{"path.longitude_out_of_range",
                                                    "the longitude is beyond 360 degrees"};
inline constexpr MessageText origin_too_far{"path.origin_too_far", "more than 100 km from the origin"};
inline constexpr MessageText plan_airspeed_not_positive{"path.plan_airspeed_not_positive",
                                                        "the plan's airspeed must be positive"};
inline constexpr MessageText plan_empty{
    "path.plan_empty",
    "the plan has no waypoints; to change one thing in a plan, name it, as in plan.turn_radius"};
inline constexpr MessageText plan_full{"path.plan_full", "the plan is full: 1024 waypoints"};
inline constexpr MessageText plan_turn_radius_small{"path.plan_turn_radius_small",
                                                    "the plan's turn_radius must be at least 1 m"};
inline constexpr MessageText plan_without_waypoints{"path.plan_without_waypoints",
                                                    "the plan has no waypoints"};
inline constexpr MessageText position_back{"path.position_back",
                                           "the position is back: the path is flown again"};
inline constexpr MessageText position_lost{
    "path.position_lost", "no position: circle to the right, it drifts with the wind. Pilot: take over"};
inline constexpr MessageText roll_long{
    "path.roll_long", {"time"}, "still rolling {time} s after the touch-down: brake by hand"};
inline constexpr MessageText runway{"path.runway", "the runway"};
inline constexpr MessageText runway_length_missing{"path.runway_length_missing", "needs a length"};
inline constexpr MessageText runway_missing{
    "path.runway_missing",
    "there is no runway to land on; give one here or in the plan, as {{north, east, up, heading, length} or "
    "{{lat, lon, alt_msl, heading, length}"};
inline constexpr MessageText runway_place_ambiguous{"path.runway_place_ambiguous",
                                                    "needs either north, east, up or lat, lon, alt_msl"};
inline constexpr MessageText runway_short_landing{
    "path.runway_short_landing",
    {"needed"},
    "the landing takes {needed} m, more than the runway: landing all the same"};
inline constexpr MessageText runway_short_waiting{
    "path.runway_short_waiting",
    {"needed"},
    "the landing takes {needed} m, more than the runway: circling, take over"};
inline constexpr MessageText runway_too_short{
    "path.runway_too_short",
    {"length", "needed"},
    "{length} m is too short; aim, flare and roll take {needed} m in still air"};
inline constexpr MessageText setting_unknown{"path.setting_unknown", "no such setting of a plan"};
inline constexpr MessageText turn_radius_out_of_range{"path.turn_radius_out_of_range",
                                                      "turn_radius is 1 m to 100 km"};
inline constexpr MessageText turn_radius_tight{
    "path.turn_radius_tight",
    {"radius", "bank", "limit", "least"},
    "turn_radius {radius} m takes {bank} deg of bank; roll_max {limit} deg gives {least} m"};
inline constexpr MessageText waypoint_above_ceiling{
    "path.waypoint_above_ceiling",
    {"number", "height"},
    "waypoint {number} of the plan is at {height} m, above the ceiling of the fence"};
inline constexpr MessageText waypoint_after_close{"path.waypoint_after_close",
                                                  "less than 1 m from the waypoint after it"};
inline constexpr MessageText waypoint_before_close{"path.waypoint_before_close",
                                                   "less than 1 m from the waypoint before it"};
inline constexpr MessageText waypoint_below_floor{
    "path.waypoint_below_floor",
    {"number", "height"},
    "waypoint {number} of the plan is at {height} m, below the floor of the fence"};
inline constexpr MessageText waypoint_id_unknown{"path.waypoint_id_unknown",
                                                 "there is no waypoint of this id"};
inline constexpr MessageText waypoint_index_unknown{"path.waypoint_index_unknown",
                                                    "there is no waypoint of this index; the first is 0"};
inline constexpr MessageText waypoint_kind_unknown{"path.waypoint_kind_unknown", "no such kind of waypoint"};
inline constexpr MessageText waypoint_low{"path.waypoint_low",
                                          "lower than the planner allows: its parameter 'lowest'"};
inline constexpr MessageText waypoint_not_valid{
    "path.waypoint_not_valid", {"number", "reason"}, "waypoint {number} of the plan: {reason}"};
inline constexpr MessageText waypoint_outside_fence{
    "path.waypoint_outside_fence",
    {"number", "distance"},
    "waypoint {number} of the plan is {distance} m outside the fence"};
inline constexpr MessageText waypoint_place_ambiguous{
    "path.waypoint_place_ambiguous",
    {"number"},
    "waypoint {number} of the plan needs either north, east, up or lat, lon, alt_msl"};
inline constexpr MessageText waypoint_place_missing{
    "path.waypoint_place_missing", {"number", "keys"}, "waypoint {number} of the plan needs {keys}"};
inline constexpr MessageText waypoints_close{"path.waypoints_close",
                                             "two waypoints would be less than 1 m apart"};

}  // namespace fulmar::path_messages
