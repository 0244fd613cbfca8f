// SPDX-License-Identifier: BSD-3-Clause
// The byte layer of MCAP: record codes, little-endian numbers, length-prefixed text.
#pragma once
#include <zlib.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/log/messages.hpp"

namespace fulmar::core::mcap {

static_assert(std::endian::native == std::endian::little);

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};

enum Code : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  attachment = 9,
  attachment_index = 10,
  statistics = 11,
  metadata = 12,
  metadata_index = 13,
  summary_offset = 14,
  data_end = 15
};

inline constexpr std::size_t record_head = 1 + 8;           // code, length
inline constexpr std::size_t message_head = 2 + 4 + 8 + 8;  // channel, sequence, log time, publish time
inline constexpr std::size_t footer_record = record_head + 20;
inline constexpr std::uint64_t largest_record = 1u << 28;  // read into memory; a larger record is not from a
                                                           // flight

using Data = std::span<const std::byte>;

/// Growing buffer; new bytes are not cleared before they are written.
class Bytes {
 public:
  template <class T>
  Bytes& number(T value) {
    return raw(&value, sizeof value);
  }
  Bytes& raw(const void* from, std::size_t size) {
    if (size > 0) std::memcpy(grow(size), from, size);
    return *this;
  }
  Bytes& text(std::string_view s) {
    return number(static_cast<std::uint32_t>(s.size())).raw(s.data(), s.size());
  }
  Bytes& pairs(const std::vector<std::pair<std::string, std::string>>& map) {
    std::uint32_t size = 0;
    for (const auto& [key, value] : map) size += static_cast<std::uint32_t>(8 + key.size() + value.size());
    number(size);
    for (const auto& [key, value] : map) text(key).text(value);
    return *this;
  }
  Bytes& append(const Bytes& other) { return raw(other.data(), other.size()); }

  /// Writes a record's code and a length that `end` sets from the returned place.
  std::size_t begin(Code code) {
    number(code).number(std::uint64_t{0});
    return size_;
  }
  void end(std::size_t start) { patch(start - 8, std::uint64_t{size_ - start}); }
  /// A whole record: `write` appends its content.
  template <class Write>
  void record(Code code, Write write) {
    const std::size_t start = begin(code);
    write();
    end(start);
  }
  template <class T>
  void patch(std::size_t at, T value) {
    std::memcpy(data_.get() + at, &value, sizeof value);
  }

  /// Appends `size` bytes for the caller to fill.
  std::byte* grow(std::size_t size) {
    reserve(size);
    size_ += size;
    return data_.get() + size_ - size;
  }
  /// Reserves room for `more`: the next `grow` up to it does not allocate.
  void reserve(std::size_t more) {
    if (size_ + more <= room_) return;
    const std::size_t room = size_ + more + room_ / 2;
    std::unique_ptr<std::byte[]> larger(new std::byte[room]);
    if (size_ > 0) std::memcpy(larger.get(), data_.get(), size_);
    data_ = std::move(larger);
    room_ = room;
  }
  void shrink(std::size_t size) { size_ = size; }
  void clear() { size_ = 0; }
  std::byte* data() { return data_.get(); }
  const std::byte* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  std::unique_ptr<std::byte[]> data_;
  std::size_t size_ = 0, room_ = 0;
};

inline std::uint32_t crc_of(std::uint32_t before, Data data) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(data.data()), data.size()));
}

/// Reads consecutive values; throws Error at the end of the data.
struct Cursor {
  Data data;
  std::size_t at = 0;

  Data take(std::uint64_t size) {
    if (size > data.size() - at) throw Error(log_messages::record_truncated());
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

inline void require(bool truth, const MessageText<0>& otherwise) {
  if (!truth) throw Error(otherwise());
}

}  // namespace fulmar::core::mcap
