// SPDX-License-Identifier: BSD-3-Clause
// Text of `fulmar inspect`.
#include "tools/fulmar_inspect/inspect.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/fulmar_inspect/inspect_text.hpp"

namespace fulmar::core {
namespace {

using namespace inspect_text;

// Rows of texts in aligned columns, two blanks apart. Empty columns are left out.
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
    return static_cast<std::size_t>(
        std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  }
  std::size_t indent_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

std::string ports_text(const char* title, const std::vector<Port>& ports) {
  if (ports.empty()) return "";
  Columns columns(4);
  for (const Port& port : ports) {
    if (port.type) {
      columns.row({port.name, port.type->name, port_kind(port), byte_text(port.type->size),
                   hash_text(port.type->hash)});
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
                 std::string(param.live ? "live" : "setup") + (param.required ? ", required" : ""),
                 param.doc});
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
  return text + ports_text("inputs", component.inputs) + ports_text("outputs", component.outputs) +
         params_text(component.params);
}

void field_rows(const Type& type, const std::string& path, std::uint32_t base, const std::string& unit,
                Columns& columns) {
  for (const Field& field : type.fields) {
    const std::string own_unit = field.unit.empty() ? unit : field.unit;
    const std::string frame = field.type ? field.type->frame : "";
    const std::string limits = field.kind == FULMAR_ENUM ? join(field.labels) : range(field.min, field.max);
    const std::string at = std::to_string(base + field.offset);
    columns.row({path + field.name, element_text(field) + shape_text(field), own_unit, frame, at, limits});
    // inside an array or list the offsets count from the element
    const bool many = field.shape != FULMAR_SCALAR;
    if (field.type)
      field_rows(*field.type, path + field.name + (many ? "[]." : "."), many ? 0 : base + field.offset,
                 own_unit, columns);
  }
}

std::string messages_text(const PluginInfo& plugin) {
  std::vector<TypePtr> types;
  const auto add = [&](const TypePtr& type) {
    const bool known = !type || std::any_of(types.begin(), types.end(),
                                            [&](const TypePtr& t) { return t->hash == type->hash; });
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
    text +=
        (type->frame.empty() ? "" : "  " + type->frame) + (type->ros.empty() ? "" : "  " + type->ros) + "\n";
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
  if (!plugin.build_id.empty()) head.row({"build", plugin.build_id});
  text += head.text();
  for (const ComponentInfo& component : plugin.components) text += "\n" + component_text(component);
  return fields ? text + messages_text(plugin) : text;
}

}  // namespace fulmar::core
