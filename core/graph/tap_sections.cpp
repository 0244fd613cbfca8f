// SPDX-License-Identifier: BSD-3-Clause
// The sections of a mission for clients and other hosts: `live:` and `dds:`.
#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "core/graph/draft.hpp"
#include "core/graph/live_options.hpp"
#include "core/graph/messages.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

constexpr int max_domain = 232;         // of DDS: the ports of a higher one would exceed 65535
constexpr double slowest_hz = 1 / 9e9;  // a longer period in nanoseconds exceeds 64 bits

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

bool is_address(const std::string& text) {
  in6_addr address{};
  return text == "localhost" || is_ipv4(text) || inet_pton(AF_INET6, text.c_str(), &address) == 1;
}

/// "127.0.0.1:8765", "[::1]:8765", "8765".
bool split_address(const std::string& text, LiveOptions& live) {
  const auto colon = text.rfind(':');
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const auto [end, code] = std::from_chars(port.data(), port.data() + port.size(), live.port);
  if (code != std::errc{} || end != port.data() + port.size() || port.empty()) return false;
  if (colon == std::string::npos) return true;
  std::string host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  live.host = host;
  return is_address(host);
}

/// The address becomes a part of a header, and a pattern. So its host may only have characters that cannot
/// begin another part of the header, and each placeholder occurs once.
bool is_tiles(const std::string& url) {
  constexpr const char* of_host = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.";
  const std::string origin = origin_of(url);
  if (!origin.starts_with("http://") && !origin.starts_with("https://")) return false;
  std::string host = origin.substr(origin.find("://") + 3);
  if (const auto colon = host.find(':'); colon != std::string::npos) {
    std::uint16_t port = 0;
    const char* const last = host.data() + host.size();
    const auto [end, code] = std::from_chars(host.data() + colon + 1, last, port);
    if (code != std::errc{} || end != last || port == 0) return false;
    host.resize(colon);
  }
  if (host.empty() || host.find_first_not_of(of_host) != std::string::npos) return false;
  std::string path = url.substr(origin.size());
  for (const std::string place : {"{z}", "{x}", "{y}"}) {
    const auto at = path.find(place);
    if (at == std::string::npos) return false;
    path.erase(at, place.size());
  }
  return std::all_of(path.begin(), path.end(), [](char c) {
    return c > ' ' && c < 0x7f && std::string_view("\"'`;,<>\\{}#").find(c) == std::string_view::npos;
  });
}

bool is_topic(const std::string& text, bool namespaces) {
  if (text.empty() || text.back() == '/') return false;
  std::size_t at = text[0] == '/' ? 1 : 0;
  if (namespaces && at == 1) return false;
  while (at <= text.size()) {
    const std::size_t slash = std::min(text.find('/', at), text.size());
    if (!is_name(text.substr(at, slash - at))) return false;
    at = slash + 1;
  }
  return true;
}

class DdsReader {
 public:
  DdsReader(MissionText& mission, Report& report) : m_(mission), report_(report) {}

  void read(const Node& node) {
    const Keys keys(node, "dds",
                    {"domain", "namespace", "interfaces", "peers", "export", "import", "services",
                     "parameters", "humble"},
                    report_);
    DdsOptions& dds = m_.dds;
    dds.on = true;
    dds.where = node.where();
    if (const auto domain = keys.positive("domain", "", true)) {
      if (*domain > max_domain || std::floor(*domain) != *domain)
        report_.add(keys.where("domain"),
                    graph_messages::dds_domain_invalid(number_text(*domain), max_domain));
      else
        dds.domain = static_cast<int>(*domain);
    }
    dds.name_space = keys.text("namespace").value_or("");
    if (!dds.name_space.empty() && !is_topic(dds.name_space, true))
      report_.add(keys.where("namespace"), graph_messages::dds_namespace_invalid(dds.name_space));
    addresses(keys, "interfaces", dds.interfaces);
    if (keys.has("interfaces")) dds.interfaces_where = keys.where("interfaces");
    addresses(keys, "peers", dds.peers);
    dds.services = keys.flag("services").value_or(true);
    dds.parameters = keys.flag("parameters").value_or(true);
    dds.humble = keys.flag("humble").value_or(false);
    for (const Node& item : keys.items("export", "a list of ports such as [nav.state]")) read_export(item);
    for (const Node::Entry& entry : keys.entries("import", "a map {component.input: /topic}"))
      read_import(entry);
  }

