// SPDX-License-Identifier: BSD-3-Clause
// Logs of a synthetic flight, and a check that a file holds this flight.
#pragma once
#include <algorithm>

#include "core/log/test/log_kit.hpp"
#include "core/log/test/read_mcap.hpp"
#include "core/tap/test/taped_log.hpp"

namespace fulmar::core::test {

constexpr std::int64_t period_ns = 2'500'000;

inline std::vector<TapChannel> two_channels() {
  return {{"/mixed", mixed_type()},
          {"/number", number_type()},
          {"/silent", number_type()},
          {"/other", number_type()}};
}

inline Mixed flown_at(int i) {
  Mixed m = mixed_value();
  m.stamp_ns = i;
  m.speed_mps = 0.1 * i;
  m.legs.count = static_cast<std::uint32_t>(i % 4);
  if (m.legs.count == 3) m.legs.items[2] = m.legs.items[0];
  return m;
}

/// `ticks` ticks from -1 s on; one Mixed and, in every fourth, one Number.
inline void fly(TapedLog& log, int ticks, double value = 0.5) {
  for (int i = 0; i < ticks; ++i) {
    const std::int64_t now = i * period_ns - 1'000'000'000;
    const Mixed m = flown_at(i);
    log.write(0, now, now - 1000, bytes_of(m));
    const Number n{value * i};
    if (i % 4 == 0) log.write(1, now, now, bytes_of(n));
  }
}

inline LogResult write_log(const std::filesystem::path& file, int ticks, double value = 0.5,
                           std::size_t ring_bytes = 4u << 20) {
  TapedLog log({.file = file, .epoch_ns = epoch_ns}, two_channels(), ring_bytes);
  log.attach("mission.yaml", "application/yaml", "mission: test\n");
  log.metadata("run", {{"seed", "7"}, {"io", "sim"}});
  fly(log, ticks, value);
  log.attach("result.json", "application/json", "{}");
  return log.close();
}

/// Each message is the next one of its channel in the order of `fly`.
inline bool is_flight(const WholeLog& log) {
  const CdrEncoder encoder(*mixed_type());
  int mixed = 0, numbers = 0;
  for (const McapFile::Message& m : log.messages) {
    const std::string& topic = log.channels.at(m.channel).topic;
    const int i = topic == "/mixed" ? mixed : 4 * numbers;
    const auto now = static_cast<std::uint64_t>(epoch_ns + i * period_ns - 1'000'000'000);
    if (m.log_ns != now) return false;
    if (topic == "/number") {
      Number n{};
      cdr_decode(*number_type(), m.data.data(), m.data.size(), bytes_of(n));
      if (n.value_ratio != 0.5 * i || m.publish_ns != now ||
          m.sequence != static_cast<std::uint32_t>(numbers))
        return false;
      ++numbers;
    } else {
      const Mixed want = flown_at(i);
      std::vector<std::byte> bytes;
      encoder.encode(bytes_of(want), bytes);
      if (!std::equal(bytes.begin(), bytes.end(), m.data.begin(), m.data.end()) || m.publish_ns != now - 1000)
        return false;
      ++mixed;
    }
  }
  const int due = (mixed + 3) / 4;  // a chunk may end between the two messages of a tick
  return numbers == due || (numbers == due - 1 && mixed % 4 == 1);
}

}  // namespace fulmar::core::test
