// SPDX-License-Identifier: BSD-3-Clause
// See mat.hpp.
#include "tools/fulmar_log/mat.hpp"

#include <zlib.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "tools/fulmar_log/export_arrays.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_name = 63;
constexpr std::size_t largest_variable = 0x7fffffff;  // bytes of a variable

enum MatKind : std::uint32_t {
  mi_int8 = 1,
  mi_uint8,
  mi_int16,
  mi_uint16,
  mi_int32,
  mi_uint32,
  mi_single,
  mi_double = 9,
  mi_int64 = 12,
  mi_uint64,
  mi_matrix,
  mi_compressed,
  mi_utf8
};
enum Class : std::uint32_t {
  mx_cell = 1,
  mx_struct = 2,
  mx_char = 4,
  mx_double = 6,
  mx_single,
  mx_int8,
  mx_uint8,
  mx_int16,
  mx_uint16,
  mx_int32,
  mx_uint32,
  mx_int64,
  mx_uint64
};
constexpr std::uint32_t logical = 0x200;

struct Form {
  MatKind data;
  std::uint32_t shape;
};
/// In the order of fulmar_kind.
Form form_of(fulmar_kind kind) {
  static constexpr Form none{mi_matrix, mx_cell};  // text and structs; an enum is its byte
  static constexpr std::array<Form, kind_rows.size()> forms{{{mi_uint8, mx_uint8 | logical},
                                                             {mi_uint8, mx_uint8},
                                                             {mi_int32, mx_int32},
                                                             {mi_uint32, mx_uint32},
                                                             {mi_int64, mx_int64},
                                                             {mi_uint64, mx_uint64},
                                                             {mi_single, mx_single},
                                                             {mi_double, mx_double},
                                                             {mi_uint8, mx_uint8},
                                                             none,
                                                             none,
                                                             {mi_int8, mx_int8},
                                                             {mi_int16, mx_int16},
                                                             {mi_uint16, mx_uint16}}};
  return forms[static_cast<std::size_t>(kind) - FULMAR_BOOL];
}

std::string u32(std::uint32_t x) { return {reinterpret_cast<const char*>(&x), 4}; }

/// A data element: tag, bytes, padding to 8.
std::string mat_element(std::uint32_t type, std::string_view bytes) {
  if (bytes.size() > largest_variable) throw Error(log_tool_messages::mat_too_large());
  std::string s = u32(type) + u32(static_cast<std::uint32_t>(bytes.size()));
  s += bytes;
  s.append((8 - s.size() % 8) % 8, '\0');
  return s;
}

std::string flags_and_dims(std::uint32_t shape, std::size_t rows, std::size_t columns) {
  return mat_element(mi_uint32, u32(shape) + u32(0)) +
         mat_element(mi_int32,
                     u32(static_cast<std::uint32_t>(rows)) + u32(static_cast<std::uint32_t>(columns)));
}

/// Code points that are not one character become '?': character arrays count characters, not bytes.
std::string plain(const std::string& text) {
  std::string s = text;
  for (char& c : s)
    if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  return s;
}

std::string deflate_text(const std::string& bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string out(size, '\0');
  if (::compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), 1) != Z_OK)
    throw Error(log_tool_messages::compression_failed());
  out.resize(size);
  return out;
}

std::string unlike(const std::string& name, std::set<std::string>& taken) {
  std::string unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) {
    const std::string number = "_" + std::to_string(i);
    unique = name.substr(0, max_name - number.size()) + number;
  }
  return unique;
}

}  // namespace

std::string mat_name(const std::string& name) {
  std::string s;
  for (const char c : name) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (good) s += c;
    if (!good && !s.empty() && s.back() != '_') s += '_';
  }
  while (!s.empty() && s.back() == '_') s.pop_back();
  if (s.empty() || (s[0] >= '0' && s[0] <= '9')) s = "x" + s;
  return s.substr(0, max_name);
}

std::string MatValue::named(const std::string& name) const {
  return mat_element(mi_matrix, flags_dims_ + mat_element(mi_int8, name) + body_);
}

MatValue MatValue::numbers(fulmar_kind kind, std::size_t count, std::span<const std::byte> data) {
  const Form form = form_of(kind);
  MatValue v;
  v.flags_dims_ = flags_and_dims(form.shape, count, 1);
  v.body_ = mat_element(form.data, {reinterpret_cast<const char*>(data.data()), data.size()});
  return v;
}

MatValue MatValue::texts(const std::vector<std::string>& texts) {
  MatValue v;
  v.flags_dims_ = flags_and_dims(mx_cell, texts.size(), 1);
  for (const std::string& t : texts) {
    MatValue cell;
    cell.flags_dims_ = flags_and_dims(mx_char, t.empty() ? 0 : 1, t.size());
    cell.body_ = mat_element(mi_utf8, plain(t));
    v.body_ += cell.named("");
  }
  return v;
}

MatValue MatValue::structure(const std::vector<std::pair<std::string, MatValue>>& fields) {
  std::string names;
  std::set<std::string> taken;
  for (const auto& [name, value] : fields) {
    std::string field = unlike(mat_name(name), taken);
    field.resize(max_name + 1, '\0');
    names += field;
  }
  MatValue v;
  v.flags_dims_ = flags_and_dims(mx_struct, 1, 1);
  v.body_ = u32(4u << 16 | mi_int32) + u32(max_name + 1) +
            mat_element(mi_int8, names);  // a small element: size and type in one word
  for (const auto& [name, value] : fields) v.body_ += value.named("");
  return v;
}

MatWriter::MatWriter(const std::filesystem::path& file) : file_(file) {
  if (std::filesystem::exists(file)) throw Error(log_tool_messages::export_exists(file.string()));
  out_.open(file.string() + ".part", std::ios::binary | std::ios::trunc);
  std::string head = "MATLAB 5.0 MAT-file, written by Fulmar";
  head.resize(116, ' ');
  head.resize(124, '\0');
  head += std::string("\0\x01IM", 4);
  if (!out_.write(head.data(), static_cast<std::streamsize>(head.size())))
    throw Error(log_tool_messages::file_not_writable(file.string()));
}

void MatWriter::add(const std::string& name, const MatValue& value) {
  const std::string bytes = deflate_text(value.named(name));
  const std::string tag = u32(mi_compressed) + u32(static_cast<std::uint32_t>(bytes.size()));  // not padded
  if (!out_.write(tag.data(), 8) || !out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw Error(log_tool_messages::disk_write_failed(file_.string()));
}

void MatWriter::finish() {
  out_.close();
  if (!out_) throw Error(log_tool_messages::disk_write_failed(file_.string()));
  std::filesystem::rename(file_.string() + ".part", file_);
}

void export_mat(const Tables& tables, const std::filesystem::path& file) {
  MatWriter out(file);
  std::set<std::string> taken;
  for_each_table(tables, [&](const Table& table, const std::vector<Array>& arrays) {
    std::vector<std::pair<std::string, MatValue>> fields;
    for (const Array& a : arrays) {
      const bool text = a.kind == FULMAR_TEXT;
      fields.emplace_back(a.name,
                          text ? MatValue::texts(a.texts) : MatValue::numbers(a.kind, table.rows, a.data));
      if (!a.labels.empty()) fields.emplace_back(a.name + "_labels", MatValue::texts(a.labels));
    }
    out.add(unlike(mat_name(table.name), taken), MatValue::structure(fields));
  });
  out.finish();
}

}  // namespace fulmar::core
