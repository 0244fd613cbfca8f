// SPDX-License-Identifier: BSD-3-Clause
// A log for computation: one CSV file per topic, one NPZ file, one MAT file (level 5). Every value is exact,
// and radians stay radians. Columns: time_s (flight time at which it was logged), valid_s, then the fields:
// "legs[1].position_m.north". A list is as wide as its longest; a missing value is nan. An enum is its
// number, with its label in a further column.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/fulmar_log/export_table.hpp"

namespace fulmar::core {

enum class ExportForm { csv, npz, mat };

struct ExportResult {
  std::filesystem::path out;  // folder of the CSV files, or the file
  struct Topic {
    std::string topic;
    std::uint64_t rows = 0;
    std::size_t columns = 0;
  };
  std::vector<Topic> topics;
  std::vector<std::string> left_out;  // "/image: its messages are encoded as ..."
  std::string fault;                  // "" or the reason why the log is cut off
};

/// `out` empty: the log's name in the current directory. `topics` empty: all. Throws Error, also when the
/// file exists.
ExportResult export_log(const std::filesystem::path& log, ExportForm form, std::filesystem::path out,
                        const std::vector<std::string>& topics);

void export_csv(const Tables& tables, const std::filesystem::path& folder);
void export_npz(const Tables& tables, const std::filesystem::path& file);
void export_mat(const Tables& tables, const std::filesystem::path& file);

/// "-1.0025": nanoseconds as seconds, exact.
std::string seconds_text(std::int64_t ns);

}  // namespace fulmar::core
