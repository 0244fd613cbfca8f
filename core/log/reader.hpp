// SPDX-License-Identifier: BSD-3-Clause
// Reads MCAP files from the front, for tools and tests: every record, with verified checksums. Of a truncated
// file, it reads every whole record. Source: the MCAP file format specification, version 0.
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

/// Content of a file without its messages.
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
  bool complete = false;  // ends with a footer, and its summary agrees with the file
  std::string fault;      // "" or the reason for the end before the end of the file: "byte 4711: chunk ends
                          // after the file"

  /// The channel of a topic. Throws Error naming the existing topics.
  std::uint16_t channel(const std::string& topic) const;
  const Attachment* attachment(const std::string& name) const;
};

/// Hooks that continue reading after damage, where a stream without them ends; `fulmar log recover` has one.
struct McapSalvage {
  /// Throws Error when no record of this kind and length can begin here.
  virtual void check_head(std::uint64_t place, std::uint8_t code, std::uint64_t length) = 0;
  /// The same for a complete record whose content does not fit its length.
  virtual void check_whole(std::uint64_t place, std::uint8_t code, std::uint64_t length) = 0;
  /// Place where reading continues after the damaged record at `place`; 0: nowhere. `behind`: end of the
  /// record by its length field; 0 when that is outside the file.
  virtual std::uint64_t go_on(std::uint64_t place, std::uint8_t code, std::uint64_t behind) = 0;
  /// Called for a dropped message whose channel was in the damaged part.
  virtual void lost_message() = 0;
  /// Summary of a closed file: it repeats the schemas and channels, in case those in the chunks are damaged.
  std::vector<std::byte> summary;

 protected:
  ~McapSalvage() = default;
};

/// The messages of a file in order; at most one chunk of them is in memory.
class McapStream {
 public:
  /// Throws Error when the file cannot be read or is no MCAP file. Without `salvage`, reading ends at the
  /// first invalid byte.
  explicit McapStream(const std::filesystem::path& file, McapSalvage* salvage = nullptr);
  ~McapStream();
  McapStream(const McapStream&) = delete;
  McapStream& operator=(const McapStream&) = delete;

  /// Valid until the next call. nullptr at the end: log().complete or log().fault gives the reason.
  const McapFile::Message* next();
  /// The content read so far, without the messages.
  const McapFile& log() const;
  /// Moves the same out, at the end.
  McapFile take_log();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
