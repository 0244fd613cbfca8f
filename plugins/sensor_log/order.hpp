// SPDX-License-Identifier: BSD-3-Clause
// Selection of the stamps of a file that are in order.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fulmar::sensor_log {

/// The longest strictly increasing part of `stamps`, as indices. It leaves out as few stamps as possible: one
/// stamp far ahead does not remove those that follow. Among equal stamps, and among parts of equal length,
/// the earlier one stays.
/// Source: Schensted, Canad. J. Math. 13 (1961), run from the end.
inline std::vector<std::size_t> in_order(const std::vector<std::int64_t>& stamps) {
  constexpr std::size_t none = ~std::size_t{0};
  std::vector<std::size_t> heads;  // heads[k]: begin of the best part of k + 1 stamps so far
  std::vector<std::size_t> next(stamps.size(), none);
  for (std::size_t i = stamps.size(); i-- > 0;) {
    const auto at = std::partition_point(heads.begin(), heads.end(),
                                         [&](std::size_t head) { return stamps[head] > stamps[i]; });
    if (at != heads.begin()) next[i] = *(at - 1);
    if (at == heads.end())
      heads.push_back(i);
    else
      *at = i;
  }
  std::vector<std::size_t> part;
  for (std::size_t i = heads.empty() ? none : heads.back(); i != none; i = next[i]) part.push_back(i);
  return part;
}

}  // namespace fulmar::sensor_log
