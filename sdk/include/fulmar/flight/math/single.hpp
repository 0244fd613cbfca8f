// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bit>
#include <cstdint>

namespace fulmar {

/// Rounded to the 24 bits of single precision. A cast to float and back fails: g++ 12 removes it in
/// vectorised code.
inline double to_single(double value) {
  constexpr std::uint64_t lost = (std::uint64_t{1} << 29) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(value) + (lost >> 1) + 1) & ~lost);
}

}  // namespace fulmar
