// SPDX-License-Identifier: BSD-3-Clause
// See diff.hpp.
#include "tools/fulmar_log/diff.hpp"

#include <algorithm>

#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {
namespace {

using Named = std::map<std::string, std::string>;

Named metadata_of(const McapFile& log) {
  Named all;
  for (const McapFile::Metadata& m : log.metadata)
    for (const auto& [key, value] : m.pairs) all[m.name + ": " + key] = value;
  return all;
}

Named attachments_of(const McapFile& log) {
  Named all;
  for (const McapFile::Attachment& a : log.attachments) all[a.name] = a.content;
  return all;
}

std::size_t line_of_difference(const std::string& a, const std::string& b) {
  const auto [p, q] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return 1 + static_cast<std::size_t>(std::count(a.begin(), p, '\n'));
}

template <class Sentence>
std::vector<std::string> differences(const Named& a, const Named& b, Sentence sentence) {
  std::vector<std::string> list;
  for (const auto& [name, value] : a) {
    const auto other = b.find(name);
    if (other == b.end()) list.push_back(name + " is only in the first");
    if (other != b.end() && other->second != value) list.push_back(sentence(name, value, other->second));
  }
  for (const auto& [name, value] : b)
    if (!a.contains(name)) list.push_back(name + " is only in the second");
  return list;
}

}  // namespace

LogDiff diff_logs(const std::filesystem::path& a, const std::filesystem::path& b,
                  const DiffOptions& options) {
  LogDiff diff{diff_messages(a, b, options), {}, {}};
  diff.metadata = differences(metadata_of(diff.log_a), metadata_of(diff.log_b),
                              [](const std::string& name, const std::string& x, const std::string& y) {
                                return name + " is " + x + " and " + y;
                              });
  diff.attachments =
      differences(attachments_of(diff.log_a), attachments_of(diff.log_b),
                  [](const std::string& name, const std::string& x, const std::string& y) {
                    return log_tool_messages::attachment_differs(name, line_of_difference(x, y)).line();
                  });
  return diff;
}

}  // namespace fulmar::core