 private:
  void addresses(const Keys& keys, const std::string& key, std::vector<std::string>& out) {
    for (const Node& item : keys.items(key, "a list of addresses such as [192.168.1.7]")) {
      const auto text = scalar_text(item, "dds." + key, "an address such as 192.168.1.7", report_);
      if (text && !is_ipv4(*text))
        report_.add(item.where(), graph_messages::dds_address_invalid(key, *text));
      else if (text)
        out.push_back(*text);
    }
  }

  void read_export(const Node& item) {
    DdsOptions::Export e;
    e.where = item.where();
    if (item.is(Node::Kind::map)) {
      const Keys keys(item, "dds.export", {"port", "topic", "rate", "best_effort"}, report_);
      e.port = keys.text("port").value_or("");
      e.topic = keys.text("topic").value_or("");
      if (const auto hz = keys.positive("rate", "Hz")) {
        if (*hz < slowest_hz)
          report_.add(keys.where("rate"), graph_messages::dds_rate_too_low(number_text(*hz)));
        else
          e.period_ns = std::llround(1e9 / *hz);
      }
      e.best_effort = keys.flag("best_effort").value_or(false);
      if (!keys.has("port")) report_.add(item.where(), graph_messages::dds_port_missing());
    } else {
      e.port = scalar_text(item, "dds.export",
                           "a port such as nav.state, or {port, topic, rate, best_effort}", report_)
                   .value_or("");
    }
    if (e.port.empty() || !parse_port_name(e.port, e.where, "dds.export", report_)) return;
    if (e.topic.empty()) e.topic = slashed(e.port);  // relative to the namespace
    if (topic(e.topic, e.where, "dds.export")) m_.dds.exports.push_back(std::move(e));
  }

  void read_import(const Node::Entry& entry) {
    const std::string path = "dds.import." + entry.key;
    const auto to = parse_port_name(entry.key, entry.where(), "dds.import", report_);
    const auto name = scalar_text(entry.value, path, "a topic such as /fulmar/plan_edits", report_);
    if (to && name && topic(*name, entry.where(), path))
      m_.tap.dds_imports.push_back({*to, *name, entry.where()});
  }

  bool topic(const std::string& text, const Where& where, const std::string& path) {
    if (is_topic(text, false)) return true;
    report_.add(where, located(path, graph_messages::dds_topic_invalid(text)));
    return false;
  }

  MissionText& m_;
  Report& report_;
};

/// nullptr when it is missing, or off.
const Node* section(const Keys& mission, const std::string& key, const std::string& expected,
                    Report& report) {
  const Node* node = mission.get(key);
  if (!node || (node->is(Node::Kind::scalar) && node->text == "off")) return nullptr;
  return is_a(Node::Kind::map, *node, key, expected, report) ? node : nullptr;
}

}  // namespace

void read_live(const Keys& mission, MissionText& text, Report& report) {
  const Node* node =
      section(mission, "live", "'off' or a map {listen, token, tiles, attribution, save}", report);
  if (!node) return;
  const Keys keys(*node, "live", {"listen", "token", "tiles", "attribution", "save"}, report);
  text.live.on = true;
  text.live.where = node->where();
  if (const auto listen = keys.text("listen"); listen && !split_address(*listen, text.live))
    report.add(keys.where("listen"), graph_messages::live_address_invalid(*listen));
  text.live.token = keys.text("token").value_or("");
  text.live.tiles = keys.text("tiles").value_or("");
  text.live.attribution = keys.text("attribution").value_or("");
  if (keys.has("tiles") && !is_tiles(text.live.tiles))
    report.add(keys.where("tiles"), graph_messages::live_tiles_invalid(text.live.tiles));
  text.live.save = keys.flag("save");
  if (!text.live.attribution.empty() && text.live.tiles.empty())
    report.add(keys.where("attribution"), graph_messages::live_tiles_missing());
}

LiveOptions parse_live(const std::string& listen) {
  LiveOptions live;
  live.where = {"--live " + listen, 0};
  live.on = listen != "off";
  if (live.on && !split_address(listen, live)) throw Error(graph_messages::live_option_invalid(listen));
  return live;
}

void read_dds(const Keys& mission, MissionText& text, Report& report) {
  if (const Node* node = section(mission, "dds", "'off' or a map {export, import}", report))
    DdsReader(text, report).read(*node);
}

