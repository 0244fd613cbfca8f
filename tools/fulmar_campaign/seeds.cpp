// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_campaign/seeds.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

constexpr std::uint64_t max_seeds = 100'000;

bool whole(const std::string& text, std::uint64_t& number) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc{} && end == text.data() + text.size() && !text.empty();
}

/// Keys of a result that are no figures of the flight.
bool passed_by(const std::string& key) {
  static const std::set<std::string> keys{"allocations",  "behind_max_s", "dds",  "live",
                                          "log_dropped",  "misses",       "seed", "speedup",
                                          "step_time_us", "wall_time_s"};
  return keys.contains(key);
}

bool flown(const json& result) { return result.value("result", "").starts_with("flown"); }

using Values = std::map<std::string, std::vector<double>>;  // by JSON pointer

void collect(const json& result, Values& values) {
  const auto add = [&](const std::string& path, const json& value) {
    if (value.is_number()) values[path].push_back(value.get<double>());
  };
  for (const auto& [key, value] : result.items()) {
    if (passed_by(key)) continue;
    add("/" + key, value);
    if (!value.is_object()) continue;
    for (const auto& [name, figure] : value.items()) add("/" + key + "/" + name, figure);
  }
}

struct Spread {
  double mean = 0, deviation = 0, least = 0, most = 0;
};

Spread spread_of(const std::vector<double>& v) {
  Spread s{0, 0, *std::min_element(v.begin(), v.end()), *std::max_element(v.begin(), v.end())};
  const auto n = static_cast<double>(v.size());
  for (const double x : v) s.mean += x / n;
  for (const double x : v) s.deviation += (x - s.mean) * (x - s.mean);
  s.deviation = v.size() > 1 ? std::sqrt(s.deviation / (n - 1)) : 0;
  return s;
}

Values values_of(const std::vector<json>& results) {
  Values values;
  for (const json& result : results)
    if (flown(result)) collect(result, values);
  return values;
}

auto count_flown(const std::vector<json>& results) {
  return std::count_if(results.begin(), results.end(), flown);
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  const auto wrong = [&] {
    return Error("--seeds '" + text + "': give seeds such as 1..20 or 3,5,8..10, at most " +
                 std::to_string(max_seeds));
  };
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string part = text.substr(from, comma - from);
    const std::size_t dots = part.find("..");
    std::uint64_t first = 0, last = 0;
    if (!whole(part.substr(0, dots), first) ||
        !whole(dots == std::string::npos ? part : part.substr(dots + 2), last) || last < first ||
        last - first >= max_seeds - std::min<std::uint64_t>(seeds.size(), max_seeds))
      throw wrong();
    for (std::uint64_t n = 0; n <= last - first; ++n) seeds.push_back(first + n);
    from = comma + 1;
  }
  return seeds;
}

json spread(const std::vector<json>& results) {
  json mean = json::object(), deviation = json::object(), least = json::object(), most = json::object();
  for (const auto& [path, values] : values_of(results)) {
    const json::json_pointer at(path);
    const Spread s = spread_of(values);
    mean[at] = s.mean;
    least[at] = s.least;
    most[at] = s.most;
    deviation[at] = values.size() > 1 ? json(s.deviation) : json(nullptr);
  }
  return {{"mean", mean},
          {"deviation", deviation},
          {"least", least},
          {"most", most},
          {"flown", count_flown(results)}};
}

std::string spread_table(const std::vector<json>& results) {
  std::string out = fmt::format("\n{:<46} {:>11} {:>11} {:>11} {:>11}\n",
                                fmt::format("{} of {} flights flown", count_flown(results), results.size()),
                                "mean", "deviation", "least", "most");
  for (auto [path, values] : values_of(results)) {
    std::string name = path.substr(1);
    std::replace(name.begin(), name.end(), '/', '.');
    const Spread s = spread_of(values);
    out += fmt::format("  {:<44} {:11.4g} {:11.4g} {:11.4g} {:11.4g}\n", name, s.mean, s.deviation, s.least,
                       s.most);
  }
  return out;
}

}  // namespace fulmar::core
