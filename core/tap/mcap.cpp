// SPDX-License-Identifier: BSD-3-Clause
// See mcap.hpp. A schema and a channel stand in the chunk of the channel's first message, and again in the summary.
#include "core/tap/mcap.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/tap/mcap_bytes.hpp"
#include "core/tap/out_file.hpp"

namespace fulmar::core {
namespace {

using mcap::Bytes;

std::uint32_t crc_of(const std::byte* data, std::size_t size) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(data), size));
}

struct Schema {
  std::string name, encoding, text;
  bool begun = false, stored = false;  // in this or an earlier chunk; in a chunk that is in the file

  void write(Bytes& out, std::uint16_t id) const {
    const std::size_t start = out.begin(mcap::schema);
    out.number(id).text(name).text(encoding).text(text);
    out.end(start);
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
    const std::size_t start = out.begin(mcap::channel);
    out.number(id).number(schema).text(topic).text(encoding).pairs(metadata);
    out.end(start);
  }
};

struct Span {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;
  void add(std::uint64_t ns) {
    first = std::min(first, ns);
    last = std::max(last, ns);
  }
};

struct ZstdFree {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

struct McapWriter::Impl {
  Options options;
  OutFile file;
  std::vector<Schema> schemas;    // id = index + 1
  std::vector<Channel> channels;  // id = index
  std::unique_ptr<ZSTD_CCtx, ZstdFree> zstd{ZSTD_createCCtx()};

  Bytes chunk;  // the open one
  std::size_t message_start = 0;
  std::uint64_t chunk_messages = 0;
  Span chunk_span;

  Bytes block;  // what goes to the file in one piece
  Bytes chunk_indexes, attachment_indexes, metadata_indexes;
  std::uint32_t chunks = 0, attachments = 0, metadata_records = 0;
  std::uint64_t messages = 0, offered = 0;  // in the file; begun
  Span span;

  explicit Impl(const Options& o) : options(o), file(o.file) {
    block.raw(mcap::magic.data(), mcap::magic.size());
    const std::size_t start = block.begin(mcap::header);
    block.text(options.profile).text(options.library);
    block.end(start);
    if (!file.append(block.data(), block.size())) throw Error(file.error());
    chunk.reserve(options.chunk_bytes + options.max_message_bytes);
  }

  bool broken() const { return !file.error().empty(); }

  /// The schema and channel records that a channel's first message needs before it.
  void introduce(std::uint16_t id) {
    Channel& channel = channels[id];
    if (channel.schema > 0) {
      Schema& schema = schemas[channel.schema - 1u];
      if (!schema.begun) schema.write(chunk, channel.schema);
      schema.begun = true;
    }
    channel.write(chunk, id);
    channel.begun = true;
  }

  /// Compresses the open chunk to the end of `block`. False when that cannot be.
  bool compress() {
    if (options.zstd_level == 0) {
      block.append(chunk);
      return true;
    }
    const std::size_t before = block.size(), most = ZSTD_compressBound(chunk.size());
    const std::size_t n = ZSTD_compressCCtx(zstd.get(), block.grow(most), most, chunk.data(), chunk.size(), options.zstd_level);
    if (ZSTD_isError(n)) {
      file.fail(std::string("cannot compress: ") + ZSTD_getErrorName(n));
      return false;
    }
    block.shrink(before + n);
    return true;
  }

  void flush() {
    if (chunk_messages == 0) return;
    if (!broken()) store_chunk();
    for (Channel& c : channels) c.index.clear();
    chunk.clear();
    chunk_messages = 0;
    chunk_span = {};
  }

