// SPDX-License-Identifier: BSD-3-Clause
// See npz.hpp. Every entry has the earliest date of zip: equal arrays give equal files.
#include "tools/fulmar_log/npz.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "tools/fulmar_log/export_arrays.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::uint64_t largest_32 =
    std::numeric_limits<std::uint32_t>::max();            // limit of the 32-bit fields of the format
constexpr std::uint16_t version = 20, first_date = 0x21;  // 2.0; 1980-01-01
constexpr std::uint16_t utf8_names = 1u << 11, deflated = 8;
constexpr int level = 1;  // a higher level does not compress noise better

template <class... Numbers>
std::string little_endian(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

/// A raw deflate stream of two parts.
std::string deflate_both(const std::string& first, std::span<const std::byte> second) {
  z_stream z{};
  if (::deflateInit2(&z, level, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
    throw Error(log_tool_messages::compression_failed());
  std::string out(::deflateBound(&z, first.size() + second.size()) + 64, '\0');
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(first.data()));
  z.avail_in = static_cast<uInt>(first.size());
  int code = ::deflate(&z, Z_NO_FLUSH);
  z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(second.data()));
  z.avail_in = static_cast<uInt>(second.size());
  if (code == Z_OK) code = ::deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  ::deflateEnd(&z);
  if (code != Z_STREAM_END) throw Error(log_tool_messages::compression_failed());
  return out;
}

std::uint32_t entry_crc(const std::string& first, std::span<const std::byte> second) {
  uLong crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(first.data()), first.size());
  if (!second.empty()) crc = ::crc32_z(crc, reinterpret_cast<const Bytef*>(second.data()), second.size());
  return static_cast<std::uint32_t>(crc);
}

std::string npy_header(const std::string& type, std::size_t count) {
  std::string text =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + std::to_string(count) + ",), }";
  text.append((64 - (10 + text.size() + 1) % 64) % 64, ' ');
  text += '\n';
  return std::string("\x93NUMPY\x01\0", 8) + little_endian(static_cast<std::uint16_t>(text.size())) + text;
}

/// UTF-8 as code points; an invalid byte becomes U+FFFD.
std::u32string code_points(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    char32_t point = length == 1 ? first : first & (0x7fu >> length);
    bool good = first < 0x80 || (first >= 0xc2 && first <= 0xf4);
    for (std::size_t k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(i + k < text.size() ? text[i + k] : 0);
      good = (next & 0xc0) == 0x80;
      point = point << 6 | (next & 0x3f);
    }
    points += good ? point : U'\uFFFD';
    i += good ? length : 1;
  }
  return points;
}

/// "<f8", "|u1", "|b1"
std::string numpy_type(fulmar_kind kind) {
  const char letter = kind == FULMAR_ENUM ? 'u' : kind_word(kind)[0];
  return (primitive_size(kind) == 1 ? "|" : "<") + (letter + std::to_string(primitive_size(kind)));
}

}  // namespace

NpzWriter::NpzWriter(const std::filesystem::path& file) : file_(file) {
  if (std::filesystem::exists(file)) throw Error(log_tool_messages::export_exists(file.string()));
  out_.open(file.string() + ".part", std::ios::binary | std::ios::trunc);
  if (!out_) throw Error(log_tool_messages::file_not_writable(file.string()));
}

void NpzWriter::write(const std::string& bytes) {
  if (!out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw Error(log_tool_messages::disk_write_failed(file_.string()));
  place_ += bytes.size();
}

void NpzWriter::entry(const std::string& name, const std::string& header, std::span<const std::byte> data) {
  const std::uint64_t size = header.size() + data.size();
  if (size > largest_32 / 2 || place_ + size > largest_32 ||
      entries_.size() >= std::numeric_limits<std::uint16_t>::max())
    throw Error(log_tool_messages::npz_too_large());
  std::string content = deflate_both(header, data);
  Entry e{name + ".npy",
          entry_crc(header, data),
          0,
          static_cast<std::uint32_t>(size),
          static_cast<std::uint32_t>(place_),
          deflated};
  if (content.size() >= size) {
    content = header + std::string(reinterpret_cast<const char*>(data.data()), data.size());
    e.method = 0;
  }
  e.stored = static_cast<std::uint32_t>(content.size());
  write("PK\3\4" +
        little_endian(version, utf8_names, e.method, std::uint16_t{0}, first_date, e.crc, e.stored, e.size,
                      static_cast<std::uint16_t>(e.name.size()), std::uint16_t{0}) +
        e.name);
  write(content);
  entries_.push_back(std::move(e));
}

void NpzWriter::add(const std::string& name, const std::string& type, std::size_t count,
                    std::span<const std::byte> data) {
  entry(name, npy_header(type, count), data);
}

void NpzWriter::add(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<std::u32string> points;
  std::size_t width = 1;
  for (const std::string& t : texts) {
    points.push_back(code_points(t));
    width = std::max(width, points.back().size());
  }
  if (width * texts.size() > largest_32 / 8) throw Error(log_tool_messages::npz_text_too_large(name));
  std::vector<std::byte> data(texts.size() * width * 4);
  for (std::size_t i = 0; i < points.size(); ++i)
    std::memcpy(data.data() + i * width * 4, points[i].data(), points[i].size() * 4);
  add(name, "<U" + std::to_string(width), texts.size(), data);
}

void NpzWriter::finish() {
  const std::uint64_t start = place_;
  for (const Entry& e : entries_) {
    write("PK\1\2" +
          little_endian(version, version, utf8_names, e.method, std::uint16_t{0}, first_date, e.crc, e.stored,
                        e.size, static_cast<std::uint16_t>(e.name.size()), std::uint16_t{0}, std::uint16_t{0},
                        std::uint16_t{0}, std::uint16_t{0}, std::uint32_t{0}, e.place) +
          e.name);
  }
  const auto count = static_cast<std::uint16_t>(entries_.size());
  if (place_ > largest_32) throw Error(log_tool_messages::npz_too_large());
  write("PK\5\6" + little_endian(std::uint16_t{0}, std::uint16_t{0}, count, count,
                                 static_cast<std::uint32_t>(place_ - start),
                                 static_cast<std::uint32_t>(start), std::uint16_t{0}));
  out_.close();
  if (!out_) throw Error(log_tool_messages::disk_write_failed(file_.string()));
  std::filesystem::rename(file_.string() + ".part", file_);
}

void export_npz(const Tables& tables, const std::filesystem::path& file) {
  NpzWriter out(file);
  for_each_table(tables, [&](const Table& table, const std::vector<Array>& arrays) {
    for (const Array& a : arrays) {
      const std::string name = table.name + "." + a.name;
      if (a.kind == FULMAR_TEXT) {
        out.add(name, a.texts);
      } else {
        out.add(name, numpy_type(a.kind), table.rows, a.data);
      }
      if (!a.labels.empty()) out.add(name + ".labels", a.labels);
    }
  });
  out.finish();
}

}  // namespace fulmar::core
