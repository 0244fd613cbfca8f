// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/compare.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <set>
#include <vector>

namespace fulmar::core {
namespace {

/// Keys without a figure of the flight, or that differ between equal flights.
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

/// Adds null for a figure that one of the two does not have.
void add_missing(const nlohmann::json& has, const nlohmann::json& lacks, const std::string& path, bool before,
                 FigureChanges& found) {
  for (const auto& [key, value] : has.items()) {
    if (lacks.contains(key) || !value.is_primitive() || value.is_null()) continue;
    const nlohmann::json none;
    found.changed.push_back({path + "." + key, before ? value : none, before ? none : value});
  }
}

void walk(const nlohmann::json& before, const nlohmann::json& after, const std::string& path,
          FigureChanges& found) {
  for (const auto& [key, now] : after.items()) {
    if ((path.empty() && passed_over(key)) || !before.contains(key)) continue;
    const nlohmann::json& was = before.at(key);
    const std::string name = path.empty() ? key : path + "." + key;
    if (now.is_object() && was.is_object()) {
      walk(was, now, name, found);
    } else if (now.is_primitive() && was.is_primitive()) {
      if (now == was)
        ++found.equal;
      else
        found.changed.push_back({name, was, now});
    }
  }
  if (path.empty()) return;  // metadata of the log and the result
  add_missing(before, after, path, true, found);
  add_missing(after, before, path, false, found);
}

std::string line_of(const FigureChanges::Change& c) {
  if (!c.before.is_number() || !c.after.is_number())
    return fmt::format("  {:<44} {:>12} {:>12}\n", c.name, words(c.before), words(c.after));
  const double a = c.before.get<double>(), b = c.after.get<double>();
  return fmt::format("  {:<44} {:12.4g} {:12.4g} {:+9.1f} %\n", c.name, a, b,
                     a != 0 ? 100 * (b - a) / std::abs(a) : 0);
}

}  // namespace

FigureChanges figure_changes(const nlohmann::json& before, const nlohmann::json& after) {
  FigureChanges found;
  if (before.is_object() && after.is_object()) walk(before, after, "", found);
  return found;
}

std::string comparison(const FigureChanges& changes, const Sides& sides) {
  if (changes.changed.empty()) return fmt::format("\n{}: no figure has changed\n", sides.heading);
  std::string out =
      fmt::format("\n{:<46} {:>12} {:>12} {:>11}\n", sides.heading, sides.before, sides.after, "change");
  for (const FigureChanges::Change& c : changes.changed) out += line_of(c);
  if (changes.equal > 0)
    out += fmt::format("  {} not changed\n",
                       changes.equal == 1 ? "1 figure has" : fmt::format("{} figures have", changes.equal));
  return out;
}

std::string comparison(const nlohmann::json& before, const nlohmann::json& after) {
  return comparison(figure_changes(before, after));
}

}  // namespace fulmar::core
