// SPDX-License-Identifier: BSD-3-Clause
#include "sdk/test/flight/airframe_file.hpp"

#include <yaml-cpp/yaml.h>

#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "fulmar/schema.hpp"

namespace fulmar::test {
namespace {

double in_si(const std::string& text) {
  std::size_t used = 0;
  const double number = std::stod(text, &used);
  const std::string unit = text.substr(used);
  return unit.find("deg") != std::string::npos ? number * std::numbers::pi / 180 : number;
}

/// The unit is optional: `limit` is limit_rad.
const fulmar_field& field_of(const fulmar_type& type, const std::string& key) {
  for (std::uint32_t i = 0; i < type.field_count; ++i) {
    const std::string name = type.fields[i].name;
    if (name == key || (name.rfind('_') != std::string::npos && name.substr(0, name.rfind('_')) == key))
      return type.fields[i];
  }
  throw std::runtime_error(std::string(type.name) + " has no field " + key);
}

std::uint8_t label_of(const fulmar_field& field, const std::string& text) {
  for (std::uint8_t i = 0; i < field.label_count; ++i)
    if (text == field.labels[i]) return i;
  throw std::runtime_error(std::string(field.name) + " is not " + text);
}

void set_struct(char* at, const fulmar_type& type, const YAML::Node& node);

void set_value(char* at, const fulmar_field& field, const YAML::Node& node) {
  if (field.kind == FULMAR_STRUCT) return set_struct(at, *field.type, node);
  const std::string text = node.as<std::string>();
  if (field.kind == FULMAR_F64) {
    const double number = in_si(text);
    std::memcpy(at, &number, sizeof number);
  } else if (field.kind == FULMAR_BOOL) {
    *at = text == "true";
  } else if (field.kind == FULMAR_ENUM) {
    const std::uint8_t value = label_of(field, text);
    std::memcpy(at, &value, 1);
  } else if (field.kind == FULMAR_TEXT) {
    std::strncpy(at, text.c_str(), field.stride - 1);
  } else {
    throw std::runtime_error(std::string("cannot set ") + field.name);
  }
}

void set_field(char* at, const fulmar_field& field, const YAML::Node& node) {
  if (field.shape != FULMAR_LIST) return set_value(at, field, node);
  const auto count = static_cast<std::uint32_t>(node.size());
  if (count > field.count) throw std::runtime_error(std::string("too many of ") + field.name);
  std::memcpy(at, &count, sizeof count);
  for (std::uint32_t i = 0; i < count; ++i)
    set_value(at + field.items + static_cast<std::size_t>(i) * field.stride, field, node[i]);
}

/// A vector also has the form [x, y, z].
void set_struct(char* at, const fulmar_type& type, const YAML::Node& node) {
  if (node.IsSequence()) {
    if (node.size() != type.field_count) throw std::runtime_error(std::string("not a ") + type.name);
    for (std::uint32_t i = 0; i < type.field_count; ++i)
      set_field(at + type.fields[i].offset, type.fields[i], node[i]);
    return;
  }
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (key == "params") continue;
    const fulmar_field& field = field_of(type, key);
    set_field(at + field.offset, field, entry.second);
  }
}

}  // namespace

Airframe airframe_text(const std::string& yaml) {
  Airframe airframe;
  set_struct(reinterpret_cast<char*>(&airframe), *detail::type_table<Airframe>(), YAML::Load(yaml));
  return airframe;
}

Airframe airframe_file(const std::string& name) {
  const std::string file = std::string(FULMAR_SOURCE_DIR) + "/configs/airframes/" + name + ".yaml";
  std::ifstream in(file);
  if (!in) throw std::runtime_error("no file " + file);
  std::ostringstream text;
  text << in.rdbuf();
  return airframe_text(text.str());
}

}  // namespace fulmar::test
