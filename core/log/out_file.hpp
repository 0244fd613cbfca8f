// SPDX-License-Identifier: BSD-3-Clause
// A file that grows by whole blocks under the name FILE.part and is FILE when it is finished. Counts, CRC-32
// and SHA-256 run along.
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
  /// Throws Error when FILE or FILE.part is there already, or cannot be made. `held`: this process holds the
  /// name.
  explicit OutFile(const std::filesystem::path& file, bool held = false);
  /// Makes FILE.part, empty, so that nobody else takes the name; false when it is taken. Throws Error when it
  /// cannot be made.
  static bool hold(const std::filesystem::path& file);
  /// Gives a name back that was held and into which nothing has been written.
  static void let_go(const std::filesystem::path& file);
  /// Throws Error when FILE or FILE.part is there already.
  static void refuse(const std::filesystem::path& file);
  /// Whether a program is writing this file.
  static bool grows(const std::filesystem::path& file);
  ~OutFile();
  OutFile(const OutFile&) = delete;
  OutFile& operator=(const OutFile&) = delete;

  /// All of the block is in the file, or none of it: then false, and `error` says why.
  bool append(const void* block, std::size_t size);
  bool sync();
  /// Closes and gives the file its name, unless another has come to bear it.
  bool finish();

  std::uint64_t size() const { return size_; }
  std::uint32_t crc() const { return crc_; }
  std::string sha256() { return sha_.hex(); }
  const std::string& error() const { return error_; }
  /// As it is called now: FILE.part, FILE, or what somebody was seen to have made of it; empty: it is
  /// removed.
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
