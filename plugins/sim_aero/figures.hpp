// SPDX-License-Identifier: BSD-3-Clause
// Numbers in messages.
#pragma once
#include <cmath>
#include <cstdio>
#include <string>

namespace fulmar::sim {

inline std::string figures(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}
/// Three digits, rounded down: an upper limit above 0 stays valid.
inline std::string at_most(double limit) {
  const double digit = std::pow(10, std::floor(std::log10(limit)) - 2);
  return figures(std::floor(limit / digit * (1 + 1e-12)) * digit);
}
inline std::string degrees(double rad) { return figures(rad * 57.29577951308232) + " deg"; }

}  // namespace fulmar::sim
