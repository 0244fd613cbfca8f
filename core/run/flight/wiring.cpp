// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight/wiring.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/run/component/recorded_samples.hpp"
#include "core/run/component/replay_context.hpp"
#include "core/run/state/published.hpp"
#include "core/types/named.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

constexpr std::int64_t paced_hang_ns = 50'000'000;  // default in a paced flight
constexpr std::size_t tape_steps = 256;  // of inputs kept per component, for the rehearsal of a swap

}  // namespace

Wiring::Wiring(FlightState& state) : imports(state.graph.dds.imports.size()), state_(state) {
  for (const Component& c : state.graph.components) units.push_back(make_unit(c));
}

int Wiring::index_of(const Unit& unit) const noexcept {
  return static_cast<int>(unit.component - state_.graph.components.data());
}

std::unique_ptr<Unit> Wiring::make_unit(const Component& c) const {
  const FlightOptions& options = state_.options;
  const bool driver = c.run == RunMode::driver;
  UnitOptions o;
  o.tick_ns = state_.graph.tick_ns;
  o.seed = component_seed(state_.graph.seed, c.name);
  if (c.hang_ns > 0 || !state_.unpaced()) o.hang_ns = c.hang_ns > 0 ? c.hang_ns : paced_hang_ns;
  o.wait_for_async = !state_.on_hardware();
  o.tape_steps = options.keep_inputs && !c.info().vehicle && !driver ? tape_steps : 0;
  if (driver && !options.drivers_from.empty()) o.samples = recorded_samples(c);
  if (options.circumstances) options.circumstances->stand_in(state_.graph, c, o);
  return std::make_unique<Unit>(c, std::move(o));
}

std::unique_ptr<SampleSource> Wiring::recorded_samples(const Component& c) const {
  std::vector<std::string> topics;
  std::string probes;
  for (std::size_t i = 0; i < c.info().outputs.size(); ++i) {
    const bool probe = !c.info().outputs[i].type;
    topics.push_back(probe ? "" : "/" + slashed(topic_name(state_.graph, c, i)));
    if (probe) probes = "/" + c.name + "/probes";
  }
  return std::make_unique<RecordedSamples>(state_.options.drivers_from, c.name, c.info(), topics, probes,
                                           state_.graph.epoch_ns);
}

// ---- wires

void Wiring::connect() {
  delayed_.clear();
  roles_.resize(state_.graph.roles.size());
  for (const auto& unit : units)
    for (Slot& slot : unit->out.slots) {
      slot.queues.clear();
      slot.role = nullptr;
      slot.filler = -1;
    }
  for (std::size_t r = 0; r < roles_.size(); ++r) connect_role(r);
  for (const auto& unit : units)
    for (Reader& reader : unit->in.readers) connect_reader(reader);
}

/// The last sample of a role stays valid while its writer exists.
void Wiring::connect_role(std::size_t r) {
  const Role& role = state_.graph.roles[r];
  roles_[r].resize(role.outputs.size());
  for (std::size_t k = 0; k < role.outputs.size(); ++k) {
    RoleSlot& role_slot = roles_[r][k];
    role_slot.type = role.outputs[k].type;
    role_slot.queues.clear();
    role_slot.plans.assign(role.fillers.size(), CopyPlan{});
    role_slot.copy.resize(role_slot.type ? role_slot.type->size : 0);
    const Slot* const current = std::exchange(role_slot.current, nullptr);
    role_slot.filler = nullptr;
    for (std::size_t f = 0; f < role.fillers.size(); ++f) {
      const int output = role.provides[f][k];
      if (output < 0) continue;
      Slot& slot = nth(unit(role.fillers[f]).out.slots, output);
      slot.role = &role_slot;
      slot.filler = static_cast<int>(f);
      role_slot.plans[f] = copy_plan(*slot.port->type, *role_slot.type);
      if (&slot == current) role_slot.current = current;
      if (slot.owner->active) role_slot.filler = slot.owner;
    }
  }
}

void Wiring::connect_import(Reader& reader) {
  Import& import = nth(imports, reader.wire->import);
  import.reader = &reader;
  import.slot.port = reader.port;
  import.slot.size = reader.port->type->size;
  import.slot.published.resize(import.slot.size);
  if (reader.port->kind != FULMAR_IN_VALUE) return;
  reader.slot = &import.slot;
  reader.plans.push_back(copy_plan(*reader.port->type, *reader.port->type));
}

