// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>

#include "core/error.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {

MemoryFile::MemoryFile(const std::string& text) : file_(::memfd_create("text", MFD_CLOEXEC)) {
  std::size_t written = 0;
  while (file_ >= 0 && written < text.size()) {
    const ssize_t n = ::write(file_, text.data() + written, text.size() - written);
    if (n <= 0) break;
    written += static_cast<std::size_t>(n);
  }
  if (file_ >= 0 && written == text.size() && ::lseek(file_, 0, SEEK_SET) == 0) return;
  if (file_ >= 0) ::close(file_);
  throw Error(loader_messages::text_memory_exhausted(text.size()));
}

MemoryFile::~MemoryFile() { ::close(file_); }

std::string MemoryFile::contents() const {
  std::string text;
  std::array<char, 4096> piece;
  for (ssize_t n = 0; (n = ::pread(file_, piece.data(), piece.size(), static_cast<off_t>(text.size()))) > 0;)
    text.append(piece.data(), static_cast<std::size_t>(n));
  return text;
}

}  // namespace fulmar::core
