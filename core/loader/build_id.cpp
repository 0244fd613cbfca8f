// SPDX-License-Identifier: BSD-3-Clause
// Reads ELF notes. Source: System V Application Binary Interface, chapter 5 "Note Section"; NT_GNU_BUILD_ID
// of <elf.h>.
#include "core/loader/build_id.hpp"

#include <elf.h>
#include <link.h>

#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/loader/elf.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

constexpr std::string_view note_owner("GNU\0", 4);

// Notes are padded to 4 bytes, whatever the word size: gcc and clang write the build id so.
std::uint64_t padded(std::uint32_t size) { return (std::uint64_t{size} + 3) & ~std::uint64_t{3}; }

}  // namespace

std::string build_id_in_notes(std::span<const std::byte> notes) {
  ElfW(Nhdr) note{};
  while (read_header(notes, 0, note)) {
    const std::uint64_t name = sizeof note, content = name + padded(note.n_namesz),
                        end = content + padded(note.n_descsz);
    if (content + note.n_descsz > notes.size()) return "";
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == note_owner.size() &&
        std::memcmp(notes.data() + name, note_owner.data(), 4) == 0)
      return hex_text(notes.subspan(static_cast<std::size_t>(content), note.n_descsz));
    if (end > notes.size()) return "";
    notes = notes.subspan(static_cast<std::size_t>(end));
  }
  return "";
}

std::string build_id(std::span<const std::byte> file) {
  ElfW(Ehdr) header{};
  if (!read_header(file, 0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 ||
      header.e_phentsize != sizeof(ElfW(Phdr)))
    return "";
  for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment{};
    if (!read_header(file, header.e_phoff + i * sizeof segment, segment)) return "";
    if (segment.p_type != PT_NOTE || segment.p_offset > file.size() ||
        file.size() - segment.p_offset < segment.p_filesz)
      continue;
    const std::string id = build_id_in_notes(
        file.subspan(static_cast<std::size_t>(segment.p_offset), static_cast<std::size_t>(segment.p_filesz)));
    if (!id.empty()) return id;
  }
  return "";
}

}  // namespace fulmar::core
