// SPDX-License-Identifier: BSD-3-Clause
// XCDR1 of the host's own services: texts without a bound, and answers. Little endian.
#include <bit>
#include <cstring>

#include "core/error.hpp"
#include "core/live/describe.hpp"

namespace fulmar::core::live {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::string_view header{"\0\1\0\0", 4};

void put_text(std::string& out, std::string_view text) {
  while ((out.size() - header.size()) % 4 != 0) out += '\0';
  const auto size = static_cast<std::uint32_t>(text.size() + 1);
  out.append(reinterpret_cast<const char*>(&size), sizeof size).append(text) += '\0';
}

}  // namespace

std::string cdr_answer(bool accepted, std::string_view reason) {
  std::string out(header);
  out += accepted ? '\1' : '\0';
  put_text(out, reason);
  return out;
}

std::string cdr_text(std::string_view text) {
  std::string out(header);
  put_text(out, text);
  return out;
}

std::vector<std::string> cdr_texts(std::string_view bytes, std::size_t count) {
  if (bytes.size() < header.size() || bytes.substr(0, 2) != header.substr(0, 2)) throw Error("the request has no little-endian CDR header");
  bytes.remove_prefix(header.size());
  std::vector<std::string> texts;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    at = (at + 3) / 4 * 4;
    std::uint32_t size = 0;
    if (at > bytes.size() || bytes.size() - at < sizeof size) throw Error("the request ends before its text " + std::to_string(i + 1));
    std::memcpy(&size, bytes.data() + at, sizeof size);
    at += sizeof size;
    if (size == 0 || size > bytes.size() - at || bytes[at + size - 1] != '\0')
      throw Error("text " + std::to_string(i + 1) + " of the request does not end in NUL within it");
    texts.emplace_back(bytes.substr(at, size - 1));
    at += size;
  }
  return texts;
}

}  // namespace fulmar::core::live
