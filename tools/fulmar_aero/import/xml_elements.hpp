// SPDX-License-Identifier: BSD-3-Clause
// Elements, attributes, text and comments: the parts of XML that aircraft files use.
#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tools/fulmar_aero/import/lines.hpp"
#include "tools/fulmar_aero/import/messages.hpp"

namespace fulmar::aero::imports {

struct Element {
  std::string name, attributes, text;
  std::vector<Element> children;
  std::size_t line = 0;

  const Element* child(const std::string& wanted) const {
    for (const Element& one : children)
      if (one.name == wanted) return &one;
    return nullptr;
  }
  std::string attribute(const std::string& key) const {
    const std::size_t at = attributes.find(key + "=");
    if (at == std::string::npos || at + key.size() + 2 > attributes.size()) return "";
    const char quote = attributes[at + key.size() + 1];
    const std::size_t begin = at + key.size() + 2, end = attributes.find(quote, begin);
    return end == std::string::npos ? "" : attributes.substr(begin, end - begin);
  }
};

inline const Element& needed_child(const Lines& lines, const Element& parent, const std::string& name) {
  if (const Element* const found = parent.child(name)) return *found;
  refuse(lines.where(parent.line), aero_messages::child_element_missing(parent.name, name));
}

class XmlReader {
 public:
  explicit XmlReader(const Lines& lines) : lines_(lines), text_(lines.text) {}

  Element root() {
    Element top;
    read_into(top, 0);
    if (top.children.empty()) refuse(lines_.where(0), "expected <fdm_config>");
    return top.children[0];
  }

 private:
  std::size_t line() const {
    return std::size_t(
        std::count(text_.begin(), text_.begin() + std::ptrdiff_t(std::min(at_, text_.size())), '\n'));
  }

  void read_into(Element& parent, int depth) {
    if (depth > 50) refuse(lines_.where(line()), aero_messages::element_nesting_excessive());
    while (true) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string::npos) {
        if (!parent.name.empty())
          refuse(lines_.where(parent.line), aero_messages::element_not_closed(parent.name));
        return;
      }
      parent.text += text_.substr(at_, open - at_);
      at_ = open;
      if (skipped("<!--", "-->") || skipped("<?", "?>") || skipped("<!", ">")) continue;
      const std::size_t close = text_.find('>', open);
      if (close == std::string::npos) refuse(lines_.where(line()), aero_messages::tag_not_closed());
      std::string tag = text_.substr(open + 1, close - open - 1);
      const std::size_t here = line();
      at_ = close + 1;
      if (!tag.empty() && tag[0] == '/') {
        if (trimmed(tag.substr(1)) != parent.name)
          refuse(lines_.where(here), "expected </" + parent.name + ">; found <" + tag + ">");
        return;
      }
      const bool empty = !tag.empty() && tag.back() == '/';
      if (empty) tag.pop_back();
      Element child;
      child.line = here;
      const std::size_t blank = tag.find_first_of(" \t\r\n");
      child.name = tag.substr(0, blank);
      if (blank != std::string::npos) child.attributes = tag.substr(blank);
      if (!empty) read_into(child, depth + 1);
      parent.children.push_back(std::move(child));
    }
  }
  bool skipped(const char* begin, const char* end) {
    if (text_.compare(at_, std::string(begin).size(), begin) != 0) return false;
    const std::size_t stop = text_.find(end, at_);
    if (stop == std::string::npos) refuse(lines_.where(line()), aero_messages::markup_not_closed(begin));
    at_ = stop + std::string(end).size();
    return true;
  }

  const Lines& lines_;
  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace fulmar::aero::imports
