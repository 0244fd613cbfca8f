// SPDX-License-Identifier: BSD-3-Clause
// Mission text + plugins -> graph: existing components, fillers of roles, created components.
#include <algorithm>
#include <cmath>

#include "core/graph/draft.hpp"
#include "core/graph/messages.hpp"
#include "core/graph/private_file.hpp"
#include "core/graph/quantity.hpp"
#include "core/graph/shipped.hpp"
#include "core/loader/home.hpp"
#include "core/loader/script.hpp"
#include "core/types/names.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
Diagnostic not_there(const Draft& draft, const std::string& name) {
  if (const ComponentText* out = draft.text.component(name); out && draft.is_out(*out))
    return graph_messages::component_of_other_io(name, io_word(*out->only));
  return no_such("component", name, draft.candidates);
}

bool taken_away(Draft& draft, const std::string& name, const Where& where, const std::string& path) {
  return draft.report.still_named({"components." + name, "roles." + name}, where, path);
}

void report(Draft& draft, const Where& where, const std::string& path, const Error& fault) {
  const auto* const gone = dynamic_cast<const NoOwner*>(&fault);
  if (!gone || !taken_away(draft, gone->owner, where, path))
    draft.report.add(where, located(path, fault.diagnostic));
}

bool provided(const Graph& graph, const Source& source) {
  const auto& provides = nth(graph.roles, source.index).provides;
  return std::any_of(provides.begin(), provides.end(),
                     [&](const auto& outputs) { return nth(outputs, source.output) >= 0; });
}