void Wiring::connect_to_role(Reader& reader) {
  const Source& from = reader.wire->from;
  const auto output = static_cast<std::size_t>(from.output);
  const Role& role = nth(state_.graph.roles, from.index);
  RoleSlot& slot = nth(roles_, from.index)[output];
  reader.role = &slot;
  for (std::size_t f = 0; f < role.fillers.size(); ++f) {
    const int provided = role.provides[f][output];
    if (provided < 0) {
      reader.plans.emplace_back();
      continue;
    }
    const Slot& filler = nth(this->unit(role.fillers[f]).out.slots, provided);
    reader.plans.push_back(copy_plan(*filler.port->type, *reader.port->type));
  }
  if (reader.port->kind != FULMAR_IN_VALUE) slot.queues.emplace_back(&reader, reader.plans);
}

void Wiring::connect_reader(Reader& reader) {
  const Source& from = reader.wire->from;
  const bool value = reader.port->kind == FULMAR_IN_VALUE;
  reader.plans.clear();
  reader.slot = nullptr;
  reader.role = nullptr;
  reader.copied = 0;
  if (reader.wire->import >= 0) return connect_import(reader);
  if (from.kind == Source::Kind::none) return;
  if (from.kind == Source::Kind::component) {
    Slot& slot = nth(this->unit(from.index).out.slots, from.output);
    reader.slot = &slot;
    reader.plans.push_back(copy_plan(*slot.port->type, *reader.port->type));
    if (!value) slot.queues.emplace_back(&reader, &reader.plans.front());
  } else {
    connect_to_role(reader);
  }
  reader.delayed = value && reader.wire->delayed;
  if (reader.delayed) delayed_.push_back(&reader);
  for (const CopyPlan& plan : reader.plans)
    if (reader.delayed || !plan.whole) reader.copy.assign(reader.port->type->size, std::byte{0});
}

// ---- samples

void Wiring::publish(Unit& unit, Recorder& recorder) {
  unit.completed_ns = state_.now_ns;
  unit.out.publish([&](Slot& slot) {
    const std::byte* const message = slot.published.data();
    for (auto& [reader, plan] : slot.queues) reader->push(message, slot.valid_at_ns, *plan);
    if (slot.role) {
      slot.role->current = &slot;
      ++slot.role->sequence;
      for (auto& [reader, plans] : slot.role->queues)
        reader->push(message, slot.valid_at_ns, nth(plans, slot.filler));
    }
    recorder.put(slot);
  });
  recorder.put_probes(unit);
}

void Wiring::publish_import(std::size_t import, const std::byte* message) {
  auto& [slot, reader] = imports[import];
  std::memcpy(slot.published.data(), message, slot.size);
  slot.valid_at_ns = state_.now_ns;
  ++slot.sequence;
  if (reader->port->kind != FULMAR_IN_VALUE) reader->push(message, state_.now_ns);
}

bool Wiring::held_for(const Condition& condition, std::int64_t for_ns,
                      std::int64_t& since_ns) const noexcept {
  if (!condition.holds(*this)) {
    since_ns = never_ns;
    return false;
  }
  if (since_ns == never_ns) since_ns = state_.now_ns;
  return state_.now_ns - since_ns >= for_ns;
}

void Wiring::latch() noexcept {
  for (Reader* reader : delayed_) reader->latch();
}

const Slot* Wiring::slot_of(const Source& source) const noexcept {
  const auto index = static_cast<std::size_t>(source.index), output = static_cast<std::size_t>(source.output);
  if (source.kind == Source::Kind::component) return &units[index]->out.slots[output];
  if (source.kind == Source::Kind::role) return roles_[index][output].current;
  return nullptr;
}

void Wiring::expect_from(Unit& unit) noexcept {
  for (Slot& slot : unit.out.slots)
    if (slot.role) slot.role->filler = &unit;
}

bool Wiring::has_published(std::size_t role) const noexcept {
  return std::any_of(roles_[role].begin(), roles_[role].end(),
                     [](const RoleSlot& slot) { return slot.sequence > 0; });
}

const std::byte* Wiring::message_of(const Source& source) const noexcept {
  if (source.kind != Source::Kind::role) return slot_of(source)->published.data();
  return nth(nth(roles_, source.index), source.output).message();
}

const std::byte* Wiring::sample(const Source& source) const noexcept {
  const Slot* const slot = slot_of(source);
  if (!slot || slot->sequence == 0 || slot->owner->stopped) return nullptr;
  if (source.kind == Source::Kind::role) {
    const Publisher* const filler = nth(nth(roles_, source.index), source.output).filler;
    if (filler && filler->stopped) return nullptr;
  }
  return message_of(source);
}

}  // namespace fulmar::core
