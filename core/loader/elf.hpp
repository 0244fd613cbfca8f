// SPDX-License-Identifier: BSD-3-Clause
// Checks the header of an ELF file, for a clear message before the system's loader reads the file. Executes
// nothing.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace fulmar::core {

/// Reason why `bytes` cannot be a plugin of this host: "is not a plugin: not an ELF shared object". "" when
/// there is none.
std::string elf_fault(std::span<const std::byte> bytes);

/// "x86_64", "aarch64", ... of an ELF machine number (System V ABI, e_machine).
std::string machine_name(unsigned machine);

/// Copies a header out of a file. Returns false when the file is too short.
template <class T>
bool read_header(std::span<const std::byte> file, std::uint64_t offset, T& out) {
  if (offset > file.size() || file.size() - offset < sizeof out) return false;
  std::memcpy(&out, file.data() + offset, sizeof out);
  return true;
}

}  // namespace fulmar::core
