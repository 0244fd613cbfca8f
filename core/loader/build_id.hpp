// SPDX-License-Identifier: BSD-3-Clause
// The build id that the linker writes into a program or library: what a debugger and a crash report know a
// build by.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace fulmar::core {

/// Of an ELF file for this machine, in hex. "" when it has none, or when the bytes are no such file.
std::string build_id(std::span<const std::byte> file);

/// Of notes as they lie in a file or in memory. "" when there is none among them.
std::string build_id_in_notes(std::span<const std::byte> notes);

}  // namespace fulmar::core
