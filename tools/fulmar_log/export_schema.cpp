// SPDX-License-Identifier: BSD-3-Clause
// See export_schema.hpp.
#include "tools/fulmar_log/export_schema.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <map>

#include "core/error.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

constexpr int deepest_table = 16;
constexpr std::size_t most_table_fields = 20'000;  // of a definition, nested ones counted each time

// ---- the definition ------------------------------------------------------------------------------------------------------------

const std::map<std::string_view, RosKind> cell_kinds{
    {"bool", RosKind::flag},  {"byte", RosKind::u8},     {"char", RosKind::u8},     {"int8", RosKind::i8},    {"uint8", RosKind::u8},
    {"int16", RosKind::i16},  {"uint16", RosKind::u16},  {"int32", RosKind::i32},   {"uint32", RosKind::u32}, {"int64", RosKind::i64},
    {"uint64", RosKind::u64}, {"float32", RosKind::f32}, {"float64", RosKind::f64}, {"string", RosKind::text}};

std::string_view stripped(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

std::string small(std::string_view text) {
  std::string s(text);
  for (char& c : s) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return s;
}

template <class T>
bool read_number(std::string_view text, T& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc{} && end == text.data() + text.size();
}

/// "geometry_msgs/msg/Point" and "geometry_msgs/Point" are one.
std::string section_name(std::string_view name) {
  std::string s(name);
  const std::size_t middle = s.find("/msg/");
  return middle == std::string::npos ? s : s.erase(middle, 4);
}

class Definition {
 public:
  Definition(const std::string& name, std::string_view text) {
    std::string section = section_name(name);
    sections_[section];
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const std::string_view line = stripped(text.substr(0, end));
      text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
      if (line.starts_with("====")) continue;
      if (line.starts_with("MSG:")) {
        section = section_name(stripped(line.substr(4)));
      } else if (!line.empty() && line[0] != '#') {
        sections_[section].push_back(line);
      }
    }
  }

  void structure(const std::string& name, RosField& made, int depth) {
    const auto section = sections_.find(name);
    if (section == sections_.end()) throw Error("the definition of " + name + " is missing");
    if (depth > deepest_table) throw Error(name + " is nested too deeply, or holds itself");
    made.kind = RosKind::structure;
    std::vector<std::pair<std::int64_t, std::string>> constants;
    for (const std::string_view line : section->second) add_line(line, name, made, constants, depth);
    if (made.fields.empty()) made.fields.push_back({.name = "structure_needs_at_least_one_member", .kind = RosKind::u8});
  }

 private:
  void add_line(std::string_view line, const std::string& owner, RosField& made,
                std::vector<std::pair<std::int64_t, std::string>>& constants, int depth) {
    const std::string_view type = line.substr(0, line.find_first_of(" \t"));
    std::string_view rest = stripped(line.substr(type.size()));
    const std::size_t equals = rest.find('='), note = rest.find('#');
    if (equals < note) {
      std::int64_t value = 0;
      const std::string_view digits = stripped(rest.substr(equals + 1, note == std::string_view::npos ? note : note - equals - 1));
      if (read_number(digits, value)) constants.emplace_back(value, small(stripped(rest.substr(0, equals))));
      return;
    }
    rest = stripped(rest.substr(0, note));
    RosField field;
    field.name = std::string(rest.substr(0, rest.find_first_of(" \t")));  // a default value may follow
    if (field.name.empty() || field.name.size() > 256) throw Error(owner + ": '" + std::string(line) + "' is no field");
    if (++fields_ > most_table_fields) throw Error(owner + " has too many fields");
    kind(type, owner, field, depth);
    if (field.kind != RosKind::structure && field.kind != RosKind::text && field.kind < RosKind::f32)
      field.labels = labels(constants, field);
    constants.clear();
    made.fields.push_back(std::move(field));
  }

  void kind(std::string_view type, const std::string& owner, RosField& field, int depth) {
    std::string_view element = type;
    if (const std::size_t open = type.find('['); open != std::string_view::npos) {
      const std::string_view inside = type.substr(open + 1, type.size() - open - 2);
      element = type.substr(0, open);
      field.shape = inside.empty() || inside.starts_with("<=") ? RosField::Shape::list : RosField::Shape::array;
      const bool counted = field.shape == RosField::Shape::list || (read_number(inside, field.count) && field.count > 0);
      if (type.back() != ']' || !counted) throw Error(owner + ": '" + std::string(type) + "' is no type");
    }
    if (element.starts_with("string<=")) element = "string";
    if (const auto known = cell_kinds.find(element); known != cell_kinds.end()) {
      field.kind = known->second;
    } else if (const std::string full = resolve(element, owner); !full.empty()) {
      structure(full, field, depth + 1);
    } else {
      throw Error(owner + ": the type '" + std::string(element) + "' of " + field.name + " is not known");
    }
  }

  /// A bare name belongs to the package of its owner.
  std::string resolve(std::string_view name, const std::string& owner) const {
    const std::string full = section_name(name);
    if (sections_.contains(full)) return full;
    const std::string near = owner.substr(0, owner.find('/') + 1) + full;
    if (sections_.contains(near)) return near;
    return full == "Header" && sections_.contains("std_msgs/Header") ? "std_msgs/Header" : "";
  }

  /// Without the field's name, where all of them begin with it.
  static std::vector<std::pair<std::int64_t, std::string>> labels(const std::vector<std::pair<std::int64_t, std::string>>& constants,
                                                                  const RosField& field) {
    std::vector<std::pair<std::int64_t, std::string>> made = constants;
    const std::string prefix = small(field.name) + "_";
    const bool prefixed = std::all_of(made.begin(), made.end(), [&](const auto& c) { return c.second.starts_with(prefix); });
    if (!prefixed) return made;
    for (auto& [value, label] : made) label.erase(0, prefix.size());
    return made;
  }

  std::map<std::string, std::vector<std::string_view>> sections_;
  std::size_t fields_ = 0;
};

