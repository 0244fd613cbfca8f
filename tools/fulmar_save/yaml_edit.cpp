// SPDX-License-Identifier: BSD-3-Clause
// yaml-cpp gives the places of keys. The values are read from the text itself, so that an alias is
// recognised.
#include "tools/fulmar_save/yaml_edit.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "core/error.hpp"
#include "tools/fulmar_save/messages.hpp"

namespace fulmar::core {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool word_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// As in yaml.cpp: yaml-cpp 0.7 cannot read {truth?: T}. The replacement keeps all positions.
YAML::Node load(std::string text) {
  for (std::size_t at = text.find("?:"); at != std::string::npos; at = text.find("?:", at + 1))
    if (at > 0 && word_letter(text[at - 1])) text[at] = '_';
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& fault) {
    throw Error(save_messages::yaml_invalid(fault.mark.line + 1, fault.msg));
  }
}

std::size_t offset_of(const std::string& text, const YAML::Mark& mark) {
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (int line = 0; line < mark.line; ++line) at = std::min(text.find('\n', at), text.size() - 1) + 1;
  return at + static_cast<std::size_t>(mark.column);
}

std::size_t skip_blanks(const std::string& text, std::size_t at) {
  while (at < text.size()) {
    if (text[at] == '#' && (at == 0 || blank(text[at - 1])))
      at = std::min(text.find('\n', at), text.size());
    else if (blank(text[at]))
      ++at;
    else
      break;
  }
  return at;
}

std::size_t end_of_quoted(const std::string& text, std::size_t at) {
  const char quote = text[at++];
  for (; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\')
      ++at;
    else if (text[at] == quote && quote == '\'' && at + 1 < text.size() && text[at + 1] == quote)
      ++at;
    else if (text[at] == quote)
      return at + 1;
  }
  return text.size();
}

std::size_t end_of_plain(const std::string& text, std::size_t at, bool flow) {
  const std::size_t begin = at;
  for (; at < text.size() && text[at] != '\n'; ++at) {
    if (text[at] == '#' && at > begin && blank(text[at - 1])) break;
    if (flow && (text[at] == ',' || text[at] == ']' || text[at] == '}')) break;
    if (text[at] == ':' && (at + 1 == text.size() || blank(text[at + 1]))) break;
  }
  while (at > begin && blank(text[at - 1])) --at;
  return at;
}

/// Position after the bracket that closes the one at `at`.
std::size_t end_of_flow(const std::string& text, std::size_t at) {
  int depth = 0;
  while (at < text.size()) {
    const char c = text[at], before = at > 0 ? text[at - 1] : '\n';
    const bool begins = blank(before) || before == '{' || before == '[' || before == ',' || before == ':';
    if (begins && (c == '"' || c == '\'')) {
      at = end_of_quoted(text, at);
    } else if (c == '#' && blank(before)) {
      at = std::min(text.find('\n', at), text.size());
    } else {
      depth += (c == '{' || c == '[') - (c == '}' || c == ']');
      ++at;
      if (depth == 0) return at;
    }
  }
  throw Error(save_messages::bracket_unclosed());
}

/// The value that begins at or after `at`, without its anchor and tag.
std::optional<YamlSpan> value_at(const std::string& text, std::size_t at, bool flow) {
  using Form = YamlSpan::Form;
  at = skip_blanks(text, at);
  while (at < text.size() && (text[at] == '&' || text[at] == '!')) {
    while (at < text.size() && !blank(text[at])) ++at;
    at = skip_blanks(text, at);
  }
  if (at == text.size() || text[at] == '|' || text[at] == '>') return std::nullopt;
  const char c = text[at];
  if (c == '{' || c == '[')
    return YamlSpan{at, end_of_flow(text, at), c == '{' ? Form::map : Form::list, true};
  if (c == '"' || c == '\'') return YamlSpan{at, end_of_quoted(text, at), Form::scalar, flow};
  const YamlSpan span{at, end_of_plain(text, at, flow), c == '*' ? Form::alias : Form::scalar, flow};
  return span.end > span.begin ? std::optional(span) : std::nullopt;
}

std::size_t after_key(const std::string& text, const YAML::Mark& mark) {
  std::size_t at = offset_of(text, mark);
  while (at < text.size() && (text[at] == '&' || text[at] == '!')) {
    while (at < text.size() && !blank(text[at])) ++at;
    at = skip_blanks(text, at);
  }
  at = at < text.size() && (text[at] == '"' || text[at] == '\'') ? end_of_quoted(text, at)
                                                                 : text.find(':', at);
  if (at == std::string::npos) throw Error(save_messages::key_without_value());
  return text.find(':', at) + 1;
}

struct Found {
  YAML::Node node;
  YAML::Mark key;     // of the last key; null for the root
  bool flow = false;  // inside brackets
  std::size_t depth = 0;
};

/// Follows the path as far as it exists.
Found walk(const YAML::Node& root, const YamlPath& path) {
  Found found{root, YAML::Mark::null_mark(), false, 0};
  for (const std::string& word : path) {
    if (!found.node.IsMap()) return found;
    bool there = false;
    const bool flow = found.flow || found.node.Style() == YAML::EmitterStyle::Flow;
    for (const auto& entry : found.node) {
      if (!entry.first.IsScalar() || entry.first.Scalar() != word) continue;
      found = {entry.second, entry.first.Mark(), flow, found.depth + 1};
      there = true;
      break;
    }
    if (!there) return found;
  }
  return found;
}

