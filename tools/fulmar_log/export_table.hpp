// SPDX-License-Identifier: BSD-3-Clause
// A log as tables, one per topic: a row per message, a column per number, text or label. It is read twice,
// for the widths and for the rows, so that a long log needs no more memory than one of its chunks.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/log/reader.hpp"
#include "tools/fulmar_log/export_schema.hpp"

namespace fulmar::core {

struct Table {
  std::string topic;  // "/nav/state"
  std::string name;   // "nav.state"; unique
  RosField root;
  std::vector<Column> columns;  // in addition to the times
  std::uint64_t rows = 0;
};

class Tables {
 public:
  struct Row {
    std::size_t table = 0;
    std::int64_t time_ns = 0, valid_ns = 0;  // flight time: of the log entry, of validity
    const std::vector<Cell>* cells = nullptr;
  };

  /// First reading. No topics: all. Throws Error for a requested topic that does not exist or cannot be
  /// decoded. Without a request it is left out, and `left_out` has the reason.
  Tables(const std::filesystem::path& log, const std::vector<std::string>& topics);

  const std::vector<Table>& list() const { return tables_; }
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// "" or the reason why the log is cut off.
  const std::string& fault() const { return fault_; }
  /// Second reading: all rows of the tables for which `wanted`, in file order.
  void rows(const std::function<bool(std::size_t)>& wanted,
            const std::function<void(const Row&)>& take) const;

 private:
  struct Source {
    int table = -1;   // -1: not exported
    std::string why;  // reason why it cannot be exported
  };
  Source add(const McapFile& log, std::uint16_t channel);
  void lay_out_all();

  std::filesystem::path file_;
  std::vector<std::string> topics_;
  std::vector<Table> tables_;
  std::map<std::uint16_t, Source> sources_;  // by channel
  std::vector<std::string> left_out_;
  std::uint64_t epoch_ns_ = 0;
  std::string fault_;
};

}  // namespace fulmar::core
