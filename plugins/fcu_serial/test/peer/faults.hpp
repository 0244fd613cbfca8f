// SPDX-License-Identifier: BSD-3-Clause
// A bad line: loses, doubles, damages and delays what goes through it.
#pragma once
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "fulmar/random.hpp"

namespace fulmar::fcu::peer {

struct FaultRates {
  double loss = 0, duplicate = 0, corrupt = 0;  ///< of each frame, 0..1
  std::int64_t delay_us = 0;
};

class Line {
 public:
  Line(const FaultRates& rates, std::uint64_t seed) : rates_(rates), random_(seed) {}

  void put(std::span<const std::uint8_t> frame, std::int64_t now_us) {
    if (frame.empty() || happens(rates_.loss)) return;
    const int times = happens(rates_.duplicate) ? 2 : 1;
    for (int k = 0; k < times; ++k) {
      waiting_.push_back({now_us + rates_.delay_us, {frame.begin(), frame.end()}});
      if (!happens(rates_.corrupt)) continue;
      auto& bytes = waiting_.back().bytes;
      const auto at = static_cast<std::size_t>(random_.uniform(0, static_cast<double>(bytes.size())));
      bytes[at % bytes.size()] ^=
          static_cast<std::uint8_t>(1u << static_cast<unsigned>(random_.uniform(0, 7.99)));
    }
  }
  /// Data that has arrived at the other end. Returns false for none.
  bool take(std::vector<std::uint8_t>& bytes, std::int64_t now_us) {
    if (waiting_.empty() || waiting_.front().at_us > now_us) return false;
    bytes = std::move(waiting_.front().bytes);
    waiting_.pop_front();
    return true;
  }
  std::int64_t next_us() const { return waiting_.empty() ? INT64_MAX : waiting_.front().at_us; }
  void clear() { waiting_.clear(); }

 private:
  struct Item {
    std::int64_t at_us;
    std::vector<std::uint8_t> bytes;
  };
  bool happens(double probability) { return probability > 0 && random_.uniform(0, 1) < probability; }
  FaultRates rates_;
  Random random_;
  std::deque<Item> waiting_;
};

}  // namespace fulmar::fcu::peer
