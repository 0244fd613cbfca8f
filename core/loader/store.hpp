// SPDX-License-Identifier: BSD-3-Clause
// The private, content-addressed copies that plugins are loaded from: rebuilding a file in flight changes nothing that is mapped.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace fulmar::core {

/// Puts `bytes`, whose SHA-256 is `sha256`, into the store and returns the copy's path. A copy that is there already is verified.
/// The store is ${FULMAR_STORE}, else ${XDG_CACHE_HOME:-$HOME/.cache}/fulmar/plugins, else a temporary folder of this process.
/// Throws Error when others may write to the store or it cannot be written.
std::filesystem::path keep_copy(std::span<const std::byte> bytes, const std::string& sha256);

}  // namespace fulmar::core
