// SPDX-License-Identifier: BSD-3-Clause
// Changes single values in the text of a YAML file and leaves comments, layout, quotes and order unchanged.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fulmar::core {

using YamlPath = std::vector<std::string>;  // keys from the root: {"components", "slc", "params", "roll_kp"}

/// Position of the value of a key, without its anchor and tag.
struct YamlSpan {
  std::size_t begin = 0, end = 0;  // bytes
  enum class Form { scalar, alias, list, map } form = Form::scalar;
  bool flow = false;  // in brackets, or itself in brackets
};

/// No value when the path does not exist, or its value is empty or in a form that is not edited here (block
/// scalars).
std::optional<YamlSpan> find_value(const std::string& text, const YamlPath& path);

/// The items of a list in brackets.
std::vector<YamlSpan> list_items(const std::string& text, const YamlSpan& list);

/// The text without quotes, and a text in the quotes of `old`.
std::string unquoted(const std::string& scalar);
std::string quoted_like(const std::string& old, const std::string& value);

/// The text with one value replaced.
std::string with_value(const std::string& text, const YamlSpan& span, const std::string& value);

/// The text with `value` at a new path: at the end of the deepest existing map, with the missing levels in
/// braces. Throws Error when that is no map.
std::string with_entry(const std::string& text, const YamlPath& path, const std::string& value);

}  // namespace fulmar::core
