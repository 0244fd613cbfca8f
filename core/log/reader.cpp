// SPDX-License-Identifier: BSD-3-Clause
// Reading ends at the first invalid byte; the content before it stays valid.
#include "core/log/reader.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <set>

#include "core/error.hpp"
#include "core/log/mcap_bytes.hpp"
#include "core/log/messages.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

using mcap::crc_of, mcap::Cursor, mcap::Data, mcap::largest_record, mcap::require;

constexpr std::uint64_t largest_chunk =
    1u << 25;  // decompressed; a chunk of a flight has 768 kB and a message, chunks of other writers a few MB
constexpr std::uint64_t largest_schemas =
    1u << 25;  // limit on all schemas and channels, of which chunks can hold thousands

/// Decompresses the content of a chunk into `room`.
Data open_chunk(const std::string& compression, Data stored, std::uint64_t size,
                std::vector<std::byte>& room) {
  if (compression.empty()) {
    require(stored.size() == size, log_messages::chunk_size_differs);
    room.assign(stored.begin(), stored.end());
    return room;
  }
  if (compression != "zstd") throw Error(log_messages::compression_unknown(compression.substr(0, 32)));
  require(size <= largest_chunk, log_messages::chunk_too_large);
  // Check the size before the allocation.
  const unsigned long long stated = ZSTD_getFrameContentSize(stored.data(), stored.size());
  require(stated == ZSTD_CONTENTSIZE_UNKNOWN || stated == size, log_messages::chunk_not_decompressible);
  room.resize(size);
  const std::size_t n = ZSTD_decompress(room.data(), size, stored.data(), stored.size());
  require(!ZSTD_isError(n) && n == size, log_messages::chunk_not_decompressible);
  return room;
}

}  // namespace

struct McapStream::Impl {
  std::ifstream in;
  McapSalvage* salvage;
  McapFile file;
  std::uint64_t size = 0, place = 0;  // size of the file; offset of the next record
  struct {
    std::uint64_t place = 0;
    std::uint8_t code = 0;
    bool whole = false;   // the record is complete by its length field
  } now;                  // the current record
  std::uint32_t crc = 0;  // of the section up to there: the data, then the summary
  std::vector<std::byte> record;
  Data chunk;  // the last chunk, decompressed
  struct {
    std::vector<std::byte> chunk;       // room for the messages of a chunk
    bool in_chunk = false;              // the pending messages are in `chunk`, else in `record`
    std::vector<std::uint32_t> starts;  // offset of each message's content: a chunk can hold a million
    std::size_t given = 0;
  } pending;                  // messages
  McapFile::Message present;  // the message returned last
  std::uint64_t messages = 0, defined_bytes = 0;
  bool damaged = false;                                    // any record was skipped, even an index
  std::map<std::uint8_t, std::set<std::uint64_t>> places;  // of the chunks, attachments and metadata so far
  std::uint64_t summary_start = 0;                         // 0: not reached yet
  bool ended = false;

  Impl(const std::filesystem::path& path, McapSalvage* s) : salvage(s) {
    std::error_code fault;
    const std::filesystem::file_status status = std::filesystem::status(path, fault);
    errno = 0;
    if (std::filesystem::is_regular_file(status)) in.open(path, std::ios::binary | std::ios::ate);
    if (!in.is_open() || !in) {
      const int no_file = std::filesystem::is_directory(status) ? EISDIR : fault ? fault.value() : ESPIPE;
      throw Error(log_messages::log_not_readable(path.string(), std::strerror(errno != 0 ? errno : no_file)));
    }
    size = static_cast<std::uint64_t>(in.tellg());
    in.seekg(0);
    std::string magic(mcap::magic.size(), '\0');
    if (size < magic.size() || !in.read(magic.data(), static_cast<std::streamsize>(magic.size())) ||
        magic != mcap::magic)
      throw Error(log_messages::log_format_invalid(path.string()));
    place = mcap::magic.size();
    if (salvage) definitions(salvage->summary);
    crc = crc_of(0, std::as_bytes(std::span(magic)));
  }

