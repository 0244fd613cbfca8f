// SPDX-License-Identifier: BSD-3-Clause
// See reader.hpp. The reading ends at the first byte that is not as the format says; what came before stays.
#include "core/tap/reader.hpp"

#include <zlib.h>
#include <zstd.h>

#include <fstream>
#include <set>

#include "core/error.hpp"
#include "core/tap/mcap_bytes.hpp"

namespace fulmar::core {
namespace {

using Data = std::span<const std::byte>;

std::uint32_t crc_of(Data data) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(data.data()), data.size()));
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

struct Scanner {
  McapFile& file;
  Data bytes;
  Data chunk;  // the last one, decompressed
  std::set<std::uint64_t> chunk_places, attachment_places, metadata_places;
  std::size_t summary_start = 0;  // 0: not there yet
  bool ended = false;

  /// One record at `at`; returns where the next one begins.
  std::size_t record(std::size_t at) {
    Cursor head{bytes, at};
    require(bytes.size() - at >= mcap::record_head, "the file ends inside a record");
    const auto code = head.number<std::uint8_t>();
    const auto length = head.number<std::uint64_t>();
    require(length <= bytes.size() - head.at, "the file ends inside a record");
    content(code, head.take(length), at);
    return head.at;
  }

  void content(std::uint8_t code, Data data, std::size_t place) {
    Cursor in{data};
    switch (code) {
      case mcap::header:
        file.profile = in.text();
        file.library = in.text();
        break;
      case mcap::schema:
      case mcap::channel:
        definition(code, in);
        break;
      case mcap::message:
        message(in);
        break;
      case mcap::chunk:
        open_chunk(in);
        chunk_places.insert(place);
        break;
      case mcap::message_index:
        check_message_index(in);
        break;
      case mcap::attachment:
        attachment(in);
        attachment_places.insert(place);
        break;
      case mcap::metadata:
        file.metadata.push_back({in.text(), {}});
        file.metadata.back().pairs = in.pairs();
        metadata_places.insert(place);
        break;
      case mcap::data_end:
        require(in.number<std::uint32_t>() == crc_of(bytes.first(place)), "the checksum of the data is wrong");
        summary_start = place + mcap::record_head + data.size();
        break;
      case mcap::statistics:
        check_statistics(in);
        break;
      case mcap::chunk_index:
        in.take(16);
        require(chunk_places.contains(in.number<std::uint64_t>()), "a chunk index points at no chunk");
        break;
      case mcap::attachment_index:
        require(attachment_places.contains(in.number<std::uint64_t>()), "an attachment index points at no attachment");
        break;
      case mcap::metadata_index:
        require(metadata_places.contains(in.number<std::uint64_t>()), "a metadata index points at no metadata");
        break;
      case mcap::footer:
        footer(in, place);
        break;
      default:
        break;  // the format may grow
    }
  }

  void definition(std::uint8_t code, Cursor& in) {
    const auto id = in.number<std::uint16_t>();
    if (code == mcap::schema) {
      McapFile::Schema schema{in.text(), in.text(), in.text()};
      file.schemas.try_emplace(id, std::move(schema));
      return;
    }
    McapFile::Channel channel{.schema = in.number<std::uint16_t>(), .topic = in.text(), .encoding = in.text(), .metadata = {}};
    channel.metadata = in.pairs();
    file.channels.try_emplace(id, std::move(channel));
  }

  void message(Cursor& in) {
    McapFile::Message m;
    m.channel = in.number<std::uint16_t>();
    m.sequence = in.number<std::uint32_t>();
    m.log_ns = in.number<std::uint64_t>();
    m.publish_ns = in.number<std::uint64_t>();
    m.data = in.data.subspan(in.at);
    require(file.channels.contains(m.channel), "a message belongs to no channel");
    file.messages.push_back(m);
  }

