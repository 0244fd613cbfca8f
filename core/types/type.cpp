// SPDX-License-Identifier: BSD-3-Clause
// Look-up in type descriptions, and sizes of elements.
#include "core/types/type.hpp"

#include "core/types/named.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
Field host_field(const char* name, fulmar_kind kind, std::size_t offset, std::size_t room) {
  const std::size_t stride = kind == FULMAR_TEXT ? room : primitive_size(kind);
  return {.name = name,
          .kind = kind,
          .offset = static_cast<std::uint32_t>(offset),
          .stride = static_cast<std::uint32_t>(stride)};
}

TypePtr host_struct(const std::string& name, std::size_t size, std::size_t align, std::vector<Field> fields) {
  return std::make_shared<const Type>(Type{.name = name,
                                           .fields = std::move(fields),
                                           .size = static_cast<std::uint32_t>(size),
                                           .align = static_cast<std::uint32_t>(align)});
}

bool is_identifier(std::string_view name) { return name.size() <= 128 && is_name(name); }

std::uint32_t element_size(const Field& field) {
  if (field.kind == FULMAR_TEXT) return field.stride;
  return field.kind == FULMAR_STRUCT ? field.type->size : primitive_size(field.kind);
}

std::uint64_t field_span(const Field& field) {
  const std::uint64_t head = field.shape == FULMAR_LIST ? field.items : 0;
  return head + std::uint64_t{field.count - 1} * field.stride + element_size(field);
}

const Field* Type::find(std::string_view field) const { return find_named(fields, field); }

int ComponentInfo::input(std::string_view port) const { return index_named(inputs, port); }
int ComponentInfo::output(std::string_view port) const { return index_named(outputs, port); }
int ComponentInfo::param(std::string_view name_) const { return index_named(params, name_); }

}  // namespace fulmar::core