  void store_chunk() {
    const std::string_view compression = options.zstd_level == 0 ? "" : "zstd";
    block.clear();
    const std::size_t start = block.begin(mcap::chunk);
    block.number(chunk_span.first)
        .number(chunk_span.last)
        .number(std::uint64_t{chunk.size()})
        .number(crc_of(chunk.data(), chunk.size()))
        .text(compression);
    const std::size_t data = block.number(std::uint64_t{0}).size();
    if (!compress()) return;
    const std::uint64_t compressed = block.size() - data;
    block.patch(data - 8, compressed);
    block.end(start);
    const std::uint64_t chunk_length = block.size();

    Bytes offsets;  // of each channel's index
    for (std::size_t id = 0; id < channels.size(); ++id) {
      const std::vector<Entry>& index = channels[id].index;
      if (index.empty()) continue;
      offsets.number(static_cast<std::uint16_t>(id)).number(file.size() + block.size());
      const std::size_t record = block.begin(mcap::message_index);
      block.number(static_cast<std::uint16_t>(id)).number(static_cast<std::uint32_t>(index.size() * sizeof(Entry)));
      block.raw(index.data(), index.size() * sizeof(Entry));
      block.end(record);
    }
    const std::uint64_t place = file.size();
    if (!file.append(block.data(), block.size())) return;
    if (options.sync) file.sync();

    const std::size_t record = chunk_indexes.begin(mcap::chunk_index);
    chunk_indexes.number(chunk_span.first).number(chunk_span.last).number(place).number(chunk_length);
    chunk_indexes.number(static_cast<std::uint32_t>(offsets.size())).append(offsets).number(std::uint64_t{block.size() - chunk_length});
    chunk_indexes.text(compression).number(compressed).number(std::uint64_t{chunk.size()});
    chunk_indexes.end(record);
    note_stored();
  }

  void note_stored() {
    ++chunks;
    messages += chunk_messages;
    span.add(chunk_span.first);
    span.add(chunk_span.last);
    for (Channel& c : channels) {
      c.messages += c.index.size();
      c.stored = c.begun;
      if (c.begun && c.schema > 0) schemas[c.schema - 1u].stored = true;
    }
  }

  void statistics(Bytes& out) const {
    const std::size_t start = out.begin(mcap::statistics);
    Bytes counts;
    std::uint16_t schema_count = 0;
    std::uint32_t channel_count = 0;
    for (const Schema& s : schemas) schema_count = static_cast<std::uint16_t>(schema_count + s.stored);
    for (std::size_t id = 0; id < channels.size(); ++id) {
      if (!channels[id].stored) continue;
      ++channel_count;
      counts.number(static_cast<std::uint16_t>(id)).number(channels[id].messages);
    }
    out.number(messages).number(schema_count).number(channel_count).number(attachments).number(metadata_records).number(chunks);
    out.number(messages > 0 ? span.first : std::uint64_t{0}).number(span.last);
    out.number(static_cast<std::uint32_t>(counts.size())).append(counts);
    out.end(start);
  }

  /// Data end, summary, its offsets and footer, as one block.
  void summary() {
    block.clear();
    const std::size_t end = block.begin(mcap::data_end);
    block.number(file.crc());
    block.end(end);
    const std::size_t summary_start = block.size();

    Bytes offsets;
    std::size_t group = summary_start;
    const auto end_group = [&](mcap::Code code) {
      if (block.size() > group) {
        const std::size_t start = offsets.begin(mcap::summary_offset);
        offsets.number(code).number(file.size() + group).number(std::uint64_t{block.size() - group});
        offsets.end(start);
      }
      group = block.size();
    };
    for (std::size_t i = 0; i < schemas.size(); ++i) {
      if (schemas[i].stored) schemas[i].write(block, static_cast<std::uint16_t>(i + 1));
    }
    end_group(mcap::schema);
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i].stored) channels[i].write(block, static_cast<std::uint16_t>(i));
    }
    end_group(mcap::channel);
    statistics(block);
    end_group(mcap::statistics);
    block.append(chunk_indexes);
    end_group(mcap::chunk_index);
    block.append(attachment_indexes);
    end_group(mcap::attachment_index);
    block.append(metadata_indexes);
    end_group(mcap::metadata_index);
    const std::size_t offset_start = block.size();
    block.append(offsets);

    const std::size_t start = block.begin(mcap::footer);
    block.number(std::uint64_t{file.size() + summary_start}).number(std::uint64_t{file.size() + offset_start});
    block.patch(start - 8, std::uint64_t{20});  // the sum covers the footer up to itself, its length too
    block.number(crc_of(block.data() + summary_start, block.size() - summary_start));
    block.raw(mcap::magic.data(), mcap::magic.size());
  }
};

McapWriter::McapWriter(const Options& options) : impl_(std::make_unique<Impl>(options)) {}

McapWriter::~McapWriter() = default;

