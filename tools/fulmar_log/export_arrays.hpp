// SPDX-License-Identifier: BSD-3-Clause
// The columns of tables as arrays in memory, for files of arrays.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tools/fulmar_log/export_table.hpp"

namespace fulmar::core {

struct Array {
  std::string name;  // "time_s", "legs[1].position_m.north"
  fulmar_kind kind = FULMAR_F64;
  std::vector<std::byte> data{};      // one element after the other
  std::vector<std::string> texts{};   // of kind text
  std::vector<std::string> labels{};  // of the numbers 0, 1, ...; empty: none
};

/// Calls for each table that has rows. Tables of some 200 MB together, and at least one, are in memory at a
/// time.
void for_each_table(const Tables& tables,
                    const std::function<void(const Table&, const std::vector<Array>&)>& take);

}  // namespace fulmar::core