// ---- the bytes -----------------------------------------------------------------------------------------------------------------

std::size_t size_of(RosKind kind) {
  static constexpr std::array<std::size_t, 11> sizes{1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(kind)];
}

struct CdrBytes {
  std::span<const std::byte> data;
  std::size_t at = cdr_header_bytes;

  explicit CdrBytes(std::span<const std::byte> message) : data(message) {
    if (message.size() < cdr_header_bytes) throw Error("a message is too short");
    const auto form = static_cast<unsigned>(message[0]) << 8 | static_cast<unsigned>(message[1]);
    if (form != 1) throw Error("a message has the encapsulation " + std::to_string(form) + "; only 1, plain little-endian CDR, is read");
  }
  const std::byte* take(std::size_t size, std::size_t align) {
    at += (align - (at - cdr_header_bytes) % align) % align;
    if (at > data.size() || size > data.size() - at) throw Error("a message is too short for its definition");
    at += size;
    return data.data() + (at - size);
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value, sizeof value), sizeof value);
    return value;
  }
  std::string_view text() {
    const auto size = number<std::uint32_t>();
    const char* first = reinterpret_cast<const char*>(take(size, 1));
    return {first, ::strnlen(first, size)};
  }
  void finish() const {
    if (data.size() - at > 7) throw Error("a message is longer than its definition");  // up to 7: padding of the whole
  }
};

