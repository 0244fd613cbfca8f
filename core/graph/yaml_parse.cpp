// SPDX-License-Identifier: BSD-3-Clause
// From a YAML text to the tree. yaml-cpp reads the text event by event. The tree is built from the events, so
// that a file with a tree that is too large is rejected early.
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <new>
#include <sstream>

#include "core/graph/messages.hpp"
#include "core/graph/yaml.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

constexpr int deepest = 60;
constexpr std::size_t max_values = 500'000;
constexpr std::size_t max_text = 32u << 20;  // twice the largest file: only aliases can exceed that

/// Size of a tree. Aliases copy, so a short text can become a large tree.
struct Size {
  std::size_t values = 1, text = 0;
  int depth = 0;
};

Size size_of(const Node& node) {
  Size size{1, node.text.size(), 0};
  const auto add = [&](const Node& child, std::size_t key) {
    const Size inside = size_of(child);
    size.values += inside.values;
    size.text += inside.text + key;
    size.depth = std::max(size.depth, inside.depth + 1);
  };
  for (const Node& item : node.items) add(item, 0);
  for (const Node::Entry& entry : node.entries) add(entry.value, entry.key.size());
  return size;
}

class Builder : public YAML::EventHandler {
 public:
  Builder(const FilePtr& file, Report& report) : file_(file), report_(report) {}

