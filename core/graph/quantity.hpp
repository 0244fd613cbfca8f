// SPDX-License-Identifier: BSD-3-Clause
// Numbers with units in the form of files: "20 deg", "17 m/s", "200 ms", "2 deg/(m/s)". SI inside.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {

/// A unit: its dimension and its factor to SI. The angle counts as a dimension, so that "5 deg" is not a
/// plain number.
struct PhysicalUnit {
  std::array<std::int8_t, 6> dimension{};  // powers of m, kg, s, A, K, rad
  double factor = 1;                       // SI value = number * factor + offset
  double offset = 0;                       // degC alone
};

/// "m/s", "rad/(m/s)", "kg m^2"; "", "frac", "ratio", "1" are plain numbers. Nothing when a symbol is
/// unknown.
std::optional<PhysicalUnit> parse_unit(std::string_view text);

bool same_dimension(const std::string& unit_a, const std::string& unit_b);

/// Factor from a value in `from` to one in `to`. 1 when either is unknown. Both must have the same dimension.
double unit_factor(const std::string& from, const std::string& to);

enum class UnitRule {
  optional,  // a bare number is in the declared unit
  required,  // a bare number is a fault, unless the declared unit is a plain number or deg
};

/// A finite number, with the unit it was written in.
struct Quantity {
  double number = 0;
  std::string unit;  // "" when none was written
  std::string text;  // as written
};
/// Throws Error: "'abc' is not a number", ".nan is not a finite number".
Quantity parse_quantity(std::string_view text);

/// The quantity in the declared unit. Throws Error: "5 kg is a mass, not a length".
double convert(const Quantity& quantity, const std::string& unit, UnitRule rule);
double quantity_in(std::string_view text, const std::string& unit, UnitRule rule);

/// Throws Error "9 is outside 0 .. 2 rad/rad", in the unit that the quantity was written in.
void check_range(const Quantity& quantity, double value, const std::string& unit, double min, double max);

/// The unit suffix that a field's name ends in: {"stall_alpha", "rad"}. A plain number (_frac, _ratio) has
/// the unit "". Nothing without a suffix.
struct Suffixed {
  std::string name, unit;
};
std::optional<Suffixed> split_suffix(const std::string& field);

}  // namespace fulmar::core
