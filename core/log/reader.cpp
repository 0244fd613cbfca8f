// SPDX-License-Identifier: BSD-3-Clause
// See reader.hpp. The reading ends at the first byte that is not as the format says, or goes on behind it;
// what came before stays.
#include "core/log/reader.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <new>
#include <set>

#include "core/error.hpp"
#include "core/log/mcap_bytes.hpp"

namespace fulmar::core {
namespace {

using Data = std::span<const std::byte>;

constexpr std::uint64_t largest_chunk =
    1u << 28;  // decompressed; a file that claims more is not one of a flight
constexpr std::uint64_t largest_record = 1u << 28;  // the same of a record that has to be in memory
constexpr std::uint64_t largest_schemas =
    1u << 28;  // the same of all schemas and channels, which chunks can hold by the thousand

std::uint32_t crc_of(std::uint32_t before, Data data) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(data.data()), data.size()));
}

/// Reads values one after the other; throws Error at the end of the data.
struct Cursor {
  Data data;
  std::size_t at = 0;

  Data take(std::uint64_t size) {
    if (size > data.size() - at) throw Error("a record ends too early");
    at += size;
    return data.subspan(at - size, size);
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() {
    const Data bytes = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::vector<std::pair<std::string, std::string>> pairs() {
    Cursor inside{take(number<std::uint32_t>())};
    std::vector<std::pair<std::string, std::string>> map;
    while (inside.at < inside.data.size()) {
      std::string key = inside.text();
      map.emplace_back(std::move(key), inside.text());
    }
    return map;
  }
  bool more() const { return at < data.size(); }
};

void require(bool truth, const char* otherwise) {
  if (!truth) throw Error(otherwise);
}

/// The content of a chunk, decompressed into `room`.
Data open_chunk(const std::string& compression, Data stored, std::uint64_t size,
                std::vector<std::byte>& room) {
  if (compression.empty()) {
    require(stored.size() == size, "a chunk is not as long as it says");
    room.assign(stored.begin(), stored.end());
    return room;
  }
  if (compression != "zstd")
    throw Error("a chunk is compressed as '" + compression.substr(0, 32) + "'. Valid: zstd, or not at all");
  require(size <= largest_chunk, "a chunk claims to hold more than 256 MB");
  // A wrong size is found before memory is taken for it.
  const unsigned long long says = ZSTD_getFrameContentSize(stored.data(), stored.size());
  require(says == ZSTD_CONTENTSIZE_UNKNOWN || says == size, "a chunk does not decompress");
  room.resize(size);
  const std::size_t n = ZSTD_decompress(room.data(), size, stored.data(), stored.size());
  require(!ZSTD_isError(n) && n == size, "a chunk does not decompress");
  return room;
}

}  // namespace

struct McapStream::Impl {
  std::ifstream in;
  BadChunks bad_chunks;
  McapFile file;
  std::uint64_t size = 0, place = 0;          // of the file; of the next record
  std::uint64_t place_before = 0;             // of the record that is read now
  std::uint8_t code_before = 0;               // its code
  bool framed = false;                        // it was there up to the end that it claims
  std::uint32_t crc = 0;                      // of the section up to there: the data, then the summary
  std::vector<std::byte> record, chunk_room;  // that the pending messages point into
  Data chunk;                                 // the last one, decompressed
  std::vector<McapFile::Message> pending;
  std::size_t given = 0;  // of the pending ones
  bool in_chunk = false;  // they point into chunk_room, else into record
  std::uint64_t messages = 0, defined_bytes = 0;
  McapStream::LeftOut left_out;
  bool damaged = false;  // something was left out, if only an index
  std::set<std::uint64_t> chunk_places, attachment_places, metadata_places;
  std::map<std::uint64_t, std::uint8_t>
      named;  // places that the summary names, and what is there: when damage is to be skipped
  std::uint64_t summary_start = 0;  // 0: not there yet
  bool ended = false;

