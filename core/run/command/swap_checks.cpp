// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/command/swap_checks.hpp"

#include <algorithm>
#include <tuple>

#include "core/graph/params.hpp"
#include "core/loader/probe.hpp"
#include "core/run/messages.hpp"
#include "core/run/state/published.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

std::string version_words(const PluginInfo& plugin) {
  return plugin.file + " " + plugin.version + " (" + plugin.sha256.substr(0, 12) + ")";
}

namespace {

bool can_carry(const ParamInfo& old, const ParamInfo& now) {
  if (now.kind != old.kind || now.choices != old.choices) return false;
  return (now.kind != FULMAR_RECORD && now.kind != FULMAR_VECTOR) || now.type->hash == old.type->hash;
}

std::string listed(const MessageText<1>& message, const std::vector<std::string>& items) {
  return items.empty() ? "" : "; " + message(join(items)).text;
}

}  // namespace

std::string parameter_words(const ComponentInfo& from, const std::vector<ParamValue>& values,
                            const ComponentInfo& to, const std::vector<ParamValue>& into) {
  std::vector<std::string> kept, fresh, gone;
  for (std::size_t k = 0; k < to.params.size(); ++k) {
    const ParamInfo& now = to.params[k];
    const int i = from.param(now.name);
    if (i < 0 || !can_carry(nth(from.params, i), now)) {
      fresh.push_back(now.name + " = " + value_text(now, into[k]));
      continue;
    }
    const ParamInfo& old = nth(from.params, i);
    const std::string is = value_text(old, nth(values, i)), usual = value_text(now, initial_value(now));
    if (usual != value_text(old, initial_value(old)) && is != usual && is != value_text(now, into[k]))
      kept.push_back(run_messages::parameter_default_changed(now.name, is, usual));
  }
  for (const ParamInfo& old : from.params)
    if (const int k = to.param(old.name); k < 0) gone.push_back(old.name);
  const std::string all = listed(run_messages::parameters_kept, kept) +
                          listed(run_messages::parameters_added, fresh) +
                          listed(run_messages::parameters_removed, gone);
  return all.empty() ? all : all.substr(2);
}

void carry_parameters(const ComponentInfo& from, const std::vector<ParamValue>& values,
                      const ComponentInfo& to, std::vector<ParamValue>& into) {
  for (std::size_t i = 0; i < from.params.size(); ++i) {
    const ParamInfo& old = from.params[i];
    const int k = to.param(old.name);
    if (k < 0) continue;
    const ParamInfo& now = nth(to.params, k);
    if (!can_carry(old, now)) continue;
    const double number =
        now.kind == FULMAR_NUMBER ? values[i].number[0] : static_cast<double>(values[i].integer);
    const bool ranged = now.kind == FULMAR_NUMBER || now.kind == FULMAR_COUNT;
    if (ranged && !(number >= now.min && number <= now.max))
      throw Error(run_messages::value_not_carried(now.name, value_text(old, values[i]), now.min, now.max));
    nth(into, k) = values[i];
  }
}

std::string structural_difference(const Graph& now, const Graph& next) {
  const auto differs = [](const auto& a, const auto& b, auto same) {
    if (a.size() != b.size()) return true;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same(a[i], b[i])) return true;
    return false;
  };
  const auto same_component = [](const Component& a, const Component& b) {
    return a.name == b.name && a.roles == b.roles && a.period_ns == b.period_ns && a.run == b.run;
  };
  if (differs(now.components, next.components, same_component)) return "other components";
  if (differs(now.roles, next.roles,
              [](const Role& a, const Role& b) { return a.name == b.name && a.fillers == b.fillers; }))
    return "other roles";
  if (differs(now.phases, next.phases, [](const Phase& a, const Phase& b) { return a.name == b.name; }))
    return "other phases";
  if (now.order != next.order) return run_messages::step_order_differs().line();
  if (now.tick_ns != next.tick_ns || now.io != next.io) return run_messages::rate_or_io_differs().line();
  const auto same_import = [](const auto& a, const auto& b) {
    return a.component == b.component && a.input == b.input && a.topic == b.topic;
  };
  if (differs(now.dds.imports, next.dds.imports, same_import)) return "other imports";
  return "";
}

void check_unloads(const PluginInfo& was, const ComponentInfo& component) {
  if (component.resident || !was.script.empty() || !stays_mapped(was.copy)) return;
  throw Error(run_messages::plugin_not_unloaded(was.file));
}

bool same_inputs(const ComponentInfo& a, const ComponentInfo& b) {
  return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(),
                    [](const Port& x, const Port& y) {
                      return x.name == y.name && x.kind == y.kind && x.capacity == y.capacity &&
                             x.type->hash == y.type->hash;
                    });
}

bool same_entrances(const Component& a, const Component& b) {
  const auto entrances = [](const Component& c) {
    std::vector<std::tuple<std::string, std::uint32_t, std::uint64_t, int>> list;
    for (std::size_t i = 0; i < c.info().inputs.size(); ++i)
      if (const Port& port = c.info().inputs[i]; port.kind == FULMAR_IN_REQUEST || c.wires[i].import >= 0)
        list.emplace_back(port.name, port.capacity, port.type->hash, c.wires[i].import);
    return list;
  };
  return entrances(a) == entrances(b);
}

void rehearse(const Component& component, std::int64_t tick_ns, std::uint64_t seed, const Tape* tape) {
  Component in_child = component;
  in_child.run = RunMode::process;
  UnitOptions options;
  options.tick_ns = tick_ns;
  options.seed = seed;
  Unit unit(in_child, std::move(options));
  unit.configure();
  if (tape && !unit.rehearse(*tape)) throw Error(std::string(unit.problem.text));
}

}  // namespace fulmar::core