std::uint16_t McapWriter::add_schema(const std::string& name, const std::string& encoding, const std::string& text) {
  impl_->schemas.push_back({name, encoding, text});
  return static_cast<std::uint16_t>(impl_->schemas.size());
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, const std::string& topic, const std::string& encoding, const Pairs& metadata) {
  if (impl_->channels.size() > std::numeric_limits<std::uint16_t>::max()) throw Error("a log holds at most 65536 channels");
  impl_->channels.push_back({.schema = schema, .topic = topic, .encoding = encoding, .metadata = metadata});
  return static_cast<std::uint16_t>(impl_->channels.size() - 1);
}

std::byte* McapWriter::begin_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns, std::uint64_t publish_ns) {
  Impl& w = *impl_;
  const bool long_enough = w.chunk_messages > 0 && log_ns >= w.chunk_span.first + static_cast<std::uint64_t>(w.options.chunk_ns);
  if (long_enough || w.chunk.size() >= w.options.chunk_bytes) w.flush();
  if (!w.channels[channel].begun) w.introduce(channel);
  w.chunk.reserve(mcap::record_head + mcap::message_head + w.options.max_message_bytes);

  w.channels[channel].index.push_back({log_ns, w.chunk.size()});
  w.message_start = w.chunk.size();
  w.chunk_span.add(log_ns);
  ++w.chunk_messages;
  ++w.offered;
  std::byte* at = w.chunk.grow(mcap::record_head + mcap::message_head);
  *at = static_cast<std::byte>(mcap::message);
  at += mcap::record_head;  // the length follows in end_message
  std::memcpy(at, &channel, 2);
  std::memcpy(at + 2, &sequence, 4);
  std::memcpy(at + 6, &log_ns, 8);
  std::memcpy(at + 14, &publish_ns, 8);
  return at + mcap::message_head;
}

void McapWriter::end_message(std::size_t size) {
  Impl& w = *impl_;
  w.chunk.grow(size);
  w.chunk.end(w.message_start + mcap::record_head);
}

void McapWriter::attach(const std::string& name, const std::string& media_type, const std::string& content, std::uint64_t time_ns) {
  Impl& w = *impl_;
  if (w.broken()) return;
  w.block.clear();
  const std::size_t start = w.block.begin(mcap::attachment);
  w.block.number(time_ns)
      .number(time_ns)
      .text(name)
      .text(media_type)
      .number(std::uint64_t{content.size()})
      .raw(content.data(), content.size());
  w.block.number(crc_of(w.block.data() + start, w.block.size() - start));
  w.block.end(start);
  const std::uint64_t place = w.file.size();
  if (!w.file.append(w.block.data(), w.block.size())) return;
  ++w.attachments;
  const std::size_t record = w.attachment_indexes.begin(mcap::attachment_index);
  w.attachment_indexes.number(place).number(std::uint64_t{w.block.size()}).number(time_ns).number(time_ns);
  w.attachment_indexes.number(std::uint64_t{content.size()}).text(name).text(media_type);
  w.attachment_indexes.end(record);
}

void McapWriter::metadata(const std::string& name, const Pairs& pairs) {
  Impl& w = *impl_;
  if (w.broken()) return;
  w.block.clear();
  const std::size_t start = w.block.begin(mcap::metadata);
  w.block.text(name).pairs(pairs);
  w.block.end(start);
  const std::uint64_t place = w.file.size();
  if (!w.file.append(w.block.data(), w.block.size())) return;
  ++w.metadata_records;
  const std::size_t record = w.metadata_indexes.begin(mcap::metadata_index);
  w.metadata_indexes.number(place).number(std::uint64_t{w.block.size()}).text(name);
  w.metadata_indexes.end(record);
}

bool McapWriter::failed() const { return impl_->broken(); }

void McapWriter::fail(const std::string& why) { impl_->file.fail(why); }

McapWriter::Result McapWriter::close() {
  Impl& w = *impl_;
  w.flush();
  // After a full disk there is often room for the summary: then the file ends well, only short.
  w.summary();
  bool whole = w.file.append(w.block.data(), w.block.size());
  whole = whole && w.file.finish();
  if (!whole && !std::filesystem::exists(w.file.name())) w.messages = 0;  // somebody has removed the file
  return {w.file.sha256(), w.messages, w.file.size(), w.offered - w.messages, w.file.error(), w.file.name()};
}

}  // namespace fulmar::core
