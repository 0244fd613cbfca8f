// SPDX-License-Identifier: BSD-3-Clause
// Table of element kinds, one row each: names and sizes of a kind are read here alone.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "fulmar/abi.h"

namespace fulmar::core {

struct KindRow {
  fulmar_kind kind;
  std::uint32_t bytes;  // of a number, bool or enum; 0 for text and structs
  const char* word;     // "f64"; the sign of a number's kind is its first letter
  const char* ros;      // in ROS 2 messages
  int ros_id;           // of type_description_interfaces/msg/FieldType
};

inline constexpr std::array<KindRow, 14> kind_rows{{{FULMAR_BOOL, 1, "bool", "bool", 15},
                                                    {FULMAR_U8, 1, "u8", "uint8", 3},
                                                    {FULMAR_I32, 4, "i32", "int32", 6},
                                                    {FULMAR_U32, 4, "u32", "uint32", 7},
                                                    {FULMAR_I64, 8, "i64", "int64", 8},
                                                    {FULMAR_U64, 8, "u64", "uint64", 9},
                                                    {FULMAR_F32, 4, "f32", "float32", 10},
                                                    {FULMAR_F64, 8, "f64", "float64", 11},
                                                    {FULMAR_ENUM, 1, "enum", "uint8", 3},
                                                    {FULMAR_TEXT, 0, "text", "string", 17},
                                                    {FULMAR_STRUCT, 0, "struct", "", 1},
                                                    {FULMAR_I8, 1, "i8", "int8", 2},
                                                    {FULMAR_I16, 2, "i16", "int16", 4},
                                                    {FULMAR_U16, 2, "u16", "uint16", 5}}};

constexpr const KindRow& kind_row(fulmar_kind kind) {
  return kind_rows[static_cast<std::size_t>(kind) - FULMAR_BOOL];
}
static_assert([] {
  for (std::size_t i = 0; i < kind_rows.size(); ++i)
    if (static_cast<std::size_t>(kind_rows[i].kind) != i + FULMAR_BOOL) return false;
  return true;
}());

/// "bool", "f64", "struct".
constexpr const char* kind_word(fulmar_kind kind) { return kind_row(kind).word; }

/// Bytes of one number, bool or enum; 0 for text and structs.
constexpr std::uint32_t primitive_size(fulmar_kind kind) { return kind_row(kind).bytes; }

constexpr bool is_real(fulmar_kind kind) { return kind == FULMAR_F32 || kind == FULMAR_F64; }
/// A whole number of more than one value; bool and enum do not count.
constexpr bool is_integer(fulmar_kind kind) {
  return primitive_size(kind) > 0 && !is_real(kind) && kind != FULMAR_BOOL && kind != FULMAR_ENUM;
}

template <class T>
T load(const std::byte* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Calls `take` with the element at `at` in its own C++ type, bool and enum as their byte; with nan for text
/// and structs.
template <class Take>
decltype(auto) with_number(fulmar_kind kind, const std::byte* at, Take&& take) {
  switch (kind) {
    case FULMAR_BOOL:
    case FULMAR_U8:
    case FULMAR_ENUM: return take(load<std::uint8_t>(at));
    case FULMAR_I8: return take(load<std::int8_t>(at));
    case FULMAR_I16: return take(load<std::int16_t>(at));
    case FULMAR_U16: return take(load<std::uint16_t>(at));
    case FULMAR_I32: return take(load<std::int32_t>(at));
    case FULMAR_U32: return take(load<std::uint32_t>(at));
    case FULMAR_I64: return take(load<std::int64_t>(at));
    case FULMAR_U64: return take(load<std::uint64_t>(at));
    case FULMAR_F32: return take(load<float>(at));
    case FULMAR_F64: return take(load<double>(at));
    case FULMAR_TEXT:
    case FULMAR_STRUCT: break;
  }
  return take(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace fulmar::core