/// Marks inputs that are fed from outside. Call it before the check of unfed inputs.
void mark_imports(Draft& draft) {
  for (std::size_t n = 0; n < draft.text.tap.dds_imports.size(); ++n) {
    const ImportText& import = draft.text.tap.dds_imports[n];
    const std::string path = "dds.import." + import.to.text();
    const int index = draft.candidate(import.to.owner);
    if (index < 0) {
      if (!draft.text.component(import.to.owner) && !taken_away(draft, import.to.owner, import.where, path))
        draft.report.add(import.where, located(path, not_there(draft, import.to.owner)));
      continue;  // it exists with the other io
    }
    Candidate& candidate = nth(draft.candidates, index);
    if (!candidate.loaded) continue;
    const int input = candidate.info().input(import.to.port);
    if (input < 0) {
      draft.report.add(
          import.where,
          located(path, graph_messages::imported_input_unknown(
                            candidate.use, choices_text(import.to.port, names_of(candidate.info().inputs)))));
      continue;
    }
    Wire& wire = nth(candidate.wires, input);
    if (nth(candidate.info().inputs, input).kind == FULMAR_IN_REQUEST)
      draft.report.add(import.where, located(path, graph_messages::imported_input_invalid()));
    // An import of the mission replaces a wire of the file that it extends; there is no other way to remove
    // that wire.
    const bool replaces = import.where.file == draft.text.file->name && wire.where.file != import.where.file;
    if (wire.from.kind != Source::Kind::none && !replaces)
      draft.report.add(import.where,
                       located(path, graph_messages::imported_input_connected(wire.where.text())));
    wire.from = {};
    wire.import = static_cast<int>(n);
    if (wire.max_age_ns <= 0) wire.max_age_ns = candidate.text->max_age_ns.value_or(Wire::unsaid);
    wire.where = import.where;
  }
}

namespace {

const std::string& ros_or_name(const Type& type) { return type.ros.empty() ? type.name : type.ros; }

/// Type of a role's output or a component's; empty for a probe.
TypePtr type_of_port(const Graph& graph, const std::string& port) {
  const std::size_t dot = port.find('.');
  const std::string owner = port.substr(0, dot), output = port.substr(dot + 1);
  if (const Role* role = find_named(graph.roles, owner))
    if (const RolePort* p = find_named(role->outputs, output)) return p->type;
  if (const Component* c = find_named(graph.components, owner))
    if (const Port* p = find_named(c->info().outputs, output)) return p->type;
  return nullptr;
}

}  // namespace

/// Call it after the wires of the graph are built.
void resolve_dds(Draft& draft, const std::vector<std::string>& ports) {
  Graph& graph = draft.graph;
  for (std::size_t c = 0; c < graph.components.size(); ++c)
    for (std::size_t i = 0; i < graph.components[c].wires.size(); ++i) {
      Wire& wire = graph.components[c].wires[i];
      if (wire.import < 0) continue;
      const ImportText& import = nth(draft.text.tap.dds_imports, wire.import);
      wire.import = static_cast<int>(graph.dds.imports.size());
      graph.dds.imports.push_back({static_cast<int>(c), static_cast<int>(i), import.topic, import.where});
    }
  std::map<std::string, std::pair<TypePtr, Where>> known;  // by the topics' full names: each has one type
  const auto add = [&](const std::string& topic, const TypePtr& type, const Where& where,
                       const std::string& path) {
    if (!type) return;
    const std::string space = graph.dds.name_space.empty() ? "/" : "/" + graph.dds.name_space + "/";
    const std::string name = topic.starts_with('/') ? topic : space + topic;
    const auto [at, is_new] = known.try_emplace(name, type, where);
    const auto& [first, first_where] = at->second;
    if (is_new || ros_or_name(*first) == ros_or_name(*type)) return;
    draft.report.add(
        where, located(path, graph_messages::dds_type_differs(name, ros_or_name(*first), first_where.text(),
                                                              ros_or_name(*type))));
  };
  for (const DdsOptions::Import& i : graph.dds.imports) {
    const Component& c = nth(graph.components, i.component);
    const Port& port = nth(c.info().inputs, i.input);
    add(i.topic, port.type, i.where, "dds.import." + c.name + "." + port.name);
  }
  std::vector<std::string> topics;
  for (const DdsOptions::Export& e : graph.dds.exports) {
    add(e.topic, type_of_port(graph, e.port), e.where, "dds.export: " + e.port);
    if (std::find(ports.begin(), ports.end(), e.port) == ports.end() &&
        !taken_away(draft, e.port.substr(0, e.port.find('.')), e.where, "dds.export"))
      draft.report.add(e.where, graph_messages::dds_port_unknown(e.port, choices_text(e.port, ports)));
    if (std::find(topics.begin(), topics.end(), e.topic) != topics.end())
      draft.report.add(e.where, graph_messages::dds_topic_repeated(e.topic));
    topics.push_back(e.topic);
  }
}

}  // namespace fulmar::core
