// SPDX-License-Identifier: BSD-3-Clause
// Text files of other tools, line by line, and numbers in them.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/fulmar_aero/import/analysis.hpp"

namespace fulmar::aero::imports {

/// A file's lines without their ends: LF, CRLF, a byte order mark and any 8-bit encoding are read.
struct Lines {
  std::string file;  ///< as given
  std::string text;
  std::vector<std::string> all;

  std::string place(std::size_t line, const std::string& what = "") const;  ///< "a.st:40 CLa"
  core::Where where(std::size_t line) const { return {file, int(line) + 1}; }
  /// The first line from `from` on that holds the text.
  std::optional<std::size_t> find(const std::string& text, std::size_t from = 0) const;
  bool has(const std::string& what) const { return text.find(what) != std::string::npos; }
};

/// Throws core::Error for a file that cannot be read, a folder, an empty file, UTF-16 or bytes that are no
/// text.
Lines read_lines(const std::string& file);
Lines lines_of(const std::string& file, const std::string& text);

[[noreturn]] void refuse(const core::Where& where, const Diagnostic& sentence);

/// The number at `at` (blanks before it are skipped), and its end. Throws core::Error for another text, a
/// value that is not finite, or a decimal comma.
double number_at(const Lines& lines, std::size_t line, std::size_t at, const std::string& what,
                 std::size_t* end = nullptr);
/// All numbers of a line from `at` on, up to another text. Numbers may touch: "-1.5-2.5".
std::vector<double> numbers_at(const Lines& lines, std::size_t line, std::size_t at);

/// "key = number" pairs of the tables of Fortran and Qt: a key ends at "=", with or without a blank.
struct Pair {
  double value = 0;
  std::size_t line = 0;
  std::string unit;  ///< the word behind the number
};
class Pairs {
 public:
  /// Of lines first..last-1; `writer` is the program that wrote the file.
  Pairs(const Lines& lines, std::size_t first, std::size_t last, const char* writer);
  bool has(const std::string& key) const { return all_.count(key) > 0; }
  /// Throws core::Error with the line at which the search ended.
  Value value(const std::string& key, double factor = 1) const;
  const Pair& pair(const std::string& key) const;

 private:
  const Lines& lines_;
  std::size_t last_;
  const char* writer_;
  std::map<std::string, Pair> all_;
};

/// Converts to SI; no value for an unknown unit. The exponent of an area or an inertia may be any byte: files
/// have several encodings.
std::optional<double> length_unit(const std::string& unit);  ///< "mm"
std::optional<double> area_unit(const std::string& unit);
std::optional<double> mass_unit(const std::string& unit);
std::optional<double> inertia_unit(const std::string& unit);  ///< "kg.m", "slug-ft^2"

std::vector<std::string> words_of(const std::string& line);
std::vector<std::string> cells_of(const std::string& line);  ///< between commas, trimmed
std::string trimmed(const std::string& text);
std::string lower(std::string text);
bool begins(const std::string& text, const std::string& with);

}  // namespace fulmar::aero::imports
