// SPDX-License-Identifier: BSD-3-Clause
// MAT files of level 5, which MATLAB, Octave and SciPy read. Source: "MAT-File Format", The MathWorks.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/types/kinds.hpp"

namespace fulmar::core {

/// A value in the bytes of the format.
class MatValue {
 public:
  /// A column of numbers.
  static MatValue numbers(fulmar_kind kind, std::size_t count, std::span<const std::byte> data);
  /// A column of cells, each a text.
  static MatValue texts(const std::vector<std::string>& texts);
  /// A struct of 1 x 1. Names are cut to 63 letters, digits and underscores, and made unique.
  static MatValue structure(const std::vector<std::pair<std::string, MatValue>>& fields);

 private:
  friend class MatWriter;
  std::string flags_dims_;  // before the name
  std::string body_;        // after the name
  std::string named(const std::string& name) const;
};

class MatWriter {
 public:
  /// Throws Error when the file exists or cannot be written; the other functions throw for a failed write.
  /// The file is FILE.part until `finish`.
  explicit MatWriter(const std::filesystem::path& file);
  void add(const std::string& name, const MatValue& value);
  void finish();

 private:
  std::filesystem::path file_;
  std::ofstream out_;
};

/// Letters, digits and underscores, the first one a letter, at most 63.
std::string mat_name(const std::string& name);

}  // namespace fulmar::core
