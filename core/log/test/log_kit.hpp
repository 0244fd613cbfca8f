// SPDX-License-Identifier: BSD-3-Clause
// Logs for tests of log readers, written message by message.
#pragma once
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "core/log/mcap.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core::test {

constexpr std::int64_t epoch_ns = 1'767'225'600'000'000'000;  // 2026-01-01

/// A temporary folder, removed at the end of the test.
struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "fulmar-log-XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void store(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

struct Number {
  double value_ratio;
};
inline TypePtr number_type() { return make_type("Number", 8, 8, {number("value_ratio", 0)}); }

/// A writer with channels of described types, and attachments and metadata like those of a flight.
struct Sample {
  McapWriter writer;
  std::vector<CdrEncoder> encoders;

  explicit Sample(const McapWriter::Options& options) : writer(options) {
    writer.attach("mission.yaml", "application/yaml", "mission: test\n", epoch_ns);
    writer.metadata("fulmar", {{"mission", "test"}, {"seed", "7"}});
  }
  std::uint16_t channel(const std::string& topic, const Type& type) {
    const std::uint16_t schema = writer.add_schema(ros_name(type), "ros2msg", ros_definition(type));
    encoders.emplace_back(type);
    return writer.add_channel(schema, topic, "cdr", {{"topic_type_hash", ros_type_hash(type)}});
  }
  void write(std::uint16_t channel, std::int64_t flight_ns, const std::byte* data, std::uint32_t sequence = 0,
             std::uint64_t age_ns = 1000) {
    const auto ns = static_cast<std::uint64_t>(epoch_ns + flight_ns);
    std::byte* room = writer.begin_message(channel, sequence, ns, ns - age_ns);
    writer.end_message(encoders[channel].encode(data, room));
  }
};

inline Mixed mixed_at(int i) {
  Mixed m = mixed_value();
  m.stamp_ns = i;
  m.speed_mps = 0.1 * i;
  m.legs.count = static_cast<std::uint32_t>(i % 3);
  return m;
}

/// `ticks` of 2.5 ms from -1 s on: /mixed in each, /number in every fourth. `change` may alter a message.
inline McapWriter::Result write_sample(McapWriter::Options options, int ticks,
                                       const std::function<void(int, Mixed&)>& change = {}) {
  options.max_message_bytes = 4096;
  Sample sample(options);
  const std::uint16_t mixed = sample.channel("/mixed", *mixed_type()),
                      numbers = sample.channel("/number", *number_type());
  for (int i = 0; i < ticks; ++i) {
    const std::int64_t now = i * 2'500'000LL - 1'000'000'000;
    Mixed m = mixed_at(i);
    if (change) change(i, m);
    sample.write(mixed, now, bytes_of(m), static_cast<std::uint32_t>(i));
    const Number n{0.5 * i};
    if (i % 4 == 0) sample.write(numbers, now, bytes_of(n));
  }
  return sample.writer.close();
}

}  // namespace fulmar::core::test
