// SPDX-License-Identifier: BSD-3-Clause
// A schema and a channel are written to the chunk of the channel's first message, and again to the summary.
#include "core/log/mcap.hpp"

#include <zstd.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/log/mcap_bytes.hpp"
#include "core/log/mcap_summary.hpp"
#include "core/log/messages.hpp"
#include "core/log/out_file.hpp"

namespace fulmar::core {
namespace {

using mcap::Bytes, mcap::Channel, mcap::Entry, mcap::Schema, mcap::Span;

struct ZstdFree {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

struct McapWriter::Impl {
  Options options;
  std::unique_ptr<OutFile> out;
  std::vector<Schema> schemas;    // id = index + 1
  std::vector<Channel> channels;  // id = index
  std::unique_ptr<ZSTD_CCtx, ZstdFree> zstd{ZSTD_createCCtx()};

  Bytes chunk;                    // the open chunk
  std::size_t message_start = 0;  // in the chunk, of the current message
  std::uint64_t chunk_messages = 0;
  Span chunk_span;

  Bytes block;                // next bytes for the file, in one write
  mcap::Totals file;          // content of the file
  std::uint64_t offered = 0;  // messages begun

  explicit Impl(const Options& o) : options(o) {
    begin_file();
    chunk.reserve(options.chunk_bytes + options.max_message_bytes);
  }

  bool broken() const { return !out->error().empty(); }

  void begin_file() {
    out = std::make_unique<OutFile>(options.file, options.held);
    block.raw(mcap::magic.data(), mcap::magic.size());
    block.record(mcap::header, [&] { block.text(options.profile).text(options.library); });
    if (out->append(block.data(), block.size())) return;
    const std::string why = out->error();
    out.reset();
    std::error_code ignored;
    std::filesystem::remove(options.file.string() + ".part", ignored);
    throw Error(why);
  }

  /// Leaves a file with a failed write in the state of an interrupted one: no summary, no final name.
  Result end_file() {
    if (!broken()) {
      block.clear();
      mcap::write_summary(block, *out, schemas, channels, file);
      if (out->append(block.data(), block.size())) out->finish();
    }
    Result result;
    result.file = out->name();
    result.error = out->error();
    if (std::error_code none;
        broken() && !std::filesystem::exists(result.file, none)) {  // the file was removed
      file.messages = 0;
      result.file.clear();
    }
    result.sha256 = out->sha256();
    result.messages = file.messages;
    result.bytes = out->size();
    result.lost = offered - file.messages;
    return result;
  }

  /// Adds the next message of the chunk to the index.
  void note_message(std::uint16_t channel, std::uint64_t log_ns) {
    if (!channels[channel].begun) introduce(channel);
    channels[channel].index.push_back({log_ns, chunk.size()});
    chunk_span.add(log_ns);
    ++chunk_messages;
  }

  /// Stores `block`, a complete attachment or metadata record.
  void store_extra() {
    const std::uint64_t place = out->size();
    if (!out->append(block.data(), block.size())) return;
    const bool attachment = static_cast<mcap::Code>(*block.data()) == mcap::attachment;
    Bytes& index = attachment ? file.attachment_indexes : file.metadata_indexes;
    ++(attachment ? file.attachments : file.metadata_records);
    const std::size_t start = index.begin(attachment ? mcap::attachment_index : mcap::metadata_index);
    index.number(place).number(std::uint64_t{block.size()});
    mcap::Cursor in{{block.data(), block.size()}, mcap::record_head};
    if (attachment) {
      const mcap::Data times = in.take(16);
      const std::string name = in.text(), type = in.text();
      const auto content = in.number<std::uint64_t>();
      index.raw(times.data(), times.size()).number(content).text(name).text(type);
    } else {
      index.text(in.text());
    }
    index.end(start);
  }

  /// Ends the chunk if the message does not belong to it.
  void make_place(std::uint64_t log_ns) {
    const bool long_enough =
        chunk_messages > 0 && log_ns >= chunk_span.first + static_cast<std::uint64_t>(options.chunk_ns);
    if (long_enough || chunk.size() >= options.chunk_bytes) flush();
  }

  /// Writes the schema and channel records before a channel's first message.
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

