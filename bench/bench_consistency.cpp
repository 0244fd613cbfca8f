// SPDX-License-Identifier: BSD-3-Clause
// Consistency of the estimator: flies climbs, descents, turns and changes of speed with the shipped
// autopilot, with many seeds, two sets of sensors, light and moderate turbulence, and another wind direction
// each time. Compares the errors of the estimate with the reported standard deviations. Exits 1 when a flight
// is lost.
// bench_consistency [--flights N] [--set PARAMETER=VALUE]... [--with PLUGIN.so] [--json]
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/consistency/statistics.hpp"
#include "core/run/flight.hpp"

using namespace fulmar::core;
using fulmar::FilterCheck;
using fulmar::VehicleState;
using namespace fulmar::consistency;

namespace {

struct Options {
  int flights = 20;
  bool json = false;
  Overrides overrides;
};

/// One flight, evaluated from 10 s after the lift-off on.
class Judged {
 public:
  Judged(const Graph& graph, Table& table, const fulmar::Vec3<fulmar::Ned>& wind_mps)
      : flight_(graph, without_log()), table_(table), wind_mps_(wind_mps) {
    truth_ = output(graph, "sim", "truth");
    state_ = output(graph, "ekf", "state");
    check_ = output(graph, "ekf", "check");
    for (Sensor& s : sensors_) s.source = output(graph, "ekf", s.port);
  }
  FlightResult fly() {
    Nees nees;
    while (flight_.step()) {
      const auto* const x = at<VehicleState>(truth_);
      const auto* const s = at<VehicleState>(state_);
      const auto* const check = at<FilterCheck>(check_);
      if (!x || !s || !check) continue;
      // the truth has a lower rate than the estimate
      const bool truth_is_new = x->position_m.north != north_m_;
      north_m_ = x->position_m.north;
      const double now_s = 1e-9 * static_cast<double>(flight_.now_ns());
      if (left_s_ < 0 && x->height_m > 10) left_s_ = now_s;
      if (left_s_ < 0 || now_s < left_s_ + 10) continue;
      look_at(*check);
      if (truth_is_new) table_.judge(*x, *s, *check, wind_mps_, nees);
    }
    if (nees.any()) table_.flights.push_back(nees);  // otherwise it was lost before the evaluation began
    for (const auto& [name, ratios] : ratios_) table_.innovations[name].add_flight(ratios);
    return flight_.finish();
  }

 private:
  struct Sensor {
    const char *port, *name;
    Source source{};
  };
  static FlightOptions without_log() {
    FlightOptions options;
    options.log = false;
    return options;
  }
  static Source output(const Graph& graph, const std::string& component, const std::string& port) {
    for (std::size_t i = 0; i < graph.components.size(); ++i)
      if (graph.components[i].name == component)
        return {Source::Kind::component, static_cast<int>(i), graph.components[i].info().output(port)};
    throw std::runtime_error("no component " + component);
  }
  template <class T>
  const T* at(const Source& source) const {
    return reinterpret_cast<const T*>(flight_.sample(source));
  }
  /// Innovations stay on their ports until the next sample: two equal ones are one.
  void add(const std::string& name, double ratio) {
    double& last = last_[name];
    if (ratio == last) return;
    last = ratio;
    ratios_[name].push_back(ratio);
  }
  void look_at(const FilterCheck& check) {
    for (const Sensor& s : sensors_)
      if (const double* const ratio = at<double>(s.source)) add(s.name, *ratio);
    add("GNSS position north", check.position_innovation_ratio.north);
    add("GNSS position east", check.position_innovation_ratio.east);
    add("GNSS height", check.position_innovation_ratio.down);
    add("GNSS velocity north", check.velocity_innovation_ratio.north);
    add("GNSS velocity east", check.velocity_innovation_ratio.east);
    add("GNSS velocity down", check.velocity_innovation_ratio.down);
  }

