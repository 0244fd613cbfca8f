// SPDX-License-Identifier: BSD-3-Clause
// Reads an airframe file for the tests, with as much of YAML as those files use: `key: value`, indentation,
// {a: 1, b: 2}, comments. Throws on a key that the struct does not have.
#pragma once
#include <cstring>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "fulmar/msg/airframe.hpp"
#include "fulmar/schema.hpp"

namespace fulmar::test {

inline double in_si(const std::string& text) {
  std::size_t used = 0;
  const double number = std::stod(text, &used);
  const std::string unit = text.substr(used);
  return unit.find("deg") != std::string::npos ? number * std::numbers::pi / 180 : number;
}

inline const fulmar_field& field_of(const fulmar_type& type, const std::string& key) {
  for (std::uint32_t i = 0; i < type.field_count; ++i) {
    const std::string name = type.fields[i].name;
    if (name == key || (name.rfind('_') != std::string::npos && name.substr(0, name.rfind('_')) == key))
      return type.fields[i];
  }
  throw std::runtime_error(std::string(type.name) + " has no field " + key);
}

/// Sets one value; `path` leads to it from the root.
inline void set_value(void* root, const fulmar_type* type, const std::vector<std::string>& path,
                      const std::string& text) {
  char* at = static_cast<char*>(root);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const fulmar_field& field = field_of(*type, path[i]);
    at += field.offset;
    if (field.kind == FULMAR_STRUCT && i + 1 < path.size()) {
      type = field.type;
    } else if (field.kind == FULMAR_F64 && i + 1 == path.size()) {
      const double number = in_si(text);
      std::memcpy(at, &number, sizeof number);
    } else if (field.kind == FULMAR_BOOL && i + 1 == path.size()) {
      *at = text == "true";
    } else if (field.kind == FULMAR_TEXT && i + 1 == path.size()) {
      std::strncpy(at, text.c_str(), field.stride - 1);
    } else {
      throw std::runtime_error("cannot set " + path[i]);
    }
  }
}

inline std::string trimmed(const std::string& s) {
  const auto a = s.find_first_not_of(' '), b = s.find_last_not_of(' ');
  return a == std::string::npos ? "" : s.substr(a, b - a + 1);
}

inline Airframe airframe_file(const std::string& name) {
  const std::string file = std::string(FULMAR_SOURCE_DIR) + "/configs/airframes/" + name + ".yaml";
  std::ifstream in(file);
  if (!in) throw std::runtime_error("no file " + file);
  Airframe airframe;
  std::vector<std::pair<std::size_t, std::string>> open;  // indentation and key of the maps around
  for (std::string line; std::getline(in, line);) {
    line = line.substr(0, line.find('#'));
    const std::size_t indent = line.find_first_not_of(' '), colon = line.find(':');
    if (indent == std::string::npos || colon == std::string::npos) continue;
    if (line.substr(indent, colon - indent) == "params") break;
    while (!open.empty() && open.back().first >= indent) open.pop_back();
    open.emplace_back(indent, line.substr(indent, colon - indent));
    std::string value = trimmed(line.substr(colon + 1));
    std::vector<std::string> path;
    for (const auto& [depth, key] : open) path.push_back(key);
    if (!value.empty() && value.front() == '{') {
      value = value.substr(1, value.rfind('}') - 1);
      for (std::size_t a = 0; a < value.size();) {
        const std::size_t b = std::min(value.find(',', a), value.size());
        const std::string entry = value.substr(a, b - a);
        auto inner = path;
        inner.push_back(trimmed(entry.substr(0, entry.find(':'))));
        set_value(&airframe, detail::type_table<Airframe>(), inner,
                  trimmed(entry.substr(entry.find(':') + 1)));
        a = b + 1;
      }
    } else if (!value.empty()) {
      set_value(&airframe, detail::type_table<Airframe>(), path, value);
    }
  }
  return airframe;
}

}  // namespace fulmar::test
