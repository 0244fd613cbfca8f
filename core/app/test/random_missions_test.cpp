// SPDX-License-Identifier: BSD-3-Clause
// Random missions from the shipped components, in which a random one fails (frail.cpp). Within 0.3 s of each
// stop, a component with live inputs is active or failsafe is announced. A flight that left its plan is not
// reported as flown. Each log replays byte for byte.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/app/report.hpp"
#include "core/graph/condition.hpp"
#include "core/run/component/allocation.hpp"
#include "tools/fulmar_replay/replay.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace random_missions_test {

constexpr std::int64_t patience_ns = 300'000'000;  // until a component is active, or failsafe
constexpr double astray_m = 300;

/// A random mission and its random faults.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {
    for (const char* name : {"truth", "plan", "manage", "follow", "slc", "tecs", "attitude"})
      frail_.emplace_back(name);
    second_chain_ = chance(0.5);
    whole_ = chance(0.5);
    second_inner_ = chance(0.5);
    components();
    phases();
  }
  std::string text() const { return text_; }

 private:
  bool chance(double p) { return std::uniform_real_distribution<>()(random_) < p; }
  double between(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  template <class T>
  T one_of(const std::vector<T>& list) {
    return list[std::uniform_int_distribution<std::size_t>(0, list.size() - 1)(random_)];
  }

  void component(const std::string& name, const std::string& keys, const std::string& params = "") {
    const bool child = chance(0.15), async = !child && chance(0.1);
    std::string all = params;
    if (name == victim_) {
      std::vector<std::string> faults = {"throws", "fails", "nan"};
      if (child && counts_allocations())
        faults = {"throws", "nan", "crashes", "aborts", "exits", "hangs", "hangs"};
      all += (all.empty() ? "" : ", ") + ("fault: " + one_of(faults)) +
             ", fault_at: " + std::to_string(between(-4, 32)) + " s";
    }
    text_ += "  " + name + ": {" + keys + (child ? ", run: process, hang: 300 ms" : "") +
             (async ? ", run: async, latency: " + one_of<std::string>({"10 ms", "20 ms", "50 ms"}) : "") +
             (all.empty() ? "" : ", params: {" + all + "}") + "}\n";
  }

  /// A wire; sometimes that of the previous tick.
  std::string from(const std::string& port) {
    return chance(0.2) ? "{from: " + port + ", delayed: true}" : port;
  }

  void components() {
    if (second_chain_) frail_.insert(frail_.end(), {"plan_two", "manage_two", "follow_two"});
    if (whole_) frail_.emplace_back("whole");
    if (second_inner_) frail_.emplace_back("inner_two");
    victim_ = one_of(frail_);
    const std::string file = "plan: " FULMAR_SOURCE_DIR "/configs/plans/hourglass.yaml";
    const double to = between(0, 6.283), speed = between(0, 6);
    text_ +=
        "components:\n  sim: {params: {sensors: " + one_of<std::string>({"perfect", "rosflight", "ublox"}) +
        ", turbulence: light, wind_ned: [" + std::to_string(speed * std::cos(to)) + ", " +
        std::to_string(speed * std::sin(to)) + ", 0]}}\n";
    component("truth", "use: frail/Truth, in: {truth: " + from("vehicle.truth") + "}");
    component("plan", "use: frail/Planner", file);
    component("manage",
              "use: frail/Manager, in: {state: " + from("nav.state") + ", plan: " + from("plan.plan") + "}");
    component("follow", "use: frail/Guide, rate: " + one_of<std::string>({"50 Hz", "100 Hz", "400 Hz"}));
    component("slc", "use: frail/Slc");
    component("tecs", "use: frail/Tecs");
    component("attitude", "use: frail/Inner");
    if (second_chain_) {
      component("plan_two", "use: frail/Planner, rate: 50 Hz, in: {state: nav.state}", file);
      component("manage_two", "use: frail/Manager, rate: 100 Hz, in: {state: nav.state, plan: " +
                                  from("plan_two.plan") + "}");
      component("follow_two",
                "fills: guide, use: frail/Guide, rate: 100 Hz, in: {path: " + from("manage_two.path") + "}");
    }
    if (whole_) component("whole", "fills: [outer, inner], use: frail/Both, rate: 100 Hz");
    if (second_inner_) component("inner_two", "fills: inner, use: frail/Inner, rate: 100 Hz");
  }

  /// "outer: {use: slc, fallback: tecs}"
  std::string role(const std::string& name, std::vector<std::string> candidates,
                   const std::string& set = "") {
    std::shuffle(candidates.begin(), candidates.end(), random_);
    const bool fallback = candidates.size() > 1 && chance(0.7);
    return name + ": {use: " + candidates[0] + set + (fallback ? ", fallback: " + candidates[1] : "") + "}";
  }

  std::string assignments(bool cruise) {
    const std::vector<std::string> guides =
        second_chain_ ? std::vector<std::string>{"follow", "follow_two"} : std::vector<std::string>{"follow"};
    const std::vector<std::string> inners = second_inner_ ? std::vector<std::string>{"attitude", "inner_two"}
                                                          : std::vector<std::string>{"attitude"};
    std::string text = role("nav", {"ekf", "truth"}) + ", " + role("guide", guides);
    if (cruise && whole_ && chance(0.5))
      return text + ", outer: {use: whole" + (chance(0.7) ? ", fallback: slc" : "") + "}";
    if (!cruise)
      return text + ", " + role("outer", {"slc", "tecs"}, ", set: {law: takeoff}") + ", " +
             role("inner", inners);
    return text + ", " + role("outer", {"slc", "tecs"}) + ", " + role("inner", inners);
  }

  void phases() {
    text_ += "phases:\n  takeoff: {" + assignments(false) +
             ", next: [{to: cruise, when: \"nav.state.height_m > 30 m\", for: 0.5 s}]}\n";
    text_ += "  cruise: {" + assignments(true);
    if (chance(0.5))
      text_ += ", next: [{to: change, when: \"nav.state.position_m.north > 100 m\"}]}\n  change: {" +
               assignments(true) + ", next: [{to: cruise, when: \"nav.state.position_m.north < -100 m\"}]}\n";
    else
      text_ += "}\n";
  }

  std::mt19937 random_;
  std::vector<std::string> frail_;
  std::string victim_, text_;
  bool second_chain_, whole_, second_inner_;
};

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-random-" + std::to_string(getpid()));
  Folder() {
    fs::create_directories(path);
    setenv("FULMAR_PLUGIN_PATH", FULMAR_TEST_PLUGIN_DIR, 1);
    setenv("FULMAR_STORE", (path / "store").c_str(), 1);
  }
  ~Folder() { fs::remove_all(path); }
};

