// SPDX-License-Identifier: BSD-3-Clause
// Writer of MCAP files: chunks with indexes, attachments, metadata, summary, CRC-32 throughout. Source: the
// MCAP file format specification, version 0. One thread. After the constructor, only std::bad_alloc is
// thrown. After the first disk fault it stores no message, `error` gives the reason, and the file keeps its
// ".part", without a summary. A partial write is removed, so that the file stays readable.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

using Pairs = std::vector<std::pair<std::string, std::string>>;

class McapWriter {
 public:
  struct Options {
    std::filesystem::path file;  // written as file + ".part", renamed when closed
    bool held = false;           // this process has reserved the name, see OutFile::hold
    std::string profile = "ros2";
    std::string library = "fulmar";
    int zstd_level = 1;                     // below 0: faster than level 1; 0: chunks are not compressed
    std::size_t chunk_bytes = 768u << 10;   // before compression
    std::int64_t chunk_ns = 1'000'000'000;  // of log time
    std::size_t max_message_bytes = 1u << 20;
    bool sync = false;  // flush to the disk after each chunk: for flights that may end with a loss of power
  };
  struct Result {
    std::filesystem::path file;  // current name; empty: the file is missing
    std::string error;
    std::string sha256;
    std::uint64_t messages = 0, bytes = 0;
    std::uint64_t lost = 0;  // messages that are not in the file
  };

  /// Throws Error when the file, or its ".part", exists or cannot be written.
  explicit McapWriter(const Options& options);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  std::uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& text);
  /// Schema 0: none.
  std::uint16_t add_channel(std::uint16_t schema, const std::string& topic, const std::string& encoding,
                            const Pairs& metadata);

  /// Room of max_message_bytes for a message; `end_message` gets the bytes used.
  std::byte* begin_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns,
                           std::uint64_t publish_ns);
  void end_message(std::size_t size);

  void attach(const std::string& name, const std::string& media_type, const std::string& content,
              std::uint64_t time_ns);
  void metadata(const std::string& name, const Pairs& pairs);

  bool failed() const;  // whether it has stopped storing messages
  const std::string& error() const;
  /// Stops storing messages; the content of the file stays.
  void fail(const Diagnostic& why);
  /// Call once, at the end. A file that could not be completed keeps its ".part".
  Result close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
