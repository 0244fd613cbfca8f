// SPDX-License-Identifier: BSD-3-Clause
// YAML files as a tree with file and line of every node, and the report that collects all faults of a set-up.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/source_file.hpp"

namespace fulmar::core {

/// The faults of a set-up: each once, ordered by file (as the files were opened) and line. At most the first
/// hundred are kept.
class Report {
 public:
  void add(const Where& where, Diagnostic message);
  void opened(const std::string& file);
  bool empty() const;
  /// Whether the report drops further faults: the caller can skip their texts.
  bool full() const;
  /// Records a name that a layer removes: "components.manage". All later uses of it give one fault with that
  /// place.
  void taken_away(const std::string& name, const Where& where);
  /// Whether one of `names` was removed; `path` is then added as a remaining use.
  bool still_named(const std::vector<std::string>& names, const Where& where, const std::string& path);
  bool is_taken_away(const std::string& name) const;
  /// Whether a removed name with this prefix is still in use.
  bool misses(const std::string& prefix) const;
  std::vector<Diagnostic> faults() const;
  /// One fault per line.
  std::string text() const;
  void throw_if_any() const;

 private:
  struct Fault {
    std::size_t rank;
    Where where;
    Diagnostic message;
  };
  struct Taken {
    std::string name;
    Where where;
    std::vector<std::string> named_by;
  };
  std::size_t rank(const std::string& file);
  std::vector<std::string> files_;
  std::vector<Fault> faults_;
  std::vector<Taken> taken_;
};

struct Node {
  enum class Kind : std::uint8_t { missing, null, scalar, sequence, map };
  struct Entry;
  Kind kind = Kind::missing;
  bool quoted = false;  // a quoted scalar is always text
  int line = 0;
  FilePtr file;
  std::string text;            // of a scalar; "null" for a written null, unlike an omitted value
  std::vector<Node> items;     // of a sequence
  std::vector<Entry> entries;  // of a map, in file order, each key once

  Where where() const { return {file ? file->name : "", line}; }
  const Node* find(const std::string& key) const;
  bool is(Kind k) const { return kind == k; }
};

struct Node::Entry {
  std::string key;
  int line = 0;  // of the key
  Node value;
  Where where() const { return {value.file ? value.file->name : "", line}; }
};

/// Description of a node for a message: "nothing", "a list", "a map", "'text'".
std::string found_words(const Node& node);

class StoredFiles;
/// Reads a file. Throws Error when it cannot be read. `name` is its name in faults. `stored`: in place of the
/// disk.
FilePtr read_source(const std::filesystem::path& path, const std::string& name,
                    const StoredFiles* stored = nullptr);
/// Text without a file, such as a value on the command line: faults name it without a line.
FilePtr make_source(const std::string& text, const std::string& name);

/// Parses a file. Broken YAML and duplicate keys go to the report; broken YAML gives a missing node.
Node parse_yaml(const FilePtr& file, Report& report);

/// `top` merged over `base`: maps merge key by key down to `depth` levels, any other value is replaced; a
/// null removes a value of `base`. Values of `base` come first.
Node merged(const Node& base, const Node& top, int depth);

/// A word of the file with its place: a port, a field, a condition.
struct Word {
  std::string text;
  Where where;
};

/// A map whose keys are known: reports unknown keys and wrong types, each with the valid choices.
class Keys {
 public:
  /// `path` is the map's name in faults: "components.slc"; "" for the file itself.
  Keys(const Node& map, std::string path, std::vector<std::string> valid, Report& report);

  const Node* get(const std::string& key) const { return map_.find(key); }
  bool has(const std::string& key) const { return get(key) != nullptr; }
  std::string path(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  Where where(const std::string& key) const;

  std::optional<std::string> text(const std::string& key) const;
  /// The same with its place; empty when there is none.
  Word word_at(const std::string& key) const { return {text(key).value_or(""), where(key)}; }
  std::optional<bool> flag(const std::string& key) const;
  /// A number with a unit, converted to `unit`. Must be above 0 (`or_zero`: at least 0).
  std::optional<double> positive(const std::string& key, const std::string& unit, bool or_zero = false) const;
  std::optional<std::int64_t> duration_ns(const std::string& key) const;
  /// Items of the list or map under the key. Another type gives nothing and a fault; a missing key gives
  /// nothing. `expected` is the description in the fault: "a list of ports such as [nav.state]".
  const std::vector<Node>& items(const std::string& key, const std::string& expected) const;
  const std::vector<Node::Entry>& entries(const std::string& key, const std::string& expected) const;
  /// One of `words`; anything else is a fault.
  std::optional<std::string> word(const std::string& key, const std::vector<std::string>& words) const;

 private:
  const Node& map_;
  std::string path_;
  Report& report_;
};

/// Whether it is a list, a map or another expected kind; a fault when not.
bool is_a(Node::Kind kind, const Node& node, const std::string& path, const std::string& expected,
          Report& report);
/// The text of a scalar, or nothing and a fault.
std::optional<std::string> scalar_text(const Node& node, const std::string& path, const std::string& expected,
                                       Report& report);
std::optional<bool> scalar_flag(const Node& node, const std::string& path, Report& report);
/// Index of a word in `words`.
std::optional<std::size_t> scalar_word(const Node& node, const std::string& path,
                                       const std::vector<std::string>& words, Report& report);
/// Text that is shorter than `room` bytes.
std::optional<std::string> scalar_text_for(std::size_t room, const Node& node, const std::string& path,
                                           Report& report);
/// A number in `unit`, of at least `min` and at most `max`.
struct NumberWanted {
  std::string unit;
  UnitRule rule = UnitRule::optional;
  double min, max;
};
std::optional<double> scalar_number(const Node& node, const std::string& path, const NumberWanted& wanted,
                                    Report& report);

}  // namespace fulmar::core
