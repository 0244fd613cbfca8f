// SPDX-License-Identifier: BSD-3-Clause
// Texts of set-up errors: lists of choices and the nearest name.
#include "core/error.hpp"

#include <algorithm>
#include <cstddef>

namespace fulmar::core {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Edit distance in which a swap of two neighbours counts as one edit (optimal string alignment), case
// ignored.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> before(width), above(width), row(width);
  for (std::size_t j = 0; j < width; ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j < width; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

}  // namespace

Error::Error(std::vector<Diagnostic> faults)
    : std::runtime_error([&] {
        std::string lines;
        for (const Diagnostic& fault : faults) lines += (lines.empty() ? "" : "\n") + fault.line();
        return lines;
      }()),
      diagnostic(what()),
      several(std::move(faults)) {}

std::string nearest(std::string_view name, const std::vector<std::string>& choices) {
  constexpr std::size_t longest = 200;  // a longer name is not a typing error
  if (name.empty() || name.size() > longest) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, (name.size() + 2) / 3) + 1;
  for (const std::string& choice : choices) {
    if (choice.empty() || choice.size() > longest) continue;
    const std::size_t distance = edit_distance(name, choice);
    // a word with every letter replaced is not near, however short
    if (distance >= std::max(name.size(), choice.size())) continue;
    if (distance < best_distance) {
      best = choice;
      best_distance = distance;
    }
  }
  return best;
}

std::string join(const std::vector<std::string>& words) {
  if (words.empty()) return "none";
  std::string text = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) text += ", " + words[i];
  return text;
}

std::string choices_text(std::string_view name, const std::vector<std::string>& choices) {
  const std::string near = nearest(name, choices);
  if (writes_codes()) return " [" + near + "] " + join(choices);
  const std::string hint = near.empty() ? "" : " Did you mean '" + near + "'?";
  return hint + " Valid: " + join(choices) + ".";
}

}  // namespace fulmar::core
