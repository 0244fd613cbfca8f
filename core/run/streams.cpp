// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/streams.hpp"

#include <algorithm>

#include "core/run/unit.hpp"

namespace fulmar::core {
namespace {

constexpr int habit = 50;  // steps in a row with a sample make a stream

}  // namespace

void Streams::add(const Slot& slot, std::int64_t limit_ns) {
  if (slot.port->kind != FULMAR_OUT_EVENT || slot.owner->info->vehicle) return;
  for (Stream& s : streams_)
    if (s.slot == &slot) {
      s.limit_ns = std::min(s.limit_ns, limit_ns);
      return;
    }
  streams_.push_back({.slot = &slot, .limit_ns = limit_ns});
}

void Streams::connect(const Wiring& wiring, const FlightState& state) {
  streams_.clear();
  for (const auto& unit : wiring.units)
    for (const Reader& reader : unit->in.readers) {
      const Wire& wire = *reader.wire;
      if (!wire.by_steps || wire.max_age_ns <= 0) continue;
      if (wire.from.kind == Source::Kind::component)
        add(nth(wiring.unit(wire.from.index).out.slots, wire.from.output), wire.max_age_ns);
      if (wire.from.kind != Source::Kind::role) continue;
      const Role& role = nth(state.graph.roles, wire.from.index);
      for (std::size_t f = 0; f < role.fillers.size(); ++f)
        if (const int output = nth(role.provides[f], wire.from.output); output >= 0)
          add(nth(wiring.unit(role.fillers[f]).out.slots, output), wire.max_age_ns);
    }
}

void Streams::watch(std::int64_t now_ns, Recorder& recorder) noexcept {
  for (Stream& s : streams_) {
    const Unit& unit = *s.slot->owner;
    if (!unit.active || unit.stopped) {
      s.streak = 0;
      s.told = false;
      continue;
    }
    if (unit.out.completed_ns == s.completed_ns) continue;
    s.completed_ns = unit.out.completed_ns;
    const bool published = s.slot->sequence != s.sequence;
    s.sequence = s.slot->sequence;
    const bool returns = published && s.told,
               lapses = !published && !s.told && s.streak >= habit && now_ns - s.published_ns > s.limit_ns;
    if (published) s.published_ns = now_ns;
    if (published) s.streak = std::min(s.streak + 1, habit);
    if (!published && s.streak < habit) s.streak = 0;
    if (!returns && !lapses) continue;
    s.told = lapses;
    Event e = event_of(Code::notice, unit.component->name);
    e.severity = Severity::warning;
    if (lapses)
      say(e, "nothing on '%s' for %.1f s, though it steps: who reads it goes on with the last of it",
          s.slot->port->name.c_str(), 1e-9 * static_cast<double>(now_ns - s.published_ns));
    else
      say(e, "speaks on '%s' again", s.slot->port->name.c_str());
    recorder.note(e);
  }
}

}  // namespace fulmar::core
