// SPDX-License-Identifier: BSD-3-Clause
// Values of parameters, from YAML.
#include "core/graph/params.hpp"

#include <algorithm>
#include <cmath>

#include "core/graph/messages.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/record.hpp"
#include "core/graph/shipped.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;

// ---- files

FilePtr FileStore::known(const fs::path& path) const {
  for (const FilePtr& file : files_)
    if (file->path.lexically_normal() == path.lexically_normal()) return file;
  return nullptr;
}

void FileStore::keep(const FilePtr& file) {
  if (!known(file->path)) files_.push_back(file);
}

FilePtr FileStore::read(const Node& node, const std::string& path) {
  const fs::path file = named_file(node.file->path.parent_path(), node.text);
  if (const FilePtr there = known(file)) return there;
  try {
    return files_.emplace_back(read_source(file, node.text, stored_));
  } catch (const Error& fault) {
    report_.add(node.where(), located(path, fault.diagnostic));
    return nullptr;
  }
}

const Node& FileStore::tree(const FilePtr& file) {
  const std::string key = file->path.lexically_normal().string();
  const auto it = trees_.find(key);
  return it != trees_.end() ? it->second : trees_.emplace(key, parse_yaml(file, report_)).first->second;
}

std::vector<std::filesystem::path> FileStore::paths() const {
  std::vector<std::filesystem::path> paths;
  for (const FilePtr& file : files_) paths.push_back(file->path);
  return paths;
}

std::vector<std::pair<std::string, std::string>> FileStore::attachments() const {
  std::vector<std::pair<std::string, std::string>> list;
  const auto taken = [&](const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return entry.first == name; });
  };
  for (const FilePtr& file : files_) {
    std::string name = file->path.filename().string();
    if (taken(name)) name = file->path.parent_path().filename().string() + "/" + name;
    for (int i = 2; taken(name); ++i) name = std::to_string(i) + "/" + file->path.filename().string();
    list.emplace_back(name, file->text);
  }
  return list;
}

// ---- values

ParamValue initial_value(const ParamInfo& param) {
  ParamValue value;
  std::copy(std::begin(param.initial), std::end(param.initial), std::begin(value.number));
  value.integer =
      param.kind == FULMAR_RECORD || param.kind == FULMAR_BLOB ? 0 : std::llround(param.initial[0]);
  if (param.kind == FULMAR_STRING) value.text = param.initial_text;
  if (param.kind == FULMAR_RECORD) value.data = param.initial_data;
  return value;
}

namespace {

struct ParamReader {
  const ParamInfo& param;
  const std::string& path;
  ParamValue& value;
  FileStore& files;
  Report& report;

  void fault(const Node& node, const Diagnostic& message) const {
    report.add(node.where(), located(path, message));
  }
  bool number_into(const Node& node, const std::string& name, double& target) const {
    const auto number =
        scalar_number(node, name, {param.unit, UnitRule::optional, param.min, param.max}, report);
    if (number) target = *number;
    return number.has_value();
  }

  void count(const Node& node) const {
    double number = 0;
    if (!number_into(node, path, number)) return;
    if (number != std::floor(number)) return fault(node, graph_messages::integer_invalid(node.text));
    if (std::abs(number) > 9e15) return fault(node, graph_messages::integer_too_large(node.text));
    whole(static_cast<std::int64_t>(number));
  }

  void whole(std::int64_t number) const {
    value.integer = number;
    value.number[0] = static_cast<double>(number);
  }

  void vector(const Node& node) const {
    std::vector<std::string> names = {"x", "y", "z"};
    if (param.type && param.type->fields.size() == 3) names = names_of(param.type->fields);
    double numbers[3] = {value.number[0], value.number[1], value.number[2]};
    bool good = true;
    if (node.is(Node::Kind::map)) {
      const Keys keys(node, path, names, report);
      for (std::size_t i = 0; i < 3; ++i)
        if (const Node* item = keys.get(names[i]))
          good = number_into(*item, path + "." + names[i], numbers[i]) && good;
    } else if (node.is(Node::Kind::sequence) && node.items.size() == 3) {
      for (std::size_t i = 0; i < 3; ++i)
        good = number_into(node.items[i], path + "." + names[i], numbers[i]) && good;
    } else {
      const bool list = node.is(Node::Kind::sequence);
      return fault(node, graph_messages::three_numbers_expected(
                             join(names), list ? std::to_string(node.items.size()) +
                                                     (node.items.size() == 1 ? " item" : " items")
                                               : found_words(node)));
    }
    if (good) std::copy(numbers, numbers + 3, value.number);
  }

