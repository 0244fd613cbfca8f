// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string_view>

#include "fulmar/abi.h"
#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

/// [tick] Writes a message, truncated to the room of `problem`.
void put_problem(fulmar_error& problem, std::string_view text) noexcept;
template <std::size_t N, class... Values>
void put_problem(fulmar_error& problem, const MessageText<N>& text, const Values&... values) noexcept {
  text.write(problem.text, sizeof problem.text, values...);
}

}  // namespace fulmar::core
