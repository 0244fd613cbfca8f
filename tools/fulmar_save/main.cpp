// SPDX-License-Identifier: BSD-3-Clause
// The program fulmar-save, which the live view of a flight starts: a request in JSON on standard input, the
// answer in JSON on standard output (answer.hpp). Exit codes: 0 answered; 2 the input is no request.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tools/fulmar_save/answer.hpp"

int main() {
  using nlohmann::json;
  const json request = json::parse(std::cin, nullptr, false);
  if (!request.is_object()) {
    std::fputs("fulmar-save reads a request in JSON, from the live view of a flight\n", stderr);
    return 2;
  }
  const json answer = fulmar::core::save_answer(request);
  std::cout << answer.dump(-1, ' ', false, json::error_handler_t::replace);
  return std::cout.flush() ? 0 : 1;
}