  void open_chunk(Cursor& in) {
    in.take(16);  // first and last time
    const auto size = in.number<std::uint64_t>();
    const auto crc = in.number<std::uint32_t>();
    const std::string compression = in.text();
    const Data stored = in.take(in.number<std::uint64_t>());
    constexpr std::uint64_t most = 1u << 30;
    require(size <= most, "a chunk claims to hold more than a gigabyte");
    if (compression == "zstd") {
      std::vector<std::byte>& room = file.memory.emplace_back(size);
      const std::size_t n = ZSTD_decompress(room.data(), size, stored.data(), stored.size());
      require(!ZSTD_isError(n) && n == size, "a chunk does not decompress");
      chunk = room;
    } else {
      require(compression.empty() && stored.size() == size, "a chunk has an unknown compression");
      chunk = stored;
    }
    require(crc == 0 || crc == crc_of(chunk), "the checksum of a chunk is wrong");
    ++file.chunks;
    Cursor inside{chunk};
    while (inside.more()) {
      const std::size_t place = inside.at;
      const auto code = inside.number<std::uint8_t>();
      require(code == mcap::schema || code == mcap::channel || code == mcap::message, "a chunk holds what does not belong there");
      content(code, inside.take(inside.number<std::uint64_t>()), place);
    }
  }

  void check_message_index(Cursor& in) {
    const auto channel = in.number<std::uint16_t>();
    Cursor entries{in.take(in.number<std::uint32_t>())};
    while (entries.more()) {
      const auto log_ns = entries.number<std::uint64_t>();
      const auto offset = entries.number<std::uint64_t>();
      require(offset < chunk.size(), "a message index points out of its chunk");
      Cursor at{chunk, offset};
      const bool is_message = at.number<std::uint8_t>() == mcap::message;
      at.take(8);
      const bool same_channel = at.number<std::uint16_t>() == channel;
      at.take(4);
      require(is_message && same_channel && at.number<std::uint64_t>() == log_ns, "a message index points at something else");
    }
  }

  void attachment(Cursor& in) {
    McapFile::Attachment a;
    a.log_ns = in.number<std::uint64_t>();
    in.take(8);
    a.name = in.text();
    a.media_type = in.text();
    const Data content = in.take(in.number<std::uint64_t>());
    a.content.assign(reinterpret_cast<const char*>(content.data()), content.size());
    const std::uint32_t sum = crc_of(in.data.first(in.at));
    require(in.number<std::uint32_t>() == sum, "the checksum of an attachment is wrong");
    file.attachments.push_back(std::move(a));
  }

  void check_statistics(Cursor& in) const {
    const bool messages = in.number<std::uint64_t>() == file.messages.size();
    const bool schemas = in.number<std::uint16_t>() == file.schemas.size();
    const bool channels = in.number<std::uint32_t>() == file.channels.size();
    const bool attachments = in.number<std::uint32_t>() == file.attachments.size();
    const bool metadata = in.number<std::uint32_t>() == file.metadata.size();
    const bool chunks = in.number<std::uint32_t>() == file.chunks;
    require(messages && schemas && channels && attachments && metadata && chunks, "the statistics do not fit the file");
  }

  void footer(Cursor& in, std::size_t place) {
    require(in.number<std::uint64_t>() == summary_start, "the footer points beside the summary");
    in.take(8);
    const Data summed = bytes.subspan(summary_start, place + mcap::record_head + in.at - summary_start);
    require(in.number<std::uint32_t>() == crc_of(summed), "the checksum of the summary is wrong");
    const Data rest = bytes.subspan(place + mcap::footer_record);
    require(rest.size() == mcap::magic.size() && std::memcmp(rest.data(), mcap::magic.data(), rest.size()) == 0,
            "the closing magic is not there");
    ended = true;
  }
};

std::vector<std::byte> contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw Error("cannot read '" + path.string() + "'");
  std::vector<std::byte> bytes(static_cast<std::size_t>(in.tellg()));
  in.seekg(0);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw Error("cannot read '" + path.string() + "'");
  return bytes;
}

}  // namespace

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

McapFile read_mcap(const std::filesystem::path& path) {
  McapFile file;
  const std::vector<std::byte>& bytes = file.memory.emplace_back(contents(path));
  const bool is_mcap = bytes.size() >= mcap::magic.size() && std::memcmp(bytes.data(), mcap::magic.data(), mcap::magic.size()) == 0;
  if (!is_mcap) throw Error("'" + path.string() + "' is no MCAP file");
  Scanner scanner{.file = file, .bytes = bytes, .chunk = {}, .chunk_places = {}, .attachment_places = {}, .metadata_places = {}};
  std::size_t at = mcap::magic.size();
  try {
    while (!scanner.ended) at = scanner.record(at);
    file.complete = true;
  } catch (const Error& e) {
    file.fault = "byte " + std::to_string(at) + ": " + e.what();
  }
  return file;
}

}  // namespace fulmar::core
