// SPDX-License-Identifier: BSD-3-Clause
// The published attitude benchmark of the Skywalker X8 (attitude/suite.hpp), flown by the shipped control_slc
// with the gains of configs/airframes/x8.yaml, or by the PID of the publication. Exits 1 when a bar is
// missed.
//   bench_attitude [--episodes N] [--seed N] [--turbulence none|light|moderate|severe|all] [--law slc|pid]
//                  [--set COMPONENT.PARAM=NUMBER]... [--json]
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/attitude/flown.hpp"

using namespace fulmar;
using namespace fulmar::attitude;

namespace {

struct Options {
  std::uint64_t episodes = 300, seed = 1;
  std::string turbulence = "all", law = "slc";
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
      if (value != "slc" && value != "pid") throw Wrong("--law is " + value + "; there are slc, pid");
      o.law = value;
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
  gains.push_back({text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), value});
}

constexpr const char* page = R"(# Attitude from large upsets

Written by `build/bin/bench_attitude > docs/attitude.md`; nothing here is typed.

The attitude benchmark of E. Bohn, E. M. Coates, S. Moe, T. A. Johansen, *Deep Reinforcement Learning Attitude Control of Fixed-Wing UAVs Using Proximal Policy
Optimization* (ICUAS 2019), flown by `control_slc/Airspeed` and `control_slc/Inner` with the gains of `configs/airframes/x8.yaml`, one set for all rows: the Skywalker
X8, an unstable Dutch roll and no rudder, true state, 100 Hz.

- Start: roll within 60, pitch 25 deg, airspeed 17 to 28 m/s with up to 5 m/s of it sideways and 5 down or up, rates within 40 deg/s, throttle closed.
- Target: roll within 15, pitch 10 deg, airspeed within 3 m/s of the start's, so 14 to 31 m/s; it moves with the pitch that is asked for: down to 26.27 - 41.25 theta
  (theta in rad) in a climb of 5 deg and more, up to 28.4 - 40.1 theta in a descent of 2.5 deg and more.
- Success: roll and pitch within 5 deg and airspeed within 2 m/s for 100 steps on end, within 1500. Settling is the end of those 100; a failure counts 1500.
- Variation: mean of |rate| of elevator, aileron (rad) and throttle, averaged over the three, from the first command to the end of the episode; mean of the episodes.
- Turbulence: Dryden (MIL-F-8785C) of 100 m height and 25 m/s, 15, 30 and 45 knots at 20 ft, with rotational gusts.

`PID here` is the published PID with its published gains in this simulator; beside it what was published: how far apart the two simulators and draws of episodes are.
The bars: success of the best learnt policy, settling and variation of the published PID. The exit code is 1 when one is missed.

One setting differs from the shipped airframe: `limits.airspeed_max` is 40 m/s, as the suite asks for up to 35 m/s in descents; the file has 24 m/s. `success, file's limits` has
the file as shipped: an airspeed above 24 m/s is not flown then. The file's `pitch_trade` lets the airspeed law change the pitch by up to 4 deg where the throttle is at its stop: 31 m/s
at 5 deg of pitch is more than level flight gives at full throttle.

)";

Row flown(const Options& o, std::size_t level, const std::string& law, const Gains& gains,
          nlohmann::json& failed, Limits limits = Limits::suite) {
  const auto turbulence = static_cast<Turbulence>(level);
  std::vector<Result> results;
  for (std::uint64_t i = 0; i < o.episodes; ++i) {
    const Episode e = episode(o.seed, i);
    results.push_back(law == "pid" ? fly_published(e, turbulence)
                                   : fly_shipped(gains, e, turbulence, limits));
    if (!results.back().success) failed.push_back(i);
  }
  return summary(results);
}

std::string shown(const Row& r) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.0f | %.0f | %.2f", r.success_percent, r.settling_steps,
                r.variation_per_s);
  return text.data();
}

int run(const Options& o) {
  Gains gains = shipped_gains();
  for (const std::string& s : o.sets) apply(gains, s);
  check(gains);
  nlohmann::json all = nlohmann::json::object();
  bool good = true;
  if (!o.json)
    std::printf(
        "%s%llu episodes, seed %llu, law `%s`.\n\n"
        "| turbulence | success, %% | settling, steps | variation, 1/s | success, file's limits, %% | PID "
        "here "
        "| | | PID published | | | best policy published, success |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        page, static_cast<unsigned long long>(o.episodes), static_cast<unsigned long long>(o.seed),
        o.law.c_str());
  for (std::size_t level = 0; level < published.size(); ++level) {
    const Published& p = published[level];
    if (o.turbulence != "all" && o.turbulence != p.turbulence) continue;
    nlohmann::json failed = nlohmann::json::array(), unused = nlohmann::json::array();
    const Row row = flown(o, level, o.law, gains, failed);
    good = good && within(row, p);
    all[p.turbulence] = {{"success_percent", row.success_percent},
                         {"settling_steps", row.settling_steps},
                         {"control_variation_per_s", row.variation_per_s},
                         {"within", within(row, p)},
                         {"failed", failed}};
    if (!o.json)
      std::printf("| %s | %s | %.0f | %s | %s | %.0f |\n", p.turbulence, shown(row).c_str(),
                  flown(o, level, o.law, gains, unused, Limits::file).success_percent,
                  shown(flown(o, level, "pid", gains, unused)).c_str(), shown(p.pid).c_str(),
                  p.policy_percent);
  }
  if (all.empty())
    throw Wrong("--turbulence is " + o.turbulence + "; there are none, light, moderate, severe, all");
  if (o.json) std::printf("%s\n", all.dump(2).c_str());
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(options(argc, argv));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_attitude: %s\n", e.what());
    return 2;
  }
}
