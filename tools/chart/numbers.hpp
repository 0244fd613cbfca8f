// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text.
#pragma once
#include <cmath>
#include <cstdio>
#include <string>

namespace fulmar::chart {

/// Without "-0.00".
inline std::string fixed(double x, int decimals) {
  char text[64];
  const double least = 0.5 * std::pow(10.0, -decimals);
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(x) < least ? 0.0 : x);
  return text;
}
inline std::string figures(double x, int digits = 3) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}

}  // namespace fulmar::chart
