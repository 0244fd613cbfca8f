// SPDX-License-Identifier: BSD-3-Clause
// The published attitude benchmark of the Skywalker X8 (attitude/suite.hpp), flown by the shipped control_slc
// with the gains of configs/airframes/x8.yaml.
//   bench_attitude [--episodes N] [--seed N] [--turbulence none|light|moderate|severe|all] [--law slc]
//                  [--set COMPONENT.PARAM=NUMBER]... [--json]
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/attitude/flown.hpp"
#include "bench/attitude/gains.hpp"

#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

using namespace fulmar;
using namespace fulmar::attitude;

namespace {

struct Options {
  std::uint64_t episodes = 100, seed = 1;
  std::string turbulence = "all";
  bool json = false;
  std::vector<std::string> sets;
};

std::uint64_t whole(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  unsigned long long n = 0;
  try {
    n = std::stoull(text, &used);
  } catch (const std::exception&) {
  }
  if (used == 0 || used != text.size() || text[0] == '-')
    throw Wrong(option + " is " + text + " and must be a whole number");
  return n;
}

Options options(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--json") {
      o.json = true;
      continue;
    }
    if (i + 1 >= argc) throw Wrong(name + " is no option, or lacks its value");
    const std::string value = argv[++i];
    if (name == "--episodes") {
      o.episodes = whole(name, value);
      if (o.episodes == 0) throw Wrong("--episodes is 0 and must be above 0");
    } else if (name == "--seed") {
      o.seed = whole(name, value);
    } else if (name == "--turbulence") {
      o.turbulence = value;
    } else if (name == "--law") {
      if (value != "slc") throw Wrong("--law is " + value + "; there is: slc");
    } else if (name == "--set") {
      o.sets.push_back(value);
    } else {
      throw Wrong("there is no option " + name +
                  "; there are --episodes, --seed, --turbulence, --law, --set, --json");
    }
  }
  return o;
}

void apply(Gains& gains, const std::string& text) {
  const std::size_t dot = text.find('.'), equals = text.find('=');
  double value = 0;
  try {
    value = std::stod(text.substr(equals + 1));
  } catch (const std::exception&) {
    throw Wrong("--set is " + text + " and must be COMPONENT.PARAM=NUMBER");
  }
  if (dot == std::string::npos || equals == std::string::npos || dot > equals)
    throw Wrong("--set is " + text + " and must be COMPONENT.PARAM=NUMBER");
  set(gains, text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), value);
}

int run(const Options& o) {
  const Airframe a = x8();
  Gains gains = shipped_gains();
  for (const std::string& s : o.sets) apply(gains, s);
  nlohmann::json all = nlohmann::json::object();
  bool known = false;
  if (!o.json)
    std::printf(
        "| turbulence | success, %% | settling, steps | variation, 1/s | PID, published | best policy, "
        "published |\n"
        "|---|---|---|---|---|---|\n");
  for (std::size_t level = 0; level < published.size(); ++level) {
    const Published& p = published[level];
    if (o.turbulence != "all" && o.turbulence != p.turbulence) continue;
    known = true;
    std::vector<Result> results;
    nlohmann::json failed = nlohmann::json::array();
    for (std::uint64_t i = 0; i < o.episodes; ++i) {
      results.push_back(fly(a, gains, episode(o.seed, i), static_cast<Turbulence>(level)));
      if (!results.back().success) failed.push_back(i);
    }
    const Row row = summary(results);
    all[p.turbulence] = {{"success_percent", row.success_percent},
                         {"settling_steps", row.settling_steps},
                         {"control_variation_per_s", row.variation_per_s},
                         {"failed", failed}};
    if (!o.json)
      std::printf("| %s | %.0f | %.0f | %.2f | %.0f, %.0f, %.2f | %.0f |\n", p.turbulence,
                  row.success_percent, row.settling_steps, row.variation_per_s, p.pid.success_percent,
                  p.pid.settling_steps, p.pid.variation_per_s, p.policy_percent);
  }
  if (!known)
    throw Wrong("--turbulence is " + o.turbulence + "; there are none, light, moderate, severe, all");
  if (o.json) std::printf("%s\n", all.dump(2).c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(options(argc, argv));
  } catch (const std::exception& e) {
    return std::fprintf(stderr, "bench_attitude: %s\n", e.what()), 2;
  }
}
