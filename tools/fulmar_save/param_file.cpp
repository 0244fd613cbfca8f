// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_save/param_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "core/graph/catalogue.hpp"
#include "core/graph/mission.hpp"
#include "core/graph/params.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/shipped.hpp"
#include "core/graph/yaml.hpp"
#include "tools/fulmar_save/messages.hpp"
#include "tools/fulmar_save/yaml_edit.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

// ---- values as text

bool same_number(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

bool same_value(const ParamInfo& info, const ParamValue& a, const ParamValue& b) {
  switch (info.kind) {
    case FULMAR_NUMBER: return same_number(a.number[0], b.number[0]);
    case FULMAR_VECTOR:
      return same_number(a.number[0], b.number[0]) && same_number(a.number[1], b.number[1]) &&
             same_number(a.number[2], b.number[2]);
    case FULMAR_STRING: return a.text == b.text;
    default: return a.integer == b.integer;
  }
}

/// The shortest number that, in this unit, reads back as `value`.
std::string number_in(double value, const std::string& unit, const std::string& declared) {
  const std::string tail = unit.empty() ? "" : " " + unit;
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.*g", digits,
                  unit.empty() ? value : value / unit_factor(unit, declared));
    text = number_text(std::strtod(buffer, nullptr)) + tail;
    if (quantity_in(text, declared, UnitRule::optional) == value) break;
  }
  return text;
}

/// Text of a new number: angles in degrees when that is short.
std::string new_number(double value, const std::string& declared) {
  constexpr std::size_t brief = 8;
  if (declared.empty() || declared == "frac" || declared == "ratio") return number_text(value);
  const auto unit = parse_unit(declared);
  if (!unit || unit->dimension == PhysicalUnit{}.dimension) return number_text(value);  // rad/rad: a gain
  if (declared == "rad") {
    const std::string degrees = number_in(value, "deg", declared);
    if (degrees.size() <= brief + 4 && quantity_in(degrees, declared, UnitRule::optional) == value)
      return degrees;
  }
  const std::string text = number_text(value) + " " + declared;
  try {
    if (quantity_in(text, declared, UnitRule::optional) == value) return text;
  } catch (const Error&) {
  }
  return number_text(value);
}

std::string number_like(const std::string& old, double value, const std::string& declared) {
  try {
    const Quantity quantity = parse_quantity(unquoted(old));
    if (quantity.unit.empty() || same_dimension(quantity.unit, declared))
      return quoted_like(old, number_in(value, quantity.unit, declared));
  } catch (const Error&) {  // for example an alias
  }
  return new_number(value, declared);
}

std::string word_text(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
  const bool bare = !word.empty() && word.find_first_not_of(plain) == std::string::npos &&
                    std::isalpha(static_cast<unsigned char>(word[0]));
  static const std::vector<std::string> taken = {"true", "false", "yes", "no", "on", "off", "null"};
  return bare && std::find(taken.begin(), taken.end(), word) == taken.end() ? word : quoted_like("\"", word);
}

std::string scalar_like(const std::string& old, const SavedParam& p) {
  switch (p.info.kind) {
    case FULMAR_NUMBER: return number_like(old, p.value.number[0], p.info.unit);
    case FULMAR_COUNT: return quoted_like(old, std::to_string(p.value.integer));
    case FULMAR_FLAG: return p.value.integer ? "true" : "false";
    case FULMAR_CHOICE: return quoted_like(old, p.info.choices.at(static_cast<std::size_t>(p.value.integer)));
    default: {
      const std::string quoted = quoted_like(old, p.value.text);
      return quoted != p.value.text ? quoted : word_text(p.value.text);
    }
  }
}

std::string new_text(const SavedParam& p) {
  if (p.info.kind == FULMAR_NUMBER) return new_number(p.value.number[0], p.info.unit);
  if (p.info.kind != FULMAR_VECTOR) return scalar_like("", p);
  std::string text;
  for (const double x : p.value.number) text += (text.empty() ? "[" : ", ") + new_number(x, p.info.unit);
  return text + "]";
}

// ---- places

struct FilePlace {
  std::size_t file = 0;  // into Saver::files_
  YamlPath path;
};

const Node* at_path(const Node& root, const YamlPath& path) {
  const Node* node = &root;
  for (const std::string& key : path)
    if (!(node = node->find(key))) return nullptr;
  return node;
}

/// Every value with its path, as unambiguous text.
void flatten(const Node& node, const std::string& path, std::map<std::string, std::string>& out) {
  if (node.is(Node::Kind::map) || node.is(Node::Kind::sequence))
    out[path] = node.is(Node::Kind::map) ? "{" : "[";
  if (node.is(Node::Kind::scalar)) out[path] = (node.quoted ? "'" : "=") + node.text;
  for (const Node::Entry& entry : node.entries) flatten(entry.value, path + "\n" + entry.key, out);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    flatten(node.items[i], path + "\n" + std::to_string(i), out);
}

