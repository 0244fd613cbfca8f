// SPDX-License-Identifier: BSD-3-Clause
// NPZ: arrays of NumPy in a zip file. Sources: NumPy's NEP 1 (format 1.0); PKWARE's APPNOTE 6.3, stored and
// deflated entries, no ZIP64.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace fulmar::core {

class NpzWriter {
 public:
  /// Throws Error when the file exists or cannot be written; the other functions throw for a failed write.
  /// The file is FILE.part until `finish`.
  explicit NpzWriter(const std::filesystem::path& file);
  /// `type` in NumPy's notation: "<f8", "|u1", "|b1".
  void add(const std::string& name, const std::string& type, std::size_t count,
           std::span<const std::byte> data);
  /// An array of text.
  void add(const std::string& name, const std::vector<std::string>& texts);
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint32_t crc = 0, stored = 0, size = 0, place = 0;
    std::uint16_t method = 0;
  };
  void entry(const std::string& name, const std::string& header, std::span<const std::byte> data);
  void write(const std::string& bytes);

  std::filesystem::path file_;
  std::ofstream out_;
  std::uint64_t place_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace fulmar::core
