// SPDX-License-Identifier: BSD-3-Clause
// What enters a flight from other threads: parameters, requests, phases, swaps, samples of foreign origin.
// The live view, the command line and DDS speak to a flight through this and nothing else.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/tap/pace.hpp"
#include "core/types/type.hpp"

namespace fulmar::core {

/// What somebody outside may know of a flight's parts. A copy.
struct ParameterView {
  ParamInfo info;
  ParamValue base;        // mission, --set, live changes
  bool overlaid = false;  // a phase sets something else while it lasts
};
struct PortView {
  std::string name;
  TypePtr type;        // empty for a probe
  std::string source;  // of an input: "nav.state", or ""
  int channel = -1;    // of an output or request: into Tap::channels()
  bool request = false, imported = false;
};
struct ComponentView {
  std::string name, use, doc, run;
  std::string role;     // "outer, inner": all that it fills
  std::string swapped;  // what its last swap did to its parameters; "": nothing that a user would not expect
  bool active = false, stopped = false;  // flies now; stopped by a guard
  std::uint64_t steps = 0;
  double step_us = 0, step_max_us = 0,
         budget_us = 0;  // by the clock on the wall: mean, largest; 0: no budget
  std::vector<ParameterView> params;
  std::vector<PortView> inputs, outputs;
};
struct Geodetic {
  double lat_deg = 0, lon_deg = 0, alt_msl_m = 0;
};
struct FlightView {
  std::string mission, io;
  struct {
    std::string now;
    std::vector<std::string> all;
  } phase;
  std::int64_t now_ns = 0, epoch_ns = 0;
  bool armed = false, over = false;
  struct {
    bool paused = false;
    double speed = 1;  // times real time; 0: as fast as the machine allows
  } pace;
  std::vector<ComponentView> components;
  std::string file;  // of the mission
  std::uint64_t seed = 0;
  std::optional<Geodetic> origin;  // of the local frame, where the mission says it
  struct {
    std::string tiles, attribution;
  } map;                         // LiveOptions
  std::string no_save;           // why no client may write files; "": each may
  std::vector<std::string> set;  // parameters that the command line has set, "slc.roll_kp"
};

/// The parameter "slc.roll_kp", or nullptr.
inline const ParameterView* find_parameter(const FlightView& view, const std::string& name) {
  for (const ComponentView& c : view.components) {
    const std::size_t dot = c.name.size();
    if (name.size() <= dot || name[dot] != '.' || !name.starts_with(c.name)) continue;
    for (const ParameterView& p : c.params)
      if (std::string_view(name).substr(dot + 1) == p.info.name) return &p;
  }
  return nullptr;
}
inline std::vector<std::string> parameter_names(const FlightView& view) {
  std::vector<std::string> names;
  for (const ComponentView& c : view.components)
    for (const ParameterView& p : c.params) names.push_back(c.name + "." + p.info.name);
  return names;
}

/// Any thread may call any of these. What can be checked without the loop is checked in the caller's thread:
/// those throw Error with the valid choices. What the loop then says comes through `answer`, once, from a
/// thread of the control's: "" accepted, else the reason; a flight that ends before answers "the flight has
/// ended".
class Control {
 public:
  using Answer = std::function<void(const std::string& refusal)>;
  virtual ~Control() = default;

  virtual FlightView view() const = 0;
  /// Text as in a mission file: "0.6", "20 deg", "[1, 2, 3]", "true", a choice.
  virtual void set_parameter(const std::string& component, const std::string& param, const std::string& text,
                             Answer answer) = 0;
  /// `message`: a struct of the request port's type.
  virtual void request(const std::string& component, const std::string& port, std::vector<std::byte> message,
                       Answer answer) = 0;
  /// A sample for an input that `dds.import` names; a struct of its type. False: thrown away, counted, as
  /// more of them come than the loop takes.
  virtual bool publish(const std::string& component, const std::string& port,
                       std::vector<std::byte> message) = 0;
  virtual void enter_phase(const std::string& phase, Answer answer) = 0;
  virtual void swap(const std::string& component, const std::string& file, Answer answer) = 0;
  virtual void reset_guards(Answer answer) = 0;
  /// Steps are answered when the last one has been flown. Throws Error on hardware, and of a restart where
  /// nobody would begin another flight.
  virtual void pace(const PaceOrder& order, Answer answer) = 0;

  /// Called from a thread of the control's after each change that the loop has made: (component, parameter).
  virtual void on_parameter(std::function<void(const std::string&, const std::string&)> changed) = 0;
  /// Imported samples that found no room.
  virtual std::uint64_t lost_samples() const = 0;
};

}  // namespace fulmar::core
