// SPDX-License-Identifier: BSD-3-Clause
// CSV text: a line of names, then a line per row. Lines that begin with # and empty ones are ignored.
#pragma once
#include <algorithm>
#include <charconv>
#include <string_view>

#include "table.hpp"

namespace fulmar::sensor_log {

inline std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// "1384992000.25" in units of `unit_ns`, without the rounding of a double; no_stamp for any other text.
inline std::int64_t stamp_of(std::string_view text, std::int64_t unit_ns) {
  const std::size_t dot = std::min(text.find('.'), text.size());
  const bool negative = !text.empty() && text.front() == '-';
  std::int64_t whole = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + dot, whole);
  if (code != std::errc{} || end != text.data() + dot) return no_stamp;
  const std::int64_t most = last_stamp_ns / unit_ns;
  if (whole > most || whole < -most) return no_stamp;
  std::int64_t part = 0, digit_ns = unit_ns;
  for (std::size_t i = dot + 1; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9') return no_stamp;
    digit_ns /= 10;
    part += (text[i] - '0') * digit_ns;
  }
  return stamp_or_none(whole * unit_ns + (negative ? -part : part));
}

class Csv {
 public:
  Csv(const File& file, const std::vector<Wanted>& wanted)
      : path_(file.path), key_(file.key), bytes_(file.bytes), wanted_(wanted) {}

  Table read() {
    std::string_view bytes = bytes_;
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    table_.columns.resize(wanted_.size());
    const bool cut = !bytes.empty() && bytes.back() != '\n';
    while (!bytes.empty()) {
      const std::size_t end = std::min(bytes.find('\n'), bytes.size());
      const std::string_view text = trimmed(bytes.substr(0, end));
      bytes.remove_prefix(std::min(end + 1, bytes.size()));
      ++line_;
      if (text.empty() || text.front() == '#') continue;
      if (names_.empty())
        head(text);
      else
        row(text);
    }
    if (names_.empty()) refuse(key_, sensor_log_messages::file_empty(path_));
    // a number that is cut off is also a number
    if (cut) refuse(key_, sensor_log_messages::last_line_cut(place()));
    return std::move(table_);
  }

 private:
  std::string place() const { return path_ + ":" + std::to_string(line_); }

  const std::vector<std::string_view>& cells_of(std::string_view line) {
    cells_.clear();
    for (std::size_t from = 0; from <= line.size();) {
      const std::size_t comma = std::min(line.find(',', from), line.size());
      cells_.push_back(trimmed(line.substr(from, comma - from)));
      from = comma + 1;
    }
    return cells_;
  }

  void head(std::string_view text) {
    for (const std::string_view name : cells_of(text)) names_.emplace_back(name);
    for (const Wanted& each : wanted_) {
      const auto at = std::find(names_.begin(), names_.end(), each.name);
      if (at == names_.end()) refuse_column(each, place(), names_);
      if (std::find(at + 1, names_.end(), each.name) != names_.end())
        refuse(each.use, sensor_log_messages::column_repeated(place(), each.name));
      place_of_.push_back(static_cast<std::size_t>(at - names_.begin()));
    }
  }

  void row(std::string_view text) {
    const std::vector<std::string_view>& cells = cells_of(text);
    if (cells.size() != names_.size())
      refuse(key_, cells.size() == 1 ? sensor_log_messages::row_of_one_cell(place(), names_.size())
                   : cells.size() < names_.size()
                       ? sensor_log_messages::row_cut(place(), cells.size(), names_.size())
                       : sensor_log_messages::row_too_long(place(), cells.size(), names_.size()));
    for (std::size_t i = 0; i < wanted_.size(); ++i) cell(cells[place_of_[i]], i);
    table_.lines.push_back(line_);
  }

  void cell(std::string_view text, std::size_t i) {
    const Wanted& wanted = wanted_[i];
    Column& column = table_.columns[i];
    if (wanted.unit_ns != 0)
      if (const std::int64_t stamp = stamp_of(text, wanted.unit_ns); stamp != no_stamp)
        return column.stamps_ns.push_back(stamp);
    double number = std::numeric_limits<double>::quiet_NaN();  // value of an empty cell
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool whole = end == text.data() + text.size();
    if (whole && code == std::errc::result_out_of_range)
      number = text.find_first_of("eE") != text.npos && text.find("-", 1) != text.npos ? 0 : infinity;
    else if (!text.empty() && (code != std::errc{} || !whole))
      refuse(wanted.use, sensor_log_messages::number_not_valid(place(), text.substr(0, 40), wanted.name));
    put(column, wanted, number);
  }

  std::string path_, key_;
  std::string_view bytes_;
  const std::vector<Wanted>& wanted_;
  std::vector<std::string> names_;
  std::vector<std::string_view> cells_;
  std::vector<std::size_t> place_of_;
  std::size_t line_ = 0;
  Table table_;
};

}  // namespace fulmar::sensor_log
