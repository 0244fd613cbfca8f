// SPDX-License-Identifier: BSD-3-Clause
// Reads a column of one of NASA's six-degree-of-freedom check cases (NASA/TM-2015-218675), if available.
#pragma once
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fulmar::test {

class CheckCase {
 public:
  /// Returns nothing without the folder.
  static std::optional<CheckCase> open(const std::string& file) {
    std::ifstream in(std::string(FULMAR_REFERENCE_DATA) + "/six_dof/" + file);
    if (!in) return std::nullopt;
    CheckCase c;
    std::string line, cell;
    std::getline(in, line);
    for (std::istringstream s(line); std::getline(s, cell, ',');) c.names_.push_back(cell);
    while (std::getline(in, line)) {
      c.rows_.emplace_back();
      for (std::istringstream s(line); std::getline(s, cell, ',');) c.rows_.back().push_back(std::stod(cell));
    }
    return c;
  }
  std::size_t size() const { return rows_.size(); }
  double at(std::size_t row, const std::string& name) const {
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (names_[i].find(name) == 0) return rows_.at(row).at(i);
    throw std::runtime_error("no column " + name);
  }
  /// Index of the row at a time.
  std::size_t row_at(double time_s) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (rows_[i][0] > time_s - 1e-4) return i;
    throw std::runtime_error("the case ends before");
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace fulmar::test
