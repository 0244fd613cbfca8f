// SPDX-License-Identifier: BSD-3-Clause
// Distribution of step times: fixed memory, 16 buckets per octave, so quantiles are within 5 %.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

namespace fulmar::core {

class Histogram {
 public:
  void add(std::int64_t ns) noexcept {
    const std::uint64_t v = static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0));
    ++buckets_[index(v)];
    ++count_;
    max_ = std::max(max_, v);
    sum_ += v;
  }
  std::uint64_t count() const { return count_; }
  double mean_us() const {
    return count_ > 0 ? 1e-3 * static_cast<double>(sum_) / static_cast<double>(count_) : 0;
  }
  double max_us() const { return 1e-3 * static_cast<double>(max_); }
  /// The time that a fraction `q` of the steps did not exceed, in microseconds; the middle of its bucket.
  double quantile_us(double q) const {
    const auto target = static_cast<std::uint64_t>(q * static_cast<double>(count_));
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < buckets_.size(); ++i) {
      seen += buckets_[i];
      if (seen > target) return std::min(1e-3 * (lower(i) + lower(i + 1)) / 2, max_us());
    }
    return max_us();
  }

 private:
  static constexpr std::size_t per_octave = 16;
  static std::size_t index(std::uint64_t v) {
    if (v < per_octave) return v;
    const int octave = static_cast<int>(std::bit_width(v)) - 5;  // v >> octave is in [16, 32)
    return static_cast<std::size_t>(octave) * per_octave + static_cast<std::size_t>(v >> octave);
  }
  static double lower(std::size_t i) {
    if (i < 2 * per_octave) return static_cast<double>(i);
    const std::size_t octave = i / per_octave - 1;
    return static_cast<double>((i % per_octave + per_octave) << octave);
  }
  std::array<std::uint32_t, 45 * per_octave> buckets_{};
  std::uint64_t count_ = 0, max_ = 0, sum_ = 0;
};

struct ComponentStats {
  std::string name;
  Histogram time;
  std::uint64_t steps = 0, degraded = 0, allocations = 0, overruns = 0;
  std::uint64_t misses = 0;  // late asynchronous results; lost samples of a driver
};

}  // namespace fulmar::core
