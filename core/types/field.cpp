// SPDX-License-Identifier: BSD-3-Clause
// Access to fields by name.
#include <charconv>
#include <cstring>

#include "core/error.hpp"
#include "core/types/messages.hpp"
#include "core/types/named.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {
namespace {

// One part of a dotted name: "waypoints[3]" is {"waypoints", 3}; without brackets the index is -1.
struct Part {
  std::string_view name;
  std::int64_t index = -1;
};

Part parse_part(std::string_view part, std::string_view dotted) {
  const std::size_t open = part.find('[');
  if (open == std::string_view::npos) return {part, -1};
  const std::string_view digits = part.substr(open + 1, part.size() - open - 2);
  std::uint32_t index = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (part.back() != ']' || part.size() < open + 3 || fault != std::errc() ||
      end != digits.data() + digits.size())
    throw Error(types_messages::index_invalid(part, dotted));
  return {part.substr(0, open), index};
}

const Field& find_field(const Type& type, std::string_view name) {
  return nth(type.fields, require_named(type.fields, name, type.name, "field"));
}

// The number of items of a list, as a separate field.
const Field& count_field() {
  static const Field field{.name = "count", .kind = FULMAR_U32, .stride = sizeof(std::uint32_t)};
  return field;
}

void enter(FieldRef& ref, const Field& field, const Part& part) {
  const std::string name(part.name);
  ref.field = &field;
  ref.offset += field.offset;
  if (!field.unit.empty()) ref.unit = field.unit;
  if (field.shape == FULMAR_SCALAR) {
    if (part.index >= 0) throw Error(types_messages::index_not_allowed(name));
    return;
  }
  const std::string is = "' is a" +
                         std::string(field.shape == FULMAR_LIST ? " list of at most " : "n array of ") +
                         std::to_string(field.count);
  if (part.index < 0) throw Error(types_messages::index_missing(name, is, name));
  if (part.index >= field.count) throw Error(types_messages::index_out_of_range(name, part.index, name, is));
  const auto index = static_cast<std::uint32_t>(part.index);
  if (field.shape == FULMAR_LIST) {
    ref.items.push_back({ref.offset, index});
    ref.offset += field.items;
  }
  ref.offset += index * field.stride;
}

}  // namespace

bool FieldRef::present(const std::byte* message) const noexcept {
  for (const Item& item : items) {
    std::uint32_t count = 0;
    std::memcpy(&count, message + item.count_offset, sizeof count);
    if (item.index >= count) return false;
  }
  return true;
}

FieldRef resolve_field(const Type& type, std::string_view dotted) {
  FieldRef ref;
  const Type* inside = &type;
  std::string_view rest = dotted;
  while (true) {
    const std::size_t dot = rest.find('.');
    const bool last = dot == std::string_view::npos;
    const Part part = parse_part(rest.substr(0, dot), dotted);
    if (inside == nullptr) throw Error(types_messages::field_not_struct(ref.field->name, dotted));
    const Field& field = find_field(*inside, part.name);
    if (!last && field.shape == FULMAR_LIST && part.index < 0 && rest.substr(dot + 1) == "count") {
      ref.field = &count_field();
      ref.offset += field.offset;
      ref.unit.clear();
      return ref;
    }
    enter(ref, field, part);
    if (last) return ref;
    inside = field.kind == FULMAR_STRUCT ? field.type.get() : nullptr;
    rest = rest.substr(dot + 1);
  }
}

}  // namespace fulmar::core