Node parsed(const std::string& text, const std::string& name) {
  Report report;
  const Node root = parse_yaml(make_source(text, name), report);
  report.throw_if_any();
  return root;
}

class Saver {
 public:
  Saver(const fs::path& mission, const std::vector<std::string>& flown) : flown_(flown) {
    open(mission, mission.string(), true);
    // the mission of a flight has no cycle, but a file may have changed since
    constexpr std::size_t most = 32;
    for (const Node* base = nullptr;
         (base = roots_.back().find("extends")) && base->is(Node::Kind::scalar) && files_.size() < most;)
      open_named(files_.size() - 1, base->text);
    missions_ = files_.size();
    for (std::size_t i = 0; i < missions_; ++i) {
      const Node* airframe = roots_[i].find("airframe");
      if (!airframe) continue;
      if (airframe->is(Node::Kind::map)) airframe_ = FilePlace{i, {"airframe", "params"}};
      if (!airframe->is(Node::Kind::scalar)) break;
      open_named(i, airframe->text);
      airframe_ = FilePlace{files_.size() - 1, {"params"}};
      break;
    }
  }

  void save(SavedParam p) {
    if (p.info.kind == FULMAR_RECORD || p.info.kind == FULMAR_BLOB) return;
    const std::optional<FilePlace> place = find(p);
    if (place && p.info.kind == FULMAR_VECTOR && !p.info.type)
      p.info.type = names_of(*at_path(roots_[place->file], place->path));
    if (place ? already(p, *place) : same_value(p.info, p.value, initial_value(p.info))) return;
    const bool replaces = place && ours_[place->file];
    const FilePlace where =
        replaces ? *place : FilePlace{0, {"components", p.component, "params", p.info.name}};
    const std::string name = p.component + "." + p.info.name;
    try {
      const std::string& before = files_[where.file].after;
      const std::string after =
          replaces ? replaced(before, where.path, p) : with_entry(before, where.path, new_text(p));
      const std::vector<std::string> also = check(before, after, where, p);
      files_[where.file].after = after;
      roots_[where.file] = parsed(after, files_[where.file].name);
      plan_.changed.push_back(name);
      for (const std::string& section : also)
        plan_.also.push_back(
            located(files_[where.file].name, save_messages::text_of_other_plugin(name, section)));
    } catch (const Error& fault) {
      plan_.refused.push_back(
          located(files_[where.file].name, save_messages::edit_by_hand(name, new_text(p), fault.what())));
    }
  }

  SavePlan plan() {
    for (FileEdit& file : files_)
      if (file.before != file.after) plan_.files.push_back(file);
    return plan_;
  }

 private:
  /// Reads a file that the nth one names. Files of the installation are never written.
  void open_named(std::size_t nth, const std::string& name) {
    open(named_file(files_[nth].path.parent_path(), name), name, ours_[nth] && !is_shipped_name(name));
  }
  void open(const fs::path& path, const std::string& name, bool ours) {
    ours_.push_back(ours);
    const FilePtr file = read_source(path, name);
    roots_.push_back(parsed(file->text, name));
    files_.push_back({path, path.filename().string(), file->text, file->text});
  }

  std::optional<FilePlace> find(const SavedParam& p) const {
    const YamlPath own{"components", p.component, "params", p.info.name};
    for (std::size_t i = 0; i < missions_; ++i)
      if (at_path(roots_[i], own)) return FilePlace{i, own};
    if (!airframe_) return std::nullopt;
    const Node* sections = at_path(roots_[airframe_->file], airframe_->path);
    const auto [plugin, component] = split_use(p.use);
    for (std::size_t i = 0; sections && i < sections->entries.size(); ++i) {
      const Node::Entry& section = sections->entries[i];
      const auto [for_plugin, for_component] = split_use(section.key);
      if (for_plugin != plugin && for_plugin != plugin + ".so") continue;
      if ((!for_component.empty() && for_component != component) || !section.value.find(p.info.name))
        continue;
      FilePlace place = *airframe_;
      place.path.push_back(section.key);
      place.path.push_back(p.info.name);
      return place;
    }
    return std::nullopt;
  }

  /// A request does not hold the names of the elements: they are those of the frame in the file.
  static TypePtr names_of(const Node& map) {
    Type type;
    type.fields.resize(3);
    const bool ned = map.find("north") || map.find("east") || map.find("down");
    for (std::size_t i = 0; i < 3; ++i)
      type.fields[i].name = std::vector{ned ? "north" : "x", ned ? "east" : "y", ned ? "down" : "z"}[i];
    return std::make_shared<const Type>(std::move(type));
  }

  /// True when the file has the value of the flight.
  static bool says(const SavedParam& p, const Node& node) {
    Report report;
    FileStore none(report);
    ParamValue value = initial_value(p.info);
    read_param(p.info, node, p.info.name, value, none, report);
    return report.empty() && same_value(p.info, value, p.value);
  }
  bool already(const SavedParam& p, const FilePlace& place) const {
    return says(p, *at_path(roots_[place.file], place.path));
  }

