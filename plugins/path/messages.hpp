// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::path_messages {

inline constexpr MessageText airspeed_beyond_airframe{
    "path.airspeed_beyond_airframe",
    {"airspeed", "lowest", "highest"},
    "{airspeed} m/s is beyond the airframe's {lowest} to {highest} m/s, flown at the limit"};
inline constexpr MessageText airspeed_not_valid{
    "path.airspeed_not_valid", {"found"}, "the airspeed is {found} m/s; expected 0 to below 1000 m/s"};
inline constexpr MessageText airspeed_out_of_range{
    "path.airspeed_out_of_range", {"found"}, "the airspeed is {found} m/s; expected 3 to 300 m/s"};
inline constexpr MessageText circuit_of_one{
    "path.circuit_of_one", "a circuit needs two or more waypoints. Add one, or set end: orbit."};
inline constexpr MessageText coordinate_not_finite{"path.coordinate_not_finite",
                                                   "a coordinate of the waypoint is not a finite number"};
inline constexpr MessageText course_not_finite{"path.course_not_finite",
                                               "the course of the waypoint is not a finite number"};
inline constexpr MessageText crosswind_landing{
    "path.crosswind_landing", {"wind"}, "crosswind of {wind} m/s is beyond the limit: landing all the same"};
inline constexpr MessageText crosswind_waiting{
    "path.crosswind_waiting", {"wind"}, "crosswind of {wind} m/s is beyond the limit: circling, take over"};
inline constexpr MessageText edit_kind_unknown{
    "path.edit_kind_unknown", "kind must be append, insert, replace, remove, clear or set_current"};
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
inline constexpr MessageText edits_lost{"path.edits_lost",
                                        "edits of its group were lost; send the whole group again"};
inline constexpr MessageText end_unknown{"path.end_unknown",
                                         "end has another value than circuit and orbit; set one of them"};
inline constexpr MessageText final_approach{"path.final_approach", "the final approach"};
inline constexpr MessageText glide_slope_steep{
    "path.glide_slope_steep",
    {"slope", "airspeed", "sink", "limit", "most"},
    "{slope} rad is too steep: at {airspeed} m/s it sinks {sink} m/s, above limits.sink_rate_max of {limit} "
    "m/s. At most {most} rad is valid."};
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
                                              "its group was incomplete when another began; send it again"};
inline constexpr MessageText group_outdated{"path.group_outdated",
                                            "the plan changed before the group was complete; send it again"};
inline constexpr MessageText group_refused{
    "path.group_refused", "another edit of its group was rejected; correct it, send all again"};
inline constexpr MessageText group_size_missing{
    "path.group_size_missing", "an edit of a group needs its group_size, the number of edits"};
inline constexpr MessageText group_sizes_differ{"path.group_sizes_differ",
                                                "all edits of a group must have the same group_size"};
inline constexpr MessageText index_beyond_end{
    "path.index_beyond_end", {"index", "count"}, "the index is {index}; valid: 0 to {count}"};
inline constexpr MessageText landing_above_ceiling{
    "path.landing_above_ceiling",
    {"height", "ceiling", "margin"},
    "the circle onto the final approach is at {height} m; the ceiling of {ceiling} m must be fence_margin, "
    "{margin} m, higher"};
inline constexpr MessageText landing_circle{"path.landing_circle", "the circle onto the final approach"};
inline constexpr MessageText landing_near_fence{
    "path.landing_near_fence",
    {"part", "north", "east", "distance", "margin"},
    "{part} passes {distance} m from the fence at {north} m north, {east} m east; fence_margin requires "
    "{margin} m. Move the fence, or change final_length, circle_radius or circle."};
inline constexpr MessageText landing_outside_fence{
    "path.landing_outside_fence",
    {"part", "north", "east", "distance"},
    "{part} is {distance} m outside the fence at {north} m north, {east} m east. Move the fence, or change "
    "final_length, circle_radius or circle."};
inline constexpr MessageText latitude_out_of_range{
    "path.latitude_out_of_range", {"found"}, "the latitude is {found} deg; expected -90 to 90 deg"};
inline constexpr MessageText longitude_out_of_range{
    "path.longitude_out_of_range", {"found"}, "the longitude is {found} deg; expected -360 to 360 deg"};
inline constexpr MessageText origin_too_far{"path.origin_too_far",
                                            "the waypoint is more than 100 km from the origin"};
