// SPDX-License-Identifier: BSD-3-Clause
// Aerodynamic data of an airframe besides the derivatives.
#pragma once
#include <cstddef>

#include "fulmar/message.hpp"

namespace fulmar {

/// Drag over the square of an angle: CD += value angle^2, radians. A deflection adds drag either way.
struct DragSquared {
  double beta_ratio = 0, aileron_ratio = 0, elevator_ratio = 0, rudder_ratio = 0;  ///< drag over the square
                                                                                   ///< of this angle
};

enum class Coefficient : std::uint8_t { lift, drag, side, roll, pitch, yaw };

/// Variable of a table. Angles in radians, Mach number without unit.
enum class TableVariable : std::uint8_t { none, alpha, beta, mach, aileron, elevator, rudder };

/// Part of one coefficient over one or two variables, added to the derivative set: linear between its points,
/// constant beyond them.
struct CoefficientTable {
  Coefficient coefficient = Coefficient::lift;   ///< coefficient of the table
  TableVariable over = TableVariable::alpha;     ///< first variable
  List<double, 32> at_ratio;                     ///< points of `over`, rising; rad, or the Mach number
  TableVariable and_over = TableVariable::none;  ///< second variable
  List<double, 16> and_at_ratio;                 ///< points of `and_over`, rising
  List<double, 256> values_ratio;                ///< values: for each point of `over` those of all points of
                                                 ///< `and_over`
};
template <>
inline constexpr std::array<std::string_view, 2> rising_fields<CoefficientTable>{"at_ratio", "and_at_ratio"};
template <>
inline constexpr std::array<std::string_view, 4> required_fields<CoefficientTable>{
    "coefficient", "over", "at_ratio", "values_ratio"};

}  // namespace fulmar
