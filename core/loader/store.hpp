// SPDX-License-Identifier: BSD-3-Clause
// Private, content-addressed copies from which plugins are loaded: a rebuild of a file in flight changes no
// mapped memory.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace fulmar::core {

/// Puts `bytes`, whose SHA-256 is `sha256`, into the store and returns the copy's path. Verifies a copy that
/// exists. `suffix` is that of the file: ".so" of a library, ".py" of a script. The store is ${FULMAR_STORE},
/// else ${XDG_CACHE_HOME:-$HOME/.cache}/fulmar/plugins, else a temporary folder of this process. It holds the
/// 128 most recently used copies. Throws Error when other users may write to the store or it cannot be
/// written.
std::filesystem::path keep_copy(std::span<const std::byte> bytes, const std::string& sha256,
                                const std::string& suffix = ".so");

/// The verified copy with this SHA-256, so that a flown version can fly again. Nothing when it is missing or
/// damaged. Throws Error when other users may write to the store.
std::optional<std::filesystem::path> find_in_store(const std::string& sha256);

/// The copy of a plugin that a log names. Throws Error, naming the missing version.
std::filesystem::path version_that_flew(const std::string& file, const std::string& version,
                                        const std::string& sha256);

}  // namespace fulmar::core