  Flight flight_;
  Table& table_;
  fulmar::Vec3<fulmar::Ned> wind_mps_;
  Source truth_, state_, check_;
  std::array<Sensor, 3> sensors_{
      {{"baro_ratio", "barometer"}, {"heading_ratio", "magnetometer"}, {"pitot_ratio", "pitot tube"}}};
  double left_s_ = -1, north_m_ = 0;
  std::map<std::string, double> last_;
  std::map<std::string, std::vector<double>> ratios_;
};

/// Returns false when the flight failed.
bool fly(const Options& options, const std::string& sensors, const std::string& turbulence, int seed,
         Table& table) {
  const double from_rad = 2.4 * seed;  // the golden angle: all directions in a few flights
  const fulmar::Vec3<fulmar::Ned> wind{5 * std::cos(from_rad), 5 * std::sin(from_rad), 0};
  Overrides overrides = options.overrides;
  overrides.seed = static_cast<std::uint64_t>(seed);
  overrides.set.insert(overrides.set.begin(), {{"sim.sensors", sensors},
                                               {"sim.turbulence", turbulence},
                                               {"sim.wind_ned", "[" + std::to_string(wind.north) + ", " +
                                                                    std::to_string(wind.east) + ", 0]"}});
  const FlightResult result =
      Judged(load_mission("bench/consistency/mission.yaml", overrides), table, wind).fly();
  if (result.outcome == Outcome::flown && result.guards.empty()) return true;
  std::fprintf(stderr, "%s, %s, seed %d: %s\n", sensors.c_str(), turbulence.c_str(), seed,
               result.reason.c_str());
  return false;
}

void print(const std::string& sensors, const std::string& turbulence, const Table& t) {
  std::printf("\n%s, %s turbulence, %zu flights\n\n", sensors.c_str(), turbulence.c_str(), t.flights.size());
  std::printf("| error | rms | claimed | within 1 | within 2 |\n|---|---|---|---|---|\n");
  for (const std::string& name : t.order) {
    const Channel& c = t.channels.at(name);
    std::printf("| %s | %.3f | %.3f | %.3f | %.3f |\n", name.c_str(), c.rms(), c.claim(), c.share_1(),
                c.share_2());
  }
  std::printf("\n| innovation | square | lag 1 | 2 | 3 | 4 | 5 |\n|---|---|---|---|---|---|---|\n");
  for (const auto& [name, i] : t.innovations) {
    std::printf("| %s | %.2f ", name.c_str(), i.nis());
    for (std::size_t lag = 1; lag <= Innovations::lags; ++lag) std::printf("| %.2f ", i.correlation(lag));
    std::printf("|\n");
  }
  double inside = 0, least = 1, mean = 0;
  for (const Nees& n : t.flights) {
    inside += n.inside() / static_cast<double>(t.flights.size());
    mean += n.mean() / static_cast<double>(t.flights.size());
    least = std::min(least, n.inside());
  }
  std::printf(
      "\nNEES of 9: mean %.1f; %.1f %% of the time inside %.2f to %.2f, in the worst flight %.1f %%\n", mean,
      100 * inside, Nees::low, Nees::high, 100 * least);
}

nlohmann::json json_of(const Table& t) {
  nlohmann::json j;
  for (const auto& [name, c] : t.channels)
    j["errors"][name] = {
        {"rms", c.rms()}, {"claimed", c.claim()}, {"within_1", c.share_1()}, {"within_2", c.share_2()}};
  for (const auto& [name, i] : t.innovations) {
    std::vector<double> lags;
    for (std::size_t lag = 1; lag <= Innovations::lags; ++lag) lags.push_back(i.correlation(lag));
    j["innovations"][name] = {{"nis", i.nis()}, {"correlation", lags}};
  }
  for (const Nees& n : t.flights) j["nees"].push_back({{"mean", n.mean()}, {"inside", n.inside()}});
  return j;
}

Options options_of(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    const std::size_t equals = value.find('=');
    if (word == "--json") {
      o.json = true;
      continue;
    }
    if (word == "--flights" && std::atoi(value.c_str()) > 0)
      o.flights = std::atoi(value.c_str());
    else if (word == "--with" && !value.empty())
      o.overrides.with.emplace_back("ekf", value);
    else if (word == "--set" && equals != std::string::npos)
      o.overrides.set.emplace_back("ekf." + value.substr(0, equals), value.substr(equals + 1));
    else
      throw std::invalid_argument(
          "usage: bench_consistency [--flights N] [--set PARAMETER=VALUE]... [--with PLUGIN.so] [--json]");
    ++i;
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  int lost = 0;
  try {
    const Options options = options_of(argc, argv);
    nlohmann::json all = nlohmann::json::object();
    int begun = 0;
    for (const std::string sensors : {"rosflight", "ublox"})
      for (const std::string turbulence : {"light", "moderate"}) {
        Table table;
        const int here = (options.flights + 3 - begun++) / 4;  // divided among the four
        for (int seed = 1; seed <= here; ++seed) lost += !fly(options, sensors, turbulence, seed, table);
        if (table.flights.empty()) continue;
        if (options.json)
          all[sensors][turbulence] = json_of(table);
        else
          print(sensors, turbulence, table);
      }
    if (options.json) std::printf("%s\n", all.dump(2).c_str());
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return lost == 0 ? 0 : 1;
}
