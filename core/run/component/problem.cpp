// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/problem.hpp"

#include <algorithm>

namespace fulmar::core {

void put_problem(fulmar_error& problem, std::string_view text) noexcept {
  const std::size_t size = std::min(text.size(), sizeof problem.text - 1);
  std::copy_n(text.data(), size, problem.text);
  problem.text[size] = '\0';
}

}  // namespace fulmar::core