Cell value(const RosField& f, CdrBytes& in) {
  Cell cell;
  const auto whole = [&](std::int64_t x) { cell.kind = Cell::Kind::whole, cell.whole = x; };
  const auto natural = [&](std::uint64_t x) { cell.kind = Cell::Kind::natural, cell.natural = x; };
  switch (f.kind) {
    case RosKind::flag:
    case RosKind::u8:
      return natural(in.number<std::uint8_t>()), cell;
    case RosKind::i8:
      return whole(in.number<std::int8_t>()), cell;
    case RosKind::i16:
      return whole(in.number<std::int16_t>()), cell;
    case RosKind::u16:
      return natural(in.number<std::uint16_t>()), cell;
    case RosKind::i32:
      return whole(in.number<std::int32_t>()), cell;
    case RosKind::u32:
      return natural(in.number<std::uint32_t>()), cell;
    case RosKind::i64:
      return whole(in.number<std::int64_t>()), cell;
    case RosKind::u64:
      return natural(in.number<std::uint64_t>()), cell;
    case RosKind::f32:
      return cell.kind = Cell::Kind::single, cell.single = in.number<float>(), cell;
    case RosKind::f64:
      return cell.kind = Cell::Kind::real, cell.real = in.number<double>(), cell;
    case RosKind::text:
    case RosKind::structure:
      break;
  }
  return cell.kind = Cell::Kind::text, cell.text = in.text(), cell;
}

void measure_field(RosField& f, CdrBytes& in) {
  std::uint32_t n = f.count;
  if (f.shape == RosField::Shape::list) n = in.number<std::uint32_t>();
  if (f.kind < RosKind::text) {
    if (n > in.data.size()) throw Error("a message is too short for its definition");
    if (n > 0) in.take(size_of(f.kind) * n, size_of(f.kind));
  } else {
    for (std::uint32_t i = 0; i < n; ++i) {
      if (f.kind == RosKind::text) in.text();
      for (RosField& inner : f.fields) measure_field(inner, in);
    }
  }
  f.longest = std::max(f.longest, n);
}

std::size_t cells(const RosField& f) { return f.width * (f.shape == RosField::Shape::list ? f.longest : f.count); }

void widen(RosField& f, std::size_t most) {
  f.width = f.kind == RosKind::structure ? 0 : 1;
  for (RosField& inner : f.fields) {
    widen(inner, most);
    f.width += cells(inner);
  }
  if (cells(f) > most) throw Error("its messages have more than " + std::to_string(most) + " numbers each");
}

void name_columns(const RosField& f, const std::string& name, bool in_list, std::vector<Column>& columns) {
  const bool list = f.shape == RosField::Shape::list, one = f.shape == RosField::Shape::scalar;
  const std::uint32_t n = list ? f.longest : f.count;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::string element = one ? name : name + "[" + std::to_string(i) + "]";
    if (f.kind != RosKind::structure) columns.push_back({element, &f, in_list || list});
    for (const RosField& inner : f.fields) name_columns(inner, element + "." + inner.name, in_list || list, columns);
  }
}

/// Fills the field's cells from `to` on.
void decode_field(const RosField& f, CdrBytes& in, Cell* to) {
  std::uint32_t n = f.count;
  if (f.shape == RosField::Shape::list) {
    n = in.number<std::uint32_t>();
    if (n > f.longest) throw Error("a list is longer than it was");
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    Cell* cell = to + i * f.width;
    if (f.kind != RosKind::structure) *cell = value(f, in);
    for (const RosField& inner : f.fields) {
      decode_field(inner, in, cell);
      cell += cells(inner);
    }
  }
}

template <class T>
std::string shortest(T x) {
  std::array<char, 40> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  return {text.data(), end};
}

}  // namespace

RosField parse_ros2msg(const std::string& name, const std::string& text) {
  RosField root;
  Definition(name, text).structure(section_name(name), root, 0);
  return root;
}

void measure(RosField& root, std::span<const std::byte> message) {
  CdrBytes in(message);
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
  CdrBytes in(message);
  Cell* to = row.data();
  for (const RosField& f : root.fields) {
    decode_field(f, in, to);
    to += cells(f);
  }
  in.finish();
}

std::string cell_text(const Cell& cell) {
  switch (cell.kind) {
    case Cell::Kind::none:
      return "nan";
    case Cell::Kind::whole:
      return std::to_string(cell.whole);
    case Cell::Kind::natural:
      return std::to_string(cell.natural);
    case Cell::Kind::single:
      return shortest(cell.single);
    case Cell::Kind::real:
      return shortest(cell.real);
    case Cell::Kind::text:
      return std::string(cell.text);
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
