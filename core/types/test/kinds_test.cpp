// SPDX-License-Identifier: BSD-3-Clause
// The table of kinds against the C++ types of message fields.
#include "core/types/kinds.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <type_traits>

namespace kinds_test {

using namespace fulmar::core;

TEST_CASE("the row of a kind has the size, sign and names of its C++ type") {
  const std::array<std::byte, 8> zero{};
  for (const KindRow& row : kind_rows) {
    CAPTURE(row.word);
    if (row.bytes == 0) continue;  // text and structs
    with_number(row.kind, zero.data(), [&](auto x) {
      using T = decltype(x);
      CHECK(sizeof(T) == row.bytes);
      CHECK(std::is_floating_point_v<T> == is_real(row.kind));
      if (!is_real(row.kind) && !is_integer(row.kind)) return;  // a bool or an enum
      const std::string letter = is_real(row.kind) ? "f" : std::is_signed_v<T> ? "i" : "u";
      const std::string begin = is_real(row.kind) ? "float" : std::is_signed_v<T> ? "int" : "uint";
      CHECK(row.word == letter + std::to_string(8 * sizeof(T)));
      CHECK(row.ros == begin + std::to_string(8 * sizeof(T)));
    });
  }
}

TEST_CASE("an element that is no number gives nan") {
  const std::array<std::byte, 8> zero{};
  for (const fulmar_kind kind : {FULMAR_TEXT, FULMAR_STRUCT}) {
    CHECK(primitive_size(kind) == 0);
    CHECK(with_number(kind, zero.data(), [](auto x) { return std::isnan(static_cast<double>(x)); }));
  }
}

}  // namespace kinds_test
