// SPDX-License-Identifier: BSD-3-Clause
// The private, content-addressed copies that plugins are loaded from: rebuilding a file in flight changes
// nothing that is mapped.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace fulmar::core {

/// Puts `bytes`, whose SHA-256 is `sha256`, into the store and returns the copy's path. A copy that is there
/// already is verified. `suffix` is that of the file: ".so" of a library, ".py" of a script. The store is
/// ${FULMAR_STORE}, else ${XDG_CACHE_HOME:-$HOME/.cache}/fulmar/plugins, else a temporary folder of this
/// process. It holds the 128 copies that were used last. Throws Error when others may write to the store or
/// it cannot be written.
std::filesystem::path keep_copy(std::span<const std::byte> bytes, const std::string& sha256,
                                const std::string& suffix = ".so");

/// The copy that has this SHA-256, its content verified: what flew once can fly again. Nothing when there is
/// none, or it was damaged. Throws Error when others may write to the store.
std::optional<std::filesystem::path> find_in_store(const std::string& sha256);

/// The copy of a plugin that a log names. Throws Error, naming the version that is missing.
std::filesystem::path version_that_flew(const std::string& file, const std::string& version,
                                        const std::string& sha256);

}  // namespace fulmar::core
