// SPDX-License-Identifier: BSD-3-Clause
// Input of a flight from other threads: parameters, requests, phases, swaps, imported samples. The live view,
// the command line and DDS use only this interface.
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

/// Copies of the state of a flight's parts, for clients.
struct ParameterView {
  ParamInfo info;
  ParamValue base;        // mission, --set, live changes
  bool overlaid = false;  // a phase sets another value while it lasts
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
  std::string role;                      // "outer, inner": all roles that it fills
  std::string swapped;                   // unexpected changes of its parameters by its last swap; "": none
  bool active = false, stopped = false;  // active: flies now; stopped: by a guard
  std::uint64_t steps = 0;
  double step_us = 0, step_max_us = 0,
         budget_us = 0;  // wall-clock time: mean, largest; 0: no budget
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
  std::optional<Geodetic> origin;  // of the local frame, if the mission sets it
  struct {
    std::string tiles, attribution;
  } map;                         // LiveOptions
  std::string no_save;           // reason why no client may write files; "": every client may
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

/// Thread-safe. Checks that do not need the loop run in the caller's thread and throw Error with the valid
/// choices. The loop's result comes once through `answer`, from a thread of the control: "" accepted, else
/// the reason. A flight that ends before that answers "the flight has ended".
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
  /// A sample for an input that `dds.import` names; a struct of its type. Returns false for a sample that is
  /// dropped and counted because the loop's queue is full.
  virtual bool publish(const std::string& component, const std::string& port,
                       std::vector<std::byte> message) = 0;
  virtual void enter_phase(const std::string& phase, Answer answer) = 0;
  virtual void swap(const std::string& component, const std::string& file, Answer answer) = 0;
  virtual void reset_guards(Answer answer) = 0;
  /// Steps are answered after the last one. Throws Error on hardware, and for a restart when the host cannot
  /// begin another flight.
  virtual void pace(const PaceOrder& order, Answer answer) = 0;

  /// A thread of the control calls it after each change by the loop: (component, parameter).
  virtual void on_parameter(std::function<void(const std::string&, const std::string&)> changed) = 0;
  /// Imported samples that were dropped because the queue was full.
  virtual std::uint64_t lost_samples() const = 0;
};

}  // namespace fulmar::core
