// SPDX-License-Identifier: BSD-3-Clause
// Numbers in messages.
#pragma once
#include <cstdio>
#include <string>

namespace fulmar::sim {

inline std::string figures(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}
inline std::string degrees(double rad) { return figures(rad * 57.29577951308232) + " deg"; }

}  // namespace fulmar::sim
