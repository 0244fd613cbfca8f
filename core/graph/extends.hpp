// SPDX-License-Identifier: BSD-3-Clause
// A mission's layers: a file, the file that it extends, and so on, laid over each other.
#pragma once
#include <vector>

#include "core/graph/yaml.hpp"

namespace fulmar::core {

/// The tree of `file` over that of the file it extends, to any depth. Every file that was read is added to
/// `files`, the top one excepted. A layer that cannot be read is the only fault that is worth telling: the
/// report then holds it, and the tree is missing. `below`: what each lower layer says with those under it,
/// the lowest first.
Node layered_tree(const FilePtr& file, const StoredFiles* stored, std::vector<FilePtr>& files,
                  std::vector<Node>& below, Report& report);

}  // namespace fulmar::core
