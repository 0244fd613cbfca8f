// SPDX-License-Identifier: BSD-3-Clause
// Text of `fulmar inspect --markdown`: the reference page of a plugin. Tables as GitHub and pandoc read them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/error.hpp"
#include "tools/fulmar_inspect/inspect.hpp"
#include "tools/fulmar_inspect/inspect_text.hpp"

namespace fulmar::core {
namespace {

using namespace inspect_text;

constexpr double unknown =
    1e9;  // unknown_std of the SDK: an unknown standard deviation, a field that a file may leave out

/// Text of a table cell: its only mark-up are pairs of back-ticks. A bar ends a cell even between back-ticks.
std::string cell(const std::string& text) {
  const bool paired = std::count(text.begin(), text.end(), '`') % 2 == 0;
  bool code = false;
  std::string out;
  for (const char c : text) {
    if (c == '`' && paired) code = !code;
    if (c == '\n' || c == '\r' || c == '\t')
      out += ' ';
    else if (c == '|')
      out += "\\|";
    else if (c == '<' && !code)
      out += "&lt;";
    else if ((c == '*' || c == '\\' || c == '[' || (c == '`' && !paired)) && !code)
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

/// A table; columns without content are left out.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : head_(std::move(head)), used_(head_.size(), false) {
    used_[0] = true;
  }
  void row(std::vector<std::string> cells) {
    cells.resize(head_.size());
    for (std::size_t i = 0; i < cells.size(); ++i) used_[i] = used_[i] || !cells[i].empty();
    rows_.push_back(std::move(cells));
  }
  std::string text() const {
    if (rows_.empty()) return "";
    std::string all = line(head_) + line(std::vector<std::string>(head_.size(), "---"));
    for (const auto& cells : rows_) all += line(cells);
    return all + "\n";
  }

 private:
  std::string line(const std::vector<std::string>& cells) const {
    std::string all = "|";
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (used_[i]) all += " " + cells[i] + " |";
    return all + "\n";
  }
  std::vector<std::string> head_;
  std::vector<bool> used_;
  std::vector<std::vector<std::string>> rows_;
};

/// GitHub's rule for the anchor of a heading that is one word.
std::string link_to(const std::string& heading) {
  std::string anchor = heading;
  std::transform(anchor.begin(), anchor.end(), anchor.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return "[" + heading + "](#" + anchor + ")";
}

/// " (45 deg)" after an angle in radians.
std::string in_degrees(const ParamInfo& param) {
  const bool angle = param.unit == "rad" || param.unit == "rad/s" || param.unit == "rad/s2";
  if (param.kind != FULMAR_NUMBER || !angle || param.initial[0] == 0) return "";
  char text[48];
  std::snprintf(text, sizeof text, " (%.4g deg%s)", param.initial[0] * 180 / std::numbers::pi,
                param.unit.c_str() + 3);
  return text;
}

std::string ports(const char* title, const char* column, const std::vector<Port>& all) {
  if (all.empty()) return "";
  Table table({column, "message", "kind"});
  for (const Port& port : all)
    table.row({code(port.name), port.type ? link_to(port.type->name) : "", port_kind(port)});
  return "### " + std::string(title) + "\n\n" + table.text();
}

std::string parameters(const std::vector<ParamInfo>& all) {
  if (all.empty()) return "";
  Table table({"parameter", "default", "range", "set", "what"});
  for (const ParamInfo& param : all) {
    const std::string initial = param.kind == FULMAR_RECORD ? link_to(param.type->name)
                                                            : cell(initial_text(param) + in_degrees(param));
    const std::string set =
        std::string(param.live ? "live" : "set-up") + (param.required ? ", required" : "");
    table.row({code(param.name), initial, cell(limits_text(param)), set, cell(param.doc)});
  }
  return "### Parameters\n\n" + table.text();
}

/// Example for a mission, with every input that must be connected.
std::string use_text(const std::string& plugin, const ComponentInfo& component) {
  std::vector<std::string> wires;
  for (const Port& port : component.inputs)
    if (port.kind == FULMAR_IN_VALUE && !port.optional) wires.push_back(port.name + ": ...");
  return "```yaml\nname: {use: " + plugin + "/" + component.name +
         (wires.empty() ? "" : ", in: {" + join(wires) + "}") + "}\n```\n\n";
}

std::string component_page(const std::string& plugin, const ComponentInfo& component) {
  std::string text = "## " + component.name + "\n\n";
  if (!component.doc.empty()) text += cell(component.doc) + "\n\n";
  text += use_text(plugin, component);
  if (component.vehicle) text += "A vehicle: it keeps the time, and fills the role `vehicle`.\n\n";
  if (component.activates) text += "Takes over in flight without a bump.\n\n";
  if (component.resident) text += "Its library stays loaded once it is loaded.\n\n";
  return text + ports("Inputs", "input", component.inputs) + ports("Outputs", "output", component.outputs) +
         parameters(component.params);
}

/// Initial value of a record's field; "" for a field that a file must list item by item.
std::string initial_of(const Field& field, const std::byte* at) {
  if (at == nullptr || field.shape != FULMAR_SCALAR) return "";
  if (field.kind == FULMAR_TEXT) return reinterpret_cast<const char*>(at);
  const double value = number_at(field, at);
  if (field.kind == FULMAR_BOOL) return value != 0 ? "true" : "false";
  if (field.kind == FULMAR_ENUM)
    return value < static_cast<double>(field.labels.size()) ? field.labels[static_cast<std::size_t>(value)]
                                                            : "";
  return value == unknown ? "none" : number(value);
}

std::string vector_initial(const Field& field, const std::byte* at) {
  if (at == nullptr || field.shape != FULMAR_SCALAR) return "";
  std::vector<std::string> parts;
  for (const Field& part : field.type->fields) parts.push_back(initial_of(part, at + part.offset));
  return "[" + join(parts) + "]";
}

/// One row per field. The fields of a nested struct follow with their path; those of a vector share a row.
void table_rows(const Type& type, const std::string& path, const std::byte* data, Table& table) {
  for (const Field& field : type.fields) {
    const std::byte* at = data == nullptr ? nullptr : data + field.offset;
    const std::string name = path + field.name, many = shape_text(field);
    if (field.kind == FULMAR_STRUCT && field.type->frame.empty()) {
      if (!many.empty()) table.row({code(name), cell(field.type->name + many)});
      table_rows(*field.type, name + (many.empty() ? "." : "[]."), many.empty() ? at : nullptr, table);
      continue;
    }
    if (field.kind == FULMAR_STRUCT) {
      std::vector<std::string> axes;
      for (const Field& axis : field.type->fields) axes.push_back(axis.name);
      table.row({code(name), cell("{" + join(axes) + "}" + many), cell(field.unit), field.type->frame,
                 cell(vector_initial(field, at))});
      continue;
    }
    const std::string limits = field.kind == FULMAR_ENUM ? join(field.labels) : range(field.min, field.max);
    table.row({code(name), cell(element_text(field) + many), cell(field.unit), "",
               cell(initial_of(field, at)), cell(limits)});
  }
}

std::string type_text(const Type& type, const std::byte* initial) {
  std::string text =
      "### " + type.name + "\n\n" + byte_text(type.size) + ", layout `" + hash_text(type.hash) + "`";
  if (!type.frame.empty()) text += ", " + type.frame;
  if (!type.ros.empty()) text += ", ROS type `" + type.ros + "`";
  Table table({"field", "kind", "unit", "frame", "default", "range"});
  table_rows(type, "", initial, table);
  return text + "\n\n" + table.text();
}

struct Section {  // each type once
  std::vector<std::uint64_t> seen;
  std::string text;
  void add(const TypePtr& type, const std::byte* initial = nullptr) {
    if (!type || std::find(seen.begin(), seen.end(), type->hash) != seen.end()) return;
    seen.push_back(type->hash);
    text += type_text(*type, initial);
  }
};

std::string types_text(const PluginInfo& plugin) {
  Section files, messages;
  for (const ComponentInfo& component : plugin.components)
    for (const ParamInfo& param : component.params)
      if (param.kind == FULMAR_RECORD)
        files.add(param.type, param.initial_data.empty() ? nullptr : param.initial_data.data());
  messages.seen = files.seen;
  for (const ComponentInfo& component : plugin.components) {
    for (const Port& port : component.inputs) messages.add(port.type);
    for (const Port& port : component.outputs) messages.add(port.type);
  }
  std::string text;
  if (!messages.text.empty()) text += "## Messages\n\n" + messages.text;
  if (!files.text.empty())
    text += "## Files\n\nWhat the parameters above read. A field that is not named has its default.\n\n" +
            files.text;
  return text;
}

}  // namespace

std::string describe_plugin_markdown(const PluginInfo& plugin) {
  const std::string name = plugin.file.substr(0, plugin.file.rfind(".so"));
  std::string text = "# " + name + "\n\n`" + plugin.file + "`, version " + cell(plugin.version) + ", ABI " +
                     std::to_string(plugin.abi_major) + "." + std::to_string(plugin.abi_minor) + "\n\n";
  Table components({"component", "what"});
  for (const ComponentInfo& component : plugin.components)
    components.row({link_to(component.name), cell(component.doc)});
  text += components.text();
  for (const ComponentInfo& component : plugin.components) text += component_page(name, component);
  text += types_text(plugin);
  text.pop_back();  // one newline at the end
  return text;
}

}  // namespace fulmar::core
