// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/problem.hpp"

#include <cstdarg>
#include <cstdio>

namespace fulmar::core {

void put_problem(fulmar_error& problem, const char* format, ...) noexcept {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(problem.text, sizeof problem.text, format, arguments);
  va_end(arguments);
}

}  // namespace fulmar::core
