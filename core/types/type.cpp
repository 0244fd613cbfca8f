// SPDX-License-Identifier: BSD-3-Clause
// Looking up in descriptions, and the sizes of what they describe.
#include "core/types/type.hpp"

#include <algorithm>

namespace fulmar::core {
namespace {

template <class List>
int index_of(const List& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

bool is_identifier(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && name.size() <= 128 && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c); });
}

std::uint32_t element_size(const Field& field) {
  if (field.kind == FULMAR_TEXT) return field.stride;
  return field.kind == FULMAR_STRUCT ? field.type->size : primitive_size(field.kind);
}

std::uint64_t field_span(const Field& field) {
  const std::uint64_t head = field.shape == FULMAR_LIST ? field.items : 0;
  return head + std::uint64_t{field.count - 1} * field.stride + element_size(field);
}

const Field* Type::find(std::string_view field) const {
  const int i = index_of(fields, field);
  return i < 0 ? nullptr : &fields[static_cast<std::size_t>(i)];
}

int ComponentInfo::input(std::string_view port) const { return index_of(inputs, port); }
int ComponentInfo::output(std::string_view port) const { return index_of(outputs, port); }
int ComponentInfo::param(std::string_view name_) const { return index_of(params, name_); }

}  // namespace fulmar::core
