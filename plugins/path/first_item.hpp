// SPDX-License-Identifier: BSD-3-Clause
// The first waypoint, from a parameter.
#pragma once
#include <cstdint>
#include <optional>
#include <utility>

namespace fulmar::path {

/// A change of the parameter counts once, at the next adoption of a plan.
class FirstItem {
 public:
  /// Returns true when it differs from the value before.
  bool change(std::int64_t item) {
    if (item == seen_) return false;
    seen_ = item;
    begin_with_ = static_cast<std::uint32_t>(item);
    return true;
  }
  std::optional<std::uint32_t> take() { return std::exchange(begin_with_, std::nullopt); }

 private:
  std::int64_t seen_ = 0;
  std::optional<std::uint32_t> begin_with_;
};

}  // namespace fulmar::path