namespace {

/// "build/my_law.so", in contrast to "control_slc/Outer" as in `use`.
bool is_file(const std::string& word) {
  std::error_code fault;
  return word.ends_with(".so") || !script_host(word).empty() || fs::is_regular_file(word + ".so", fault);
}

void load_component(Draft& draft, Catalogue& catalogue, Candidate& candidate) {
  const ComponentText& text = *candidate.text;
  if (text.use.text.empty()) return;
  const std::string path = "components." + text.name;
  Where where = text.use.where;
  try {
    auto [plugin, component] = split_use(text.use.text);
    std::string unnamed;  // the file of --with, when it names no component
    for (const auto& [name, word] : draft.overrides.with) {
      if (name != text.name) continue;
      const auto [named, part] = is_file(word) ? std::pair{word, std::string()} : split_use(word);
      plugin = is_file(named) ? fs::absolute(named).string() : named;
      unnamed = part.empty() && draft.overrides.swaps != text.name ? word : "";
      if (!part.empty()) component = part;
      if (draft.overrides.swaps != text.name) where = {"--with " + name + "=" + word, 0};
    }
    const FoundPlugin found = catalogue.open(plugin);
    candidate.plugin = found.info;
    candidate.library = found.library;
    const auto& components = found.info->components;
    if (components.empty()) throw Error(graph_messages::plugin_without_components(plugin));
    if (!unnamed.empty() && index_named(components, component) < 0) {
      if (components.size() > 1)
        throw Error(graph_messages::plugin_component_unknown(
            has_no("the plugin " + unnamed, "component", component, components), text.name, unnamed,
            components[0].name));
      component.clear();
    }
    if (!component.empty())
      candidate.index_in_plugin =
          static_cast<std::size_t>(require_named(components, component, "the plugin " + plugin, "component"));
    const std::string stem = fs::path(found.info->file).stem().string();
    candidate.use = (stem.empty() ? plugin : stem) + "/" + candidate.info().name;
    candidate.loaded = true;
  } catch (const Error& fault) {
    draft.report.add(where, located(path, fault.diagnostic));
  }
}

void collect_candidates(Draft& draft, Catalogue& catalogue) {
  for (const RoleText& text : draft.text.roles) {
    draft.roles.push_back({&text, text.name, {}, {}});
    if (draft.text.component(text.name))
      draft.report.add(text.where, graph_messages::role_name_taken(text.name));
  }
  for (const ComponentText& text : draft.text.components) {
    if (draft.is_out(text)) continue;
    Candidate candidate;
    candidate.text = &text;
    static_cast<ComponentSettings&>(candidate) = static_cast<const ComponentSettings&>(text);
    load_component(draft, catalogue, candidate);
    for (const Word& fills : text.fills) {
      const int role = draft.role(fills.text);
      if (role < 0 && !taken_away(draft, fills.text, fills.where, "components." + text.name + ".fills"))
        draft.report.add(fills.where,
                         located("components." + text.name, no_such("role", fills.text, draft.roles)));
      else if (role >= 0)
        candidate.roles.push_back(role);
    }
    std::sort(candidate.roles.begin(), candidate.roles.end());
    if (text.rate_hz > draft.text.rate_hz * (1 + 1e-9))
      draft.report.add(text.where_rate,
                       graph_messages::component_rate_too_high(text.name, number_text(text.rate_hz),
                                                               number_text(draft.text.rate_hz)));
    draft.candidates.push_back(std::move(candidate));
  }
}

/// Components that are created: those without a role, those that a condition names or a phase assigns, and
/// those that are wired to them by name.
void mark_used(Draft& draft) {
  std::vector<Candidate*> todo;
  for (Candidate& candidate : draft.candidates) {
    candidate.used = candidate.used || candidate.assigned || candidate.text->fills.empty();
    if (candidate.used) todo.push_back(&candidate);
  }
  while (!todo.empty()) {
    const Candidate& reader = *todo.back();
    todo.pop_back();
    for (const Wire& wire : reader.wires) {
      if (wire.from.kind != Source::Kind::component) continue;
      Candidate& writer = nth(draft.candidates, wire.from.index);
      if (!writer.used) todo.push_back(&writer);
      writer.used = true;
    }
  }
}

Source in_graph(const Draft& draft, Source source) {
  if (source.kind != Source::Kind::component) return source;
  source.index = nth(draft.candidates, source.index).component;
  return source.index < 0 ? Source{} : source;  // its component was rejected
}

/// Plugins of the host are in its own folder.
bool installed(const PluginInfo& plugin) {
  std::error_code code;
  const fs::path self = fs::read_symlink("/proc/self/exe", code);
  const fs::path folder = self.parent_path().parent_path() / "lib" / "fulmar";
  return fs::weakly_canonical(fs::path(plugin.path).parent_path(), code) ==
         fs::weakly_canonical(folder, code);
}

/// Run mode of a component, and the limits of each mode. On hardware, a plugin from outside the installation
/// runs in a child.
void run_mode(Draft& draft, Candidate& candidate) {
  const ComponentText& text = *candidate.text;
  const ComponentInfo& info = candidate.info();
  const bool foreign =
      draft.text.io == Io::fcu && !info.vehicle && candidate.library && !installed(*candidate.plugin);
  candidate.run = text.run.value_or(foreign ? RunMode::process : RunMode::tick);
  const std::string path = "components." + text.name;
  if (info.vehicle && candidate.run != RunMode::tick)
    draft.report.add(text.where, graph_messages::vehicle_run_invalid(path));
  if (candidate.run == RunMode::driver) {
    for (const Port& port : info.outputs)
      if (port.kind != FULMAR_OUT_QUEUE && port.kind != FULMAR_OUT_PROBE)
        draft.report.add(text.where, graph_messages::driver_output_invalid(path, port.name, candidate.use));
    if (!info.inputs.empty())
      draft.report.add(text.where,
                       graph_messages::driver_with_input(path, candidate.use, info.inputs[0].name));
  }
}

/// Names that a command can use, and that the log therefore holds.
void check_names(Draft& draft, const Candidate& candidate) {
  const auto check = [&](const char* what, const std::string& name) {
    if (name.size() < name_room) return;
    draft.report.add(candidate.where,
                     graph_messages::plugin_name_too_long(candidate.name, what, name, candidate.use,
                                                          name.size(), name_room - 1));
  };
  for (const Port& port : candidate.info().inputs) check("input", port.name);
  for (const ParamInfo& param : candidate.info().params) check("parameter", param.name);
}

void build_components(Draft& draft) {
  for (Candidate& candidate : draft.candidates) {
    if (!candidate.used || !candidate.loaded) continue;
    check_names(draft, candidate);
    candidate.component = static_cast<int>(draft.graph.components.size());
    const double rate = candidate.text->rate_hz;
    candidate.period_ns = rate > 0 && rate < draft.text.rate_hz * (1 - 1e-9) ? std::llround(1e9 / rate) : 0;
    run_mode(draft, candidate);
    if (candidate.info().vehicle) draft.graph.vehicle = candidate.component;
    Component& component = draft.graph.components.emplace_back(candidate);
    if (!candidate.assigned) component.roles.clear();
    if (component.run == RunMode::process) component.library.reset();  // only the child needs the code
  }
}

void build_roles(Draft& draft) {
  for (const RoleDraft& from : draft.roles) {
    Role role;
    role.name = from.name;
    role.where = from.text->where;
    for (std::size_t o = 0; o < from.text->out.size(); ++o)
      role.outputs.push_back({from.text->out[o].name, from.types[o], from.text->out[o].optional});
    for (const int f : from.fillers) {
      const Candidate& filler = nth(draft.candidates, f);
      if (filler.component < 0 || !filler.assigned) continue;
      role.fillers.push_back(filler.component);
      role.provides.emplace_back();
      for (const RolePort& port : role.outputs)
        role.provides.back().push_back(filler.info().output(port.name));
    }
    draft.graph.roles.push_back(std::move(role));
  }
}

void build_wires(Draft& draft) {
  for (const Candidate& candidate : draft.candidates) {
    if (candidate.component < 0) continue;
    Component& component = nth(draft.graph.components, candidate.component);
    component.wires = candidate.wires;
    for (Wire& wire : component.wires) {
      wire.from = in_graph(draft, wire.from);
      // an output of a role that no filler in this run has feeds nothing
      if (wire.from.kind == Source::Kind::role && !provided(draft.graph, wire.from)) wire.from = {};
    }
  }
}

/// Whether the output belongs to a role: it is then recorded under the role's name.
bool provides(const Graph& graph, const Component& component, int output) {
  for (const int r : component.roles) {
    const Role& role = nth(graph.roles, r);
    for (std::size_t f = 0; f < role.fillers.size(); ++f)
      if (&nth(graph.components, role.fillers[f]) == &component &&
          std::find(role.provides[f].begin(), role.provides[f].end(), output) != role.provides[f].end())
        return true;
  }
  return false;
}

/// The names under which outputs are recorded, shown and exported.
std::vector<std::string> tap_ports(const Graph& graph) {
  std::vector<std::string> ports;
  for (const Role& role : graph.roles)
    for (const RolePort& port : role.outputs) ports.push_back(role.name + "." + port.name);
  for (const Component& component : graph.components) {
    bool probes = false;
    for (std::size_t o = 0; o < component.info().outputs.size(); ++o) {
      const Port& port = component.info().outputs[o];
      probes = probes || !port.type;
      if (port.type && !provides(graph, component, static_cast<int>(o)))
        ports.push_back(component.name + "." + port.name);
    }
    if (probes) ports.push_back(component.name + ".probes");
  }
  return ports;
}

void check_record_rules(Draft& draft, const std::vector<std::string>& ports) {
  for (std::size_t i = 0; i < draft.text.record_rules.size(); ++i) {
    const std::string& pattern = draft.text.record_rules[i].ports[0];
    if (pattern.size() < 200 && std::count(pattern.begin(), pattern.end(), '*') < 5 &&
        std::any_of(ports.begin(), ports.end(),
                    [&](const std::string& port) { return port_matches(port, pattern); }))
      continue;
    if (taken_away(draft, pattern.substr(0, pattern.find('.')), draft.text.tap.record[i], "record.ports"))
      continue;
    const std::string near = nearest(pattern, ports);
    draft.report.add(
        draft.text.tap.record[i],
        graph_messages::record_port_unknown(pattern, near.empty() ? "" : " Did you mean '" + near + "'?"));
  }
}

void read_control(Draft& draft) {
  for (const Word& word : draft.text.control) {
    const int role = draft.role(word.text);
    if (role < 0 && taken_away(draft, word.text, word.where, "control")) continue;
    if (role < 0)
      draft.report.add(word.where, located("control", no_such("role", word.text, draft.roles)));
    else if (role == draft.role("vehicle"))
      draft.report.add(word.where, graph_messages::control_role_invalid());
    else
      draft.graph.control.push_back(role);
  }
}

void read_head(Draft& draft) {
  Graph& graph = draft.graph;
  static_cast<Settings&>(graph) = static_cast<const Settings&>(draft.text);
  graph.tick_ns = std::llround(1e9 / draft.text.rate_hz);
  if (draft.text.node.airframe.is(Node::Kind::scalar)) graph.airframe = draft.text.node.airframe.text;
}

void resolve(Draft& draft, Catalogue& catalogue) {
  read_head(draft);
  collect_candidates(draft, catalogue);
  resolve_roles(draft);
  check_groups(draft);
  resolve_wires(draft);
  read_values(draft);
  assign_roles(draft);
  report_overlaid(draft);
  name_ports(draft);
  mark_used(draft);
  choose_vehicle(draft);
  build_components(draft);
  build_roles(draft);
  check_fed(draft);
  build_wires(draft);
  compile_phases(draft);
  order_steps(draft);
  guard_wires(draft);
  report_two_fences(draft);
  read_failsafe(draft);
  read_vehicle_flags(draft);
  read_control(draft);
  const std::vector<std::string> ports = tap_ports(draft.graph);
  check_record_rules(draft, ports);
  resolve_dds(draft, ports);
  if (!draft.overrides.files) report_simulator_ports(draft, catalogue);
}

/// Whether `--with` names this file: by its search name, in a folder and perhaps without its ending.
bool asked_for(const fs::path& file, const fs::path& plugin) {
  const std::string found = "/" + plugin.lexically_normal().string();
  const std::string asked = "/" + file.lexically_normal().string();
  if (file.is_absolute()) return found == asked || found == asked + ".so";
  return found.ends_with(asked) || found.ends_with(asked + ".so");
}

/// A log is untrusted data. Plugins come from the installation, from the store of copies, or from `--with`;
/// never from a path in the log.
void admit_again(const fs::path& plugin, const Overrides& overrides) {
  const std::vector<fs::path> ours = plugin_folders();
  if (std::find(ours.begin(), ours.end(), plugin.parent_path()) != ours.end()) return;
  for (const auto& [component, use] : overrides.with)
    if (asked_for(split_use(use).first, plugin)) return;
  const std::string sha256 = sha256_file(plugin);
  const bool flew =
      std::find(overrides.flown.begin(), overrides.flown.end(), sha256) != overrides.flown.end();
  throw Error(graph_messages::plugin_not_admitted(
      plugin.string(), flew ? " is what flew, says the log, but is not of the installation"
                            : " is not what flew: its SHA-256 is " + sha256));
}

}  // namespace

