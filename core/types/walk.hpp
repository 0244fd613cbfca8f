// SPDX-License-Identifier: BSD-3-Clause
// Traversal of a message's bytes, shared by all that is compiled from a type: it enters nested structs,
// unrolls or loops over arrays, and loops over lists.
#pragma once
#include "core/types/type.hpp"

namespace fulmar::core {

/// A compiler has
/// - value(field, at): a number or text at that offset of the message, or of the innermost loop's element
/// - at_once(field, at): whether it has taken the whole array there in one step
/// - unrolled: how many elements of an array stand one by one; more become a loop
/// - begin(field, at): a loop over the array or list there; what follows is of one element. Returns its place
/// - end(place): of that loop
/// - empty(): a struct without fields; may be missing
template <class Compiler>
void walk(const Type& type, std::uint32_t base, Compiler& to) {
  const auto element = [&](const Field& field, std::uint32_t at) {
    field.kind == FULMAR_STRUCT ? walk(*field.type, at, to) : to.value(field, at);
  };
  if constexpr (requires { to.empty(); })
    if (type.fields.empty()) to.empty();
  for (const Field& field : type.fields) {
    const std::uint32_t at = base + field.offset;
    const bool array = field.shape == FULMAR_ARRAY;
    if (field.shape == FULMAR_SCALAR) {
      element(field, at);
    } else if (array && field.kind != FULMAR_STRUCT && to.at_once(field, at)) {
      continue;
    } else if (array && field.count <= Compiler::unrolled) {
      for (std::uint32_t i = 0; i < field.count; ++i) element(field, at + i * field.stride);
    } else {
      const std::size_t place = to.begin(field, at);
      element(field, 0);
      to.end(place);
    }
  }
}

}  // namespace fulmar::core
