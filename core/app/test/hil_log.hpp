// SPDX-License-Identifier: BSD-3-Clause
// Messages from a host's log, and the gaps of its inertial samples.
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/loader/table.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/types/type.hpp"
#include "core/types/wire.hpp"
#include "fulmar/schema.hpp"

namespace fulmar::fcu::testing {

template <class T>
struct Logged {
  double t = 0, valid_t = 0;  ///< flight time, s: of the tick; of validity
  T value;
};

/// Every message of a topic.
template <class T>
std::vector<Logged<T>> logged(const core::WholeLog& file, const std::string& topic) {
  const core::TypePtr type = core::copy_type(*detail::type_table<T>());
  const std::uint16_t channel = file.channel(topic);
  const auto first_ns = static_cast<std::int64_t>(file.messages.front().log_ns);
  const auto flight_s = [&](std::uint64_t ns) {
    return 1e-9 * static_cast<double>(static_cast<std::int64_t>(ns) - first_ns);
  };
  std::vector<Logged<T>> all;
  for (const core::McapFile::Message& m : file.messages) {
    if (m.channel != channel) continue;
    Logged<T>& l = all.emplace_back();
    l.t = flight_s(m.log_ns);
    l.valid_t = flight_s(m.publish_ns);
    core::cdr_decode(*type, m.data.data(), m.data.size(), reinterpret_cast<std::byte*>(&l.value));
  }
  return all;
}

/// A time without messages: from the last before it to the first after it.
struct Gap {
  double from = 0, to = 0;
  double length() const { return to - from; }
};
template <class T>
std::vector<Gap> gaps(const std::vector<Logged<T>>& all, double least, double most) {
  std::vector<Gap> found;
  for (std::size_t k = 1; k < all.size(); ++k)
    if (const Gap g{all[k - 1].t, all[k].t}; g.length() >= least && g.length() < most) found.push_back(g);
  return found;
}

/// The messages of the ticks in (from, to].
template <class T>
std::vector<Logged<T>> between(const std::vector<Logged<T>>& all, double from, double to) {
  std::vector<Logged<T>> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const Logged<T>& l) { return l.t > from && l.t <= to; });
  return some;
}

}  // namespace fulmar::fcu::testing