  /// The first document is the tree. Its exception stops the parser at the first value of a second one.
  struct SecondDocument {
    int line;
  };
  /// Place of a rejected value.
  struct Refused {
    int line;
    Diagnostic message;
  };
  Node root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override { ended_ = true; }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node node = begin(mark, Node::Kind::null);
    const auto at = static_cast<std::size_t>(mark.pos);
    if (at < file_->text.size() && std::string_view("nN~").find(file_->text[at]) != std::string_view::npos)
      node.text = "null";  // marks a written null, not an omitted value
    node.line = open_.empty() ? first_line() : open_.back().line();
    place(std::move(node), mark, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node node = begin(mark, Node::Kind::scalar);
    count({0, value.size(), 0}, mark);
    node.text = value;
    node.quoted = tag == "!";
    place(std::move(node), mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    begin(mark, Node::Kind::null);
    const auto it = anchors_.find(anchor);
    if (it == anchors_.end()) throw Refused{line_of(mark), graph_messages::anchor_recursive()};
    const Anchor& known = it->second;
    if (static_cast<int>(open_.size()) + known.size.depth > deepest) throw too_deep(mark);
    count(known.size, mark);
    place(Node(known.node), mark, 0);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(begin(mark, Node::Kind::sequence), mark, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(begin(mark, Node::Kind::map), mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  /// A list or map whose end has not been read.
  struct Open {
    Node node;
    YAML::Mark mark;
    YAML::anchor_t anchor;
    std::map<std::string, int> lines;  // lines of the keys so far; a map, so that no choice of keys makes it
                                       // slow
    std::string key;                   // of the next value
    int key_line = 0;
    bool has_key = false, dropped = false;  // dropped: the key was rejected, and so is its value

    int line() const { return has_key ? key_line : node.line; }
  };
  struct Anchor {
    Node node;
    Size size;
  };

  int first_line() const { return file_->path.empty() ? 0 : 1; }
  /// A text without a file has no lines.
  int line_of(const YAML::Mark& mark) const { return file_->path.empty() ? 0 : mark.line + 1; }
  Refused too_deep(const YAML::Mark& mark) const {
    return {line_of(mark), graph_messages::yaml_too_deep(deepest)};
  }

  bool key_is_next() const {
    return !open_.empty() && open_.back().node.is(Node::Kind::map) && !open_.back().has_key;
  }

  Node begin(const YAML::Mark& mark, Node::Kind kind) {
    if (ended_) throw SecondDocument{mark.line + 1};
    if (static_cast<int>(open_.size()) > deepest) throw too_deep(mark);
    if (!key_is_next()) count({1, 0, 0}, mark);
    Node node;
    node.kind = kind;
    node.file = file_;
    node.line = line_of(mark);
    return node;
  }

  void count(const Size& size, const YAML::Mark& mark) {
    values_ += size.values;
    text_ += size.text;
    if (values_ > max_values) throw Refused{line_of(mark), graph_messages::yaml_too_many_values(max_values)};
    if (text_ > max_text) throw Refused{line_of(mark), graph_messages::yaml_text_too_large(max_text >> 20)};
  }

  void open(Node node, const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.push_back({std::move(node), mark, anchor, {}, {}, 0, false, false});
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    place(std::move(done.node), done.mark, done.anchor);
  }

  void place(Node node, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) {  // a copy is kept for the aliases, and counts
      const Size size = size_of(node);
      count(size, mark);
      anchors_[anchor] = {node, size};
    }
    if (key_is_next()) return take_key(node, line_of(mark));
    refuse_control(node.text, node.line);
    if (open_.empty()) {
      root = std::move(node);
    } else if (Open& in = open_.back(); in.node.is(Node::Kind::sequence)) {
      in.node.items.push_back(std::move(node));
    } else {
      if (!in.dropped) in.node.entries.push_back({in.key, in.key_line, std::move(node)});
      in.has_key = false;
    }
  }

  void take_key(const Node& key, int line) {
    Open& map = open_.back();
    map.key = key.text;
    map.key_line = line;
    map.has_key = map.dropped = true;
    if (!key.is(Node::Kind::scalar))
      return report_.add({file_->name, line}, graph_messages::key_not_scalar());
    refuse_control(key.text, line);
    if (const auto [first, is_new] = map.lines.try_emplace(key.text, line); !is_new)
      return report_.add({file_->name, line}, graph_messages::key_repeated(key.text, first->second));
    map.dropped = false;
  }

  /// A control character could end a file name, or affect the terminal of a reader.
  void refuse_control(const std::string& text, int line) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (!is_control(text, i) || text[i] == '\r') continue;
      const int code = static_cast<unsigned char>(text[i]) == 0xc2 ? text[i + 1] & 0xff : text[i];
      return report_.add({file_->name, line}, graph_messages::control_character_found(code));
    }
  }

  const FilePtr& file_;
  Report& report_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchor> anchors_;
  std::size_t values_ = 0, text_ = 0;
  bool ended_ = false;
};

/// Replaces grammar terms of yaml-cpp by the probable fault.
std::string plain_words(const std::string& original) {
  static const std::vector<std::pair<std::string, std::string>> known = {
      {"end of map not found", "the indentation does not fit what stands above, or a ':' is missing"},
      {"end of sequence not found", "the indentation of a list does not fit what stands above"},
      {"end of map flow not found", "a '{' is not closed, or a ',' is missing"},
      {"end of sequence flow not found", "a '[' is not closed, or a ',' is missing"},
      {"illegal map value",
       "a ':' stands where none can: look at the indentation and at the line above; text that holds ': ' "
       "needs quotes"},
      {"illegal EOF in scalar", "a quote is not closed"},
      {"unknown token", "a character that cannot begin a value; put the text in quotes"},
      {"illegal block entry", "a '-' stands where no list can begin"},
      {"bad file", "nested too deep"},
  };
  for (const auto& [key, words] : known)
    if (original == key) return words;
  return original;
}

bool begins_with_tab(const std::string& text, int line) {
  std::size_t at = 0;
  for (int i = 0; i < line && at != std::string::npos; ++i) {
    at = text.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  const std::size_t first = at == std::string::npos ? at : text.find_first_not_of(' ', at);
  return first != std::string::npos && text[first] == '\t';
}

/// Optional ports are written {truth?: VehicleState}. YAML allows it, but yaml-cpp 0.7 rejects it inside
/// braces, so such keys are quoted first.
std::string quoted_optional_keys(const std::string& text) {
  std::string out;
  char quote =
      0;  // the open quote; it opens only where a value can begin, and closes at the latest with its line
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], before = i > 0 ? text[i - 1] : '\n';
    const bool begins = std::string_view(" \t\n{[,:").find(before) != std::string_view::npos;
    if (c == '\n')
      quote = 0;
    else if (quote == 0 && begins && (c == '"' || c == '\''))
      quote = c;
    else if (quote != 0 && c == quote && before != '\\')
      quote = 0;
    if (quote == 0 && begins && c == '#')
      while (i + 1 < text.size() && text[i + 1] != '\n') out += text[i++];
    std::size_t end = i;
    while (quote == 0 && begins && end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    if (end > i && end + 1 < text.size() && text[end] == '?' && text[end + 1] == ':') {
      out += '"' + text.substr(i, end + 1 - i) + '"';
      i = end;
    } else {
      out += text[i];
    }
  }
  return out;
}

/// An empty text gives a missing node.
Node first_document(const FilePtr& file, Report& report) {
  Builder builder(file, report);
  std::istringstream text(quoted_optional_keys(file->text));
  YAML::Parser parser(text);
  try {
    if (!parser.HandleNextDocument(builder))
      return Node{Node::Kind::null, false, file->path.empty() ? 0 : 1, file, {}, {}, {}};
    parser.HandleNextDocument(builder);
  } catch (const Builder::SecondDocument& second) {
    report.add({file->name, second.line}, graph_messages::document_repeated());
  } catch (const Builder::Refused& refused) {
    report.add({file->name, refused.line}, refused.message);
    return {};
  }
  return std::move(builder.root);
}

}  // namespace

Node parse_yaml(const FilePtr& file, Report& report) {
  report.opened(file->name);
  try {
    return first_document(file, report);
  } catch (const YAML::Exception& fault) {
    const bool placed = !fault.mark.is_null() && !file->path.empty();
    const bool tab = !fault.mark.is_null() && begins_with_tab(file->text, fault.mark.line);
    report.add({file->name, placed ? fault.mark.line + 1 : 0},
               graph_messages::yaml_invalid(tab ? "a tab indents this line; YAML wants spaces"
                                                : plain_words(fault.msg)));
  } catch (const std::bad_alloc&) {
    report.add({file->name, 0}, graph_messages::memory_exhausted());
  }
  return {};
}

}  // namespace fulmar::core