inline constexpr MessageText plan_empty{
    "path.plan_empty",
    "the plan has no waypoints. To change one value of a plan, write a key such as plan.turn_radius."};
inline constexpr MessageText plan_full{"path.plan_full",
                                       "the plan is full with 1024 waypoints; remove one first"};
inline constexpr MessageText plan_without_waypoints{"path.plan_without_waypoints",
                                                    "the plan has no waypoints; append one first"};
inline constexpr MessageText position_back{"path.position_back",
                                           "the position is back: the path is flown again"};
inline constexpr MessageText position_lost{
    "path.position_lost", "no position: circle to the right, it drifts with the wind. Pilot: take over"};
inline constexpr MessageText roll_long{
    "path.roll_long", {"time"}, "still rolling {time} s after the touch-down: brake by hand"};
inline constexpr MessageText runway{"path.runway", "the runway"};
inline constexpr MessageText runway_length_missing{"path.runway_length_missing",
                                                   "the runway has no length; set a length above 0"};
inline constexpr MessageText runway_missing{
    "path.runway_missing",
    "no runway is given. Set runway of this component or of its plan, to {{north, east, up, heading, length} "
    "or {{lat, lon, alt_msl, heading, length}."};
inline constexpr MessageText runway_place_ambiguous{
    "path.runway_place_ambiguous",
    "the runway needs all of north, east and up, or all of lat, lon and alt_msl, not both"};
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
inline constexpr MessageText setting_unknown{"path.setting_unknown",
                                             "the setting is unknown; valid: end, turn_radius, airspeed"};
inline constexpr MessageText turn_radius_out_of_range{
    "path.turn_radius_out_of_range", {"found"}, "the turn_radius is {found} m; expected 1 to 100000 m"};
inline constexpr MessageText turn_radius_tight{
    "path.turn_radius_tight",
    {"radius", "bank", "limit", "least"},
    "turn_radius {radius} m takes {bank} deg of bank; with roll_max {limit} deg set {least} m or more"};
inline constexpr MessageText waypoint_above_ceiling{
    "path.waypoint_above_ceiling",
    {"height", "ceiling"},
    "the waypoint is at {height} m, above the fence's ceiling of {ceiling} m"};
inline constexpr MessageText waypoint_after_close{
    "path.waypoint_after_close", "less than 1 m horizontally from the waypoint after it; move one"};
inline constexpr MessageText waypoint_before_close{
    "path.waypoint_before_close", "less than 1 m horizontally from the waypoint before it; move one"};
inline constexpr MessageText waypoint_below_floor{
    "path.waypoint_below_floor",
    {"height", "floor"},
    "the waypoint is at {height} m, below the fence's floor of {floor} m"};
inline constexpr MessageText waypoint_id_unknown{
    "path.waypoint_id_unknown", {"id"}, "the plan has no waypoint with the id {id}; see the output plan"};
inline constexpr MessageText waypoint_index_unknown{
    "path.waypoint_index_unknown", {"index", "last"}, "the plan has no waypoint {index}; valid: 0 to {last}"};
inline constexpr MessageText waypoint_frame_unknown{
    "path.waypoint_frame_unknown", "the frame of the waypoint is unknown; valid: local, geodetic"};
inline constexpr MessageText waypoint_low{
    "path.waypoint_low",
    {"height", "lowest"},
    "the waypoint is at {height} m; the parameter 'lowest' requires {lowest} m"};
inline constexpr MessageText waypoint_not_valid{
    "path.waypoint_not_valid", {"number", "reason"}, "waypoint {number} of the plan: {reason}"};
inline constexpr MessageText waypoint_outside_fence{
    "path.waypoint_outside_fence",
    {"distance"},
    "the waypoint is {distance} m outside the fence; move the waypoint or the fence"};
inline constexpr MessageText waypoint_placed_twice{
    "path.waypoint_placed_twice",
    "the waypoint has a local and a geodetic position; give north, east and up, or lat, lon and alt_msl"};
inline constexpr MessageText waypoint_place_missing{
    "path.waypoint_place_missing", {"keys"}, "the waypoint needs {keys}"};
inline constexpr MessageText waypoint_without_place{
    "path.waypoint_without_place",
    "the waypoint has no position; give north, east and up, or lat, lon and alt_msl"};
inline constexpr MessageText waypoints_close{
    "path.waypoints_close",
    {"first", "second"},
    "waypoints {first} and {second} are less than 1 m apart horizontally; move one"};

}  // namespace fulmar::path_messages
