// SPDX-License-Identifier: BSD-3-Clause
// A flight in the form of the live protocol: channels, services, parameters, connection graph, and the whole
// view as JSON.
//
// The view, answer of the service /fulmar/view:
//   {mission, file, io, phase, phases: [..], now_ns, epoch_ns, armed, over, paused, speed, seed,
//    origin: {lat_deg, lon_deg, alt_msl_m} or null, tiles, attribution, no_save,
//    components: [
//     {name, use, role, doc, run, swapped, active, stopped, steps, step_us, step_max_us, budget_us,
//      params: [{name, kind, unit, doc, value, text, begun, initial, min, max, choices, live, required,
//                overlaid}],
//      inputs: [{name, type, source, request, imported, topic}],
//      outputs: [{name, type, topic}]}]}
// `value` is in the parameter's unit, `text` has the form of a mission file ("0.55 rad/rad"). `begun` is the
// value at the start of the flight. `type` is a ROS 2 name, "" for a probe. `seed` is a text, because numbers
// in JavaScript have 53 bits. `topic` is the channel of an output, the service of a request, or the topic of
// an imported input. `step_us` is the mean wall-clock time since the start; `budget_us` 0: none.
#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/tap/control.hpp"
#include "core/tap/tap.hpp"
#include "core/types/type.hpp"

namespace fulmar::core::live {

/// A service of the protocol: a request of a component, or a service of the host.
struct Service {
  enum class What : std::uint8_t {
    request,
    set_parameter,
    phase,
    swap,
    reset_guards,
    pause,
    resume,
    step,
    speed,
    restart,
    save,
    record,
    view
  };
  What what = What::request;
  std::string name;                      // "/plan/add_waypoints"
  const char* word = "";                 // service of the host: part of its type's name
  std::vector<std::string> arguments{};  // service of the host: texts
  std::string component{}, port{};       // service of a request
  TypePtr type{};                        // service of a request
};
std::vector<Service> services_of(const FlightView& view);

/// Channel and service ids are indexes, counted from 1.
nlohmann::json advertise(const Tap& tap);
nlohmann::json advertise_services(const std::vector<Service>& services);
nlohmann::json connection_graph(const FlightView& view, const Tap& tap, const std::vector<Service>& services);
/// `begun`: the view at the start of the flight; a parameter that it lacks began with its present value.
nlohmann::json view_json(const FlightView& view, const FlightView& begun, const Tap& tap);
/// Input of the program fulmar-save: the current parameters of all components, and their sources.
nlohmann::json save_request(const FlightView& view, const std::string& component, const std::string& mark);
/// Fields of a parameter that is a record. Throws Error when there is no such parameter, or no record.
nlohmann::json record_json(const FlightView& view, const std::string& component, const std::string& name);

/// {name, value, type} of the protocol; without a value when the parameter has no finite number.
nlohmann::json parameter_json(const std::string& name, const ParameterView& parameter);
/// A value in the form of a mission file. Texts stay as they are ("20 deg"), unless the parameter is a text.
std::string mission_text(const nlohmann::json& value, bool text_parameter);

/// For a browser: the topics, one HTML file that asks for nothing else.
std::string topics_page(const std::string& mission, const Tap& tap);

/// JSON as text; bytes that are not UTF-8 are replaced.
std::string dumped(const nlohmann::json& value);

}  // namespace fulmar::core::live
