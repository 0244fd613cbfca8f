// SPDX-License-Identifier: BSD-3-Clause
// What the wire forms ask of a field of a message struct.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/types/type.hpp"

namespace fulmar::core {

static_assert(std::endian::native == std::endian::little, "message bytes are copied to the wire as they are");

template <class T>
T load(const std::byte* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Bytes of one number, bool or enum; 0 for text and structs.
inline std::uint32_t primitive_size(fulmar_kind kind) {
  switch (kind) {
    case FULMAR_BOOL:
    case FULMAR_U8:
    case FULMAR_ENUM:
    case FULMAR_I8:
      return 1;
    case FULMAR_I16:
    case FULMAR_U16:
      return 2;
    case FULMAR_I32:
    case FULMAR_U32:
    case FULMAR_F32:
      return 4;
    case FULMAR_I64:
    case FULMAR_U64:
    case FULMAR_F64:
      return 8;
    default:
      return 0;
  }
}

/// The elements that are there: 1, all of an array, or what a list counts. A count beyond the capacity is cut.
struct Elements {
  const std::byte* first;
  std::uint32_t count;
};
inline Elements elements(const Field& field, const std::byte* message) noexcept {
  const std::byte* at = message + field.offset;
  if (field.shape == FULMAR_LIST) return {at + field.items, std::min(load<std::uint32_t>(at), field.count)};
  return {at, field.shape == FULMAR_ARRAY ? field.count : 1};
}

inline std::string_view text_at(const std::byte* at, std::uint32_t room) noexcept {
  const char* text = reinterpret_cast<const char*>(at);
  return {text, ::strnlen(text, room)};
}

}  // namespace fulmar::core