Graph load_mission(const std::string& file, const Overrides& given, Catalogue& catalogue) {
  Report report;
  for (const auto& [role, component] : given.roles) report.opened("--role " + role + "=" + component);
  for (const auto& [name, with] : given.with) report.opened("--with " + name + "=" + with);
  for (const auto& [name, value] : given.set) report.opened("--set " + name + "=" + value);
  for (const std::string& ports : given.record) report.opened("--record " + ports);
  const MissionText text = parse_mission(file, given, report);
  if (!given.files) check_hardware(text, given, report);  // a mission from a log was flown already
  const Overrides overrides = with_components(text, given, report);
  catalogue.admit = [&overrides](const fs::path& plugin) {
    check_private_file(plugin);
    if (overrides.files) admit_again(plugin, overrides);
  };
  FileStore files(report, overrides.files.get());
  for (const FilePtr& read : text.files) files.keep(read);
  Draft draft{text, overrides, report, files, {}, {}, {}, {}};
  resolve(draft, catalogue);
  for (const auto& [name, with] : overrides.with)
    if (!text.component(name) && !text.role(name))
      report.add({"--with " + name + "=" + with, 0}, not_there(draft, name));
  report.throw_if_any();
  draft.graph.source.attachments = files.attachments();
  draft.graph.source.file = text.file->path.string();
  draft.graph.source.overrides = overrides;
  draft.graph.source.files = files.paths();
  return std::move(draft.graph);
}

Graph load_mission(const std::string& file, const Overrides& overrides) {
  PluginCatalogue catalogue(PluginCatalogue::folders_for(named_file({}, file)));
  return load_mission(file, overrides, catalogue);
}

bool port_matches(const std::string& text, const std::string& pattern, std::size_t t, std::size_t p) {
  while (p < pattern.size() && pattern[p] != '*') {
    if (t >= text.size() || text[t] != pattern[p]) return false;
    ++t;
    ++p;
  }
  if (p == pattern.size()) return t == text.size();
  while (p < pattern.size() && pattern[p] == '*') ++p;
  for (; t <= text.size(); ++t)
    if (port_matches(text, pattern, t, p)) return true;
  return false;
}

}  // namespace fulmar::core