  /// Compresses the open chunk to the end of `block`. Returns false on failure.
  bool compress() {
    if (options.zstd_level == 0) {
      block.append(chunk);
      return true;
    }
    const std::size_t before = block.size(), most = ZSTD_compressBound(chunk.size());
    const std::size_t n =
        ZSTD_compressCCtx(zstd.get(), block.grow(most), most, chunk.data(), chunk.size(), options.zstd_level);
    if (ZSTD_isError(n)) {
      out->fail(std::string("cannot compress: ") + ZSTD_getErrorName(n));
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
        .number(mcap::crc_of(0, {chunk.data(), chunk.size()}))
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
      offsets.number(static_cast<std::uint16_t>(id)).number(out->size() + block.size());
      block.record(mcap::message_index, [&] {
        const std::size_t bytes = index.size() * sizeof(Entry);
        block.number(static_cast<std::uint16_t>(id)).number(static_cast<std::uint32_t>(bytes));
        block.raw(index.data(), bytes);
      });
    }
    const std::uint64_t place = out->size();
    if (!out->append(block.data(), block.size())) return;
    if (options.sync) out->sync();

    Bytes& chunk_indexes = file.chunk_indexes;
    const std::size_t record = chunk_indexes.begin(mcap::chunk_index);
    chunk_indexes.number(chunk_span.first).number(chunk_span.last).number(place).number(chunk_length);
    chunk_indexes.number(static_cast<std::uint32_t>(offsets.size()))
        .append(offsets)
        .number(std::uint64_t{block.size() - chunk_length});
    chunk_indexes.text(compression).number(compressed).number(std::uint64_t{chunk.size()});
    chunk_indexes.end(record);
    note_stored();
  }

  void note_stored() {
    ++file.chunks;
    file.messages += chunk_messages;
    file.span.add(chunk_span.first);
    file.span.add(chunk_span.last);
    for (Channel& c : channels) {
      c.messages += c.index.size();
      c.stored = c.begun;
      if (c.begun && c.schema > 0) schemas[c.schema - 1u].stored = true;
    }
  }
};

McapWriter::McapWriter(const Options& options) : impl_(std::make_unique<Impl>(options)) {}

McapWriter::~McapWriter() = default;

std::uint16_t McapWriter::add_schema(const std::string& name, const std::string& encoding,
                                     const std::string& text) {
  impl_->schemas.push_back({name, encoding, text});
  return static_cast<std::uint16_t>(impl_->schemas.size());
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, const std::string& topic,
                                      const std::string& encoding, const Pairs& metadata) {
  if (impl_->channels.size() > std::numeric_limits<std::uint16_t>::max())
    throw Error(log_messages::too_many_channels());
  impl_->channels.push_back({.schema = schema, .topic = topic, .encoding = encoding, .metadata = metadata});
  return static_cast<std::uint16_t>(impl_->channels.size() - 1);
}

std::byte* McapWriter::begin_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_ns,
                                     std::uint64_t publish_ns) {
  Impl& w = *impl_;
  w.make_place(log_ns);
  w.note_message(channel, log_ns);
  w.chunk.reserve(mcap::record_head + mcap::message_head + w.options.max_message_bytes);
  w.message_start = w.chunk.size();
  ++w.offered;
  w.chunk.begin(mcap::message);  // the length follows in end_message
  w.chunk.number(channel).number(sequence).number(log_ns).number(publish_ns);
  return w.chunk.data() + w.chunk.size();
}

void McapWriter::end_message(std::size_t size) {
  Impl& w = *impl_;
  w.chunk.grow(size);
  w.chunk.end(w.message_start + mcap::record_head);
}

void McapWriter::attach(const std::string& name, const std::string& media_type, const std::string& content,
                        std::uint64_t time_ns) {
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
  w.block.number(mcap::crc_of(0, {w.block.data() + start, w.block.size() - start}));
  w.block.end(start);
  w.store_extra();
}

void McapWriter::metadata(const std::string& name, const Pairs& pairs) {
  Impl& w = *impl_;
  if (w.broken()) return;
  w.block.clear();
  w.block.record(mcap::metadata, [&] { w.block.text(name).pairs(pairs); });
  w.store_extra();
}

bool McapWriter::failed() const { return impl_->broken(); }

const std::string& McapWriter::error() const { return impl_->out->error(); }

void McapWriter::fail(const Diagnostic& why) { impl_->out->fail(why); }

McapWriter::Result McapWriter::close() {
  Impl& w = *impl_;
  w.flush();
  return w.end_file();
}

}  // namespace fulmar::core