Graph mission(const fs::path& folder, unsigned seed) {
  const fs::path file = folder / "random.yaml";
  const std::string configs = FULMAR_SOURCE_DIR "/configs/";
  std::ofstream(file)
      << "mission: random\nextends: " << configs << "missions/common.yaml\nairframe: " << configs
      << "airframes/anaconda.yaml\norigin: {lat: 40.2463724, lon: -111.6474138, alt_msl: 1387 m}\n"
      << "seed: " << seed << "\nlive: off\n"
      << Draw(seed).text();
  return load_mission(file.string());
}

/// Distance from the nearest leg of the hourglass; over the ground, with sharp corners.
double from_plan_m(double north, double east) {
  constexpr double corner[4][2] = {{400, -250}, {-400, -50}, {-400, -250}, {400, -50}};
  double least = 1e9;
  for (int i = 0; i < 4; ++i) {
    const double *a = corner[i], *b = corner[(i + 1) % 4];
    const double n = b[0] - a[0], e = b[1] - a[1];
    const double s = std::clamp(((north - a[0]) * n + (east - a[1]) * e) / (n * n + e * e), 0.0, 1.0);
    least = std::min(least, std::hypot(north - a[0] - s * n, east - a[1] - s * e));
  }
  return least;
}

struct Flown {
  FlightResult result;
  std::string word;
  double farthest_m = 0;
  std::vector<std::pair<std::int64_t, std::string>> failsafe;  // failsafe events and their times
};

Flown fly(const Graph& graph, const fs::path& log) {
  Flown flown;
  FlightOptions o;
  o.log_file = log;
  o.duration_s = 40;
  std::int64_t now_ns = 0;
  o.say = [&](const std::string& line, bool) {
    if (line.find("run.failsafe(") != std::string::npos) flown.failsafe.emplace_back(now_ns, line);
  };
  Flight flight(graph, o);
  const Component& vehicle = graph.components[static_cast<std::size_t>(graph.vehicle)];
  const int truth = vehicle.info().output("truth");
  const Type& type = *vehicle.info().outputs[static_cast<std::size_t>(truth)].type;
  const FieldRef north = resolve_field(type, "position_m.north"),
                 east = resolve_field(type, "position_m.east");
  do {
    now_ns = flight.now_ns();
    const std::byte* message = flight.sample({Source::Kind::component, graph.vehicle, truth});
    if (!message) continue;
    flown.farthest_m = std::max(flown.farthest_m, from_plan_m(number_at(*north.field, message + north.offset),
                                                              number_at(*east.field, message + east.offset)));
  } while (flight.step());
  flown.result = flight.finish();
  flown.word = result_word(flown.result);
  return flown;
}

