// SPDX-License-Identifier: BSD-3-Clause
// YAML files as a tree with places: the report, and access to the tree.
#include "core/graph/yaml.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/graph/messages.hpp"
#include "core/graph/shipped.hpp"
#include "core/graph/stored_files.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_faults = 100;  // further faults are not useful, and each is compared with those
                                         // before it

}  // namespace

// ---- report

std::size_t Report::rank(const std::string& file) {
  const auto it = std::find(files_.begin(), files_.end(), file);
  if (it != files_.end()) return static_cast<std::size_t>(it - files_.begin());
  files_.push_back(file);
  return files_.size() - 1;
}

void Report::opened(const std::string& file) { rank(file); }

bool Report::full() const { return faults_.size() > max_faults; }

void Report::add(const Where& where, Diagnostic message) {
  if (full()) return;
  for (const Fault& fault : faults_)
    if (fault.where.line == where.line && fault.where.file == where.file &&
        fault.message.line() == message.line())
      return;
  if (faults_.size() < max_faults) return faults_.push_back({rank(where.file), where, std::move(message)});
  constexpr std::size_t last = std::numeric_limits<std::size_t>::max();
  faults_.push_back({last, {where.file, 0}, graph_messages::more_faults(max_faults)});
}

void Report::taken_away(const std::string& name, const Where& where) {
  rank(where.file);
  taken_.push_back({name, where, {}});
}

bool Report::still_named(const std::vector<std::string>& names, const Where& where, const std::string& path) {
  for (Taken& taken : taken_) {
    if (std::find(names.begin(), names.end(), taken.name) == names.end()) continue;
    const std::string words = path + " (" + where.text() + ")";
    if (std::find(taken.named_by.begin(), taken.named_by.end(), words) == taken.named_by.end())
      taken.named_by.push_back(words);
    return true;
  }
  return false;
}

bool Report::is_taken_away(const std::string& name) const {
  return std::any_of(taken_.begin(), taken_.end(), [&](const Taken& taken) { return taken.name == name; });
}

bool Report::misses(const std::string& prefix) const {
  return std::any_of(taken_.begin(), taken_.end(), [&](const Taken& taken) {
    return !taken.named_by.empty() && taken.name.starts_with(prefix);
  });
}

bool Report::empty() const { return faults_.empty() && !misses(""); }

std::vector<Diagnostic> Report::faults() const {
  std::vector<Fault> sorted = faults_;
  for (const Taken& taken : taken_) {
    if (taken.named_by.empty()) continue;
    const auto file = std::find(files_.begin(), files_.end(), taken.where.file);
    sorted.push_back({static_cast<std::size_t>(file - files_.begin()), taken.where,
                      graph_messages::still_named(taken.name, join(taken.named_by))});
  }
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.where.line < b.where.line;
  });
  std::vector<Diagnostic> all;
  all.reserve(sorted.size());
  for (const Fault& fault : sorted) all.push_back(located(fault.where, fault.message));
  return all;
}

std::string Report::text() const { return Error(faults()).what(); }

void Report::throw_if_any() const {
  if (!empty()) throw Error(faults());
}

// ---- tree

