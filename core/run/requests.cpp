// SPDX-License-Identifier: BSD-3-Clause
// What enters a flight from outside, between ticks: requests, live parameters, the reset of a guard.
#include "core/run/flight_impl.hpp"

namespace fulmar::core {

Unit& Flight::Impl::unit(const std::string& component) {
  std::vector<std::string> names;
  for (const auto& u : units) {
    if (u->component->name == component) return *u;
    names.push_back(u->component->name);
  }
  throw Error("there is no component '" + component + "'." + choices_text(component, names));
}

void Flight::request(const std::string& component, const std::string& port, const std::byte* message,
                     std::function<void(const std::string&)> answered) {
  Unit& unit = impl_->unit(component);
  std::vector<std::string> names;
  for (Reader& r : unit.readers) {
    if (r.port->kind != FULMAR_IN_REQUEST) continue;
    names.push_back(r.port->name);
    if (r.port->name != port) continue;
    CopyPlan whole;
    whole.size = r.port->type->size;
    if (r.count == r.port->capacity)
      throw Error(component + "." + port + " has " + std::to_string(r.count) + " requests waiting; there is no room for more");
    if (const Guard guard(*r.port->type); !guard.check(message)) throw Error(component + "." + port + ": " + guard.explain(message));
    r.push(message, impl_->now_ns, whole);
    r.replies[r.count - 1] = std::move(answered);
    impl_->event(EventKind::request, component, port);
    return;
  }
  throw Error("'" + component + "' takes no request '" + port + "'." + choices_text(port, names));
}

void Flight::set_parameter(const std::string& component, const std::string& param, const ParamValue& value) {
  Unit& unit = impl_->unit(component);
  const int i = unit.info->param(param);
  if (i < 0) {
    std::vector<std::string> names;
    for (const ParamInfo& p : unit.info->params) names.push_back(p.name);
    throw Error("'" + component + "' has no parameter '" + param + "'." + choices_text(param, names));
  }
  const ParamInfo& info = unit.info->params[static_cast<std::size_t>(i)];
  if (!info.live) throw Error(component + "." + param + " is a set-up parameter: it cannot change in flight");
  const double number = info.kind == FULMAR_NUMBER ? value.number[0] : static_cast<double>(value.integer);
  if (info.kind != FULMAR_VECTOR && !(number >= info.min && number <= info.max))
    throw Error(component + "." + param + ": " + std::to_string(number) + " is outside " + std::to_string(info.min) + " .. " +
                std::to_string(info.max));
  unit.base[static_cast<std::size_t>(i)] = value;
  const std::vector<Overlay>* overlay = impl_->overlay_of(static_cast<int>(unit.component - impl_->graph.components.data()));
  if (!unit.dead() && !unit.retune(overlay)) throw Error(component + ": " + unit.problem.text);
  impl_->event(EventKind::parameter, component, param + " = " + std::to_string(number));
}

const std::vector<Overlay>* Flight::Impl::overlay_of(int component) const {
  for (const Assignment& a : graph.phases[static_cast<std::size_t>(phase)].roles)
    if (a.component == component && !a.set.empty()) return &a.set;
  return nullptr;
}

const Tape* Flight::tape(const std::string& component) const { return impl_->unit(component).tape.get(); }

void Flight::reset_guards() {
  for (std::size_t i = 0; i < impl_->units.size(); ++i) {
    Unit* unit = impl_->units[i].get();
    if (!unit->stopped) continue;
    const std::string name = unit->component->name;
    if (unit->dead()) {
      if (const std::string why = impl_->in_use(); !why.empty()) {
        impl_->event(EventKind::request, name, "guard not reset: its process has ended, and is started anew on the ground; " + why);
        continue;
      }
      impl_->restart(i);
      unit = impl_->units[i].get();
    }
    unit->stopped = false;
    unit->overruns_in_a_row = 0;
    unit->fresh_start = true;
    impl_->event(EventKind::request, name, "guard reset");
  }
}

}  // namespace fulmar::core
