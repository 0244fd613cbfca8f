// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/compare.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace fulmar::core {
namespace {

/// What says nothing of how it flew, or differs between equal flights.
bool passed_over(const std::string& key) {
  static const std::set<std::string> keys{"wall_time_s", "speedup",      "step_time_us", "not_reproducible",
                                          "log_bytes",   "log_messages", "log_sha256",   "log",
                                          "seed",        "live",         "dds",          "allocations",
                                          "misses",      "log_error",    "phases",       "guards",
                                          "behind_max_s"};
  return keys.contains(key);
}

std::string words(const nlohmann::json& value) {
  return (value.is_string() ? value.get<std::string>() : value.dump()).substr(0, 40);
}

void walk(const nlohmann::json& before, const nlohmann::json& after, const std::string& path,
          std::vector<std::string>& lines, int& equal) {
  for (const auto& [key, now] : after.items()) {
    if ((path.empty() && passed_over(key)) || !before.contains(key)) continue;
    const nlohmann::json& was = before.at(key);
    const std::string name = path.empty() ? key : path + "." + key;
    if (now.is_object() && was.is_object()) {
      walk(was, now, name, lines, equal);
      continue;
    }
    if (!now.is_primitive() || !was.is_primitive()) continue;
    if (now == was) {
      ++equal;
      continue;
    }
    if (now.is_number() && was.is_number()) {
      const double a = was.get<double>(), b = now.get<double>();
      lines.push_back(fmt::format("  {:<44} {:12.4g} {:12.4g} {:+9.1f} %\n", name, a, b,
                                  a != 0 ? 100 * (b - a) / std::abs(a) : 0));
    } else {
      lines.push_back(fmt::format("  {:<44} {:>12} {:>12}\n", name, words(was), words(now)));
    }
  }
}

}  // namespace

std::string comparison(const nlohmann::json& before, const nlohmann::json& after) {
  std::vector<std::string> lines;
  int equal = 0;
  walk(before, after, "", lines, equal);
  if (lines.empty()) return "\ncompared with the flight before: no figure has changed\n";
  std::string out = fmt::format("\n{:<46} {:>12} {:>12} {:>11}\n", "compared with the flight before",
                                "before", "now", "change");
  for (const std::string& line : lines) out += line;
  if (equal > 0)
    out += "  " + std::to_string(equal) + (equal == 1 ? " figure has" : " figures have") + " not changed\n";
  return out;
}

}  // namespace fulmar::core
