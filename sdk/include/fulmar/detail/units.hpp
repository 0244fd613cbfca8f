// SPDX-License-Identifier: BSD-3-Clause
// The unit suffixes that end the name of every floating-point field.
#pragma once
#include <array>
#include <cstddef>
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
    Unit{"_deg", "deg"},  // for latitude and longitude only
    Unit{"_pa", "Pa"},
    Unit{"_kelvin", "K"},
    Unit{"_tesla", "T"},
    Unit{"_volt", "V"},
    Unit{"_amp", "A"},
    Unit{"_ohm", "ohm"},
    Unit{"_newton", "N"},
    Unit{"_kg", "kg"},
    Unit{"_ah", "Ah"},
    Unit{"_hz", "Hz"},
    Unit{"_ns", "ns"},
    Unit{"_s", "s"},
    Unit{"_frac", "", -1.0, 1.0},
    Unit{"_ratio", ""},
};

/// Index into `units` of the unit that ends a name, or -1. Not a pointer, for gcc's sanitizers.
constexpr int find_unit(std::string_view name) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::string_view suffix = units[i].suffix;
    if (name.size() > suffix.size() && name.substr(name.size() - suffix.size()) == suffix)
      return static_cast<int>(i);
  }
  return -1;
}

}  // namespace fulmar::detail
