// SPDX-License-Identifier: BSD-3-Clause
// The build id that the linker writes into a program or library; debuggers and crash reports identify a build
// by it.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace fulmar::core {

/// Build id of an ELF file for this machine, in hex. "" when it has none, or when the bytes are no such file.
std::string build_id(std::span<const std::byte> file);

/// Build id from ELF notes, as they lie in a file or in memory. "" without one.
std::string build_id_in_notes(std::span<const std::byte> notes);

}  // namespace fulmar::core