  static std::string replaced(const std::string& text, const YamlPath& path, const SavedParam& p) {
    const std::optional<YamlSpan> span = find_value(text, path);
    if (!span) throw Error(save_messages::value_form_unsupported());
    const std::string old = text.substr(span->begin, span->end - span->begin);
    using Form = YamlSpan::Form;
    if (span->form == Form::alias) return with_value(text, *span, new_text(p));
    if (p.info.kind != FULMAR_VECTOR) return with_value(text, *span, scalar_like(old, p));
    if (span->form == Form::map) return vector_keys(text, path, p);
    const std::vector<YamlSpan> items = list_items(text, *span);
    if (items.size() != 3) throw Error(save_messages::list_form_unsupported());
    std::string changed = text;
    for (std::size_t i = 3; i-- > 0;) {
      const std::string item = text.substr(items[i].begin, items[i].end - items[i].begin);
      if (!holds(item, p.value.number[i], p.info.unit))
        changed = with_value(changed, items[i], number_like(item, p.value.number[i], p.info.unit));
    }
    return changed;
  }

  static bool holds(const std::string& item, double value, const std::string& unit) {
    try {
      return same_number(quantity_in(unquoted(item), unit, UnitRule::optional), value);
    } catch (const Error&) {
      return false;
    }
  }

  static std::string vector_keys(std::string text, const YamlPath& path, const SavedParam& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      YamlPath key = path;
      key.push_back(p.info.type->fields[i].name);
      const std::optional<YamlSpan> span = find_value(text, key);
      const std::string old = span ? text.substr(span->begin, span->end - span->begin) : "";
      if (span && !holds(old, p.value.number[i], p.info.unit))
        text = with_value(text, *span, number_like(old, p.value.number[i], p.info.unit));
      if (!span && !same_number(p.value.number[i], p.info.initial[i]))
        text = with_entry(text, key, new_number(p.value.number[i], p.info.unit));
    }
    return text;
  }

  /// When `path` is the same parameter of the airframe for an inactive plugin, such as
  /// "control_slc/Autotune": the name of that plugin.
  std::string idle_section(const std::string& path, const FilePlace& where) const {
    if (!airframe_ || where.file != airframe_->file || where.path.size() != airframe_->path.size() + 2)
      return "";
    std::string head, tail = "\n" + where.path.back();
    for (const std::string& key : airframe_->path) head += "\n" + key;
    head += "\n";
    if (!path.starts_with(head) || !path.ends_with(tail) || path.size() <= head.size() + tail.size())
      return "";
    const std::string section = path.substr(head.size(), path.size() - head.size() - tail.size());
    if (section.find('\n') != std::string::npos) return "";
    const auto [plugin, component] = split_use(section);
    for (const std::string& use : flown_) {
      const auto [flown_plugin, flown_component] = split_use(use);
      const bool same = plugin == flown_plugin || plugin == flown_plugin + ".so";
      if (same && (component.empty() || flown_component.empty() || component == flown_component)) return "";
    }
    return section;
  }

  /// Checks the changed file: it must have the values of the flight and no other change, except for the
  /// returned plugins.
  std::vector<std::string> check(const std::string& before, const std::string& after, const FilePlace& where,
                                 const SavedParam& p) const {
    const Node root = parsed(after, "");
    const Node* node = at_path(root, where.path);
    if (!node || !says(p, *node)) throw Error(save_messages::change_not_effective());
    std::map<std::string, std::string> old, now;
    flatten(parsed(before, ""), "", old);
    flatten(root, "", now);
    std::vector<std::string> also;
    std::string own;
    for (const std::string& key : where.path) own += "\n" + key;
    for (const auto& [path, value] : old) {
      const auto same = now.find(path);
      if (path.starts_with(own) || (same != now.end() && (same->second == value || own.starts_with(path))))
        continue;
      if (const std::string section = idle_section(path, where); !section.empty()) {
        also.push_back(section);
        continue;
      }
      std::string words = path.substr(1);
      std::replace(words.begin(), words.end(), '\n', '.');
      throw Error(save_messages::text_shared(words));
    }
    return also;
  }

  std::vector<FileEdit> files_;  // mission, the files that it extends, airframe
  std::size_t missions_ = 0;     // number of missions among them
  std::vector<Node> roots_;
  std::vector<bool> ours_;  // per file: true when it may be written
  std::optional<FilePlace> airframe_;
  std::vector<std::string> flown_;
  SavePlan plan_;
};

}  // namespace

SavePlan plan_save(const fs::path& mission, const std::vector<SavedParam>& params,
                   const std::vector<std::string>& flown) {
  Saver saver(mission, flown);
  for (const SavedParam& p : params) saver.save(p);
  return saver.plan();
}

void check_mission_name(const std::string& file, const std::string& flies) {
  Report report;  // faults are reported when the file is written
  const std::string name = parse_mission(file, {}, report).mission;
  if (name != flies) throw Error(save_messages::mission_name_mismatch(file, name, flies));
}

}  // namespace fulmar::core
