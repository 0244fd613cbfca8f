// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/error.hpp"

namespace fulmar::core::test {

/// The message with which `call` is rejected; "" when it is accepted.
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
