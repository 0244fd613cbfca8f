// SPDX-License-Identifier: BSD-3-Clause
// Content of a file: the requested columns, row by row.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "messages.hpp"

namespace fulmar::sensor_log {

/// A requested column. Stamps are whole nanoseconds: a double has steps of 256 ns for times since 1970.
struct Wanted {
  std::string name;
  std::string use;           ///< key of the description that names it, for messages
  std::int64_t unit_ns = 0;  ///< unit of a stamp; 0: a number
};

struct Column {
  std::vector<double> numbers;
  std::vector<std::int64_t> stamps_ns;
};

struct Table {
  std::vector<Column> columns;     ///< in the order of the request
  std::vector<std::size_t> lines;  ///< position of each row for messages: a line, or the number of a message
  std::size_t cut_at = 0;          ///< byte at which a record is cut off; 0: complete
  std::size_t rows() const { return lines.size(); }
};

/// `key`: key of the description. It begins with the name of the parameter, so that the host finds file and
/// line.
[[noreturn]] inline void refuse(const std::string& key, const Diagnostic& message) {
  throw std::runtime_error(located(key, message).line());
}

inline std::string all_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// `place`: place of the column names.
[[noreturn]] inline void refuse_column(const Wanted& wanted, const std::string& place,
                                       const std::vector<std::string>& there) {
  refuse(wanted.use, sensor_log_messages::column_unknown(wanted.name, place, all_of(there)));
}

/// A file, and the key of the description that names it.
struct File {
  std::string path, key;
  std::string_view bytes;
};

/// Value for an invalid stamp.
inline constexpr std::int64_t no_stamp = std::numeric_limits<std::int64_t>::min();
/// Limit of a valid stamp, 95 years: neither a shift nor a difference of two stamps overflows.
inline constexpr std::int64_t last_stamp_ns = 3'000'000'000'000'000'000;

inline std::int64_t stamp_or_none(std::int64_t ns) {
  return ns > last_stamp_ns || ns < -last_stamp_ns ? no_stamp : ns;
}

/// Type and columns of a topic of a bag or a ULog.
struct Topic {
  std::string type;
  std::vector<std::string> columns;
  bool has(std::string_view name) const {
    for (const std::string& each : columns)
      if (each == name) return true;
    return false;
  }
};

/// Appends one number of a row, of any type in the file.
inline void put(Column& column, const Wanted& wanted, std::int64_t whole) {
  if (wanted.unit_ns == 0) return column.numbers.push_back(static_cast<double>(whole));
  const std::int64_t most = last_stamp_ns / wanted.unit_ns;
  column.stamps_ns.push_back(whole > most || whole < -most ? no_stamp : whole * wanted.unit_ns);
}
inline void put(Column& column, const Wanted& wanted, double number) {
  if (wanted.unit_ns == 0) return column.numbers.push_back(number);
  const double ns = number * static_cast<double>(wanted.unit_ns);
  column.stamps_ns.push_back(std::abs(ns) <= 3e18 ? std::llround(ns) : no_stamp);
}

}  // namespace fulmar::sensor_log
