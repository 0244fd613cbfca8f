// SPDX-License-Identifier: BSD-3-Clause
// Set-up errors: one exception type, whose message has a code, a place and arguments (fulmar/diagnostic.hpp).
// Nothing here is used in a tick.
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fulmar/diagnostic.hpp"

namespace fulmar::core {

struct Error : std::runtime_error {
  explicit Error(Diagnostic message) : std::runtime_error(message.line()), diagnostic(std::move(message)) {}
  /// Several faults of one file or mission: one per line.
  explicit Error(std::vector<Diagnostic> faults);
  Diagnostic diagnostic;
  std::vector<Diagnostic> several;  // empty for a single fault
};

/// A place in a file: "hourglass.yaml:12". Line 0: the file as a whole.
struct Where {
  std::string file;
  int line = 0;
  std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
};

using fulmar::located;
/// Adds the file and line to a message.
inline Diagnostic located(const Where& where, Diagnostic message) {
  message.place = where.text();
  return message;
}

/// The name in `choices` nearest to `name` by edit distance, or "" when none is near. For "did you mean".
std::string nearest(std::string_view name, const std::vector<std::string>& choices);

/// "a, b, c", or "none" for an empty list.
std::string join(const std::vector<std::string>& words);

/// " Did you mean 'height_m'? Valid: a, b, c." with the first sentence only when a name is near.
std::string choices_text(std::string_view name, const std::vector<std::string>& choices);

}  // namespace fulmar::core
