// SPDX-License-Identifier: BSD-3-Clause
// Two streams of samples with different clocks, compared at common times: the sparse one sets the times, the
// dense one is interpolated. Both are in the order of their arrival, with their times of validity.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "fulmar/msg/vehicle_state.hpp"

namespace fulmar::states {

/// Interpolates between two states; angles take the short way; a value is valid if it is so in both.
VehicleState between(const VehicleState& a, const VehicleState& b, double t);

template <class Sparse>
class Pairing {
 public:
  static constexpr std::int64_t max_gap_ns = 250'000'000;     // largest gap for an interpolation
  static constexpr std::int64_t patience_ns = 5'000'000'000;  // for late fixes

  void add_sparse(std::int64_t valid_ns, const Sparse& sample) { sparse_.emplace_back(valid_ns, sample); }
  void add_dense(std::int64_t valid_ns, const VehicleState& state) {
    if (!dense_.empty() && valid_ns <= dense_.back().first) return;
    dense_.emplace_back(valid_ns, state);
  }

  /// `take` gets the pairs that are complete.
  template <class Take>
  void settle(std::int64_t now_ns, const Take& take) {
    while (!sparse_.empty() && (is_covered() || sparse_.front().first < now_ns - patience_ns)) {
      decide(take);
      sparse_.pop_front();
    }
    while (dense_.size() > 1 && dense_[1].first < now_ns - patience_ns) dense_.pop_front();
  }
  /// Takes all remaining pairs.
  template <class Take>
  void end(const Take& take) {
    for (; !sparse_.empty(); sparse_.pop_front()) decide(take);
  }
  /// Time of validity of the present pair.
  std::int64_t pair_ns() const { return pair_ns_; }
  std::uint64_t paired() const { return paired_; }
  std::uint64_t alone() const { return alone_; }

 private:
  bool is_covered() const { return !dense_.empty() && dense_.back().first >= sparse_.front().first; }

  template <class Take>
  void decide(const Take& take) {
    const auto& [time_ns, sample] = sparse_.front();
    std::size_t after = 0;
    while (after < dense_.size() && dense_[after].first < time_ns) ++after;
    const bool there = after < dense_.size() && dense_[after].first == time_ns;
    const bool around =
        after > 0 && after < dense_.size() && dense_[after].first - dense_[after - 1].first <= max_gap_ns;
    if (!there && !around) {
      ++alone_;
      return;
    }
    ++paired_;
    pair_ns_ = time_ns;
    if (there) return take(sample, dense_[after].second);
    const auto& [from_ns, from] = dense_[after - 1];
    const auto& [to_ns, to] = dense_[after];
    take(sample,
         between(from, to, static_cast<double>(time_ns - from_ns) / static_cast<double>(to_ns - from_ns)));
  }

  std::deque<std::pair<std::int64_t, Sparse>> sparse_;
  std::deque<std::pair<std::int64_t, VehicleState>> dense_;
  std::uint64_t paired_ = 0, alone_ = 0;
  std::int64_t pair_ns_ = 0;
};

}  // namespace fulmar::states
