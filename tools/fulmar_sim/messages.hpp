// SPDX-License-Identifier: BSD-3-Clause
// The messages of this folder: code, arguments, sentence (fulmar/diagnostic.hpp); of Python in
// fulmar_sim/__init__.py.
#pragma once
#include "fulmar/diagnostic.hpp"

namespace fulmar::simulation_messages {
inline constexpr MessageText airspeed_invalid{
    "simulation.airspeed_invalid", {"found"}, "airspeed is {found} m/s and must be more than 0"};
inline constexpr MessageText altitude_out_of_range{
    "simulation.altitude_out_of_range",
    {"found"},
    "origin_altitude is {found} m and must be from -1000 to 20000"};
inline constexpr MessageText error_unknown{
    "simulation.error_unknown",
    "an unknown error inside the simulation; report it with the call that you used"};
inline constexpr MessageText heading_not_finite{
    "simulation.heading_not_finite", {"found"}, "the given heading is {found}; give a finite angle in rad"};
inline constexpr MessageText height_invalid{
    "simulation.height_invalid", {"found"}, "height is {found} m and must be more than 0"};
inline constexpr MessageText level_flight_missing{
    "simulation.level_flight_missing",
    {"airspeed", "height"},
    "no steady level flight exists at {airspeed} m/s and {height} m height; give another airspeed or height"};
inline constexpr MessageText memory_exhausted{"simulation.memory_exhausted",
                                              "there is not enough memory; simulate fewer aircraft"};
inline constexpr MessageText other_process{
    "simulation.other_process",
    "the simulation belongs to another process and cannot be used after a fork; make one in this process"};
inline constexpr MessageText wind_out_of_range{
    "simulation.wind_out_of_range", {"found"}, "the wind is {found} m/s and must be within +-1000"};

}  // namespace fulmar::simulation_messages
