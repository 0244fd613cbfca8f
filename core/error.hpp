// SPDX-License-Identifier: BSD-3-Clause
// Set-up errors: one exception type, one sentence with file:line and the valid choices. Nothing here is used
// in a tick.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fulmar::core {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A place in a file, as people say it: "hourglass.yaml:12". Line 0: the file as a whole.
struct Where {
  std::string file;
  int line = 0;
  std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

/// The name in `choices` nearest to `name` by edit distance, or "" when none is near. For "did you mean".
std::string nearest(std::string_view name, const std::vector<std::string>& choices);

/// "a, b, c", or "none" for an empty list.
std::string join(const std::vector<std::string>& words);

/// " Did you mean 'height_m'? Valid: a, b, c." with the first sentence only when a name is near.
std::string choices_text(std::string_view name, const std::vector<std::string>& choices);

}  // namespace fulmar::core
