// SPDX-License-Identifier: BSD-3-Clause
// Reads type tables that somebody else wrote: every pointer is checked before it is followed, every number before it is believed.
#pragma once
#include <algorithm>
#include <cstring>
#include <map>
#include <string>

#include "core/error.hpp"
#include "core/loader/memory.hpp"
#include "core/loader/type.hpp"

namespace fulmar::core {

class TableReader {
 public:
  TypePtr type(const fulmar_type* type, const std::string& what);
  std::string text(const char* at, const std::string& what) const { return memory_.text(at, what); }
  std::vector<std::string> texts(const char* const* at, std::uint32_t count, const std::string& what) const;
  const Memory& memory() const { return memory_; }

  /// Element `i` of an array whose elements lie `stride` bytes apart. A stride that is larger than the struct comes from a newer minor
  /// version.
  template <class T>
  T element(const T* base, std::uint32_t stride, std::uint32_t i, const std::string& what) const {
    if (stride < sizeof(T) || stride > largest_stride || stride % alignof(T) != 0)
      throw Error(what + " lie " + std::to_string(stride) + " bytes apart, where " + std::to_string(sizeof(T)) + " are needed");
    const auto at = reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(base) + std::uintptr_t{stride} * i);
    if (base == nullptr || !memory_.readable(at, sizeof(T))) throw Error(what + " lie outside the plugin's memory");
    T copy;
    std::memcpy(&copy, at, sizeof(T));
    return copy;
  }

 private:
  static constexpr std::uint32_t largest_stride = 65536;
  std::shared_ptr<Type> read_type(const fulmar_type& from, const std::string& what);
  Field read_field(const fulmar_field& from, const std::string& owner);

  Memory memory_;
  std::map<const fulmar_type*, TypePtr> done_;
  int depth_ = 0;
};

/// A name that people can write in a mission file: letters, digits and underscores, no digit first.
bool is_identifier(std::string_view name);

/// Bytes of one element.
std::uint32_t element_size(const Field& field);

/// Bytes from a field's offset to its end.
std::uint64_t field_span(const Field& field);

}  // namespace fulmar::core
