// SPDX-License-Identifier: BSD-3-Clause
// See columns.hpp.
#include "tools/fulmar_report/columns.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "tools/fulmar_report/messages.hpp"

namespace fulmar::report {
namespace {

void add_planes(std::string& to, const std::vector<std::uint32_t>& words) {
  for (int shift = 0; shift < 32; shift += 8)
    for (const std::uint32_t word : words) to += static_cast<char>(word >> shift & 0xff);
}

}  // namespace

std::string packed(const Columns& columns) {
  std::string all;
  std::vector<std::uint32_t> words(columns.t.size());
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto now = static_cast<std::uint32_t>(columns.t[i]);
    words[i] = now - before;
    before = now;
  }
  add_planes(all, words);
  for (const std::vector<float>& column : columns.values) {
    before = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto now = std::bit_cast<std::uint32_t>(column.at(i));
      words[i] = now ^ before;
      before = now;
    }
    add_planes(all, words);
  }
  return base64(compressed(all));
}

std::string packed(const std::vector<std::string>& messages) {
  std::string all;
  for (const std::string& message : messages) {
    const auto size = static_cast<std::uint32_t>(message.size());
    for (int shift = 0; shift < 32; shift += 8) all += static_cast<char>(size >> shift & 0xff);
    all += message;
  }
  return base64(compressed(all));
}

Columns thinned_to_peaks(const Columns& series, std::size_t most) {
  if (series.t.size() <= most || most == 0) return series;
  Columns out;
  out.values.resize(series.values.size());
  const auto ends = std::minmax_element(series.t.begin(), series.t.end());
  const double first = *ends.first, part = (*ends.second - first + 1) / static_cast<double>(most);
  const auto part_of = [&](std::size_t i) { return static_cast<std::size_t>((series.t[i] - first) / part); };
  for (std::size_t i = 0; i < series.t.size();) {
    std::size_t peak = i;
    const std::size_t here = part_of(i);
    for (; i < series.t.size() && part_of(i) == here; ++i)
      if (std::abs(series.values[0][i]) > std::abs(series.values[0][peak])) peak = i;
    out.t.push_back(series.t[peak]);
    for (std::size_t k = 0; k < out.values.size(); ++k) out.values[k].push_back(series.values[k][peak]);
  }
  return out;
}

Columns every(const Columns& columns, std::size_t n) {
  Columns out;
  out.values.resize(columns.values.size());
  for (std::size_t i = 0; i < columns.t.size(); i += n) {
    out.t.push_back(columns.t[i]);
    for (std::size_t k = 0; k < out.values.size(); ++k) out.values[k].push_back(columns.values[k][i]);
  }
  return out;
}

std::int32_t tenths_of_ms(std::int64_t ns) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::round(1e-5 * static_cast<double>(ns)), -most, most));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? letters[(word >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

std::string compressed(const std::string& bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string out(size, '\0');
  const int code = ::compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  if (code != Z_OK) throw core::Error(report_messages::compression_failed());
  out.resize(size);
  return out;
}

}  // namespace fulmar::report
