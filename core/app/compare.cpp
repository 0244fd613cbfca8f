// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/compare.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

namespace fulmar::core {
namespace {

/// What says nothing of how it flew, or differs between equal flights.
bool passed_over(const std::string& key) {
  for (const char* name :
       {"wall_time_s", "speedup", "step_time_us", "not_reproducible", "log_bytes", "log_messages",
        "log_sha256", "log", "seed", "live", "dds", "allocations", "misses", "log_error", "phases", "guards"})
    if (key == name) return true;
  return false;
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
    char text[256];
    if (now.is_number() && was.is_number()) {
      const double a = was.get<double>(), b = now.get<double>();
      const double percent = a != 0 ? 100 * (b - a) / std::abs(a) : 0;
      std::snprintf(text, sizeof text, "  %-44s %12.4g %12.4g %+9.1f %%\n", name.c_str(), a, b, percent);
    } else {
      const auto words = [](const nlohmann::json& j) {
        return j.is_string() ? j.get<std::string>() : j.dump();
      };
      std::snprintf(text, sizeof text, "  %-44s %12s %12s\n", name.c_str(), words(was).substr(0, 40).c_str(),
                    words(now).substr(0, 40).c_str());
    }
    lines.push_back(text);
  }
}

}  // namespace

std::string comparison(const nlohmann::json& before, const nlohmann::json& after) {
  std::vector<std::string> lines;
  int equal = 0;
  walk(before, after, "", lines, equal);
  if (lines.empty()) return "\ncompared with the flight before: no figure has changed\n";
  char head[128];
  std::snprintf(head, sizeof head, "\n%-46s %12s %12s %11s\n", "compared with the flight before", "before",
                "now", "change");
  std::string out = head;
  for (const std::string& line : lines) out += line;
  if (equal > 0)
    out += "  " + std::to_string(equal) + (equal == 1 ? " figure has" : " figures have") + " not changed\n";
  return out;
}

}  // namespace fulmar::core
