// SPDX-License-Identifier: BSD-3-Clause
// ELF header checks. Source: System V Application Binary Interface, chapter 4 "Object Files"; elf(5).
#include "core/loader/elf.hpp"

#include <link.h>

#include <algorithm>
#include <array>

#include "core/loader/messages.hpp"

// Target of this program: its own ELF header in memory, at the linker's symbol.
extern "C" const ElfW(Ehdr) __ehdr_start __attribute__((visibility("hidden")));  // NOLINT

namespace fulmar::core {
namespace {

// File length that the headers need, or 0 when the program headers are outside the file.
std::uint64_t promised_bytes(std::span<const std::byte> bytes) {
  ElfW(Ehdr) header{};
  if (!read_header(bytes, 0, header) || header.e_phentsize != sizeof(ElfW(Phdr)) || header.e_phnum == 0)
    return 0;
  if (header.e_shoff > UINT64_MAX / 2) return 0;
  // the section headers usually come last: an incomplete copy lacks them
  std::uint64_t end = header.e_shoff + std::uint64_t{header.e_shnum} * header.e_shentsize;
  for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment{};
    if (!read_header(bytes, header.e_phoff + i * sizeof segment, segment)) return 0;
    if (segment.p_type != PT_LOAD) continue;
    if (segment.p_offset > UINT64_MAX / 2 || segment.p_filesz > UINT64_MAX / 2) return 0;
    end = std::max<std::uint64_t>(end, std::uint64_t{segment.p_offset} + segment.p_filesz);
  }
  return end;
}

}  // namespace

std::string machine_name(unsigned machine) {
  switch (machine) {
    case EM_X86_64: return "x86_64";
    case EM_386: return "i386";
    case EM_AARCH64: return "aarch64";
    case EM_ARM: return "arm";
    case EM_RISCV: return "riscv";
    case EM_PPC64: return "ppc64";
    case EM_S390: return "s390";
    case EM_MIPS: return "mips";
    default: return "machine " + std::to_string(machine);
  }
}

std::string elf_fault(std::span<const std::byte> bytes) {
  struct {
    std::array<unsigned char, EI_NIDENT> ident;
    std::uint16_t type, machine;
  } start{};
  if (bytes.size() < SELFMAG || std::memcmp(bytes.data(), ELFMAG, SELFMAG) != 0)
    return loader_messages::elf_missing().line();
  if (!read_header(bytes, 0, start)) return loader_messages::elf_header_truncated().line();
  if (start.ident[EI_DATA] != __ehdr_start.e_ident[EI_DATA])
    start.machine =
        static_cast<std::uint16_t>(static_cast<unsigned>(start.machine) << 8 | start.machine >> 8);
  if (start.machine != __ehdr_start.e_machine)
    return loader_messages::machine_differs(machine_name(start.machine), machine_name(__ehdr_start.e_machine))
        .line();
  if (start.ident[EI_DATA] != __ehdr_start.e_ident[EI_DATA] ||
      start.ident[EI_CLASS] != __ehdr_start.e_ident[EI_CLASS])
    return loader_messages::word_size_differs().line();
  if (start.type != ET_DYN) return loader_messages::elf_not_shared().line();
  const std::uint64_t needed = promised_bytes(bytes);
  if (needed == 0) return loader_messages::program_headers_damaged().line();
  if (needed > bytes.size()) return loader_messages::plugin_truncated(needed, bytes.size()).line();
  return "";
}

}  // namespace fulmar::core