/// End of the last line of a map whose keys are indented by `indent`, from the line of its last key on.
std::size_t end_of_block(const std::string& text, std::size_t last_key, std::size_t indent) {
  std::size_t end = std::min(text.find('\n', last_key), text.size() - 1) + 1;
  for (std::size_t line = end; line < text.size();) {
    const std::size_t next = std::min(text.find('\n', line), text.size() - 1) + 1;
    const std::size_t first = text.find_first_not_of(" \t\r\n", line);
    if (first < next && text[first] != '#') {
      const bool item = text.compare(first, 2, "- ") == 0 && first - line == indent;
      if (first - line <= indent && !item) break;
      end = next;
    }
    line = next;
  }
  return end;
}

std::string into_flow(const std::string& text, const YamlSpan& map, const std::string& entry) {
  std::size_t last = map.begin + 1;  // after the last line with content
  for (std::size_t at = skip_blanks(text, last); at < map.end - 1; at = skip_blanks(text, at)) {
    const char c = text[at];
    at = c == '"' || c == '\''  ? end_of_quoted(text, at)
         : c == '{' || c == '[' ? end_of_flow(text, at)
                                : at + 1;
    last = at;
  }
  const char before = text[last - 1];
  const std::string comma = before == ',' ? " " : last == map.begin + 1 ? "" : ", ";
  return text.substr(0, last) + comma + entry + text.substr(last);
}

std::string into_block(const std::string& text, const YAML::Node& map, const std::string& entry) {
  YAML::Mark first = YAML::Mark::null_mark(), last = first;
  for (const auto& pair : map) {
    if (first.is_null()) first = pair.first.Mark();
    last = pair.first.Mark();
  }
  const auto indent = static_cast<std::size_t>(first.column);
  std::size_t at = end_of_block(text, offset_of(text, last), indent);
  const bool returns = text.find("\r\n") != std::string::npos;
  const std::string end = returns ? "\r\n" : "\n";
  const std::string before = at > 0 && text[at - 1] != '\n' ? end : "";
  return text.substr(0, at) + before + std::string(indent, ' ') + entry + end + text.substr(at);
}

}  // namespace

std::optional<YamlSpan> find_value(const std::string& text, const YamlPath& path) {
  const Found found = walk(load(text), path);
  if (found.depth < path.size() || found.key.is_null() || found.node.IsNull()) return std::nullopt;
  std::optional<YamlSpan> span = value_at(text, after_key(text, found.key), found.flow);
  if (!span || span->form != YamlSpan::Form::scalar) return span;
  if (found.node.IsMap() || found.node.IsSequence())
    span->form = found.node.IsMap() ? YamlSpan::Form::map : YamlSpan::Form::list;
  return span;
}

std::vector<YamlSpan> list_items(const std::string& text, const YamlSpan& list) {
  std::vector<YamlSpan> items;
  if (text[list.begin] != '[') return items;
  for (std::size_t at = skip_blanks(text, list.begin + 1); at < list.end - 1; at = skip_blanks(text, at)) {
    const std::optional<YamlSpan> item = value_at(text, at, true);
    if (!item || item->end > list.end - 1) break;
    items.push_back(*item);
    at = skip_blanks(text, item->end);
    if (text[at] == ',') ++at;
  }
  return items;
}

std::string unquoted(const std::string& scalar) {
  const bool quoted = scalar.size() > 1 && (scalar[0] == '"' || scalar[0] == '\'');
  return quoted ? load(scalar).Scalar() : scalar;
}

std::string quoted_like(const std::string& old, const std::string& value) {
  const char quote = old.empty() ? 0 : old[0];
  if (quote != '"' && quote != '\'') return value;
  std::string text(1, quote);
  for (const char c : value) {
    if (quote == '"' && (c == '"' || c == '\\')) text += '\\';
    if (quote == '\'' && c == '\'') text += '\'';
    text += c;
  }
  return text + quote;
}

std::string with_value(const std::string& text, const YamlSpan& span, const std::string& value) {
  return text.substr(0, span.begin) + value + text.substr(span.end);
}

std::string with_entry(const std::string& text, const YamlPath& path, const std::string& value) {
  const YAML::Node root = load(text);
  const Found found = walk(root, path);
  if (found.depth >= path.size()) throw Error(save_messages::entry_exists(path.back()));
  std::string rest = value;
  for (std::size_t i = path.size() - 1; i > found.depth; --i) rest = "{" + path[i] + ": " + rest + "}";
  const std::string entry = path[found.depth] + ": " + rest;
  const bool at_root = found.key.is_null();
  if (found.node.IsNull()) {
    if (at_root) return text + (text.empty() || text.back() == '\n' ? "" : "\n") + entry + "\n";
    const std::size_t at = after_key(text, found.key);
    return text.substr(0, at) + " {" + entry + "}" + text.substr(at);
  }
  if (!found.node.IsMap())
    throw Error(save_messages::map_expected(at_root ? std::string("the file") : path[found.depth - 1]));
  const std::optional<YamlSpan> span = value_at(text, at_root ? 0 : after_key(text, found.key), found.flow);
  if (span && span->form == YamlSpan::Form::alias)
    throw Error(save_messages::map_is_alias(path[found.depth - 1],
                                            text.substr(span->begin, span->end - span->begin)));
  if (span && span->form == YamlSpan::Form::map) return into_flow(text, *span, entry);
  return into_block(text, found.node, entry);
}

}  // namespace fulmar::core
