// SPDX-License-Identifier: BSD-3-Clause
// See salvage.hpp. Source: the MCAP file format specification, version 0.
#include "tools/fulmar_log/salvage.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {

using mcap::crc_of, mcap::Cursor, mcap::Data, mcap::require;

Salvage::Salvage(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return;  // McapStream reports it
  in_.open(file, std::ios::binary | std::ios::ate);
  if (!in_) return;
  holes_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  size_ = static_cast<std::uint64_t>(in_.tellg());
  read_summary();
}

Salvage::~Salvage() {
  if (holes_ >= 0) ::close(holes_);
}

/// The next byte at or after `at` that the file system has stored; the size of the file for none. After a
/// power failure a file may end in gigabytes that were never written.
std::uint64_t Salvage::next_stored(std::uint64_t at) const {
  const off_t stored = holes_ < 0 ? -1 : ::lseek(holes_, static_cast<off_t>(at), SEEK_DATA);
  if (stored >= 0) return static_cast<std::uint64_t>(stored);
  return holes_ >= 0 && errno == ENXIO ? size_ : at;
}

void Salvage::seek(std::uint64_t to) {
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(to));
  place_ = to;
}

void Salvage::read(std::byte* to, std::uint64_t bytes) {
  require(bytes <= size_ - place_, log_tool_messages::record_truncated);
  require(static_cast<bool>(in_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(bytes))),
          log_tool_messages::file_not_readable);
  place_ += bytes;
}

/// Reads the end of a closed file: the schemas and channels, and the places of chunks, attachments and
/// metadata. Ignores an invalid one.
void Salvage::read_summary() {
  constexpr std::uint64_t tail = mcap::footer_record + mcap::magic.size(),
                          data_end_record = mcap::record_head + 4;
  if (size_ < mcap::magic.size() + data_end_record + tail) return;
  try {
    std::vector<std::byte> end(tail);
    seek(size_ - tail);
    read(end.data(), tail);
    Cursor footer{end};
    require(footer.number<std::uint8_t>() == mcap::footer && footer.number<std::uint64_t>() == 20,
            log_tool_messages::footer_missing);
    const auto start = footer.number<std::uint64_t>();
    footer.take(8);
    const Data summed = Data(end).first(footer.at);
    const auto sum = footer.number<std::uint32_t>();
    require(start > data_end_record && start < size_ - tail && size_ - tail - start <= mcap::largest_record,
            log_tool_messages::summary_missing);
    std::vector<std::byte> whole(size_ - tail - start);
    seek(start);
    read(whole.data(), whole.size());
    require(sum == 0 || sum == crc_of(crc_of(0, whole), summed), log_tool_messages::summary_checksum_invalid);
    summary = std::move(whole);
    for (Cursor records{summary}; records.more();) {
      const auto code = records.number<std::uint8_t>();
      name_place(code, Cursor{records.take(records.number<std::uint64_t>())});
    }
    named_[start - data_end_record] = mcap::data_end;
  } catch (const Error&) {
    named_.clear();
  }
}

void Salvage::name_place(std::uint8_t code, Cursor of) {
  if (code == mcap::chunk_index) {
    of.take(16);
    named_[of.number<std::uint64_t>()] = mcap::chunk;
  }
  if (code == mcap::attachment_index) named_[of.number<std::uint64_t>()] = mcap::attachment;
  if (code == mcap::metadata_index) named_[of.number<std::uint64_t>()] = mcap::metadata;
}

/// Checks records without a checksum and lengths that exceed the next record.
void Salvage::check_head(std::uint64_t place, std::uint8_t code, std::uint64_t length) {
  const auto here = named_.find(place), next = named_.upper_bound(place);
  require(here == named_.end() || here->second == code, log_tool_messages::record_kind_differs);
  require(next == named_.end() || next->first >= place + mcap::record_head + length,
          log_tool_messages::record_overlong);
  require((code > 0 && code <= mcap::data_end) || code >= 0x80, log_tool_messages::record_kind_unknown);
}

