// SPDX-License-Identifier: BSD-3-Clause
// Lists of things, found by name or by an index that is an int.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/types/messages.hpp"

namespace fulmar::core {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& thing : list) names.push_back(thing.name);
  return names;
}

/// The place of the first that bears the name, or -1.
template <class List>
int index_named(const List& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<int>(i);
  return -1;
}

/// The first that bears the name, or nullptr.
template <class List>
auto find_named(const List& list, std::string_view name) -> decltype(list.data()) {
  const int i = index_named(list, name);
  return i < 0 ? nullptr : list.data() + i;
}

/// There is no role 'x'. `kind`: "role".
template <class List>
Diagnostic no_such(const char* kind, std::string_view name, const List& list) {
  return types_messages::name_unknown(kind, name, choices_text(name, names_of(list)));
}

/// The plugin y has no component 'x'. `owner`: "the plugin y", `kind`: "component".
template <class List>
Diagnostic has_no(const std::string& owner, const char* kind, std::string_view name, const List& list) {
  return types_messages::name_unknown_in(owner, kind, name, choices_text(name, names_of(list)));
}

/// The place of the one that bears the name. Throws Error: `owner` has no such one.
template <class List>
int require_named(const List& list, std::string_view name, const std::string& owner, const char* kind) {
  const int i = index_named(list, name);
  if (i < 0) throw Error(has_no(owner, kind, name, list));
  return i;
}

/// By an index that may be -1 for none, and is not.
template <class List>
decltype(auto) nth(List& list, int i) {
  return list[static_cast<std::size_t>(i)];
}

}  // namespace fulmar::core
