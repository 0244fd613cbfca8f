// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "fulmar/abi.h"

namespace fulmar::core {

void put_problem(fulmar_error& problem, const char* format, ...) noexcept;

}  // namespace fulmar::core