void Salvage::check_whole(std::uint64_t place, std::uint8_t code, std::uint64_t length) {
  const bool reports = code == mcap::chunk || code == mcap::attachment || code == mcap::metadata ||
                       code == mcap::message_index;
  if (!reports) return;
  seek(place + mcap::record_head);
  require(length == length_within(code), log_tool_messages::record_length_differs);
}

std::uint64_t Salvage::go_on(std::uint64_t place, std::uint8_t code, std::uint64_t behind) {
  if (const auto known = named_.find(place); known != named_.end()) code = known->second;
  const std::uint64_t next = next_place(place);
  if (next == 0 && behind == 0) return 0;
  if (code == mcap::chunk)
    ++left_out_.chunks;
  else if (code == mcap::attachment)
    ++left_out_.attachments;
  else if (code == mcap::metadata)
    ++left_out_.metadata;
  else if (named_.empty())
    ++left_out_.others;
  return next > 0 ? next : behind;
}

namespace {

bool is_zero(Data block) {
  return block[0] == std::byte{0} && std::memcmp(block.data(), block.data() + 1, block.size() - 1) == 0;
}

}  // namespace

std::uint64_t Salvage::next_place(std::uint64_t place) {
  const auto later = named_.upper_bound(place);
  if (later != named_.end() && later->first < size_) return later->first;
  if (!named_.empty()) return 0;
  constexpr std::uint64_t step = 64 << 10, overlap = mcap::record_head;
  std::vector<std::byte> block(step + overlap);
  for (std::uint64_t at = next_stored(place + 1); at + overlap < size_; at = next_stored(at + step)) {
    const std::uint64_t bytes = std::min<std::uint64_t>(block.size(), size_ - at);
    seek(at);
    read(block.data(), bytes);
    if (is_zero(Data(block).first(bytes))) continue;
    for (std::uint64_t i = 0; i + overlap <= bytes && i < step; ++i)
      if (begins_record(Data(block).subspan(i, overlap), at + i)) return at + i;
  }
  return 0;
}

/// True when a chunk, an attachment or metadata begins there: its length is the sum of the lengths in it.
bool Salvage::begins_record(Data head, std::uint64_t at) {
  const auto code = static_cast<std::uint8_t>(head[0]);
  if (code != mcap::chunk && code != mcap::attachment && code != mcap::metadata) return false;
  Cursor in_head{head, 1};
  const auto length = in_head.number<std::uint64_t>();
  if (length < 8 || length > size_ - at - head.size()) return false;
  try {
    seek(at + head.size());
    return length == length_within(code);
  } catch (const Error&) {
    return false;
  }
}

template <class T>
T Salvage::number_here() {
  std::array<std::byte, sizeof(T)> bytes;
  read(bytes.data(), bytes.size());
  return Cursor{bytes}.number<T>();
}

std::uint64_t Salvage::pass_text() {
  const auto length = number_here<std::uint32_t>();
  require(length <= size_ - place_, log_tool_messages::record_truncated);
  seek(place_ + length);
  return 4 + std::uint64_t{length};
}

std::uint64_t Salvage::length_within(std::uint8_t code) {
  if (code == mcap::metadata) return pass_text() + pass_text();  // one expression each, so that both are read
  if (code == mcap::message_index) {
    seek(place_ + 2);
    return 2 + pass_text();
  }
  if (code == mcap::attachment) {
    seek(place_ + 16);
    const std::uint64_t words = pass_text() + pass_text();
    return 16 + words + 8 + number_here<std::uint64_t>() + 4;
  }
  seek(place_ + 16 + 8 + 4);
  const std::uint64_t compression = pass_text();
  return 16 + 8 + 4 + compression + 8 + number_here<std::uint64_t>();
}

}  // namespace fulmar::core
