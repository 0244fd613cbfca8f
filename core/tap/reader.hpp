// SPDX-License-Identifier: BSD-3-Clause
// Reads MCAP files from the front, for tools and tests: every record, checksums verified. Of a file that was cut off, all that is whole.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fulmar::core {

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
    std::span<const std::byte> data;  // into `memory`
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
  std::vector<Message> messages;  // in file order
  std::vector<Attachment> attachments;
  std::vector<Metadata> metadata;
  std::uint32_t chunks = 0;
  bool complete = false;                      // ends with a footer, and its summary says the same as the file
  std::string fault;                          // "" or why reading ended before the end: "byte 4711: chunk ends after the file"
  std::deque<std::vector<std::byte>> memory;  // the file and its chunks, decompressed

  McapFile() = default;
  McapFile(McapFile&&) = default;  // moving keeps the memory in place
  McapFile& operator=(McapFile&&) = default;

  /// The channel of a topic. Throws Error naming the topics there are.
  std::uint16_t channel(const std::string& topic) const;
  const Attachment* attachment(const std::string& name) const;
};

/// Throws Error when the file cannot be read at all or is no MCAP file.
McapFile read_mcap(const std::filesystem::path& file);

}  // namespace fulmar::core
