// SPDX-License-Identifier: BSD-3-Clause
// A comparison of two estimates, as text and as JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/fulmar_log/comparison.hpp"

namespace fulmar::states {

struct Pair {
  Side first, second;
  std::string first_name, second_name;  // displayed names
  Comparison made;
};

std::string text_of(const Pair& pair);
nlohmann::json json_of(const Pair& pair);

}  // namespace fulmar::states
