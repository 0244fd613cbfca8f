// SPDX-License-Identifier: BSD-3-Clause
// Search in lists by name or by a signed index.
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

/// Index of the first element of that name, or -1.
template <class List>
int index_named(const List& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<int>(i);
  return -1;
}

/// The first element of that name, or nullptr.
template <class List>
auto find_named(const List& list, std::string_view name) -> decltype(list.data()) {
  const int i = index_named(list, name);
  return i < 0 ? nullptr : list.data() + i;
}

/// The error "there is no role 'x'". `kind`: "role".
template <class List>
Diagnostic no_such(const char* kind, std::string_view name, const List& list) {
  return types_messages::name_unknown(kind, name, choices_text(name, names_of(list)));
}

/// The error "the plugin y has no component 'x'". `owner`: "the plugin y", `kind`: "component".
template <class List>
Diagnostic has_no(const std::string& owner, const char* kind, std::string_view name, const List& list) {
  return types_messages::name_unknown_in(owner, kind, name, choices_text(name, names_of(list)));
}

/// Index of the element of that name. Throws Error when `owner` has none.
template <class List>
int require_named(const List& list, std::string_view name, const std::string& owner, const char* kind) {
  const int i = index_named(list, name);
  if (i < 0) throw Error(has_no(owner, kind, name, list));
  return i;
}

/// Element at an index that may be -1 in general, but not here.
template <class List>
decltype(auto) nth(List& list, int i) {
  return list[static_cast<std::size_t>(i)];
}

}  // namespace fulmar::core
