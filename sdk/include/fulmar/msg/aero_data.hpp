// SPDX-License-Identifier: BSD-3-Clause
// What an airframe may say of its aerodynamics beside the derivative set.
#pragma once
#include <cstddef>

#include "fulmar/message.hpp"

namespace fulmar {

/// Drag over the square of an angle: CD += value angle^2, radians. Deflection costs drag either way.
struct DragSquared {
  double beta_ratio = 0, aileron_ratio = 0, elevator_ratio = 0, rudder_ratio = 0;
};

enum class Coefficient : std::uint8_t { lift, drag, side, roll, pitch, yaw };

/// What a table is over. Angles in radians, Mach number as it is.
enum class TableVariable : std::uint8_t { none, alpha, beta, mach, aileron, elevator, rudder };

/// A part of one coefficient over one or two variables, added to the derivative set: linear between its
/// points, held beyond them.
struct CoefficientTable {
  Coefficient coefficient = Coefficient::lift;
  TableVariable over = TableVariable::alpha;
  List<double, 32> at_ratio;  ///< rising; rad, or the Mach number
  TableVariable and_over = TableVariable::none;
  List<double, 16> and_at_ratio;   ///< rising; of `and_over`
  List<double, 256> values_ratio;  ///< for each point of `over` those of all points of `and_over`
};
template <>
inline constexpr std::array<std::string_view, 2> rising_fields<CoefficientTable>{"at_ratio", "and_at_ratio"};
template <>
inline constexpr std::array<std::string_view, 4> required_fields<CoefficientTable>{
    "coefficient", "over", "at_ratio", "values_ratio"};

}  // namespace fulmar
