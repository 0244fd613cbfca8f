// SPDX-License-Identifier: BSD-3-Clause
// Reads MCAP files from the front, for tools and tests: every record, checksums verified. Of a file that was
// cut off, all that is whole. Source: the MCAP file format specification, version 0.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fulmar::core {

/// What a file holds beside its messages.
struct McapFile {
  struct Schema {
    std::string name, encoding, text;
  };
  struct Channel {
    std::uint16_t schema = 0;
    std::string topic, encoding;
    std::vector<std::pair<std::string, std::string>> metadata;
  };
  struct Message {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t log_ns = 0, publish_ns = 0;
    std::span<const std::byte> data;
  };
  struct Attachment {
    std::string name, media_type, content;
    std::uint64_t log_ns = 0;
  };
  struct Metadata {
    std::string name;
    std::vector<std::pair<std::string, std::string>> pairs;
  };

  std::string profile, library;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<Attachment> attachments;
  std::vector<Metadata> metadata;
  std::uint32_t chunks = 0;
  bool complete = false;  // ends with a footer, and its summary says the same as the file
  std::string fault;      // "" or why reading ended before the end: "byte 4711: chunk ends after the file"

  /// The channel of a topic. Throws Error naming the topics there are.
  std::uint16_t channel(const std::string& topic) const;
  const Attachment* attachment(const std::string& name) const;
};

/// What lets a reading go on behind damage, where a stream by itself ends: `fulmar log recover` has one.
struct McapSalvage {
  /// Throws Error where no record of this kind and length can begin.
  virtual void check_head(std::uint64_t place, std::uint8_t code, std::uint64_t length) = 0;
  /// The same of a record that is there as a whole, and does not hold what its length claims.
  virtual void check_whole(std::uint64_t place, std::uint8_t code, std::uint64_t length) = 0;
  /// Where the reading goes on after the damaged record at `place`; 0: nowhere. `behind`: the end that it
  /// claims, 0 when that is not in the file.
  virtual std::uint64_t go_on(std::uint64_t place, std::uint8_t code, std::uint64_t behind) = 0;
  /// A message is left out whose channel stood in what is damaged.
  virtual void lost_message() = 0;
  /// Of a file that was closed: it repeats the schemas and channels, for when those in the chunks are
  /// damaged.
  std::vector<std::byte> summary;

 protected:
  ~McapSalvage() = default;
};

/// The messages of a file one after the other; no more than one chunk of them is in memory.
class McapStream {
 public:
  /// Throws Error when the file cannot be read at all or is no MCAP file. Without `salvage` the reading ends
  /// at the first byte that is not as the format says.
  explicit McapStream(const std::filesystem::path& file, McapSalvage* salvage = nullptr);
  ~McapStream();
  McapStream(const McapStream&) = delete;
  McapStream& operator=(const McapStream&) = delete;

  /// Valid until the next call. nullptr at the end: then log().complete or log().fault tells which one.
  const McapFile::Message* next();
  /// What has been read so far, without the messages.
  const McapFile& log() const;
  /// The same, at the end, to keep.
  McapFile take_log();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
