// SPDX-License-Identifier: BSD-3-Clause
// Source of the protocol's messages: the Foxglove WebSocket protocol, version 1.
#include "links/live/describe.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/graph/params.hpp"
#include "core/types/wire.hpp"
#include "links/live/messages.hpp"

namespace fulmar::core::live {
namespace {

using nlohmann::json;

constexpr const char* answer_text = "bool accepted\nstring reason\n";

std::string topic_of(const Tap& tap, const ComponentView& component, const PortView& port) {
  const auto channel = static_cast<std::size_t>(port.channel);
  if (port.channel >= 0 && channel < tap.channels().size()) return tap.channels()[channel].topic;
  return "/" + component.name + "/" + port.name;
}

/// "fulmar_msgs/msg/Waypoint" -> "fulmar_msgs/srv/Waypoint".
std::string service_type(const std::string& message) {
  const std::size_t at = message.find("/msg/");
  return at == std::string::npos ? message : message.substr(0, at) + "/srv/" + message.substr(at + 5);
}

struct Form {
  std::string type, request_name, request, response;
};

Form form_of(const Service& service) {
  if (service.what == Service::What::request) {
    const std::string name = ros_name(*service.type);
    return {service_type(name), name, ros_definition(*service.type), answer_text};
  }
  Form form{std::string("fulmar_msgs/srv/") + service.word, "", "", answer_text};
  form.request_name = form.type + "_Request";
  for (const std::string& argument : service.arguments) form.request += "string " + argument + "\n";
  if (service.what == Service::What::save) form.response += "string lines\nstring mark\n";
  if (service.what == Service::What::record) form.response += "string json\n";
  if (service.what == Service::What::view) form.response = "string json\n";
  return form;
}

/// In the order of fulmar_param_kind.
constexpr const char* param_kinds[]{"",     "number", "flag",   "count", "choice",
                                    "text", "vector", "record", "blob"};

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json value_json(const ParamInfo& info, const ParamValue& value) {
  switch (info.kind) {
    case FULMAR_NUMBER: return finite(value.number[0]);
    case FULMAR_FLAG: return value.integer != 0;
    case FULMAR_COUNT: return value.integer;
    case FULMAR_CHOICE:
      if (value.integer >= 0 && static_cast<std::size_t>(value.integer) < info.choices.size())
        return info.choices[static_cast<std::size_t>(value.integer)];
      return value.integer;
    case FULMAR_VECTOR: return {finite(value.number[0]), finite(value.number[1]), finite(value.number[2])};
    default: return value.text;
  }
}

json param_json(const ParameterView& parameter, const ParameterView* begun) {
  const ParamInfo& info = parameter.info;
  const bool same = begun && begun->info.kind == info.kind;
  return {{"name", info.name},
          {"begun", value_json(info, same ? begun->base : parameter.base)},
          {"kind", param_kinds[info.kind]},
          {"unit", info.unit},
          {"doc", info.doc},
          {"value", value_json(info, parameter.base)},
          {"text", value_text(info, parameter.base)},
          {"initial", value_json(info, initial_value(info))},
          {"min", finite(info.min)},
          {"max", finite(info.max)},
          {"choices", info.choices},
          {"live", info.live},
          {"required", info.required},
          {"overlaid", parameter.overlaid}};
}

json port_json(const Tap& tap, const ComponentView& component, const PortView& port, bool input) {
  json result{{"name", port.name}, {"type", port.type ? ros_name(*port.type) : ""}};
  if (!input || port.request || port.imported) result["topic"] = topic_of(tap, component, port);
  if (!input) return result;
  result["source"] = port.source;
  result["request"] = port.request;
  result["imported"] = port.imported;
  return result;
}

json component_json(const ComponentView& component, const FlightView& begun, const Tap& tap) {
  json params = json::array(), inputs = json::array(), outputs = json::array();
  for (const ParameterView& p : component.params)
    params.push_back(param_json(p, find_parameter(begun, component.name + "." + p.info.name)));
  for (const PortView& p : component.inputs) inputs.push_back(port_json(tap, component, p, true));
  for (const PortView& p : component.outputs) outputs.push_back(port_json(tap, component, p, false));
  return {{"name", component.name},
          {"use", component.use},
          {"role", component.role},
          {"doc", component.doc},
          {"run", component.run},
          {"swapped", component.swapped},
          {"active", component.active},
          {"stopped", component.stopped},
          {"steps", component.steps},
          {"step_us", component.step_us},
          {"step_max_us", component.step_max_us},
          {"budget_us", component.budget_us},
          {"params", params},
          {"inputs", inputs},
          {"outputs", outputs}};
}

/// The topics of a source "nav.state": of the component, or of all components that fill the role.
std::vector<std::string> topics_of_source(const FlightView& view, const Tap& tap, const std::string& source) {
  std::vector<std::string> topics;
  const std::size_t dot = source.find('.');
  if (dot == std::string::npos) return topics;
  const std::string owner = source.substr(0, dot), port = source.substr(dot + 1);
  for (const ComponentView& c : view.components) {
    const bool fills = (", " + c.role + ", ").find(", " + owner + ", ") != std::string::npos;
    if (c.name != owner && !fills) continue;
    for (const PortView& p : c.outputs)
      if (p.name == port) topics.push_back(topic_of(tap, c, p));
  }
  return topics;
}

json lists(const std::map<std::string, std::vector<std::string>>& map, const char* key) {
  json list = json::array();
  for (const auto& [name, ids] : map) list.push_back({{"name", name}, {key, ids}});
  return list;
}

// ---- page for browsers

constexpr const char* page_head =
    "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
    "content=\"width=device-width\">\n"
    "<style>body{font:16px/1.5 system-ui,sans-serif;max-width:52rem;margin:2rem auto;padding:0 "
    "1rem;color:#222}"
    "code{background:#f2f2f2;padding:0 "
    ".2em}table{border-collapse:collapse}td,th{text-align:left;padding:.1rem 1rem .1rem 0}</style>\n";

constexpr const char* page_how =
    "<p>This port speaks the Foxglove WebSocket protocol. To see the flight, open a connection of the kind "
    "<em>Foxglove WebSocket</em> in "
    "Foxglove, Lichtblick or PlotJuggler, and give it this page's address with <code>ws://</code> in front. "
    "In a terminal: <code>fulmar "
    "list</code>, <code>fulmar echo PORT</code>, <code>fulmar param list</code>.</p>\n"
    "<p>The page on which the flight is seen and flown is at <code>/</code>, if this Fulmar was built with "
    "it: "
    "install <code>nodejs</code> and <code>npm</code>, then configure and build again.</p>\n";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

}  // namespace

std::vector<Service> services_of(const FlightView& view) {
  using What = Service::What;
  std::vector<Service> list = {
      {What::set_parameter, "/fulmar/set_parameter", "SetParameter", {"component", "name", "text"}},
      {What::phase, "/fulmar/phase", "EnterPhase", {"phase"}},
      {What::swap, "/fulmar/swap", "Swap", {"component", "file"}},
      {What::reset_guards, "/fulmar/reset_guards", "ResetGuards"},
      {What::pause, "/fulmar/pause", "Pause"},
      {What::resume, "/fulmar/resume", "Resume"},
      {What::step, "/fulmar/step", "Step", {"ticks"}},
      {What::speed, "/fulmar/speed", "Speed", {"speed"}},
      {What::restart, "/fulmar/restart", "Restart", {"seed"}},
      {What::save, "/fulmar/save", "Save", {"component", "mark"}},
      {What::record, "/fulmar/record", "Record", {"component", "name"}},
      {What::view, "/fulmar/view", "View"}};
  for (const ComponentView& c : view.components)
    for (const PortView& p : c.inputs)
      if (p.request && p.type)
        list.push_back({What::request, "/" + c.name + "/" + p.name, "", {}, c.name, p.name, p.type});
  return list;
}

json advertise(const Tap& tap) {
  json channels = json::array();
  for (const TapChannel& c : tap.channels()) {
    channels.push_back({{"id", channels.size() + 1},
                        {"topic", c.topic},
                        {"encoding", "cdr"},
                        {"schemaName", ros_name(*c.type)},
                        {"schemaEncoding", "ros2msg"},
                        {"schema", ros_definition(*c.type)}});
  }
  return {{"op", "advertise"}, {"channels", channels}};
}

json advertise_services(const std::vector<Service>& services) {
  json list = json::array();
  for (const Service& s : services) {
    const Form form = form_of(s);
    const auto side = [](const std::string& name, const std::string& text) {
      return json{{"encoding", "cdr"}, {"schemaName", name}, {"schemaEncoding", "ros2msg"}, {"schema", text}};
    };
    list.push_back({{"id", list.size() + 1},
                    {"name", s.name},
                    {"type", form.type},
                    {"request", side(form.request_name, form.request)},
                    {"response", side(form.type + "_Response", form.response)},
                    {"requestSchema", form.request},  // for clients of a version before `request`
                    {"responseSchema", form.response}});
  }
  return {{"op", "advertiseServices"}, {"services", list}};
}

json connection_graph(const FlightView& view, const Tap& tap, const std::vector<Service>& services) {
  std::map<std::string, std::vector<std::string>> published, subscribed, provided;
  for (const ComponentView& c : view.components) {
    for (const PortView& p : c.outputs) published[topic_of(tap, c, p)].push_back(c.name);
    for (const PortView& p : c.inputs) {
      if (p.imported) subscribed["/" + c.name + "/" + p.name].push_back(c.name);
      for (const std::string& topic : topics_of_source(view, tap, p.source))
        subscribed[topic].push_back(c.name);
    }
  }
  for (const TapChannel& c : tap.channels())
    if (c.topic.starts_with("/fulmar/") || c.topic == "/rosout") published[c.topic].push_back("fulmar");
  for (const Service& s : services) provided[s.name].push_back(s.component.empty() ? "fulmar" : s.component);
  return {{"op", "connectionGraphUpdate"},
          {"publishedTopics", lists(published, "publisherIds")},
          {"subscribedTopics", lists(subscribed, "subscriberIds")},
          {"advertisedServices", lists(provided, "providerIds")},
          {"removedTopics", json::array()},
          {"removedServices", json::array()}};
}

json view_json(const FlightView& view, const FlightView& begun, const Tap& tap) {
  json components = json::array();
  for (const ComponentView& c : view.components) components.push_back(component_json(c, begun, tap));
  json origin;
  if (view.origin)
    origin = {{"lat_deg", view.origin->lat_deg},
              {"lon_deg", view.origin->lon_deg},
              {"alt_msl_m", view.origin->alt_msl_m}};
  return {{"origin", origin},
          {"tiles", view.map.tiles},
          {"attribution", view.map.attribution},
          {"no_save", view.no_save},
          {"mission", view.mission},
          {"file", view.file},
          {"io", view.io},
          {"phase", view.phase.now},
          {"phases", view.phase.all},
          {"now_ns", view.now_ns},
          {"epoch_ns", view.epoch_ns},
          {"armed", view.armed},
          {"over", view.over},
          {"paused", view.pace.paused},
          {"speed", view.pace.speed},
          {"seed", std::to_string(view.seed)},
          {"components", components}};
}

json save_request(const FlightView& view, const std::string& component, const std::string& mark) {
  json components = json::array();
  for (const ComponentView& c : view.components) {
    json params = json::array();
    for (const ParameterView& p : c.params) {
      params.push_back(param_json(p, nullptr));
      if (p.info.kind != FULMAR_VECTOR || !p.info.type) continue;
      for (const Field& field : p.info.type->fields) params.back()["fields"].push_back(field.name);
    }
    components.push_back({{"name", c.name}, {"use", c.use}, {"role", c.role}, {"params", params}});
  }
  return {{"component", component},  {"mark", mark},
          {"set", view.set},         {"file", view.file},
          {"mission", view.mission}, {"components", components}};
}

json record_json(const FlightView& view, const std::string& component, const std::string& name) {
  const ParameterView* const p = find_parameter(view, component + "." + name);
  if (!p)
    throw Error(live_messages::parameter_unknown(
        component, name, choices_text(component + "." + name, parameter_names(view))));
  if (p->info.kind != FULMAR_RECORD) throw Error(live_messages::parameter_not_record(component, name));
  return p->base.integer ? to_json(*p->info.type, p->base.data.data(), false) : json(nullptr);
}

json parameter_json(const std::string& name, const ParameterView& parameter) {
  json result{{"name", name}};
  json value = value_json(parameter.info, parameter.base);
  const bool whole =
      value.is_array() ? std::count(value.begin(), value.end(), nullptr) == 0 : !value.is_null();
  if (!whole) return result;
  if (parameter.info.kind == FULMAR_NUMBER) result["type"] = "float64";
  if (parameter.info.kind == FULMAR_VECTOR) result["type"] = "float64_array";
  result["value"] = std::move(value);
  return result;
}

std::string topics_page(const std::string& mission, const Tap& tap) {
  std::string html = page_head;
  html += "<title>" + escaped(mission) + " - Fulmar</title>\n<h1>" + escaped(mission) + "</h1>\n" + page_how;
  html += "<table>\n<tr><th>topic<th>type\n";
  for (const TapChannel& c : tap.channels())
    html += "<tr><td>" + escaped(c.topic) + "<td>" + escaped(ros_name(*c.type)) + "\n";
  return html + "</table>\n";
}

std::string mission_text(const json& value, bool text_parameter) {
  return value.is_string() && !text_parameter ? value.get<std::string>() : dumped(value);
}

std::string dumped(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

}  // namespace fulmar::core::live
