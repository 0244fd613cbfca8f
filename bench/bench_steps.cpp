// SPDX-License-Identifier: BSD-3-Clause
// Cost of a step: each shipped component and the whole tick in the hourglass missions, the simulator's forces
// and each control law alone, and a 200-byte port hop, bare, guarded and timed.
// bench_steps [--json] [MISSION...]
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/control_steps.hpp"
#include "core/run/component/unit.hpp"
#include "core/run/flight.hpp"
#include "fulmar/sim/plant.hpp"
#include "sdk/test/flight/airframe_file.hpp"

using namespace fulmar::core;

namespace {

std::int64_t now_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

struct Row {
  std::string name;
  double p50_ns, p99_ns;
};

double quantile(std::vector<double>& v, double q) {
  const auto at = v.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), at, v.end());
  return *at;
}

/// Times `batch` calls together, many times: the cost of the clock is then negligible.
template <class F>
Row time_batches(const std::string& name, F&& call) {
  constexpr int batch = 1000, batches = 400;
  std::vector<double> each;
  for (int i = 0; i < batches; ++i) {
    const std::int64_t begin = now_ns();
    for (int k = 0; k < batch; ++k) call();
    each.push_back(static_cast<double>(now_ns() - begin) / batch);
  }
  return {name, quantile(each, 0.5), quantile(each, 0.99)};
}

Component hop_component(const std::shared_ptr<Library>& library, std::size_t index, const std::string& name) {
  Component c;
  c.name = name;
  c.library = library;
  c.plugin = std::make_shared<const PluginInfo>(library->info());
  c.index_in_plugin = index;
  c.wires.resize(c.info().inputs.size());
  return c;
}

void add_hops(std::vector<Row>& rows) {
  const std::shared_ptr<Library> library = Library::open(FULMAR_HOP);
  // in a list, as in a graph: on the stack their distance to the written memory may be a multiple of 4 kB,
  // which costs 9 ns
  const std::vector<Component> both{hop_component(library, 0, "begin"), hop_component(library, 1, "hop")};
  const Component& begin = both[0];
  const Component& hop = both[1];
  Unit source(begin, UnitOptions{}), unit(hop, UnitOptions{});
  source.configure();
  unit.configure();
  unit.in.readers[0].slot = &source.out.slots[0];
  unit.in.readers[0].plans.push_back(
      copy_plan(*source.out.slots[0].port->type, *unit.in.readers[0].port->type));
  std::int64_t now = 0;
  source.step(now, 0);
  source.out.publish([](Slot&) {});

  // bare: the call through the contract, with copies of the block in and out
  const fulmar_component& functions = library->functions(1);
  fulmar_error error{};
  void* instance = functions.create(1, &error);
  std::vector<std::byte> out(unit.out.slots[0].size);
  std::int64_t stamp = 0;
  fulmar_input input{};
  input.data = source.out.slots[0].published.data();
  fulmar_output output{out.data(), &stamp, 0, 0, 0};
  const fulmar_tick tick{0, 2'500'000, 0};
  rows.push_back(
      time_batches("200-byte hop, bare", [&] { functions.step(instance, &tick, &input, &output, &error); }));
  functions.destroy(instance);
  rows.push_back(time_batches("200-byte hop, guarded", [&] {
    unit.step(now += 2'500'000, 0);
    unit.out.publish([](Slot&) {});
  }));
  Histogram histogram;
  rows.push_back(time_batches("200-byte hop, guarded and timed", [&] {
    const std::int64_t before = now_ns();
    unit.step(now += 2'500'000, 0);
    unit.out.publish([](Slot&) {});
    histogram.add(now_ns() - before);
  }));
}

/// The Anaconda in steady flight with moving surfaces, 2.5 ms, wind and no turbulence; no sensors.
void add_forces(std::vector<Row>& rows) {
  using fulmar::Actuators;
  fulmar::sim::Weather weather;
  weather.wind_n = {3, -4, 0};
  fulmar::sim::Plant plant(fulmar::test::airframe_file("anaconda"), weather, 1387, 7);
  if (!plant.fly({0, 0, -300}, 0.3, 17)) throw std::runtime_error("the Anaconda has no level flight");
  const fulmar::Deflections d = plant.deflections();
  const fulmar::RigidBody begin = plant.state();
  int i = 0;
  rows.push_back(time_batches("sim step, forces only", [&] {
    if (++i % 4000 == 0) plant.set_state(begin);
    const double s = (i / 200) % 2 ? 0.01 : -0.01;
    plant.advance(Actuators{0.57, d.aileron + s, d.elevator + 0.5 * s, d.rudder - s}, 1, 0.0025);
  }));
}

void add_laws(std::vector<Row>& rows) {
  for (const LawStep& law : law_steps()) {
    std::vector<double> each;
    for (int i = 0; i < 400; ++i) {
      const std::int64_t begin = now_ns();
      law.thousand();
      each.push_back(static_cast<double>(now_ns() - begin) / 1000);
    }
    rows.push_back({law.name, quantile(each, 0.5), quantile(each, 0.99)});
  }
}

void add_mission(std::vector<Row>& rows, const std::string& file) {
  const Graph graph = load_mission(file);
  FlightOptions options;
  options.log = false;
  Flight flight(graph, options);
  std::vector<double> ticks;
  ticks.reserve(200'000);
  for (std::int64_t begin = now_ns(); flight.step(); begin = now_ns())
    ticks.push_back(static_cast<double>(now_ns() - begin));
  const FlightResult result = flight.finish();
  for (std::size_t i = 0; i < result.components.size(); ++i) {
    const Histogram& time = result.components[i].time;
    rows.push_back({graph.mission + ": " + graph.components[i].use, 1e3 * time.quantile_us(0.5),
                    1e3 * time.quantile_us(0.99)});
  }
  double sum = 0;
  for (const double t : ticks) sum += t;
  const double mean = sum / static_cast<double>(ticks.size());
  rows.push_back({graph.mission + ": whole tick", quantile(ticks, 0.5), quantile(ticks, 0.99)});
  rows.push_back({graph.mission + ": whole tick, mean", mean, mean});
}

}  // namespace

int main(int argc, char** argv) {
  bool json = false;
  std::vector<std::string> missions;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0)
      json = true;
    else
      missions.emplace_back(argv[i]);
  }
  if (missions.empty())
    missions = {"configs/missions/hourglass.yaml", "configs/missions/two_schemes.yaml",
                "configs/missions/calm.yaml"};
  try {
    std::vector<Row> rows;
    add_hops(rows);
    add_forces(rows);
    add_laws(rows);
    for (const std::string& mission : missions) add_mission(rows, mission);
    nlohmann::json all = nlohmann::json::object();
    for (const Row& r : rows) {
      if (json)
        all[r.name] = {{"p50_ns", r.p50_ns}, {"p99_ns", r.p99_ns}};
      else
        std::printf("%-48s %9.0f %9.0f ns\n", r.name.c_str(), r.p50_ns, r.p99_ns);
    }
    if (json) std::printf("%s\n", all.dump(2).c_str());
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
