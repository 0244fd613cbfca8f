// SPDX-License-Identifier: BSD-3-Clause
// Numbers for people: angles in degrees.
#pragma once
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace fulmar::aero {

inline constexpr double degree = std::numbers::pi / 180;

/// No "-0.00".
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
inline std::string degrees(double rad, int decimals = 2) { return fixed(rad / degree, decimals) + " deg"; }

inline std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}
inline std::string right(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

inline void print_object(const nlohmann::json& object) {
  std::printf("%s\n", object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}
inline void print_text(const std::string& text) { std::fputs(text.c_str(), stdout); }

}  // namespace fulmar::aero
