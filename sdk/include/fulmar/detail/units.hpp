// SPDX-License-Identifier: BSD-3-Clause
// The unit suffixes that end the name of every floating-point field.
#pragma once
#include <array>
#include <limits>
#include <string_view>

namespace fulmar::detail {

struct Unit {
  std::string_view suffix;
  const char* printed;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

inline constexpr std::array units{
    Unit{"_mps2", "m/s2"},
    Unit{"_radps2", "rad/s2"},
    Unit{"_radps", "rad/s"},
    Unit{"_mps", "m/s"},
    Unit{"_kgm2", "kg m2"},
    Unit{"_m2", "m2"},
    Unit{"_m", "m"},
    Unit{"_rad", "rad"},
    Unit{"_deg", "deg"},  // latitude and longitude alone
    Unit{"_pa", "Pa"},
    Unit{"_kelvin", "K"},
    Unit{"_tesla", "T"},
    Unit{"_volt", "V"},
    Unit{"_amp", "A"},
    Unit{"_ohm", "ohm"},
    Unit{"_newton", "N"},
    Unit{"_kg", "kg"},
    Unit{"_hz", "Hz"},
    Unit{"_ns", "ns"},
    Unit{"_s", "s"},
    Unit{"_frac", "", -1.0, 1.0},
    Unit{"_ratio", ""},
};

/// The unit that a name ends in, or nullptr.
constexpr const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : units)
    if (name.size() > unit.suffix.size() && name.substr(name.size() - unit.suffix.size()) == unit.suffix) return &unit;
  return nullptr;
}

}  // namespace fulmar::detail
