// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/extends.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/graph/messages.hpp"
#include "core/graph/shipped.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {
namespace {

/// Depths of named maps that merge by name: a component's keys, its parameters and wires one by one, a
/// phase's entry of a role as a whole. All other values are replaced as a whole.
constexpr std::pair<std::string_view, int> depths[] = {{"components", 3}, {"roles", 3},  {"phases", 2},
                                                       {"summary", 1},    {"resume", 1}, {"failsafe", 1},
                                                       {"live", 1},       {"record", 1}, {"dds", 2}};

int depth_of(const std::string& key) {
  for (const auto& [name, depth] : depths)
    if (name == key) return depth;
  return 0;
}

/// Keys that a layer removes from the one below it.
class Takings {
 public:
  Takings(const std::string& below, Report& report) : below_(below), report_(report) {}

  /// Reports and drops removals of keys that do not exist. `levels` of maps merge.
  void check(const Node& base, Node& top, const std::string& path, int levels) {
    if (!base.is(Node::Kind::map) || !top.is(Node::Kind::map)) return;
    std::erase_if(top.entries, [&](const Node::Entry& entry) {
      return entry.value.is(Node::Kind::null) && !takes(base, entry, path);
    });
    for (Node::Entry& entry : top.entries) {
      const Node* const below = base.find(entry.key);
      const int deeper = path.empty() ? depth_of(entry.key) : levels - 1;
      if (below && deeper > 0)
        check(*below, entry.value, path.empty() ? entry.key : path + "." + entry.key, deeper);
    }
  }

 private:
  bool takes(const Node& base, const Node::Entry& entry, const std::string& path) {
    const std::string name = path.empty() ? entry.key : path + "." + entry.key;
    if (base.find(entry.key)) {
      if (path == "components" || path == "roles" || path == "phases")
        report_.taken_away(name, entry.where());
      return true;
    }
    if (is_wire(path)) return true;  // may be a wire of a role, which the mission's reader checks
    if (path == "phases" && entry.value.text.empty()) return true;  // an empty new phase
    if (report_.full()) return false;
    std::vector<std::string> there;
    for (const Node::Entry& other : base.entries) there.push_back(other.key);
    const std::string near = nearest(entry.key, there);
    report_.add(entry.where(),
                graph_messages::removed_key_missing(path.empty() ? "" : path + ": ", below_, entry.key,
                                                    near.empty() ? "" : ". Did you mean '" + near + "'?"));
    return false;
  }

  static bool is_wire(const std::string& path) {
    return path.starts_with("components.") && path.ends_with(".in");
  }

  const std::string& below_;
  Report& report_;
};

Node laid_over(const Node& base, Node top, Report& report) {
  Takings(base.file->name, report).check(base, top, "", 1);
  Node node = merged(base, top, 1);
  for (Node::Entry& entry : node.entries) {
    const Node *const below = base.find(entry.key), *const above = top.find(entry.key);
    if (below && above && depth_of(entry.key) > 0) entry.value = merged(*below, *above, depth_of(entry.key));
  }
  return node;
}

class Layers {
 public:
  Layers(const StoredFiles* stored, std::vector<FilePtr>& files, std::vector<Node>& below, Report& report)
      : stored_(stored), files_(files), below_(below), report_(report) {}

  Node tree(const FilePtr& file) {
    Node top = parse_yaml(file, report_);
    if (above_.empty() && !top.is(Node::Kind::map))
      return top;  // the mission's reader reports the expected
                   // type
    if (!is_a(Node::Kind::map, top, "extends", "a map with the keys of a mission", report_)) return {};
    const Node* const extends = top.find("extends");
    if (!extends) return top;
    above_.push_back(file);
    const FilePtr below = read(*extends, *file);
    const Node base = below ? tree(below) : Node{};
    above_.pop_back();
    if (!base.is(Node::Kind::map)) return {};
    below_.push_back(base);
    return laid_over(base, std::move(top), report_);
  }

 private:
  /// Null and a fault when there is no such file, or when it is already a layer above.
  FilePtr read(const Node& extends, const SourceFile& file) {
    const auto name = scalar_text(extends, "extends", "the name of a file", report_);
    if (!name) return nullptr;
    const auto path = named_file(file.path.parent_path(), *name);
    const auto same = [&](const FilePtr& layer) { return layer->path.lexically_normal() == path; };
    if (std::any_of(above_.begin(), above_.end(), same)) {
      std::string chain;
      for (const FilePtr& layer : above_) chain += layer->name + " -> ";
      report_.add(extends.where(), graph_messages::extends_cycle(chain, *name));
      return nullptr;
    }
    try {
      // in the same way as a mission is opened
      const bool shipped = is_shipped_name(*name);
      const auto shown =
          shipped ? std::filesystem::path(*name) : std::filesystem::path(file.name).parent_path() / *name;
      return files_.emplace_back(read_source(path, shown.string(), stored_));
    } catch (const Error& fault) {
      report_.add(extends.where(), graph_messages::extends_file_invalid(fault.what()));
      return nullptr;
    }
  }

  const StoredFiles* stored_;
  std::vector<FilePtr>& files_;
  std::vector<Node>& below_;
  Report& report_;
  std::vector<FilePtr> above_;  // the layers above the present one
};

}  // namespace

Node layered_tree(const FilePtr& file, const StoredFiles* stored, std::vector<FilePtr>& files,
                  std::vector<Node>& below, Report& report) {
  return Layers(stored, files, below, report).tree(file);
}

}  // namespace fulmar::core
