// SPDX-License-Identifier: BSD-3-Clause
// Reads the dynamic symbols. Source: System V Application Binary Interface, chapter 4 "Symbol Table";
// STB_GNU_UNIQUE of <elf.h>.
#include "core/loader/unique.hpp"

#include <elf.h>
#include <link.h>

#include <cstring>
#include <string_view>

#include "core/loader/elf.hpp"

namespace fulmar::core {
namespace {

/// Whether a mangled name is in std or __gnu_cxx, or is a static in one of their functions.
bool of_standard_library(std::string_view name) {
  if (!name.starts_with("_Z")) return false;
  name.remove_prefix(2);
  name.remove_prefix(std::min(name.find_first_not_of("GVZNKTI"), name.size()));
  return name.starts_with('S') || name.starts_with("9__gnu_cxx");
}

std::string text_at(std::span<const std::byte> file, std::uint64_t at) {
  if (at >= file.size()) return "";
  const char* const text = reinterpret_cast<const char*>(file.data() + at);
  return {text, strnlen(text, file.size() - at)};
}

/// Section `i`; false when it does not exist.
bool section(std::span<const std::byte> file, const ElfW(Ehdr) & header, std::uint64_t i, ElfW(Shdr) & out) {
  return i < header.e_shnum && read_header(file, header.e_shoff + i * sizeof out, out);
}

}  // namespace

std::vector<std::string> unique_symbols(std::span<const std::byte> file) {
  std::vector<std::string> names;
  ElfW(Ehdr) header{};
  if (!read_header(file, 0, header) || header.e_shentsize != sizeof(ElfW(Shdr))) return names;
  ElfW(Shdr) symbols{}, texts{};
  for (std::uint64_t i = 0; section(file, header, i, symbols); ++i) {
    if (symbols.sh_type != SHT_DYNSYM || !section(file, header, symbols.sh_link, texts)) continue;
    ElfW(Sym) symbol{};
    for (std::uint64_t at = 0; at + sizeof symbol <= symbols.sh_size; at += sizeof symbol) {
      if (!read_header(file, symbols.sh_offset + at, symbol)) return names;
      if (ELF64_ST_BIND(symbol.st_info) != STB_GNU_UNIQUE || symbol.st_shndx == SHN_UNDEF) continue;
      std::string name = text_at(file, std::uint64_t{texts.sh_offset} + symbol.st_name);
      if (!of_standard_library(name)) names.push_back(std::move(name));
    }
  }
  return names;
}

}  // namespace fulmar::core
