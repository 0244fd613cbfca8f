// SPDX-License-Identifier: BSD-3-Clause
// The messages of these folders: code, arguments, sentence (fulmar/diagnostic.hpp).
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::flight_messages {

inline constexpr MessageText attitude_excessive{"flight.attitude_excessive", "excessive attitude"};
inline constexpr MessageText battery_empty{"flight.battery_empty", "battery empty"};
inline constexpr MessageText battery_low{"flight.battery_low", "battery low"};
inline constexpr MessageText drifting{"flight.drifting", "wind above the top airspeed"};
inline constexpr MessageText engine_failed{"flight.engine_failed", "no thrust from the motor"};
inline constexpr MessageText engine_weak{"flight.engine_weak", "weak motor"};
inline constexpr MessageText estimator_failed{"flight.estimator_failed",
                                              "attitude, height or velocity not valid"};
inline constexpr MessageText fence{"flight.fence", "fence"};
inline constexpr MessageText fence_corners_few{
    "flight.fence_corners_few", {"count"}, "{count} of them; a fence has 3 at least"};
inline constexpr MessageText fence_floor_high{
    "flight.fence_floor_high", {"floor", "ceiling"}, "{floor} m is not below the ceiling, {ceiling} m"};
inline constexpr MessageText fence_sides_cross{
    "flight.fence_sides_cross",
    {"first", "second"},
    "the sides from corner {first} and from corner {second} cross each other"};
inline constexpr MessageText gnss_lost{"flight.gnss_lost", "no position"};
inline constexpr MessageText link_lost{"flight.link_lost", "no vehicle status"};
inline constexpr MessageText origin_missing{"flight.origin_missing",
                                            "lat and lon need the mission's origin, which is not given"};
inline constexpr MessageText pitot_lost{"flight.pitot_lost", "no airspeed"};
inline constexpr MessageText place_given_twice{
    "flight.place_given_twice", "both north, east and lat, lon are given; give one of the two"};
inline constexpr MessageText place_missing{"flight.place_missing", "give north and east, or lat and lon"};
inline constexpr MessageText places_equal{
    "flight.places_equal", {"other"}, "is the same place as places.places[{other}]"};
inline constexpr MessageText radio_lost{"flight.radio_lost", "pilot's radio lost"};
inline constexpr MessageText table_angle_large{"flight.table_angle_large",
                                               "angles are in radians, and these go beyond half a turn"};
inline constexpr MessageText table_grid_mismatched{
    "flight.table_grid_mismatched",
    {"found", "rows", "columns", "expected"},
    "there are {found}, and {rows} times {columns} points have {expected}"};
inline constexpr MessageText table_points_missing{"flight.table_points_missing",
                                                  "a table has at least one point"};
inline constexpr MessageText table_points_not_rising{"flight.table_points_not_rising",
                                                     "the points have to rise"};
inline constexpr MessageText table_second_points_missing{"flight.table_second_points_missing",
                                                         "it is missing, and and_over is given"};
inline constexpr MessageText table_second_variable_missing{"flight.table_second_variable_missing",
                                                           "it is missing, and and_at is given"};
inline constexpr MessageText table_values_mismatched{"flight.table_values_mismatched",
                                                     {"found", "points"},
                                                     "there are {found}, and {points} points have {points}"};
inline constexpr MessageText table_values_of_one_point{
    "flight.table_values_of_one_point", {"found"}, "there are {found}, and 1 point has 1"};
inline constexpr MessageText table_variable_missing{
    "flight.table_variable_missing", "a table is over alpha, beta, mach, aileron, elevator or rudder"};
inline constexpr MessageText table_variables_equal{"flight.table_variables_equal",
                                                   "it is the same variable as over"};
inline constexpr MessageText wind_excessive{"flight.wind_excessive", "wind above the limit"};

}  // namespace fulmar::flight_messages
