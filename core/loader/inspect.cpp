// SPDX-License-Identifier: BSD-3-Clause
// Text of `fulmar inspect`.
#include "core/loader/inspect.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"

namespace fulmar::core {
namespace {

// Rows of words in columns as wide as their longest word, two blanks between. Columns that are empty everywhere vanish.
class Columns {
 public:
  explicit Columns(std::size_t indent) : indent_(indent) {}
  void row(std::vector<std::string> words) {
    widths_.resize(std::max(widths_.size(), words.size()));
    for (std::size_t i = 0; i < words.size(); ++i) widths_[i] = std::max(widths_[i], width(words[i]));
    rows_.push_back(std::move(words));
  }
  std::string text() const {
    std::string all;
    for (const auto& words : rows_) {
      std::string line(indent_, ' ');
      for (std::size_t i = 0; i < words.size(); ++i)
        if (widths_[i] > 0) line += words[i] + std::string(widths_[i] - width(words[i]) + 2, ' ');
      line.erase(line.find_last_not_of(' ') + 1);
      all += line + "\n";
    }
    return all;
  }

 private:
  static std::size_t width(const std::string& utf8) {
    return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  }
  std::size_t indent_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", x);
  return text;
}

std::string range(double min, double max) {
  if (std::isinf(min) && std::isinf(max)) return "";
  if (std::isinf(min)) return "<= " + number(max);
  return std::isinf(max) ? ">= " + number(min) : number(min) + " .. " + number(max);
}

std::string hash_text(std::uint64_t hash) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string byte_text(std::uint32_t size) { return std::to_string(size) + (size == 1 ? " byte" : " bytes"); }

std::string port_kind(const Port& port) {
  const std::string many = " of " + std::to_string(port.capacity);
  switch (port.kind) {
    case FULMAR_IN_VALUE:
      return port.optional ? "value, optional" : "value";
    case FULMAR_IN_QUEUE:
      return "queue" + many;
    case FULMAR_IN_REQUEST:
      return "request" + many;
    case FULMAR_OUT_VALUE:
      return "value";
    case FULMAR_OUT_EVENT:
      return "value, may stay silent";
    case FULMAR_OUT_QUEUE:
      return "queue" + many;
    case FULMAR_OUT_PROBE:
      return "probe";
  }
  return "?";
}

std::string initial_text(const ParamInfo& param) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  switch (param.kind) {
    case FULMAR_NUMBER:
    case FULMAR_COUNT:
      return number(param.initial[0]) + unit;
    case FULMAR_FLAG:
      return param.initial[0] != 0 ? "true" : "false";
    case FULMAR_CHOICE:
      return param.choices[static_cast<std::size_t>(param.initial[0])];
    case FULMAR_STRING:
      return "\"" + param.initial_text + "\"";
    case FULMAR_VECTOR:
      return "[" + number(param.initial[0]) + ", " + number(param.initial[1]) + ", " + number(param.initial[2]) + "]" + unit;
    case FULMAR_RECORD:
      return param.type->name + " (file)";
    case FULMAR_BLOB:
      return "bytes (file)";
  }
  return "?";
}

std::string limits_text(const ParamInfo& param) {
  if (param.kind == FULMAR_CHOICE) return join(param.choices);
  const bool numeric = param.kind == FULMAR_NUMBER || param.kind == FULMAR_COUNT || param.kind == FULMAR_VECTOR;
  return numeric ? range(param.min, param.max) : "";
}

std::string ports_text(const char* title, const std::vector<Port>& ports) {
  if (ports.empty()) return "";
  Columns columns(4);
  for (const Port& port : ports) {
    if (port.type) {
      columns.row({port.name, port.type->name, port_kind(port), byte_text(port.type->size), hash_text(port.type->hash)});
    } else {
      columns.row({port.name, "", port_kind(port)});
    }
  }
  return "  " + std::string(title) + "\n" + columns.text();
}

std::string params_text(const std::vector<ParamInfo>& params) {
  if (params.empty()) return "";
  Columns columns(4);
  for (const ParamInfo& param : params)
    columns.row({param.name, initial_text(param), limits_text(param),
                 std::string(param.live ? "live" : "setup") + (param.required ? ", required" : ""), param.doc});
  return "  parameters\n" + columns.text();
}

std::string component_text(const ComponentInfo& component) {
  std::string text = component.name;
  if (!component.doc.empty()) text += "  " + component.doc;
  text += "\n";
  std::vector<std::string> traits;
  if (component.vehicle) traits.push_back("vehicle");
  if (component.activates) traits.push_back("hands over without a bump");
  if (component.resident) traits.push_back("stays resident");
  if (!traits.empty()) text += "  " + join(traits) + "\n";
  return text + ports_text("inputs", component.inputs) + ports_text("outputs", component.outputs) + params_text(component.params);
}

std::string element_text(const Field& field) {
  switch (field.kind) {
    case FULMAR_BOOL:
      return "bool";
    case FULMAR_U8:
      return "u8";
    case FULMAR_I32:
      return "i32";
    case FULMAR_U32:
      return "u32";
    case FULMAR_I64:
      return "i64";
    case FULMAR_U64:
      return "u64";
    case FULMAR_F32:
      return "f32";
    case FULMAR_F64:
      return "f64";
    case FULMAR_ENUM:
      return "enum";
    case FULMAR_TEXT:
      return "text of " + std::to_string(field.stride);
    case FULMAR_STRUCT:
      return field.type->name;
  }
  return "?";
}

std::string shape_text(const Field& field) {
  if (field.shape == FULMAR_ARRAY) return "[" + std::to_string(field.count) + "]";
  return field.shape == FULMAR_LIST ? "[<=" + std::to_string(field.count) + "]" : "";
}

void field_rows(const Type& type, const std::string& path, std::uint32_t base, const std::string& unit, Columns& columns) {
  for (const Field& field : type.fields) {
    const std::string own_unit = field.unit.empty() ? unit : field.unit;
    const std::string frame = field.type ? field.type->frame : "";
    const std::string limits = field.kind == FULMAR_ENUM ? join(field.labels) : range(field.min, field.max);
    const std::string at = std::to_string(base + field.offset);
    columns.row({path + field.name, element_text(field) + shape_text(field), own_unit, frame, at, limits});
    // inside an array or list the offsets count from the element
    const bool many = field.shape != FULMAR_SCALAR;
    if (field.type) field_rows(*field.type, path + field.name + (many ? "[]." : "."), many ? 0 : base + field.offset, own_unit, columns);
  }
}

std::string messages_text(const PluginInfo& plugin) {
  std::vector<TypePtr> types;
  const auto add = [&](const TypePtr& type) {
    const bool known = !type || std::any_of(types.begin(), types.end(), [&](const TypePtr& t) { return t->hash == type->hash; });
    if (!known) types.push_back(type);
  };
  for (const ComponentInfo& component : plugin.components) {
    for (const Port& port : component.inputs) add(port.type);
    for (const Port& port : component.outputs) add(port.type);
    for (const ParamInfo& param : component.params)
      if (param.kind == FULMAR_RECORD) add(param.type);
  }
  std::string text;
  for (const TypePtr& type : types) {
    text += "\n" + type->name + "  " + byte_text(type->size) + "  " + hash_text(type->hash);
    text += (type->frame.empty() ? "" : "  " + type->frame) + (type->ros.empty() ? "" : "  " + type->ros) + "\n";
    Columns columns(2);
    columns.row({"field", "kind", "unit", "frame", "byte", "range"});
    field_rows(*type, "", 0, "", columns);
    text += columns.text();
  }
  return text;
}

}  // namespace

std::string describe_plugin(const PluginInfo& plugin, bool fields) {
  std::string text = plugin.file + "  version " + plugin.version + "\n";
  Columns head(2);
  head.row({"abi", std::to_string(plugin.abi_major) + "." + std::to_string(plugin.abi_minor)});
  head.row({"toolchain", plugin.toolchain});
  if (!plugin.flags.empty()) head.row({"flags", plugin.flags});
  head.row({"sha256", plugin.sha256.substr(0, 16)});
  text += head.text();
  for (const ComponentInfo& component : plugin.components) text += "\n" + component_text(component);
  return fields ? text + messages_text(plugin) : text;
}

}  // namespace fulmar::core
