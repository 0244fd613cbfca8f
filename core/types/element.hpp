// SPDX-License-Identifier: BSD-3-Clause
// Access to a field of a message struct, for the wire forms.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>

#include "core/types/type.hpp"

namespace fulmar::core {

static_assert(std::endian::native == std::endian::little, "message bytes are copied to the wire as they are");

/// Existing elements: 1, all of an array, or the count of a list. A count beyond the capacity is clamped.
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
