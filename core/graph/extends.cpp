// SPDX-License-Identifier: BSD-3-Clause
// See extends.hpp.
#include "core/graph/extends.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/graph/shipped.hpp"

namespace fulmar::core {
namespace {

/// Named things merge by name: a component's keys, its parameters and wires one by one, what a phase says of
/// a role as a whole. Everything else is replaced as a whole.
Node laid_over(const Node& base, const Node& top) {
  static const std::pair<const char*, int> depths[] = {
      {"components", 3}, {"roles", 3}, {"phases", 2}, {"summary", 1}};
  Node node = merged(base, top, 1);
  for (const auto& [key, depth] : depths) {
    const Node *const below = base.find(key), *const above = top.find(key);
    if (!below || !above || above->is(Node::Kind::null)) continue;
    for (Node::Entry& entry : node.entries)
      if (entry.key == key) entry.value = merged(*below, *above, depth);
  }
  return node;
}

class Layers {
 public:
  Layers(const StoredFiles* stored, std::vector<FilePtr>& files, Report& report)
      : stored_(stored), files_(files), report_(report) {}

  Node tree(const FilePtr& file) {
    Node top = parse_yaml(file, report_);
    if (above_.empty() && !top.is(Node::Kind::map)) return top;  // its reader says what it expects
    if (!is_a(Node::Kind::map, top, "extends", "a map with the keys of a mission", report_)) return {};
    const Node* const extends = top.find("extends");
    if (!extends) return top;
    above_.push_back(file);
    const FilePtr below = read(*extends, *file);
    const Node base = below ? tree(below) : Node{};
    above_.pop_back();
    return base.is(Node::Kind::map) ? laid_over(base, top) : Node{};
  }

 private:
  /// Null and a fault when there is no such file, or it lies above this one already.
  FilePtr read(const Node& extends, const SourceFile& file) {
    const auto name = scalar_text(extends, "extends", "the name of a file", report_);
    if (!name) return nullptr;
    const auto path = named_file(file.path.parent_path(), *name);
    const auto same = [&](const FilePtr& layer) { return layer->path.lexically_normal() == path; };
    if (std::any_of(above_.begin(), above_.end(), same)) {
      std::string chain;
      for (const FilePtr& layer : above_) chain += layer->name + " -> ";
      report_.add(extends.where(), "extends: the files extend each other: " + chain + *name);
      return nullptr;
    }
    try {
      // as a reader of the mission would open it
      const bool shipped = is_shipped_name(*name);
      const auto shown =
          shipped ? std::filesystem::path(*name) : std::filesystem::path(file.name).parent_path() / *name;
      return files_.emplace_back(read_source(path, shown.string(), stored_));
    } catch (const Error& fault) {
      report_.add(extends.where(), std::string("extends: ") + fault.what());
      return nullptr;
    }
  }

  const StoredFiles* stored_;
  std::vector<FilePtr>& files_;
  Report& report_;
  std::vector<FilePtr> above_;  // the layers that lead to the one being read
};

}  // namespace

Node layered_tree(const FilePtr& file, const StoredFiles* stored, std::vector<FilePtr>& files,
                  Report& report) {
  return Layers(stored, files, report).tree(file);
}

}  // namespace fulmar::core
