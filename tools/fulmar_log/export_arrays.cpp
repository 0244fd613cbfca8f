// SPDX-License-Identifier: BSD-3-Clause
// See export_arrays.hpp.
#include "tools/fulmar_log/export_arrays.hpp"

#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "tools/fulmar_log/log_field.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t batch_bytes = 200u << 20;
constexpr std::int64_t max_labels = 256;

/// Integers in lists become doubles: only these have a nan for a missing element.
fulmar_kind array_kind(const Column& c) {
  const bool as_it_is = !c.in_list || is_real(c.field->kind) || c.field->kind == FULMAR_TEXT;
  return as_it_is ? c.field->kind : FULMAR_F64;
}

std::vector<std::string> labels(const RosField& f) {
  std::vector<std::string> list;
  for (const auto& [value, label] : f.labels) {
    if (value < 0 || value >= max_labels) continue;
    if (list.size() <= static_cast<std::size_t>(value)) list.resize(static_cast<std::size_t>(value) + 1);
    list[static_cast<std::size_t>(value)] = label;
  }
  return list;
}

std::vector<Array> begin_arrays(const Table& table) {
  std::vector<Array> list{{.name = "time_s"}, {.name = "valid_s"}};
  for (const Column& c : table.columns)
    list.push_back({.name = c.name, .kind = array_kind(c), .labels = labels(*c.field)});
  for (Array& a : list) a.data.reserve(table.rows * primitive_size(a.kind));
  return list;
}

std::size_t bytes_of(const Table& table) {
  std::size_t row = 16;
  for (const Column& c : table.columns)
    row += c.field->kind == FULMAR_TEXT ? 64 : primitive_size(array_kind(c));
  return row * table.rows;
}

template <class T>
void put(Array& to, T value) {
  const std::size_t before = to.data.size();
  to.data.resize(before + sizeof value);
  std::memcpy(to.data.data() + before, &value, sizeof value);
}

void add(Array& to, const Cell& cell) {
  if (to.kind == FULMAR_TEXT) {
    to.texts.emplace_back(cell.kind == Cell::Kind::text ? cell.text : std::string_view{});
  } else if (to.kind == FULMAR_F64) {
    put(to, number_of_cell(cell));
  } else if (to.kind == FULMAR_F32) {
    put(to, cell.kind == Cell::Kind::single ? cell.single : std::numeric_limits<float>::quiet_NaN());
  } else {  // little-endian: the low bytes are first
    const std::size_t before = to.data.size(), size = primitive_size(to.kind);
    to.data.resize(before + size);
    std::memcpy(to.data.data() + before, &cell.natural, size);
  }
}

}  // namespace

void for_each_table(const Tables& tables,
                    const std::function<void(const Table&, const std::vector<Array>&)>& take) {
  const std::vector<Table>& list = tables.list();
  for (std::size_t first = 0, last = 0; first < list.size(); first = last) {
    std::vector<std::vector<Array>> arrays(list.size());
    for (std::size_t bytes = 0;
         last < list.size() && (last == first || bytes + bytes_of(list[last]) <= batch_bytes); ++last) {
      if (list[last].rows == 0) continue;
      bytes += bytes_of(list[last]);
      arrays[last] = begin_arrays(list[last]);
    }
    tables.rows([&](std::size_t i) { return !arrays[i].empty(); },
                [&](const Tables::Row& row) {
                  std::vector<Array>& to = arrays[row.table];
                  put(to[0], static_cast<double>(row.time_ns) / 1e9);
                  put(to[1], static_cast<double>(row.valid_ns) / 1e9);
                  for (std::size_t i = 0; i < row.cells->size(); ++i) add(to[i + 2], (*row.cells)[i]);
                });
    for (std::size_t i = first; i < last; ++i) {
      if (!arrays[i].empty()) take(list[i], arrays[i]);
      arrays[i].clear();
    }
  }
}

}  // namespace fulmar::core