  Impl(const std::filesystem::path& path, BadChunks bad) : bad_chunks(bad) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) in.open(path, std::ios::binary | std::ios::ate);
    if (!in.is_open() || !in) throw Error("cannot read '" + path.string() + "'");
    size = static_cast<std::uint64_t>(in.tellg());
    in.seekg(0);
    std::string magic(mcap::magic.size(), '\0');
    if (size < magic.size() || !in.read(magic.data(), static_cast<std::streamsize>(magic.size())) ||
        magic != mcap::magic)
      throw Error("'" + path.string() + "' is no MCAP file");
    if (skips()) read_summary();
    seek(mcap::magic.size());
    crc = crc_of(0, std::as_bytes(std::span(magic)));
  }

  bool skips() const { return bad_chunks == BadChunks::skip; }

  void seek(std::uint64_t to) {
    in.clear();
    in.seekg(static_cast<std::streamoff>(to));
    place = to;
  }

  /// From the end of a file that was closed: the schemas and channels, for the case that those in the chunks
  /// are damaged, and where chunks, attachments and metadata are. Nothing when it is not as it should be.
  void read_summary() {
    constexpr std::uint64_t tail = mcap::footer_record + mcap::magic.size(),
                            data_end_record = mcap::record_head + 4;
    if (size < mcap::magic.size() + data_end_record + tail) return;
    try {
      std::vector<std::byte> end(tail);
      seek(size - tail);
      read(end.data(), tail);
      Cursor footer{end};
      require(footer.number<std::uint8_t>() == mcap::footer && footer.number<std::uint64_t>() == 20,
              "there is no footer");
      const auto start = footer.number<std::uint64_t>();
      footer.take(8);
      const Data summed = Data(end).first(footer.at);
      const auto sum = footer.number<std::uint32_t>();
      require(start > data_end_record && start < size - tail && size - tail - start <= largest_record,
              "there is no summary");
      std::vector<std::byte> summary(size - tail - start);
      seek(start);
      read(summary.data(), summary.size());
      require(sum == 0 || sum == crc_of(crc_of(0, summary), summed), "the checksum of the summary is wrong");
      for (Cursor records{summary}; records.more();) {
        const auto code = records.number<std::uint8_t>();
        name_places(code, Cursor{records.take(records.number<std::uint64_t>())});
      }
      named[start - data_end_record] = mcap::data_end;
    } catch (const Error&) {
      named.clear();
    }
  }

  void name_places(std::uint8_t code, Cursor of) {
    if (code == mcap::schema || code == mcap::channel) definition(code, of);
    if (code == mcap::chunk_index) of.take(16), named[of.number<std::uint64_t>()] = mcap::chunk;
    if (code == mcap::attachment_index) named[of.number<std::uint64_t>()] = mcap::attachment;
    if (code == mcap::metadata_index) named[of.number<std::uint64_t>()] = mcap::metadata;
  }

  void read(std::byte* to, std::uint64_t bytes) {
    require(bytes <= size - place, "the file ends inside a record");
    require(static_cast<bool>(in.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(bytes))),
            "the file cannot be read");
    place += bytes;
  }

  /// Reads records until there are messages. False at the end.
  bool fill() {
    pending.clear();
    given = 0;
    try {
      while (!ended && file.fault.empty() && pending.empty()) next_record_or_later();
    } catch (const std::bad_alloc&) {
      stop("there is not enough memory for a record");
    } catch (const Error& e) {
      stop(e.what());
    }
    messages += pending.size();
    if (ended) file.complete = !damaged;
    return !pending.empty();
  }

  void stop(const std::string& why) {
    pending.clear();
    file.fault = "byte " + std::to_string(place_before) + ": " + why;
  }

  /// Damage in the data costs the record in which it is, when damage is to be skipped.
  void next_record_or_later() {
    try {
      next_record();
    } catch (const Error&) {
      if (!skips() || summary_start > 0) throw;
      const auto known = named.find(place_before);
      const std::uint8_t code = known != named.end() ? known->second : code_before;
      const std::uint64_t behind = framed ? place : 0, next = next_place();
      if (next == 0 && behind == 0) throw;
      count(code);
      pending.clear();
      chunk = {};
      seek(next > 0 ? next : behind);
    }
  }

  void count(std::uint8_t code) {
    damaged = true;
    if (code == mcap::chunk) ++left_out.chunks;
    if (code == mcap::attachment) ++left_out.attachments;
    if (code == mcap::metadata) ++left_out.metadata;
    if (code != mcap::chunk && code != mcap::attachment && code != mcap::metadata && named.empty())
      ++left_out.others;
  }

  /// Where the reading goes on behind a damaged record; 0: nowhere.
  std::uint64_t next_place() {
    const auto later = named.upper_bound(place_before);
    if (later != named.end() && later->first < size) return later->first;
    if (!named.empty()) return 0;
    constexpr std::uint64_t step = 64 << 10, overlap = mcap::record_head;
    std::vector<std::byte> block(step + overlap);
    for (std::uint64_t at = place_before + 1; at + overlap < size; at += step) {
      const std::uint64_t bytes = std::min<std::uint64_t>(block.size(), size - at);
      seek(at);
      read(block.data(), bytes);
      for (std::uint64_t i = 0; i + overlap <= bytes && i < step; ++i)
        if (begins_record(Data(block).subspan(i, overlap), at + i)) return at + i;
    }
    return 0;
  }

  /// Whether a chunk, an attachment or metadata begins there: its length is the sum of the lengths in it.
  bool begins_record(Data head, std::uint64_t at) {
    const auto code = static_cast<std::uint8_t>(head[0]);
    if (code != mcap::chunk && code != mcap::attachment && code != mcap::metadata) return false;
    Cursor in_head{head, 1};
    const auto length = in_head.number<std::uint64_t>();
    if (length < 8 || length > size - at - head.size()) return false;
    try {
      seek(at + head.size());
      return length == length_within(code);
    } catch (const Error&) {
      return false;
    }
  }

  template <class T>
  T number_here() {
    std::array<std::byte, sizeof(T)> bytes;
    read(bytes.data(), bytes.size());
    return Cursor{bytes}.number<T>();
  }
  std::uint64_t pass_text() {
    const auto length = number_here<std::uint32_t>();
    require(length <= size - place, "the file ends inside a record");
    seek(place + length);
    return 4 + std::uint64_t{length};
  }

  std::uint64_t length_within(std::uint8_t code) {
    if (code == mcap::metadata) return pass_text() + pass_text();  // one expression each: both are read
    if (code == mcap::attachment) {
      seek(place + 16);
      const std::uint64_t words = pass_text() + pass_text();
      return 16 + words + 8 + number_here<std::uint64_t>() + 4;
    }
    seek(place + 16 + 8 + 4);
    const std::uint64_t compression = pass_text();
    return 16 + 8 + 4 + compression + 8 + number_here<std::uint64_t>();
  }

  void next_record() {
    place_before = place;
    code_before = 0;
    framed = false;
    std::array<std::byte, mcap::record_head> head;
    read(head.data(), head.size());
    Cursor in_head{head};
    const auto code = code_before = in_head.number<std::uint8_t>();
    const auto length = in_head.number<std::uint64_t>();
    require(length <= size - place, "the file ends inside a record");
    if (skips() && summary_start == 0) check_frame(code, length);
    require(length <= largest_record, "a record is longer than 256 MB");
    record.resize(length);
    read(record.data(), length);
    framed = true;
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
      require(sum == 0 || sum == before || damaged, "the checksum of the data is wrong");
    } else {
      content(code, record, place_before);
    }
  }

  /// What has no checksum of its own, and what would swallow the next record.
  void check_frame(std::uint8_t code, std::uint64_t length) const {
    const auto here = named.find(place_before), next = named.upper_bound(place_before);
    require(here == named.end() || here->second == code, "a record is not what the summary says");
    require(next == named.end() || next->first >= place + length, "a record is longer than the summary says");
    require((code > 0 && code <= mcap::data_end) || code >= 0x80, "a record is of no known kind");
  }

  void content(std::uint8_t code, Data data, std::uint64_t at) {
    Cursor cursor{data};
    switch (code) {
      case mcap::header:
        file.profile = cursor.text();
        file.library = cursor.text();
        break;
      case mcap::schema:
      case mcap::channel: definition(code, cursor); break;
      case mcap::message:
        in_chunk = false;
        message(cursor);
        break;
      case mcap::chunk:
        chunk_content(cursor);
        ++file.chunks;
        chunk_places.insert(at);
        break;
      case mcap::message_index:
        if (!skips()) {
          check_message_index(cursor);
          break;
        }
        cursor.take(2);
        cursor.take(cursor.number<std::uint32_t>());
        check_length(cursor);
        break;
      case mcap::attachment:
        attachment(cursor);
        attachment_places.insert(at);
        break;
      case mcap::metadata:
        metadata(cursor);
        metadata_places.insert(at);
        break;
      case mcap::statistics:
        if (!damaged) check_statistics(cursor);
        break;
      case mcap::chunk_index:
        cursor.take(16);
        require(damaged || chunk_places.contains(cursor.number<std::uint64_t>()),
                "a chunk index points at no chunk");
        break;
      case mcap::attachment_index:
        require(damaged || attachment_places.contains(cursor.number<std::uint64_t>()),
                "an attachment index points at no attachment");
        break;
      case mcap::metadata_index:
        require(damaged || metadata_places.contains(cursor.number<std::uint64_t>()),
                "a metadata index points at no metadata");
        break;
      default: break;  // the format may grow
    }
  }

  void definition(std::uint8_t code, Cursor& cursor) {
    const auto id = cursor.number<std::uint16_t>();
    const bool known = code == mcap::schema ? file.schemas.contains(id) : file.channels.contains(id);
    if (!known) defined_bytes += cursor.data.size();
    require(defined_bytes <= largest_schemas, "the schemas and channels take more than 256 MB");
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

  void message(Cursor& cursor) {
    McapFile::Message m;
    m.channel = cursor.number<std::uint16_t>();
    m.sequence = cursor.number<std::uint32_t>();
    m.log_ns = cursor.number<std::uint64_t>();
    m.publish_ns = cursor.number<std::uint64_t>();
    m.data = cursor.data.subspan(cursor.at);
    if (skips() && !file.channels.contains(m.channel)) {  // it stood in a damaged chunk
      damaged = true;
      ++left_out.messages;
      return;
    }
    require(file.channels.contains(m.channel), "a message belongs to no channel");
    pending.push_back(m);
  }

  void metadata(Cursor& cursor) {
    McapFile::Metadata m{cursor.text(), {}};
    m.pairs = cursor.pairs();
    if (skips()) check_length(cursor);
    file.metadata.push_back(std::move(m));
  }

  static void check_length(const Cursor& cursor) {
    require(!cursor.more(), "a record is longer than what is in it");
  }

  void chunk_content(Cursor& cursor) {
    cursor.take(16);  // first and last time
    const auto length = cursor.number<std::uint64_t>();
    const auto sum = cursor.number<std::uint32_t>();
    const std::string compression = cursor.text();
    const Data stored = cursor.take(cursor.number<std::uint64_t>());
    if (skips()) check_length(cursor);
    chunk = open_chunk(compression, stored, length, chunk_room);
    require(sum == 0 || sum == crc_of(0, chunk), "the checksum of a chunk is wrong");
    Cursor inside{chunk};
    while (inside.more()) {
      const std::size_t at = inside.at;
      const auto code = inside.number<std::uint8_t>();
      require(code == mcap::schema || code == mcap::channel || code == mcap::message,
              "a chunk holds what does not belong there");
      content(code, inside.take(inside.number<std::uint64_t>()), at);
    }
    in_chunk = true;
  }

  void check_message_index(Cursor& cursor) {
    const auto channel = cursor.number<std::uint16_t>();
    Cursor entries{cursor.take(cursor.number<std::uint32_t>())};
    while (entries.more()) {
      const auto log_ns = entries.number<std::uint64_t>();
      const auto offset = entries.number<std::uint64_t>();
      require(offset < chunk.size(), "a message index points out of its chunk");
      Cursor at{chunk, offset};
      const bool is_message = at.number<std::uint8_t>() == mcap::message;
      at.take(8);
      const bool same_channel = at.number<std::uint16_t>() == channel;
      at.take(4);
      require(is_message && same_channel && at.number<std::uint64_t>() == log_ns,
              "a message index points at something else");
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
    require(stored == 0 || stored == sum, "the checksum of an attachment is wrong");
    if (skips()) check_length(cursor);
    file.attachments.push_back(std::move(a));
  }

  /// Counts of schemas and channels are left aside: writers differ in whether those without a message count.
  void check_statistics(Cursor& cursor) const {
    const bool right_messages = cursor.number<std::uint64_t>() == messages;
    cursor.take(2 + 4);
    const bool attachments = cursor.number<std::uint32_t>() == file.attachments.size();
    const bool metadata = cursor.number<std::uint32_t>() == file.metadata.size();
    const bool chunks = cursor.number<std::uint32_t>() == file.chunks;
    require(right_messages && attachments && metadata && chunks, "the statistics do not fit the file");
  }

  void footer(Data head) {
    Cursor cursor{record};
    const auto start = cursor.number<std::uint64_t>();
    require(start == 0 || start == summary_start, "the footer points beside the summary");
    cursor.take(8);
    const std::uint32_t sum = crc_of(crc_of(crc, head), Data(record).first(cursor.at));
    const auto stored = cursor.number<std::uint32_t>();
    require(stored == 0 || stored == sum, "the checksum of the summary is wrong");
    std::string magic(mcap::magic.size(), '\0');
    require(size - place == magic.size(), "the closing magic is not there");
    read(reinterpret_cast<std::byte*>(magic.data()), magic.size());
    require(magic == mcap::magic, "the closing magic is not there");
    ended = true;
  }
};

McapStream::McapStream(const std::filesystem::path& file, BadChunks bad_chunks)
    : impl_(std::make_unique<Impl>(file, bad_chunks)) {}

McapStream::~McapStream() = default;

const McapFile::Message* McapStream::next() {
  if (impl_->given == impl_->pending.size() && !impl_->fill()) return nullptr;
  return &impl_->pending[impl_->given++];
}

const McapFile& McapStream::log() const { return impl_->file; }

McapFile McapStream::take_log() { return std::move(impl_->file); }

const McapStream::LeftOut& McapStream::left_out() const { return impl_->left_out; }

std::uint16_t McapFile::channel(const std::string& topic) const {
  std::vector<std::string> topics;
  for (const auto& [id, c] : channels) {
    if (c.topic == topic) return id;
    topics.push_back(c.topic);
  }
  throw Error("the log has no topic '" + topic + "'." + choices_text(topic, topics));
}

const McapFile::Attachment* McapFile::attachment(const std::string& name) const {
  for (const Attachment& a : attachments) {
    if (a.name == name) return &a;
  }
  return nullptr;
}

McapFile read_mcap(const std::filesystem::path& path, std::uint64_t most_bytes) {
  McapStream stream(path);
  McapStream::Impl& s = *stream.impl_;
  std::vector<McapFile::Message> messages;
  std::uint64_t bytes = 0;
  while (s.fill()) {
    bytes += (s.in_chunk ? s.chunk_room : s.record).capacity() + s.pending.size() * sizeof(McapFile::Message);
    if (bytes > most_bytes)
      throw Error("'" + path.string() + "' is too large to be read as a whole: its messages take more than " +
                  std::to_string(most_bytes >> 20) + " MB of memory");
    messages.insert(messages.end(), s.pending.begin(), s.pending.end());
    std::vector<std::byte>& room = s.in_chunk ? s.chunk_room : s.record;
    s.file.memory.push_back(
        std::move(room));  // the bytes stay where they are: message indexes are still checked against them
    room = {};
  }
  s.file.messages = std::move(messages);
  return std::move(s.file);
}

}  // namespace fulmar::core