  void record(const Node& node) const {
    if (node.is(Node::Kind::map))
      return read_record(param, node, path, node.file ? node.file->name : "", value, report);
    if (!scalar_text(node, path, "the name of a YAML file, or a map with the fields of " + param.type->name,
                     report))
      return;
    const FilePtr file = files.read(node, path);
    if (file)
      read_record(param, files.tree(file), "", file->path.filename().string(), value, report,
                  keys_beside_fields(param));
  }

  void blob(const Node& node) const {
    if (!scalar_text(node, path, "the name of a file", report)) return;
    const FilePtr file = files.read(node, path);
    if (!file) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(file->text.data());
    value.data.assign(bytes, bytes + file->text.size());
    value.text = file->path.filename().string();
    value.integer = 1;
  }
};

}  // namespace

ParamPath param_path(const ComponentInfo& info, const std::string& name) {
  if (const int whole = info.param(name); whole >= 0) return {whole, ""};
  for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
    const int param = info.param(name.substr(0, dot));
    if (param >= 0 && nth(info.params, param).kind == FULMAR_RECORD) return {param, name.substr(dot + 1)};
  }
  return {};
}

void read_param_field(const ParamInfo& param, const std::string& field, const Node& node,
                      const std::string& path, ParamValue& value, Report& report) {
  value.data.resize(param.type->size);
  value.places = with_place(value.places, field, node);
  fill_record_field(*param.type, field, node, value.data.data(), path, report);
  if (value.integer == 0 && param.required) return;  // the rest of it is missing, and will be reported
  mark_given(*param.type, value.data.data());
  if (value.integer == 0) value.text = node.file ? node.file->name : "";
  value.integer = 1;
}

const std::vector<std::string>& keys_beside_fields(const ParamInfo& param) {
  static const std::vector<std::string> none, airframe = {"params"};
  return param.name == "airframe" ? airframe : none;
}

void read_record(const ParamInfo& param, const Node& map, const std::string& path, const std::string& name,
                 ParamValue& value, Report& report, const std::vector<std::string>& also) {
  value.data = param.initial_data;
  value.data.resize(param.type->size);
  value.places = places_of(map);
  fill_record(*param.type, map, value.data.data(), path, report, also);
  const std::vector<std::string> missing = missing_in_record(*param.type, map);
  if (!missing.empty() && map.is(Node::Kind::map)) {
    const bool of_component = path.find('.') != std::string::npos;  // else the record of another component is
                                                                    // not meant
    report.add(
        map.where(),
        graph_messages::record_incomplete(
            path.empty() ? "" : path + ": ", param.type->name, join(missing),
            of_component ? graph_messages::record_field_hint(param.name + "." + missing[0]).text : ""));
  }
  mark_given(*param.type, value.data.data());
  value.text = name;
  value.integer = 1;
}

void read_param(const ParamInfo& param, const Node& node, const std::string& path, ParamValue& value,
                FileStore& files, Report& report) {
  value.places = with_place(nullptr, "", node);
  const ParamReader reader{param, path, value, files, report};
  switch (param.kind) {
    case FULMAR_NUMBER: reader.number_into(node, path, value.number[0]); return;
    case FULMAR_FLAG:
      if (const auto flag = scalar_flag(node, path, report)) reader.whole(*flag);
      return;
    case FULMAR_COUNT: return reader.count(node);
    case FULMAR_CHOICE:
      if (const auto i = scalar_word(node, path, param.choices, report))
        reader.whole(static_cast<std::int64_t>(*i));
      return;
    case FULMAR_STRING:
      if (auto text = scalar_text_for(param.capacity, node, path, report)) value.text = std::move(*text);
      return;
    case FULMAR_VECTOR: return reader.vector(node);
    case FULMAR_RECORD: return reader.record(node);
    case FULMAR_BLOB: return reader.blob(node);
  }
}

std::string value_text(const ParamInfo& param, const ParamValue& value) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  switch (param.kind) {
    case FULMAR_NUMBER: return number_text(value.number[0]) + unit;
    case FULMAR_FLAG: return value.integer ? "true" : "false";
    case FULMAR_COUNT: return std::to_string(value.integer) + unit;
    case FULMAR_CHOICE: {
      const auto i = static_cast<std::size_t>(value.integer);
      return i < param.choices.size() ? param.choices[i] : std::to_string(value.integer);
    }
    case FULMAR_STRING: return value.text;
    case FULMAR_VECTOR:
      return "[" + number_text(value.number[0]) + ", " + number_text(value.number[1]) + ", " +
             number_text(value.number[2]) + "]";
    case FULMAR_RECORD:
    case FULMAR_BLOB: return value.integer ? value.text : "not given";
  }
  return "";
}

}  // namespace fulmar::core
