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
    "flight.fence_corners_few", {"count"}, "the fence has {count} corners; it needs at least 3"};
inline constexpr MessageText fence_floor_high{
    "flight.fence_floor_high", {"floor", "ceiling"}, "{floor} m is not below the ceiling, {ceiling} m"};
inline constexpr MessageText fence_sides_cross{
    "flight.fence_sides_cross",
    {"first", "second"},
    "the sides that begin at corners {first} and {second} cross or overlap; the first corner is 0"};
inline constexpr MessageText gnss_lost{"flight.gnss_lost", "no position"};
inline constexpr MessageText link_lost{"flight.link_lost", "no vehicle status"};
inline constexpr MessageText origin_missing{
    "flight.origin_missing", "lat and lon need an origin; set origin in the mission, or give north and east"};
inline constexpr MessageText pitot_lost{"flight.pitot_lost", "no airspeed"};
inline constexpr MessageText place_given_twice{
    "flight.place_given_twice", "both north, east and lat, lon are given; give one of the two"};
inline constexpr MessageText place_missing{"flight.place_missing", "give north and east, or lat and lon"};
inline constexpr MessageText places_equal{
    "flight.places_equal",
    {"other"},
    "this place is within 1 m of places.places[{other}]; remove one of them"};
inline constexpr MessageText radio_lost{"flight.radio_lost", "pilot's radio lost"};
inline constexpr MessageText table_angle_large{
    "flight.table_angle_large",
    {"found"},
    "{found} is outside -3.2 to 3.2; the points are angles in radians"};
inline constexpr MessageText table_grid_mismatched{
    "flight.table_grid_mismatched",
    {"found", "rows", "columns", "expected"},
    "the table has {found} values; {rows} x {columns} points need {expected}"};
inline constexpr MessageText table_points_missing{"flight.table_points_missing",
                                                  "the table has no points; give at least one"};
inline constexpr MessageText table_points_not_rising{
    "flight.table_points_not_rising",
    {"found", "before"},
    "each point must be larger than the one before it, but {found} follows {before}"};
inline constexpr MessageText table_second_points_missing{"flight.table_second_points_missing",
                                                         "and_over is set, so and_at must list its points"};
inline constexpr MessageText table_second_variable_missing{
    "flight.table_second_variable_missing",
    "and_at is set, so and_over must be alpha, beta, mach, aileron, elevator or rudder; else remove and_at"};
inline constexpr MessageText table_values_mismatched{
    "flight.table_values_mismatched",
    {"found", "points"},
    "the table has {found} values for {points} points; give one value for each point"};
inline constexpr MessageText table_values_of_one_point{
    "flight.table_values_of_one_point",
    {"found"},
    "the table has {found} values for one point; give one value"};
inline constexpr MessageText table_variable_missing{
    "flight.table_variable_missing", "over must be alpha, beta, mach, aileron, elevator or rudder"};
inline constexpr MessageText table_variables_equal{"flight.table_variables_equal",
                                                   "and_over must name another variable than over"};
inline constexpr MessageText wind_excessive{"flight.wind_excessive", "wind above the limit"};

}  // namespace fulmar::flight_messages
