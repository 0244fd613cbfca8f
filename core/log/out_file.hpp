// SPDX-License-Identifier: BSD-3-Clause
// A file that grows by whole blocks under the name FILE.part and is renamed to FILE when it is complete.
// Counts, CRC-32 and SHA-256 are updated with each block.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "core/types/sha256.hpp"
#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

class OutFile {
 public:
  /// Throws Error when FILE or FILE.part exists, or cannot be made. `held`: this process has reserved the
  /// name.
  explicit OutFile(const std::filesystem::path& file, bool held = false);
  /// Makes an empty FILE.part to reserve the name; returns false when the name is taken. Throws Error when
  /// the file cannot be made.
  static bool hold(const std::filesystem::path& file);
  /// Releases a reserved name whose file is still empty.
  static void let_go(const std::filesystem::path& file);
  /// Throws Error when FILE or FILE.part exists.
  static void refuse(const std::filesystem::path& file);
  /// Whether a program is writing this file.
  static bool grows(const std::filesystem::path& file);
  ~OutFile();
  OutFile(const OutFile&) = delete;
  OutFile& operator=(const OutFile&) = delete;

  /// Writes the whole block. On a fault it writes nothing of it, returns false and sets `error`.
  bool append(const void* block, std::size_t size);
  bool sync();
  /// Closes the file and renames it to FILE, unless another file has taken that name.
  bool finish();

  std::uint64_t size() const { return size_; }
  std::uint32_t crc() const { return crc_; }
  std::string sha256() { return sha_.hex(); }
  const std::string& error() const { return error_; }
  /// Current name: FILE.part, FILE, or the name after an observed rename; empty: it is removed.
  const std::filesystem::path& name() const { return name_; }
  void fail(const Diagnostic& why);

 private:
  bool failed(const char* what);  // notes errno
  bool still_there();
  void note_move();
  std::filesystem::path file_, name_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
  Sha256 sha_;
  std::string error_;
};

}  // namespace fulmar::core