/// Active components at a time, from the result of the flight: walks from the vehicle up to its sensors.
class Chain {
 public:
  Chain(const Graph& graph, const FlightResult& result, std::int64_t at_ns)
      : graph_(graph), result_(result), at_ns_(at_ns) {}

  /// The input that is fed by a stopped component, or by none; "": all are alive.
  std::string broken() { return broken(graph_.vehicle); }

 private:
  std::string broken(int component) {
    const Component& c = graph_.components[static_cast<std::size_t>(component)];
    if (std::find(seen_.begin(), seen_.end(), component) != seen_.end()) return "";
    seen_.push_back(component);
    for (const GuardEvent& guard : result_.guards)
      if (guard.component == c.name && guard.at_ns <= at_ns_ &&
          guard.what.find("run.cannot_take_over(") == std::string::npos)
        return c.name;
    for (std::size_t i = 0; i < c.wires.size(); ++i) {
      const Port& input = c.info().inputs[i];
      const Wire& wire = c.wires[i];
      const bool needed =
          component == graph_.vehicle ? wire.from.kind == Source::Kind::role : !input.optional;
      if (input.kind != FULMAR_IN_VALUE || !needed || wire.from.kind == Source::Kind::none) continue;
      const int writer =
          wire.from.kind == Source::Kind::component ? wire.from.index : filler(wire.from.index);
      if (writer < 0) return c.name + "." + input.name + " of nobody";
      if (writer == graph_.vehicle) continue;
      if (const std::string b = broken(writer); !b.empty()) return b + " -> " + c.name;
    }
    return "";
  }

  int filler(int role) const {
    const Role& r = graph_.roles[static_cast<std::size_t>(role)];
    if (std::find(r.fillers.begin(), r.fillers.end(), graph_.vehicle) != r.fillers.end())
      return graph_.vehicle;
    int found = -1;
    for (const Tenure& t : result_.tenures)
      for (const int f : r.fillers)
        if (t.role == r.name && t.from_ns <= at_ns_ &&
            graph_.components[static_cast<std::size_t>(f)].name == t.component)
          found = f;
    return found;
  }

  const Graph& graph_;
  const FlightResult& result_;
  std::int64_t at_ns_;
  std::vector<int> seen_;
};

void check_guards(const Graph& graph, const Flown& flown) {
  for (const GuardEvent& guard : flown.result.guards) {
    const std::int64_t later_ns = guard.at_ns + patience_ns;
    if (later_ns > flown.result.last_ns) continue;  // the flight was over by then
    const bool announced = std::any_of(flown.failsafe.begin(), flown.failsafe.end(),
                                       [&](const auto& printed) { return printed.first <= later_ns; });
    const std::string broken = Chain(graph, flown.result, later_ns).broken();
    INFO(guard.component << ": " << guard.what << ": " << guard.action);
    CHECK((announced ? "" : broken) == "");
  }
}

int flights() {
  if (std::getenv("FULMAR_LONG")) return 500;
  return counts_allocations() ? 50 : 5;  // under the sanitizers a flight takes ten times as long
}

TEST_CASE(
    "whoever fails in whatever mission: somebody flies on live inputs, or failsafe; and the log replays") {
  const Folder folder;
  int guarded = 0, flown_on = 0, failsafes = 0;
  for (unsigned seed = 1; seed <= static_cast<unsigned>(flights()); ++seed) {
    CAPTURE(seed);
    CAPTURE(Draw(seed).text());
    const Graph graph = mission(folder.path, seed);
    const fs::path log = folder.path / "flight.mcap";
    const Flown flown = fly(graph, log);
    CAPTURE(flown.word);
    CAPTURE(flown.result.reason);
    check_guards(graph, flown);
    CAPTURE(flown.farthest_m);
    CHECK((flown.farthest_m <= astray_m || flown.word == "failed"));
    CHECK((flown.word == "flown") == (flown.result.outcome == Outcome::flown && flown.result.guards.empty() &&
                                      flown.result.idle.empty()));
    guarded += !flown.result.guards.empty();
    failsafes += !flown.failsafe.empty();
    flown_on += flown.word == "flown with guards";
    const Recording recording(log);
    const auto [again, replayed] =
        replay(recording, recording.mission({}, [](const std::string&, bool) {}), {});
    CHECK(replayed.equal());
    fs::remove(log);
  }
  MESSAGE(flights() << " flights: a guard fired in " << guarded << ", " << flown_on
                    << " were flown on by others, " << failsafes << " ended in failsafe");
  // the random cases cover both outcomes
  if (flights() < 50) return;
  CHECK(flown_on >= flights() / 10);
  CHECK(failsafes >= flights() / 10);
}

}  // namespace random_missions_test
