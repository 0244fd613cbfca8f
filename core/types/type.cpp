// SPDX-License-Identifier: BSD-3-Clause
// Looking up in descriptions, and the sizes of what they describe.
#include "core/types/type.hpp"

#include "core/types/named.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
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
