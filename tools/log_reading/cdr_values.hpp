// SPDX-License-Identifier: BSD-3-Clause
// The values of a message of any program, for comparison and output of logs.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::core {

/// A number, text or label in a message.
struct CdrValue {
  std::string name;  // "legs[1].position_m.north"
  std::string text;  // of a number the shortest that reads back the same, or the name of its constant
};
/// All values of a message whose type has no layout, in the order of its bytes. Throws Error when the bytes
/// do not fit the type, or hold more than `most`.
std::vector<CdrValue> cdr_values(const Type& schema, std::span<const std::byte> message, std::size_t most);

}  // namespace fulmar::core
