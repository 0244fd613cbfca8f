// SPDX-License-Identifier: BSD-3-Clause
// Output of the log subcommands on a terminal.
#pragma once
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

namespace fulmar::core {

inline double seconds(std::int64_t ns) { return static_cast<double>(ns) / 1e9; }

// A log may hold any bytes; control characters must not reach a terminal.
inline std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

inline void print_json(const nlohmann::json& object) {
  std::cout << object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace fulmar::core
