// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/error.hpp"

namespace fulmar::core::test {

/// The sentence with which `call` is refused; "" when it is not.
template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace fulmar::core::test
