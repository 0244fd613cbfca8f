// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/param_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/graph/yaml.hpp"
#include "tools/fulmar_fcu/messages.hpp"

namespace fulmar::fcu {

namespace {

using core::Node;

/// "6" and "9" are MAVLink's type numbers.
std::optional<bool> type_of(const Node& type, core::Report& report) {
  if (type.is(Node::Kind::scalar) && type.text == "6") return true;
  if (type.is(Node::Kind::scalar) && type.text == "9") return false;
  report.add(type.where(), fcu_messages::parameter_type_invalid(core::found_words(type)));
  return {};
}

void read_item(const Node& item, std::vector<FileParam>& out, core::Report& report) {
  const core::Keys keys(item, "", {"name", "type", "value"}, report);
  if (!item.is(Node::Kind::map)) return;
  for (const char* key : {"name", "type", "value"})
    if (!keys.has(key)) return report.add(item.where(), fcu_messages::parameter_key_missing(key));
  const std::optional<std::string> name = keys.text("name"), value = keys.text("value");
  const std::optional<bool> whole = type_of(*keys.get("type"), report);
  if (name && value && whole) out.push_back({*name, *value, whole, keys.where("value")});
}

void read_entry(const Node::Entry& entry, std::vector<FileParam>& out, core::Report& report) {
  if (!entry.value.is(Node::Kind::scalar))
    return report.add(entry.where(),
                      located(entry.key, fcu_messages::number_expected(core::found_words(entry.value))));
  out.push_back({entry.key, entry.value.text, {}, entry.where()});
}

void refuse_twice(const std::vector<FileParam>& list, core::Report& report) {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (list[i].name == list[j].name)
        report.add(list[i].where, fcu_messages::parameter_duplicate(list[i].name, list[j].where.line));
}

std::string left_aligned(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

}  // namespace

std::vector<FileParam> read_param_file(const std::string& path) {
  core::Report report;
  const Node root = core::parse_yaml(core::read_source(path, path), report);
  std::vector<FileParam> out;
  if (root.is(Node::Kind::sequence)) {
    for (const Node& item : root.items) read_item(item, out, report);
  } else if (root.is(Node::Kind::map)) {
    for (const Node::Entry& entry : root.entries) read_entry(entry, out, report);
  } else if (report.empty()) {
    report.add({path, root.line}, fcu_messages::parameter_list_expected(core::found_words(root)));
  }
  refuse_twice(out, report);
  report.throw_if_any();
  return out;
}

std::string param_file_text(const std::vector<Param>& params, const std::string& version) {
  const std::string title = version.empty() ? fcu_messages::param_file_unversioned().text
                                            : fcu_messages::param_file_title(version).text;
  std::string out = "# " + title + "\n# " + fcu_messages::param_file_columns.c_str() + "\n";
  for (const Param& param : params)
    out += left_aligned(param.name + ": " + param.text(), 34) + " # " + std::to_string(param.index) +
           (param.whole ? " int\n" : " float\n");
  return out;
}

void write_param_file(const std::string& path, const std::string& text, bool replace) {
  namespace fs = std::filesystem;
  if (!replace && fs::exists(path)) throw Error(fcu_messages::file_exists(path));
  const std::string part = path + ".part" + std::to_string(::getpid());
  {
    std::ofstream file(part, std::ios::binary);
    file << text;
    file.flush();
    if (!file) {
      std::error_code ignored;
      fs::remove(part, ignored);
      throw Error(fcu_messages::file_not_writable(path));
    }
  }
  std::error_code fault;
  fs::rename(part, path, fault);
  if (fault) throw Error(fcu_messages::file_write_failed(path, fault.message()));
}

std::string Change::wanted() const {
  Param param = now;
  param.bits = bits;
  return param.text();
}

std::vector<Change> changes(const std::vector<FileParam>& file, const std::vector<Param>& now) {
  core::Report report;
  std::vector<std::string> names;
  for (const Param& param : now) names.push_back(param.name);
  std::vector<Change> out;
  for (const FileParam& wanted : file) {
    const auto it = std::find(names.begin(), names.end(), wanted.name);
    if (it == names.end()) {
      const std::string near = core::nearest(wanted.name, names);
      report.add(wanted.where,
                 fcu_messages::file_parameter_unknown(
                     wanted.name, near.empty() ? "" : fcu_messages::parameter_suggestion(near).line()));
      continue;
    }
    const Param& param = now[static_cast<std::size_t>(it - names.begin())];
    try {
      if (wanted.whole && *wanted.whole != param.whole)
        throw Error(fcu_messages::parameter_type_mismatch(wanted.name,
                                                          param.whole ? "6 (whole number)" : "9 (number)"));
      if (const std::uint32_t bits = parse_value(param, wanted.text); bits != param.bits)
        out.push_back({param, bits, wanted.where});
    } catch (const Error& e) {
      report.add(wanted.where, e.diagnostic);
    }
  }
  report.throw_if_any();
  return out;
}

std::string changes_text(const std::vector<Change>& list) {
  std::string out = left_aligned("parameter", 18) + left_aligned("controller", 16) + "file\n";
  for (const Change& change : list)
    out += left_aligned(change.now.name, 18) + left_aligned(change.now.text(), 16) + change.wanted() + "\n";
  return out;
}

std::vector<Change> load_params(Client& client, const std::vector<FileParam>& file, std::vector<Change> todo,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
  // These parameters change others: a mixer fills its matrix, FIXED_WING copies the failsafe throttle
  const auto first = [](const Change& c) {
    return c.now.name == "PRIMARY_MIXER" || c.now.name == "SECONDARY_MIXER" || c.now.name == "FIXED_WING" ||
           c.now.name == "USE_MOTOR_PARAM";
  };
  for (int round = 0; round < 3 && !todo.empty(); ++round) {
    std::stable_partition(todo.begin(), todo.end(), first);
    std::size_t done = 0;
    for (const Change& change : todo) {
      client.refuse_armed("changing its parameters");
      try {
        set_param(client, change.now, change.bits);
      } catch (const Error&) {
        // reported below, from the resulting values
      }
      if (progress) progress(++done, todo.size());
    }
    client.pump(100 * ms);  // time for their consequences
    todo = changes(file, read_params(client));
  }
  return todo;
}

}  // namespace fulmar::fcu
