// SPDX-License-Identifier: BSD-3-Clause
// Reads little-endian numbers in sequence, never beyond the end.
#pragma once
#include <array>
#include <bit>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "table.hpp"

namespace fulmar::sensor_log {

static_assert(std::endian::native == std::endian::little);

struct Cursor {
  const File* file = nullptr;
  std::string_view data;
  std::size_t at = 0, base = 0;  ///< base: offset of `data` in the file, for messages

  bool more() const { return at < data.size(); }
  std::size_t left() const { return data.size() - at; }
  [[noreturn]] void fault(const Diagnostic& reason) const {
    refuse(file->key, sensor_log_messages::file_damaged(file->path, base + at, reason));
  }
  /// The next `size` bytes as a separate cursor.
  Cursor part(std::uint64_t size) {
    const std::size_t begin = base + at;
    return {file, take(size), 0, begin};
  }
  std::string_view take(std::uint64_t size) {
    if (size > left()) fault(sensor_log_messages::data_cut());
    at += static_cast<std::size_t>(size);
    return data.substr(at - static_cast<std::size_t>(size), static_cast<std::size_t>(size));
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
};

enum class Prim : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64, text, time, structure };

inline std::size_t size_of(Prim prim) {
  constexpr std::array<std::size_t, 13> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 4, 4, 1};
  return sizes[static_cast<std::size_t>(prim)];
}

template <class T>
void put_one(Cursor& from, Column& column, const Wanted& wanted) {
  const T value = from.number<T>();
  if constexpr (std::is_floating_point_v<T>)
    put(column, wanted, static_cast<double>(value));
  else
    put(column, wanted, static_cast<std::int64_t>(value));
}

inline void put_number(Prim prim, Cursor& from, Column& column, const Wanted& wanted) {
  switch (prim) {
    case Prim::u8: return put_one<std::uint8_t>(from, column, wanted);
    case Prim::i8: return put_one<std::int8_t>(from, column, wanted);
    case Prim::u16: return put_one<std::uint16_t>(from, column, wanted);
    case Prim::i16: return put_one<std::int16_t>(from, column, wanted);
    case Prim::u32: return put_one<std::uint32_t>(from, column, wanted);
    case Prim::i32: return put_one<std::int32_t>(from, column, wanted);
    case Prim::u64: return put_one<std::uint64_t>(from, column, wanted);
    case Prim::i64: return put_one<std::int64_t>(from, column, wanted);
    case Prim::f32: return put_one<float>(from, column, wanted);
    case Prim::f64: return put_one<double>(from, column, wanted);
    default: from.fault(sensor_log_messages::number_missing());
  }
}

}  // namespace fulmar::sensor_log
