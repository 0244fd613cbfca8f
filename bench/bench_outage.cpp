// SPDX-License-Identifier: BSD-3-Clause
// Drift of the estimate without GNSS. Flies a recorded flight once for each outage, with its fixes withheld
// for a while, and compares the estimate with the last withheld fix at its time of validity. It also flies
// once with all fixes and compares with each of them. Exits 1 when a flight fails.
// bench_outage LOG.yaml --folder FOLDER --starts 280,310,... [--seconds N] [--mission FILE.yaml]
//              [--set COMPONENT.PARAMETER=VALUE]... [--with COMPONENT=PLUGIN.so]... [--json]
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/outage/outages.hpp"

using namespace fulmar::outage;

namespace {

const char* const usage =
    "usage: bench_outage LOG.yaml --folder FOLDER --starts 280,310,... [--seconds N] [--mission FILE.yaml]\n"
    "                    [--set COMPONENT.PARAMETER=VALUE]... [--with COMPONENT=PLUGIN.so]... [--json]";

struct Options {
  Recipe recipe;
  std::vector<double> starts_s;
  double seconds = 30;
  bool json = false;
};

double number(const std::string& word) {
  std::size_t end = 0;
  const double value = std::stod(word, &end);
  if (end != word.size() || !std::isfinite(value)) throw std::invalid_argument(word);
  return value;
}

std::pair<std::string, std::string> pair_of(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == 0 || equals == std::string::npos) throw std::invalid_argument(word);
  return {word.substr(0, equals), word.substr(equals + 1)};
}

void read_value(Options& o, const std::string& word, const std::string& value) {
  if (word == "--folder")
    o.recipe.folder = value;
  else if (word == "--mission")
    o.recipe.mission = value;
  else if (word == "--seconds")
    o.seconds = number(value);
  else if (word == "--set")
    o.recipe.overrides.set.push_back(pair_of(value));
  else if (word == "--with")
    o.recipe.overrides.with.push_back(pair_of(value));
  else if (word == "--starts")
    for (std::size_t from = 0; from <= value.size();) {
      const std::size_t comma = std::min(value.find(',', from), value.size());
      o.starts_s.push_back(number(value.substr(from, comma - from)));
      from = comma + 1;
    }
  else
    throw std::invalid_argument(word);
}

Options options_of(int count, char** words) {
  Options o;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--json")
      o.json = true;
    else if (word.starts_with("--") && i + 1 < count)
      read_value(o, word, words[++i]);
    else if (!word.starts_with("--") && o.recipe.log.empty())
      o.recipe.log = word;
    else
      throw std::invalid_argument(word);
  }
  if (o.recipe.log.empty() || o.recipe.folder.empty() || o.starts_s.empty() || !(o.seconds > 0))
    throw std::invalid_argument("");
  return o;
}

struct Summary {
  double median = 0, p90 = 0, max = 0, rms_m = 0, claimed_m = 0;
  Summary(const std::vector<double>& errors, const std::vector<double>& claims)
      : median(quantile(errors, 0.5)),
        p90(quantile(errors, 0.9)),
        max(quantile(errors, 1)),
        rms_m(rms(errors)),
        claimed_m(rms(claims)) {}
  nlohmann::json json() const {
    return {{"median_m", median}, {"p90_m", p90},           {"max_m", max},
            {"rms_m", rms_m},     {"claimed_m", claimed_m}, {"rms_over_claimed", rms_m / claimed_m}};
  }
  void print(const char* name) const {
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.2f |\n", name, median, p90, max, rms_m,
                claimed_m, rms_m / claimed_m);
  }
};

nlohmann::json json_of(const Aided& a) {
  return {{"fixes", a.fixes},           {"horizontal_rms_m", a.horizontal_m},
          {"height_rms_m", a.height_m}, {"height_claimed_m", a.height_claimed_m},
          {"height_step_m", a.step_m},  {"velocity_down_rms_mps", a.down_mps}};
}

void report(const Options& o, const std::vector<Outcome>& all, const Aided& aided) {
  std::vector<double> errors, claims, heights, height_claims;
  for (const Outcome& each : all) {
    errors.push_back(each.horizontal_m);
    claims.push_back(each.claimed_m);
    heights.push_back(std::abs(each.height_m));
    height_claims.push_back(each.height_claimed_m);
  }
  const Summary horizontal(errors, claims), height(heights, height_claims);
  if (o.json) {
    nlohmann::json json = {
        {"seconds", o.seconds}, {"horizontal", horizontal.json()}, {"height", height.json()}};
    json["with_fixes"] = json_of(aided);
    for (const Outcome& each : all)
      json["outages"].push_back({{"start_s", each.start_s},
                                 {"after_s", each.after_s},
                                 {"horizontal_m", each.horizontal_m},
                                 {"claimed_m", each.claimed_m},
                                 {"height_m", each.height_m},
                                 {"height_claimed_m", each.height_claimed_m}});
    std::printf("%s\n", json.dump(2).c_str());
    return;
  }
  std::printf("| outage at, s | horizontal, m | claimed | height, m | claimed |\n|---|---|---|---|---|\n");
  for (const Outcome& each : all)
    std::printf("| %.0f | %.1f | %.1f | %.1f | %.1f |\n", each.start_s, each.horizontal_m, each.claimed_m,
                each.height_m, each.height_claimed_m);
  std::printf("\n%zu outages of %g s\n\n", all.size(), o.seconds);
  std::printf("| m | median | p90 | max | rms | claimed | rms / claimed |\n|---|---|---|---|---|---|---|\n");
  horizontal.print("horizontal");
  height.print("height");
  std::printf(
      "\nWith all %d fixes in the air, rms from the receiver: height %.2f m (claimed %.2f), "
      "largest step %.2f m; velocity down %.2f m/s\n",
      aided.fixes, aided.height_m, aided.height_claimed_m, aided.step_m, aided.down_mps);
}

}  // namespace

int main(int count, char** words) {
  Options o;
  try {
    o = options_of(count, words);
  } catch (const std::logic_error&) {
    std::fprintf(stderr, "%s\n", usage);
    return 2;
  }
  try {
    const Outages outages(o.recipe);
    std::vector<Outcome> all;
    for (const double start_s : o.starts_s) all.push_back(outages.fly(start_s, o.seconds));
    report(o, all, outages.aided());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
