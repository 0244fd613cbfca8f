// SPDX-License-Identifier: BSD-3-Clause
// Reads the type tables of a plugin: it checks every pointer before it follows it, and every number before it
// uses it.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <string>

#include "core/error.hpp"
#include "core/loader/memory.hpp"
#include "core/loader/messages.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// Bytes of an element in ABI 1.0, the minimum of every plugin of ABI 1: up to the last member of that
/// version. A later member goes to the end of its struct, this line stays, and 0 means "as before" for it. A
/// member is present from its first minor version on (abi_minor), or when its value is not 0.
template <class T>
inline constexpr std::uint32_t size_in_1_0 = 0;
#define FULMAR_SIZE_IN_1_0(type, last)               \
  template <>                                        \
  inline constexpr std::uint32_t size_in_1_0<type> = \
      (offsetof(type, last) + sizeof(type::last) + alignof(type) - 1) / alignof(type) * alignof(type)
FULMAR_SIZE_IN_1_0(fulmar_field, max);
FULMAR_SIZE_IN_1_0(fulmar_type, align);
FULMAR_SIZE_IN_1_0(fulmar_port, capacity);
FULMAR_SIZE_IN_1_0(fulmar_param, max);
FULMAR_SIZE_IN_1_0(fulmar_component, get_extension);
#undef FULMAR_SIZE_IN_1_0

class TableReader {
 public:
  TypePtr type(const fulmar_type* type, const std::string& what);
  std::string text(const char* at, const std::string& what) const { return memory_.text(at, what); }
  std::vector<std::string> texts(const char* const* at, std::uint32_t count, const std::string& what) const;
  const Memory& memory() const { return memory_; }

  /// Element `i` of an array whose elements lie `stride` bytes apart. Longer elements come from a newer minor
  /// version: their unknown members are dropped. Shorter ones come from an older version: the missing members
  /// are zero.
  template <class T>
  T element(const T* base, std::uint32_t stride, std::uint32_t i, const std::string& what) const {
    constexpr std::uint32_t smallest = size_in_1_0<T>;
    if (stride < smallest || stride > largest_stride || stride % alignof(T) != 0)
      throw Error(loader_messages::table_stride_invalid(what, stride, smallest));
    const std::size_t size = std::min<std::size_t>(stride, sizeof(T));
    const auto at =
        reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(base) + std::uintptr_t{stride} * i);
    if (base == nullptr || !memory_.readable(at, size))
      throw Error(loader_messages::table_outside_memory(what));
    T copy{};
    std::memcpy(&copy, at, size);
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

/// Copies a plugin's type table. Throws Error on a table that contradicts itself (overlap, size, unknown
/// kind).
TypePtr copy_type(const fulmar_type& type);

}  // namespace fulmar::core
