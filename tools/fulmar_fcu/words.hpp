// SPDX-License-Identifier: BSD-3-Clause
// Texts of bits and numbers of the controller.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace fulmar::fcu {

/// Reasons why the pilot's sticks control the outputs: bits of ROSFLIGHT_STATUS.rc_override.
std::vector<std::string> override_words(std::uint16_t bits);
/// Bits of ROSFLIGHT_STATUS.error_code.
std::vector<std::string> error_words(std::uint8_t bits);
std::string fix_words(std::uint8_t fix_type);
std::string severity_word(std::uint8_t severity);
/// "%.*f" without "-0.0".
std::string fixed(double value, int digits);

}  // namespace fulmar::fcu
