// SPDX-License-Identifier: BSD-3-Clause
// The log writer's state of schemas, channels and files, and the summary made from it. Internal to core/log.
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/log/mcap_bytes.hpp"
#include "core/log/out_file.hpp"

namespace fulmar::core::mcap {

struct Schema {
  std::string name, encoding, text;
  bool begun = false, stored = false;  // begun: in this or an earlier chunk; stored: in a chunk that is in
                                       // the file

  void write(Bytes& out, std::uint16_t id) const {
    out.record(schema, [&] { out.number(id).text(name).text(encoding).text(text); });
  }
};

struct Entry {
  std::uint64_t log_ns, offset;  // in the chunk
};

struct Channel {
  std::uint16_t schema = 0;
  std::string topic, encoding;
  Pairs metadata;
  bool begun = false, stored = false;
  std::uint64_t messages = 0;  // in the file
  std::vector<Entry> index{};  // of the open chunk

  void write(Bytes& out, std::uint16_t id) const {
    out.record(channel, [&] { out.number(id).number(schema).text(topic).text(encoding).pairs(metadata); });
  }
};

struct Span {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;
  void add(std::uint64_t ns) {
    first = std::min(first, ns);
    last = std::max(last, ns);
  }
};

/// Totals of one file and the records of its indexes.
struct Totals {
  Bytes chunk_indexes, attachment_indexes, metadata_indexes;
  std::uint32_t chunks = 0, attachments = 0, metadata_records = 0;
  std::uint64_t messages = 0;
  Span span;
};

/// Appends data end, summary, its offsets and footer to `block`, which must be the next block of the file.
void write_summary(Bytes& block, const OutFile& out, const std::vector<Schema>& schemas,
                   const std::vector<Channel>& channels, const Totals& file);

}  // namespace fulmar::core::mcap
