// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/flown_plugins.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/types/named.hpp"
#include "tools/fulmar_replay/messages.hpp"

namespace fulmar::core {

std::vector<FlownPlugin> flown_plugins(const McapFile& log) {
  const McapFile::Metadata* const metadata = find_named(log.metadata, "plugins");
  if (!metadata) throw Error(replay_messages::plugins_not_recorded());
  std::vector<FlownPlugin> list;
  for (const auto& [key, value] : metadata->pairs) {
    const std::size_t dot = key.rfind('.');
    const std::string component = key.substr(0, dot),
                      field = dot == std::string::npos ? "" : key.substr(dot + 1);
    auto flown = std::find_if(list.begin(), list.end(),
                              [&](const FlownPlugin& f) { return f.component == component; });
    if (flown == list.end()) flown = list.insert(list.end(), {component, "", "", ""});
    if (field == "file") flown->file = value;
    if (field == "version") flown->version = value;
    if (field == "sha256") flown->sha256 = value;
  }
  for (const FlownPlugin& f : list)
    if (f.file.empty() || f.sha256.empty()) throw Error(replay_messages::plugin_not_recorded(f.component));
  return list;
}

}  // namespace fulmar::core
