// SPDX-License-Identifier: BSD-3-Clause
// Layers of a mission: a file, the file that it extends, and so on, merged.
#pragma once
#include <vector>

#include "core/graph/yaml.hpp"

namespace fulmar::core {

/// Merges the tree of `file` over that of the file it extends, to any depth. Adds every file that was read to
/// `files`, except the top one. When a layer cannot be read, the report holds that single fault, and the tree
/// is missing. `below`: each lower layer merged with those under it, the lowest first.
Node layered_tree(const FilePtr& file, const StoredFiles* stored, std::vector<FilePtr>& files,
                  std::vector<Node>& below, Report& report);

}  // namespace fulmar::core
