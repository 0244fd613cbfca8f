// SPDX-License-Identifier: BSD-3-Clause
// Displayed numbers: angles in degrees.
#pragma once
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "tools/chart/numbers.hpp"

namespace fulmar::aero {

inline constexpr double degree = std::numbers::pi / 180;

using chart::figures;
using chart::fixed;
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
