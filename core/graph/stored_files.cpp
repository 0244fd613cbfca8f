// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/stored_files.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/graph/messages.hpp"

namespace fulmar::core {

FilePtr StoredFiles::read(const std::filesystem::path& path, const std::string& name) const {
  const std::filesystem::path key = path.lexically_normal();
  auto at = known_.find(key);
  for (std::size_t i = 0; at == known_.end() && i < files_.size(); ++i) {
    const bool taken =
        std::any_of(known_.begin(), known_.end(), [&](const auto& known) { return known.second == i; });
    if (!taken && std::filesystem::path(files_[i].first).filename() == key.filename())
      at = known_.emplace(key, i).first;
  }
  if (at == known_.end()) throw Error(graph_messages::stored_file_missing(name));
  return std::make_shared<SourceFile>(SourceFile{path, name, files_[at->second].second});
}

}  // namespace fulmar::core
