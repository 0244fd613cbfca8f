// SPDX-License-Identifier: BSD-3-Clause
// A ROS 2 bag in an MCAP file: one topic of it. Source: the MCAP file format specification, version 0.
#pragma once
#include <zstd.h>

#include <optional>

#include "ros_type.hpp"

namespace fulmar::sensor_log {

/// CRC of IEEE 802.3, as in MCAP.
inline std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> all{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      all[i] = i;
      for (int k = 0; k < 8; ++k) all[i] = (all[i] >> 1) ^ ((all[i] & 1) != 0 ? 0xEDB88320U : 0);
    }
    return all;
  }();
  std::uint32_t crc = ~0U;
  for (const char c : bytes) crc = (crc >> 8) ^ table[(crc ^ static_cast<std::uint8_t>(c)) & 0xFF];
  return ~crc;
}

class Bag {
 public:
  Bag(const File& file, std::string_view topic) : file_(file), topic_(topic) {
    if (!file.bytes.starts_with(magic)) refuse(file.key, sensor_log_messages::file_not_mcap(file.path));
  }

  Table read(const std::vector<Wanted>& wanted) {
    Table table;
    table.columns.resize(wanted.size());
    bool ready = false;
    scan([&](const Stamps& stamps, const Cursor& data) {
      if (!ready) type_->want(wanted);
      ready = true;
      type_->read(stamps, data, wanted, table);
      table.lines.push_back(table.rows() + 1);
    });
    return table;
  }

  /// Type and fields of the topic, such as "sensor_msgs/msg/Imu". Throws if there is no such topic. Reads no
  /// further than to the topic.
  Topic look() {
    looking_ = true;
    scan([](const Stamps&, const Cursor&) {});
    return {type_name_, type_->names()};
  }

 private:
  enum Code : std::uint8_t { schema = 3, channel = 4, message = 5, chunk = 6, data_end = 15 };
  static constexpr std::string_view magic{"\x89MCAP0\r\n", 8};

  template <class Use>
  void scan(const Use& use) {
    Cursor all{&file_, file_.bytes, magic.size(), 0};
    if (!records(all, use, false)) all.fault(sensor_log_messages::data_without_end());
    if (type_) return;
    std::vector<std::string> topics;
    for (const auto& [id, name] : topics_)
      if (std::find(topics.begin(), topics.end(), name) == topics.end()) topics.push_back(name);
    refuse(key_of_topic(), sensor_log_messages::topic_unknown(topic_, file_.path, all_of(topics)));
  }

  std::string key_of_topic() const { return file_.key.substr(0, file_.key.rfind('.')) + ".topic"; }

  /// Returns true at the end of the file.
  template <class Use>
  bool records(Cursor& from, const Use& use, bool packed) {
    while (from.more()) {
      if (looking_ && type_) return true;
      const auto code = from.number<std::uint8_t>();
      const auto size = from.number<std::uint64_t>();
      Cursor record = from.part(size);
      if (code == data_end && !packed) return true;
      if (code == schema) new_schema(record);
      if (code == channel) new_channel(record);
      if (code == chunk && !packed) unpack(record, use);
      if (code != message) continue;
      const auto id = record.number<std::uint16_t>();
      record.take(4);  // sequence
      const auto logged = record.number<std::uint64_t>();
      const auto published = record.number<std::uint64_t>();
      if (type_ && id == channel_) use(Stamps{logged, published}, record.part(record.left()));
    }
    return false;
  }

  void new_schema(Cursor& record) {
    Schema& s = schemas_[record.number<std::uint16_t>()];
    s.name = record.text();
    s.encoding = record.text();
    s.text = record.text();
  }

  void new_channel(Cursor& record) {
    const auto id = record.number<std::uint16_t>();
    const auto of = record.number<std::uint16_t>();
    const std::string name(record.text()), encoding(record.text());
    topics_[id] = name;
    if (name != topic_ || (type_ && id == channel_)) return;
    if (type_) refuse(key_of_topic(), sensor_log_messages::topic_ambiguous(topic_, file_.path));
    const Schema& s = schemas_[of];
    if (encoding != "cdr" || s.encoding != "ros2msg")
      refuse(key_of_topic(), sensor_log_messages::encoding_unsupported(topic_, encoding, s.encoding));
    channel_ = id;
    type_name_ = s.name;
    type_.emplace(file_, topic_, s.name, s.text);
  }

  template <class Use>
  void unpack(Cursor& record, const Use& use) {
    record.take(8 + 8);  // times
    const auto size = record.number<std::uint64_t>();
    const auto checksum = record.number<std::uint32_t>();
    const std::string compression(record.text());
    Cursor packed = record.part(record.number<std::uint64_t>());
    std::string plain;
    if (!compression.empty()) {
      if (compression != "zstd")
        refuse(file_.key, sensor_log_messages::chunk_packing_unsupported(file_.path, compression));
      plain = unpacked(packed, size);
    }
    Cursor inside{&file_, compression.empty() ? packed.data : std::string_view(plain), 0, packed.base};
    if (checksum != 0 && checksum != crc32(inside.data))
      packed.fault(sensor_log_messages::chunk_checksum_wrong());
    records(inside, use, true);
  }

  static std::string unpacked(const Cursor& packed, std::uint64_t size) {
    if (size > (std::uint64_t{1} << 30)) packed.fault(sensor_log_messages::chunk_too_large());
    const auto said = ZSTD_getFrameContentSize(packed.data.data(), packed.data.size());
    std::string plain;
    if (said == size || said == ZSTD_CONTENTSIZE_UNKNOWN) plain.resize(static_cast<std::size_t>(size));
    const std::size_t got =
        ZSTD_decompress(plain.data(), plain.size(), packed.data.data(), packed.data.size());
    if (ZSTD_isError(got) != 0 || got != size) packed.fault(sensor_log_messages::chunk_damaged());
    return plain;
  }

  struct Schema {
    std::string name, encoding, text;
  };
  const File& file_;
  std::string topic_, type_name_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, std::string> topics_;
  std::uint16_t channel_ = 0;
  std::optional<RosType> type_;
  bool looking_ = false;
};

}  // namespace fulmar::sensor_log