  void seek(std::uint64_t to) {
    in.clear();
    in.seekg(static_cast<std::streamoff>(to));
    place = to;
  }

  void read(std::byte* to, std::uint64_t bytes) {
    require(bytes <= size - place, log_messages::file_truncated);
    require(static_cast<bool>(in.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(bytes))),
            log_messages::content_not_readable);
    place += bytes;
  }

  /// Reads records until there are messages. False at the end.
  bool fill() {
    pending.starts.clear();
    pending.given = 0;
    try {
      while (!ended && file.fault.empty() && pending.starts.empty()) next_record_or_later();
    } catch (const std::bad_alloc&) {
      stop(log_messages::record_memory_exhausted());
    } catch (const Error& e) {
      stop(e.what() + (salvage || !is_damage(e.diagnostic.code) ? "" : log_messages::repair_hint().line()));
    }
    messages += pending.starts.size();
    if (ended) file.complete = !damaged;
    return !pending.starts.empty();
  }

  /// False for a log that another copy or a repair does not make readable.
  static bool is_damage(std::string_view code) {
    return code != log_messages::compression_unknown.code() &&
           code != log_messages::content_not_readable.code() &&
           code != log_messages::schemas_too_large.code();
  }

  void stop(const std::string& why) {
    pending.starts.clear();
    file.fault = "byte " + std::to_string(now.place) + ": " + why;
  }

  /// With salvage, damage costs only the record that contains it.
  void next_record_or_later() {
    try {
      next_record();
    } catch (const Error&) {
      if (!salvage || summary_start > 0) throw;
      const std::uint64_t next = salvage->go_on(now.place, now.code, now.whole ? place : 0);
      if (next == 0) throw;
      damaged = true;
      pending.starts.clear();
      chunk = {};
      seek(next);
    }
  }

  void next_record() {
    now.place = place;
    now.code = 0;
    now.whole = false;
    std::array<std::byte, mcap::record_head> head;
    read(head.data(), head.size());
    Cursor in_head{head};
    const auto code = now.code = in_head.number<std::uint8_t>();
    const auto length = in_head.number<std::uint64_t>();
    require(length <= size - place, log_messages::file_truncated);
    if (salvage && summary_start == 0) salvage->check_head(now.place, code, length);
    require(length <= largest_record, log_messages::record_too_large);
    record.resize(length);
    read(record.data(), length);
    now.whole = true;
    pending.in_chunk = false;
    if (salvage) salvage->check_whole(now.place, code, length);
    if (code == mcap::footer) {
      footer(head);
      return;
    }
    const std::uint32_t before = crc;
    crc = crc_of(crc_of(crc, head), record);
    if (code == mcap::data_end) {
      const auto sum = Cursor{record}.number<std::uint32_t>();
      summary_start = place;
      crc = 0;
      require(sum == 0 || sum == before || damaged, log_messages::data_checksum_invalid);
    } else {
      content(code, record);
      if (code == mcap::chunk || code == mcap::attachment || code == mcap::metadata)
        places[code].insert(now.place);
    }
  }

  void content(std::uint8_t code, Data data) {
    Cursor cursor{data};
    switch (code) {
      case mcap::header:
        file.profile = cursor.text();
        file.library = cursor.text();
        break;
      case mcap::schema:
      case mcap::channel: definition(code, cursor); break;
      case mcap::message: note_message(cursor); break;
      case mcap::chunk:
        chunk_content(cursor);
        ++file.chunks;
        break;
      case mcap::message_index:
        if (!salvage) check_message_index(cursor);
        break;
      case mcap::attachment: attachment(cursor); break;
      case mcap::metadata: metadata(cursor); break;
      case mcap::statistics:
        if (!damaged) check_statistics(cursor);
        break;
      case mcap::chunk_index:
        cursor.take(16);
        check_place(cursor, mcap::chunk, log_messages::chunk_index_wrong);
        break;
      case mcap::attachment_index:
        check_place(cursor, mcap::attachment, log_messages::attachment_index_wrong);
        break;
      case mcap::metadata_index:
        check_place(cursor, mcap::metadata, log_messages::metadata_index_wrong);
        break;
      default: break;  // other records: the format may grow
    }
  }

  void check_place(Cursor& cursor, mcap::Code code, const MessageText<0>& otherwise) {
    require(damaged || places[code].contains(cursor.number<std::uint64_t>()), otherwise);
  }

  /// Reads the definitions of a summary up to the first fault.
  void definitions(Data summary) try {
    for (Cursor records{summary}; records.more();) {
      const auto code = records.number<std::uint8_t>();
      Cursor of{records.take(records.number<std::uint64_t>())};
      if (code == mcap::schema || code == mcap::channel) definition(code, of);
    }
  } catch (const Error&) {
  }

  void definition(std::uint8_t code, Cursor& cursor) {
    const auto id = cursor.number<std::uint16_t>();
    const bool known = code == mcap::schema ? file.schemas.contains(id) : file.channels.contains(id);
    if (!known) defined_bytes += cursor.data.size();
    require(defined_bytes <= largest_schemas, log_messages::schemas_too_large);
    if (code == mcap::schema) {
      McapFile::Schema schema{cursor.text(), cursor.text(), cursor.text()};
      file.schemas.try_emplace(id, std::move(schema));
      return;
    }
    McapFile::Channel channel{.schema = cursor.number<std::uint16_t>(),
                              .topic = cursor.text(),
                              .encoding = cursor.text(),
                              .metadata = {}};
    channel.metadata = cursor.pairs();
    file.channels.try_emplace(id, std::move(channel));
  }

  void note_message(Cursor& cursor) {
    const auto channel = cursor.number<std::uint16_t>();
    cursor.take(mcap::message_head - sizeof channel);
    if (salvage && !file.channels.contains(channel)) {  // its channel was in a damaged chunk
      damaged = true;
      salvage->lost_message();
      return;
    }
    require(file.channels.contains(channel), log_messages::message_channel_missing);
    const std::byte* const room = pending.in_chunk ? pending.chunk.data() : record.data();
    pending.starts.push_back(static_cast<std::uint32_t>(cursor.data.data() - room));
  }

  /// The length precedes the content, except for a message record outside a chunk.
  McapFile::Message message(std::uint32_t at) const {
    Data content = record;
    if (pending.in_chunk) {
      Cursor length{pending.chunk, at - sizeof(std::uint64_t)};
      content = Data(pending.chunk).subspan(at, length.number<std::uint64_t>());
    }
    Cursor cursor{content};
    McapFile::Message m;
    m.channel = cursor.number<std::uint16_t>();
    m.sequence = cursor.number<std::uint32_t>();
    m.log_ns = cursor.number<std::uint64_t>();
    m.publish_ns = cursor.number<std::uint64_t>();
    m.data = content.subspan(cursor.at);
    return m;
  }

  void metadata(Cursor& cursor) {
    McapFile::Metadata m{cursor.text(), {}};
    m.pairs = cursor.pairs();
    file.metadata.push_back(std::move(m));
  }

  void chunk_content(Cursor& cursor) {
    cursor.take(16);  // first and last time
    const auto length = cursor.number<std::uint64_t>();
    const auto sum = cursor.number<std::uint32_t>();
    const std::string compression = cursor.text();
    const Data stored = cursor.take(cursor.number<std::uint64_t>());
    chunk = open_chunk(compression, stored, length, pending.chunk);
    require(sum == 0 || sum == crc_of(0, chunk), log_messages::chunk_checksum_invalid);
    pending.in_chunk = true;
    Cursor inside{chunk};
    while (inside.more()) {
      const auto code = inside.number<std::uint8_t>();
      require(code == mcap::schema || code == mcap::channel || code == mcap::message,
              log_messages::chunk_content_invalid);
      content(code, inside.take(inside.number<std::uint64_t>()));
    }
  }

  void check_message_index(Cursor& cursor) {
    const auto channel = cursor.number<std::uint16_t>();
    Cursor entries{cursor.take(cursor.number<std::uint32_t>())};
    while (entries.more()) {
      const auto log_ns = entries.number<std::uint64_t>();
      const auto offset = entries.number<std::uint64_t>();
      require(offset < chunk.size(), log_messages::index_outside_chunk);
      Cursor at{chunk, offset};
      const bool is_message = at.number<std::uint8_t>() == mcap::message;
      at.take(8);
      const bool same_channel = at.number<std::uint16_t>() == channel;
      at.take(4);
      require(is_message && same_channel && at.number<std::uint64_t>() == log_ns,
              log_messages::index_target_invalid);
    }
  }

  void attachment(Cursor& cursor) {
    McapFile::Attachment a;
    a.log_ns = cursor.number<std::uint64_t>();
    cursor.take(8);
    a.name = cursor.text();
    a.media_type = cursor.text();
    const Data content = cursor.take(cursor.number<std::uint64_t>());
    a.content.assign(reinterpret_cast<const char*>(content.data()), content.size());
    const std::uint32_t sum = crc_of(0, cursor.data.first(cursor.at));
    const auto stored = cursor.number<std::uint32_t>();
    require(stored == 0 || stored == sum, log_messages::attachment_checksum_invalid);
    file.attachments.push_back(std::move(a));
  }

  /// Ignores the counts of schemas and channels: writers differ on those without a message.
  void check_statistics(Cursor& cursor) const {
    const bool right_messages = cursor.number<std::uint64_t>() == messages;
    cursor.take(2 + 4);
    const bool attachments = cursor.number<std::uint32_t>() == file.attachments.size();
    const bool metadata = cursor.number<std::uint32_t>() == file.metadata.size();
    const bool chunks = cursor.number<std::uint32_t>() == file.chunks;
    require(right_messages && attachments && metadata && chunks, log_messages::statistics_differ);
  }

  void footer(Data head) {
    Cursor cursor{record};
    const auto start = cursor.number<std::uint64_t>();
    require(start == 0 || start == summary_start, log_messages::footer_offset_invalid);
    cursor.take(8);
    const std::uint32_t sum = crc_of(crc_of(crc, head), Data(record).first(cursor.at));
    const auto stored = cursor.number<std::uint32_t>();
    require(stored == 0 || stored == sum, log_messages::summary_checksum_invalid);
    std::string magic(mcap::magic.size(), '\0');
    require(size - place == magic.size(), log_messages::closing_magic_missing);
    read(reinterpret_cast<std::byte*>(magic.data()), magic.size());
    require(magic == mcap::magic, log_messages::closing_magic_missing);
    ended = true;
  }
};

McapStream::McapStream(const std::filesystem::path& file, McapSalvage* salvage)
    : impl_(std::make_unique<Impl>(file, salvage)) {}

McapStream::~McapStream() = default;

const McapFile::Message* McapStream::next() {
  if (impl_->pending.given == impl_->pending.starts.size() && !impl_->fill()) return nullptr;
  impl_->present = impl_->message(impl_->pending.starts[impl_->pending.given++]);
  return &impl_->present;
}

const McapFile& McapStream::log() const { return impl_->file; }

McapFile McapStream::take_log() { return std::move(impl_->file); }

std::uint16_t McapFile::channel(const std::string& topic) const {
  std::vector<std::string> topics;
  for (const auto& [id, c] : channels) {
    if (c.topic == topic) return id;
    topics.push_back(c.topic);
  }
  throw Error(log_messages::topic_unknown(topic, choices_text(topic, topics)));
}

const McapFile::Attachment* McapFile::attachment(const std::string& name) const {
  return find_named(attachments, name);
}

}  // namespace fulmar::core
