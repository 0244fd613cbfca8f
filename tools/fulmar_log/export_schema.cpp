// SPDX-License-Identifier: BSD-3-Clause
// See export_schema.hpp.
#include "tools/fulmar_log/export_schema.hpp"

#include <algorithm>
#include <type_traits>

#include "core/types/cdr_bytes.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_table_fields = 20'000;  // nested ones counted each time

/// A field for a table, with its nested fields.
RosField table_field(const Field& f, std::size_t& count) {
  if (++count > max_table_fields) throw Error(log_tool_messages::too_many_fields());
  RosField made{f.name, f.kind == FULMAR_ENUM ? FULMAR_U8 : f.kind, f.shape, f.count, f.constants};
  made.unit = f.unit;
  if (f.kind != FULMAR_STRUCT) return made;
  for (const Field& inner : f.type->fields) made.fields.push_back(table_field(inner, count));
  if (made.fields.empty())
    made.fields.push_back({.name = "structure_needs_at_least_one_member", .kind = FULMAR_U8});
  return made;
}

// ---- the bytes

template <class T>
Cell number_cell(T x) {
  Cell cell;
  if constexpr (std::is_same_v<T, float>) {
    cell.kind = Cell::Kind::single;
    cell.single = x;
  } else if constexpr (std::is_same_v<T, double>) {
    cell.kind = Cell::Kind::real;
    cell.real = x;
  } else if constexpr (std::is_signed_v<T>) {
    cell.kind = Cell::Kind::whole;
    cell.whole = x;
  } else {
    cell.kind = Cell::Kind::natural;
    cell.natural = x;
  }
  return cell;
}

Cell value(const RosField& f, CdrReader& in) {
  if (f.kind != FULMAR_TEXT)
    return with_number(f.kind, in.take(primitive_size(f.kind)), [](auto x) { return number_cell(x); });
  const std::string_view text = in.text();
  Cell cell;
  cell.kind = Cell::Kind::text;
  cell.text = text.substr(0, text.find('\0'));
  return cell;
}

std::uint32_t elements(const RosField& f, CdrReader& in) {
  return f.shape == FULMAR_LIST ? in.number<std::uint32_t>() : f.count;
}

void measure_field(RosField& f, CdrReader& in) {
  const std::uint32_t n = elements(f, in);
  if (const std::uint32_t size = primitive_size(f.kind); size > 0) {
    in.take(size, n);
  } else {
    for (std::uint32_t i = 0; i < n; ++i) {
      if (f.kind == FULMAR_TEXT) in.text();
      for (RosField& inner : f.fields) measure_field(inner, in);
    }
  }
  f.longest = std::max(f.longest, n);
}

std::size_t cells(const RosField& f) { return f.width * (f.shape == FULMAR_LIST ? f.longest : f.count); }

void widen(RosField& f, std::size_t most) {
  f.width = f.kind == FULMAR_STRUCT ? 0 : 1;
  for (RosField& inner : f.fields) {
    widen(inner, most);
    f.width += cells(inner);
  }
  if (cells(f) > most) throw Error(log_tool_messages::too_many_numbers(most));
}

void name_columns(const RosField& f, const std::string& name, bool in_list, std::vector<Column>& columns) {
  const bool list = f.shape == FULMAR_LIST, one = f.shape == FULMAR_SCALAR;
  const std::uint32_t n = list ? f.longest : f.count;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::string element = one ? name : name + "[" + std::to_string(i) + "]";
    if (f.kind != FULMAR_STRUCT) columns.push_back({element, &f, in_list || list});
    for (const RosField& inner : f.fields)
      name_columns(inner, element + "." + inner.name, in_list || list, columns);
  }
}

/// Fills the field's cells from `to` on.
void decode_field(const RosField& f, CdrReader& in, Cell* to) {
  const std::uint32_t n = elements(f, in);
  if (n > f.longest) throw Error(log_tool_messages::list_longer());
  for (std::uint32_t i = 0; i < n; ++i) {
    Cell* cell = to + i * f.width;
    if (f.kind != FULMAR_STRUCT) *cell = value(f, in);
    for (const RosField& inner : f.fields) {
      decode_field(inner, in, cell);
      cell += cells(inner);
    }
  }
}

}  // namespace

RosField parse_ros2msg(const std::string& name, const std::string& text) {
  Field root;
  root.kind = FULMAR_STRUCT;
  root.type = parse_ros_schema(name, text);
  std::size_t count = 0;
  return table_field(root, count);
}

void measure(RosField& root, std::span<const std::byte> message) {
  CdrReader in(message);
  for (RosField& f : root.fields) measure_field(f, in);
  in.finish();
}

std::vector<Column> lay_out(RosField& root, std::size_t most) {
  widen(root, most);
  std::vector<Column> columns;
  for (const RosField& f : root.fields) name_columns(f, f.name, false, columns);
  return columns;
}

void decode(const RosField& root, std::span<const std::byte> message, std::vector<Cell>& row) {
  row.assign(root.width, Cell{});
  CdrReader in(message);
  Cell* to = row.data();
  for (const RosField& f : root.fields) {
    decode_field(f, in, to);
    to += cells(f);
  }
  in.finish();
}

std::string cell_text(const Cell& cell) {
  switch (cell.kind) {
    case Cell::Kind::none: return "nan";
    case Cell::Kind::whole: return std::to_string(cell.whole);
    case Cell::Kind::natural: return std::to_string(cell.natural);
    case Cell::Kind::single: return number_text(cell.single);
    case Cell::Kind::real: return number_text(cell.real);
    case Cell::Kind::text: return std::string(cell.text);
  }
  return {};
}

std::string_view cell_label(const RosField& field, const Cell& cell) {
  if (cell.kind != Cell::Kind::whole && cell.kind != Cell::Kind::natural) return {};
  for (const auto& [value, label] : field.labels)
    if (value == cell.whole) return label;
  return {};
}

}  // namespace fulmar::core
