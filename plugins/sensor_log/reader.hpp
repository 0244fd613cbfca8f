// SPDX-License-Identifier: BSD-3-Clause
// The valid rows of one sensor, in the order of their arrival.
#pragma once
#include <array>

#include "files.hpp"
#include "order.hpp"
#include "sane.hpp"

namespace fulmar::sensor_log {

/// Numbers of skipped rows.
struct LeftOut {
  std::uint64_t not_finite = 0;    ///< a cell is empty, NaN or infinite
  std::uint64_t out_of_range = 0;  ///< values that are impossible on Earth
  std::uint64_t out_of_order = 0;  ///< stamps not after the previous ones
  std::size_t first_line = 0;
  std::uint64_t all() const { return not_finite + out_of_range + out_of_order; }
};

template <class M>
struct Series {
  std::vector<std::int64_t> at_ns;  ///< time of arrival by the clock of the file, strictly increasing
  std::vector<M> samples;
  std::int64_t delay_ns = 0;
  std::string key, path;
  std::size_t last_line = 0;
  std::size_t cut_at = 0;  ///< byte at which the file is cut off; 0: complete
  const char* line_word = "line";
  LeftOut left_out;
};

inline std::int64_t unit_ns(TimeUnit unit) {
  constexpr std::array<std::int64_t, 4> all = {1'000'000'000, 1'000'000, 1'000, 1};
  return all[static_cast<std::size_t>(unit)];
}
inline std::int64_t ns_of(double s) { return std::llround(1e9 * s); }

/// The columns of one sensor: first that of the time, then the sensor's own.
class Reader {
 public:
  Reader(const Source& from, Files& files, const std::string& key)
      : from_(from), files_(files), path_(files.path(from)), key_(key) {
    want(from.time, "from.time", unit_ns(from.unit));
    if (!from.changes.view().empty()) changes_ = want(from.changes, "from.changes");
  }

  /// Index of the column in a row.
  std::size_t want(const Name& column, const std::string& use, std::int64_t unit = 0) {
    if (column.view().empty())
      refuse(key_ + "." + use,
             (files_.has_lines(from_) ? sensor_log_messages::column_not_named
                                      : sensor_log_messages::column_of_topic_not_named)(path_));
    wanted_.push_back({std::string(column.view()), key_ + "." + use, unit});
    return wanted_.size() - 1;
  }
  std::array<std::size_t, 3> want(const std::array<Name, 3>& columns, const std::string& use) {
    std::array<std::size_t, 3> at{};
    for (std::size_t i = 0; i < 3; ++i) at[i] = want(columns[i], use + ".columns[" + std::to_string(i) + "]");
    return at;
  }

  /// `make` converts row `i` to a message, `sane` checks it.
  template <class M, class Make>
  Series<M> read(Make make) {
    table_ = files_.read(from_, key_, wanted_);
    Series<M> series;
    series.key = key_;
    series.path = path_;
    series.cut_at = table_.cut_at;
    if (!files_.has_lines(from_)) series.line_word = "message";
    series.delay_ns = ns_of(from_.delay_s);
    std::vector<std::int64_t> stamps_ns;
    std::vector<M> samples;
    std::vector<std::size_t> lines;
    for (const std::size_t i : candidates(series.left_out)) {
      const M sample = make(i);
      if (!sane(sample)) {
        leave_out(series.left_out, series.left_out.out_of_range, table_.lines[i]);
        continue;
      }
      stamps_ns.push_back(table_.columns[0].stamps_ns[i]);
      samples.push_back(sample);
      lines.push_back(table_.lines[i]);
    }
    keep_order(series, stamps_ns, samples, lines);
    if (table_.rows() == 0 && !files_.has_lines(from_))
      refuse(key_ + ".from.topic", sensor_log_messages::topic_empty(path_));
    if (series.samples.empty())
      refuse(key_ + ".from.file", sensor_log_messages::rows_unusable(path_, table_.rows()));
    return series;
  }

  double number(std::size_t column, std::size_t row) const { return table_.columns[column].numbers[row]; }
  std::array<double, 3> numbers(const std::array<std::size_t, 3>& at, std::size_t row) const {
    return {number(at[0], row), number(at[1], row), number(at[2], row)};
  }

 private:
  static void leave_out(LeftOut& all, std::uint64_t& why, std::size_t line) {
    if (all.all() == 0 || line < all.first_line) all.first_line = line;
    ++why;
  }

  /// Finite rows. With `from.changes`, without rows that repeat the one before.
  std::vector<std::size_t> candidates(LeftOut& left_out) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      if (!finite(i))
        leave_out(left_out, left_out.not_finite, table_.lines[i]);
      else if (changes_ == 0 || rows.empty() || number(changes_, i) != number(changes_, rows.back()))
        rows.push_back(i);
    }
    return rows;
  }

  template <class M>
  void keep_order(Series<M>& series, const std::vector<std::int64_t>& stamps_ns,
                  const std::vector<M>& samples, const std::vector<std::size_t>& lines) const {
    const std::int64_t shift_ns = ns_of(from_.shift_s);
    std::size_t next = 0;
    for (const std::size_t i : in_order(stamps_ns)) {
      for (; next < i; ++next) leave_out(series.left_out, series.left_out.out_of_order, lines[next]);
      ++next;
      series.at_ns.push_back(stamps_ns[i] + shift_ns);
      series.samples.push_back(samples[i]);
      series.last_line = lines[i];
    }
    for (; next < lines.size(); ++next) leave_out(series.left_out, series.left_out.out_of_order, lines[next]);
  }

  bool finite(std::size_t row) const {
    return std::all_of(table_.columns.begin(), table_.columns.end(), [row](const Column& column) {
      return column.numbers.empty() ? column.stamps_ns[row] != no_stamp : std::isfinite(column.numbers[row]);
    });
  }

  const Source& from_;
  Files& files_;
  std::string path_, key_;
  std::vector<Wanted> wanted_;
  std::size_t changes_ = 0;  ///< 0 is the column of the time
  Table table_;
};

}  // namespace fulmar::sensor_log
