// SPDX-License-Identifier: BSD-3-Clause
// Flights in a laboratory (lab.cpp): a cart that counts its ticks, laws with configurable faults.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/run/flight.hpp"

using namespace fulmar::core;
using namespace std::string_literals;
namespace fs = std::filesystem;

namespace lab {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-flight-test-" + std::to_string(getpid()));
  Folder() {
    fs::create_directories(path);
    setenv("FULMAR_PLUGIN_PATH", FULMAR_TEST_PLUGIN_DIR, 1);
  }
  ~Folder() { fs::remove_all(path); }
};

inline Folder& folder() {
  static Folder f;
  return f;
}

/// Another build of the laboratory's plugin.
inline std::string variant(const std::string& name) {
  return std::string(FULMAR_TEST_PLUGIN_DIR) + "/lab" + name + ".so";
}

inline const char* const base = R"(
mission: lab
rate: 400 Hz
arm: auto
timeout: 100 s
failsafe: {u_frac: -0.25, for: 0.5 s}
roles:
  vehicle: {in: {command: law.command}, out: {signal: Signal, applied: Received, burst: Signal, status: Arm}}
  sense:   {in: {signal: vehicle.signal}, out: {signal: Signal}}
  law:     {in: {signal: sense.signal}, out: {command: Command}}
components:
  sim:    {fills: vehicle, use: lab/Cart}
  filter: {fills: sense, use: lab/Filter}
  one:    {fills: law, use: lab/Law, params: {id: 1, u: 0.1}}
  two:    {fills: law, use: lab/Law, params: {id: 2, u: 0.2}}
  watch:  {use: lab/Watch, in: {burst: vehicle.burst, applied: vehicle.applied}}
)";

inline Graph mission(const std::string& tail,
                     const std::vector<std::pair<std::string, std::string>>& set = {},
                     std::uint64_t seed = 1) {
  const fs::path file = folder().path / "lab.yaml";
  // a component of the tail replaces the one in the base
  std::istringstream lines{std::string(base)};
  std::ofstream out(file);
  for (std::string line; std::getline(lines, line);) {
    const std::string key = line.substr(0, line.find(':') + 1);
    // on hardware a mission must name the flags that the cart's status lacks
    if (key == "  vehicle:" && tail.find("io: fcu") != std::string::npos)
      line.insert(line.find("{in:") + 1, "flags: {on_ground: stance.stands, in_control: stance.obeys}, ");
    if (!line.starts_with("  ") || key.empty() || ("\n" + tail).find("\n" + key) == std::string::npos)
      out << line << "\n";
  }
  out << tail;
  out.close();
  Overrides o;
  o.set = set;
  o.seed = seed;
  return load_mission(file.string(), o);
}

inline const char* const one_phase = "phases:\n  fly: {law: one}\n";
inline const char* const with_fallback = "phases:\n  fly: {law: {use: one, fallback: two}}\n";

inline FlightOptions options(double duration_s) {
  FlightOptions o;
  o.log = false;
  o.duration_s = duration_s;
  return o;
}

inline Source port(const Graph& graph, const std::string& component, const std::string& output) {
  for (std::size_t i = 0; i < graph.components.size(); ++i)
    if (graph.components[i].name == component)
      return {Source::Kind::component, static_cast<int>(i), graph.components[i].info().output(output)};
  FAIL("no component " << component);
  return {};
}

/// A field of a port's present sample.
inline double value(const Graph& graph, const Flight& flight, const std::string& component,
                    const std::string& output, const std::string& field) {
  const Source s = port(graph, component, output);
  const std::byte* message = flight.sample(s);
  REQUIRE(message != nullptr);
  const TypePtr type = graph.components[static_cast<std::size_t>(s.index)]
                           .info()
                           .outputs[static_cast<std::size_t>(s.output)]
                           .type;
  if (!type) {  // a probe
    double number = 0;
    std::memcpy(&number, message, sizeof number);
    return number;
  }
  const FieldRef ref = resolve_field(*type, field);
  return number_at(*ref.field, message + ref.offset);
}

}  // namespace lab
using namespace lab;
