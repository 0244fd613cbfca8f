// SPDX-License-Identifier: BSD-3-Clause
// Schedule of the requests for parameters of the controller. An answer may be lost: the firmware drops
// messages when its queue is full.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fulmar::fcu {

class WatchList {
 public:
  static constexpr std::int64_t patience_ns = 200'000'000;
  static constexpr int max_in_flight = 10;  ///< a burst would overrun the controller's queue

  explicit WatchList(const std::vector<std::string>& names) {
    for (const std::string& name : names) entries_.push_back({name, never, false});
  }

  /// Reads all values again.
  void restart() {
    for (Entry& e : entries_) e = {e.name, never, false};
  }
  void answered(std::string_view name) {
    for (Entry& e : entries_) e.answered |= e.name == name;
  }
  /// The name to request now, the one that has waited longest; empty for none.
  std::string_view next(std::int64_t now_ns) {
    Entry* longest = nullptr;
    int in_flight = 0;
    for (Entry& e : entries_) {
      if (e.answered) continue;
      if (e.asked_ns != never && now_ns - e.asked_ns < patience_ns)
        ++in_flight;
      else if (longest == nullptr || e.asked_ns < longest->asked_ns)
        longest = &e;
    }
    if (longest == nullptr || in_flight >= max_in_flight) return {};
    longest->asked_ns = now_ns;
    return longest->name;
  }

 private:
  static constexpr std::int64_t never = INT64_MIN;
  struct Entry {
    std::string name;
    std::int64_t asked_ns = never;
    bool answered = false;
  };
  std::vector<Entry> entries_;
};

}  // namespace fulmar::fcu