const Node* Node::find(const std::string& key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

std::string found_words(const Node& node) {
  switch (node.kind) {
    case Node::Kind::sequence: return "a list";
    case Node::Kind::map: return "a map";
    case Node::Kind::scalar: return "'" + node.text + "'";
    default: return "nothing";
  }
}

namespace {

constexpr std::size_t largest_source = 16u << 20;  // bytes

/// A file that is open for reading, closed by the destructor.
struct OpenFile {
  int fd;
  explicit OpenFile(const std::filesystem::path& path)
      : fd(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~OpenFile() {
    if (fd >= 0) ::close(fd);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
};

/// Reads to the end, and ignores the reported size: files of the kernel report none. An endless file, or one
/// without data yet, is rejected.
std::string contents_of(int fd, const std::string& name) {
  std::string text;
  for (std::string block(1u << 16, '\0'); text.size() <= largest_source;) {
    const ssize_t n = ::read(fd, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      throw Error(errno == EAGAIN ? graph_messages::file_not_regular(name)
                                  : graph_messages::file_not_readable(name, std::strerror(errno)));
    if (n == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(n));
  }
  throw Error(graph_messages::file_too_large(name));
}

}  // namespace

FilePtr read_source(const std::filesystem::path& path, const std::string& name, const StoredFiles* stored) {
  if (stored) return stored->read(path, name);
  const OpenFile file(path);
  if (file.fd < 0 && (errno == ENOENT || errno == ENOTDIR))
    throw Error(graph_messages::file_missing(name, file_hint(path, name)));
  struct stat status {};
  if (file.fd < 0 || ::fstat(file.fd, &status) != 0)
    throw Error(errno == ENXIO ? graph_messages::file_not_regular(name)
                               : graph_messages::file_not_readable(name, std::strerror(errno)));
  if (S_ISDIR(status.st_mode)) throw Error(graph_messages::file_is_folder(name));
  if (!S_ISREG(status.st_mode)) throw Error(graph_messages::file_not_regular(name));
  return std::make_shared<SourceFile>(SourceFile{path, name, contents_of(file.fd, name)});
}

FilePtr make_source(const std::string& text, const std::string& name) {
  return std::make_shared<SourceFile>(SourceFile{{}, name, text});
}

Node merged(const Node& base, const Node& top, int depth) {
  if (depth == 0 || !base.is(Node::Kind::map) || !top.is(Node::Kind::map)) return top;
  Node node = base;
  for (const Node::Entry& entry : top.entries) {
    const auto it = std::find_if(node.entries.begin(), node.entries.end(),
                                 [&](const Node::Entry& e) { return e.key == entry.key; });
    if (it == node.entries.end()) {
      node.entries.push_back(entry);
    } else if (entry.value.is(Node::Kind::null)) {
      node.entries.erase(it);
    } else {
      Node both = merged(it->value, entry.value, depth - 1);
      *it = Node::Entry{entry.key, entry.line, std::move(both)};
    }
  }
  node.file = top.file;
  node.line = top.line;
  return node;
}

// ---- keys

Keys::Keys(const Node& map, std::string path, std::vector<std::string> valid, Report& report)
    : map_(map), path_(std::move(path)), report_(report) {
  const std::string prefix = path_.empty() ? "" : path_ + ": ";
  if (map.is(Node::Kind::missing)) return;
  if (!map.is(Node::Kind::map)) {
    report_.add(map.where(), graph_messages::map_expected(prefix, join(valid), found_words(map)));
    return;
  }
  for (const Node::Entry& entry : map.entries)
    if (!report_.full() && std::find(valid.begin(), valid.end(), entry.key) == valid.end())
      report_.add(entry.where(),
                  graph_messages::key_unknown(prefix, entry.key, choices_text(entry.key, valid)));
}

Where Keys::where(const std::string& key) const {
  for (const Node::Entry& entry : map_.entries)
    if (entry.key == key) return entry.where();
  return map_.where();
}

const std::vector<Node>& Keys::items(const std::string& key, const std::string& expected) const {
  static const std::vector<Node> none;
  const Node* node = get(key);
  return node && is_a(Node::Kind::sequence, *node, path(key), expected, report_) ? node->items : none;
}

const std::vector<Node::Entry>& Keys::entries(const std::string& key, const std::string& expected) const {
  static const std::vector<Node::Entry> none;
  const Node* node = get(key);
  return node && is_a(Node::Kind::map, *node, path(key), expected, report_) ? node->entries : none;
}

bool is_a(Node::Kind kind, const Node& node, const std::string& path, const std::string& expected,
          Report& report) {
  if (!node.is(kind))
    report.add(node.where(), located(path, graph_messages::value_not_valid(expected, found_words(node))));
  return node.is(kind);
}

std::optional<std::string> scalar_text(const Node& node, const std::string& path, const std::string& expected,
                                       Report& report) {
  if (node.is(Node::Kind::scalar) && (node.quoted || !node.text.empty())) return node.text;
  report.add(node.where(), located(path, graph_messages::value_not_valid(expected, found_words(node))));
  return std::nullopt;
}

std::optional<bool> scalar_flag(const Node& node, const std::string& path, Report& report) {
  if (node.is(Node::Kind::scalar) && !node.quoted) {
    if (node.text == "true" || node.text == "on" || node.text == "yes") return true;
    if (node.text == "false" || node.text == "off" || node.text == "no") return false;
  }
  report.add(node.where(), located(path, graph_messages::flag_expected(found_words(node))));
  return std::nullopt;
}

std::optional<std::size_t> scalar_word(const Node& node, const std::string& path,
                                       const std::vector<std::string>& words, Report& report) {
  const auto text = scalar_text(node, path, "one of " + join(words), report);
  if (!text) return std::nullopt;
  const auto it = std::find(words.begin(), words.end(), *text);
  if (it != words.end()) return static_cast<std::size_t>(it - words.begin());
  report.add(node.where(), located(path, graph_messages::choice_unknown(*text, choices_text(*text, words))));
  return std::nullopt;
}

std::optional<std::string> scalar_text_for(std::size_t room, const Node& node, const std::string& path,
                                           Report& report) {
  if (!is_a(Node::Kind::scalar, node, path, "text", report)) return std::nullopt;
  if (node.text.size() < room) return node.text;
  report.add(node.where(), located(path, graph_messages::text_too_long(node.text.size(), room - 1)));
  return std::nullopt;
}

std::optional<double> scalar_number(const Node& node, const std::string& path, const NumberWanted& wanted,
                                    Report& report) {
  const std::string expected = "a number" + (wanted.unit.empty() ? "" : " in " + wanted.unit);
  if (!is_a(Node::Kind::scalar, node, path, expected, report)) return std::nullopt;
  try {
    const Quantity quantity = parse_quantity(node.text);
    const double number = convert(quantity, wanted.unit, wanted.rule);
    check_range(quantity, number, wanted.unit, wanted.min, wanted.max);
    return number;
  } catch (const Error& fault) {
    report.add(node.where(), located(path, fault.diagnostic));
    return std::nullopt;
  }
}

std::optional<std::string> Keys::text(const std::string& key) const {
  const Node* node = get(key);
  return node ? scalar_text(*node, path(key), "text", report_) : std::nullopt;
}

std::optional<bool> Keys::flag(const std::string& key) const {
  const Node* node = get(key);
  return node ? scalar_flag(*node, path(key), report_) : std::nullopt;
}

std::optional<double> Keys::positive(const std::string& key, const std::string& unit, bool or_zero) const {
  const Node* node = get(key);
  if (!node) return std::nullopt;
  if (!is_a(Node::Kind::scalar, *node, path(key), "a number with a unit, such as 10 " + unit, report_))
    return std::nullopt;
  try {
    const double value = quantity_in(node->text, unit, UnitRule::required);
    if (value < 0 || (value == 0 && !or_zero))
      throw Error(or_zero ? graph_messages::quantity_negative(node->text)
                          : graph_messages::quantity_not_positive(node->text));
    return value;
  } catch (const Error& fault) {
    report_.add(node->where(), located(path(key), fault.diagnostic));
  }
  return std::nullopt;
}

std::optional<std::int64_t> Keys::duration_ns(const std::string& key) const {
  const auto seconds = positive(key, "s", true);
  if (!seconds) return std::nullopt;
  if (*seconds > 0 && *seconds < 0.5e-9) {
    report_.add(get(key)->where(),
                located(path(key), graph_messages::duration_too_short(found_words(*get(key)))));
    return std::nullopt;
  }
  if (*seconds <= 9e9) return std::llround(*seconds * 1e9);
  report_.add(get(key)->where(),
              located(path(key), graph_messages::duration_too_long(found_words(*get(key)))));
  return std::nullopt;
}

std::optional<std::string> Keys::word(const std::string& key, const std::vector<std::string>& words) const {
  const Node* node = get(key);
  const auto i = node ? scalar_word(*node, path(key), words, report_) : std::nullopt;
  return i ? std::optional(words[*i]) : std::nullopt;
}

}  // namespace fulmar::core
