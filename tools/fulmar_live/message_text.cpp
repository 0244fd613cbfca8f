// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/message_text.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/types/text.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

using nlohmann::ordered_json;

bool one_column(const Field& field) {
  return field.shape == FULMAR_LIST || (field.shape == FULMAR_ARRAY && field.kind == FULMAR_STRUCT);
}

}  // namespace

std::string short_text(const ordered_json& value) {
  if (value.is_number_float()) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value.get<double>());
    return buffer;
  }
  if (value.is_string()) return for_terminal(value.get<std::string>());
  if (value.is_null()) return "-";
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, item] : value.items())
    text += (text.empty() ? "" : ", ") + (value.is_object() ? key + ": " : std::string()) + short_text(item);
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

std::string message_lines(const ordered_json& message) {
  std::string text;
  for (const auto& [key, value] : message.items()) text += "  " + key + ": " + short_text(value) + "\n";
  return text;
}

std::vector<std::string> columns(const Type& type, const std::string& prefix) {
  std::vector<std::string> names;
  for (const Field& f : type.fields) {
    const std::string name = (prefix.empty() ? "" : prefix + ".") + shown_name(f.name);
    if (one_column(f) || (f.shape == FULMAR_SCALAR && f.kind != FULMAR_STRUCT)) {
      names.push_back(name);
    } else if (f.shape == FULMAR_ARRAY) {
      for (std::uint32_t i = 0; i < f.count; ++i) names.push_back(name + "[" + std::to_string(i) + "]");
    } else {
      for (std::string& inner : columns(*f.type, name)) names.push_back(std::move(inner));
    }
  }
  return names;
}

// The inner fields of a struct whose name ends in _rad are already in degrees: shown_json has converted them
// and kept their names.
std::vector<std::string> cells(const Type& type, const ordered_json& message) {
  std::vector<std::string> list;
  for (const Field& f : type.fields) {
    const auto found = message.find(shown_name(f.name));
    const ordered_json value = found == message.end() ? ordered_json(nullptr) : *found;
    if (one_column(f) || (f.shape == FULMAR_SCALAR && f.kind != FULMAR_STRUCT)) {
      list.push_back(csv_cell(value));
    } else if (f.shape == FULMAR_ARRAY) {
      for (std::uint32_t i = 0; i < f.count; ++i) list.push_back(i < value.size() ? csv_cell(value[i]) : "");
    } else {
      for (std::string& inner : cells(*f.type, value)) list.push_back(std::move(inner));
    }
  }
  return list;
}

std::string csv_cell(const ordered_json& value) {
  if (value.is_null()) return "";
  std::string text = value.is_string() ? for_terminal(value.get<std::string>()) : value.dump();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return '"' + text + '"';
}

}  // namespace fulmar::core
