// SPDX-License-Identifier: BSD-3-Clause
// A unit before and between flights: rooms for its ports, its instance in this process or in a child, its parameters.
#include <cstdio>

#include "core/replay/playback.hpp"
#include "core/run/realtime.hpp"
#include "core/run/unit.hpp"

namespace fulmar::core {

Unit::Unit(const Component& c, UnitOptions options)
    : component(&c),
      info(&c.info()),
      slots(info->outputs.size()),
      readers(info->inputs.size()),
      base(c.params),
      inputs_(info->inputs.size()),
      outputs_(info->outputs.size()),
      last_(info->outputs.size()),
      values_(info->params.size()),
      samples_(std::move(options.samples)),
      wait_for_async_(options.wait_for_async),
      late_(std::move(options.late)),
      tick_ns_(options.tick_ns) {
  stats.name = c.name;
  active = c.role < 0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Slot& s = slots[i];
    s.port = &info->outputs[i];
    s.owner = this;
    s.size = s.port->type ? s.port->type->size : sizeof(double);
    s.staging.resize(std::size_t{s.size} * s.port->capacity);
    s.published.resize(s.size);
    s.stamps.resize(s.port->capacity);
    if (s.port->type)
      s.guard = std::make_unique<Guard>(*s.port->type);
    else
      probes.push_back(static_cast<std::uint32_t>(i));
  }
  probe_values.resize(probes.size());
  for (std::size_t i = 0; i < readers.size(); ++i) {
    Reader& r = readers[i];
    r.port = &info->inputs[i];
    r.wire = &c.wires[i];
    r.max_age_ns = r.wire->max_age_ns;
    if (r.port->kind == FULMAR_IN_VALUE) continue;
    r.items.resize(std::size_t{r.port->capacity} * r.port->type->size);
    r.stamps.resize(r.port->capacity);
    r.answers.resize(r.port->capacity);
    r.replies.resize(r.port->capacity);
    if (r.port->kind == FULMAR_IN_REQUEST) refusals.reserve(32);
  }
  if (options.tape_steps > 0) tape = std::make_unique<Tape>(*info, options.tape_steps);
  if (!samples_) create(options);
}

void Unit::create(const UnitOptions& options) {
  const Component& c = *component;
  if (options.playback) {
    functions_ = &Playback::functions();
    instance_ = options.playback;
    return;
  }
  if (c.run == RunMode::process) {
    IsolatedOptions o;
    o.name = c.name, o.copy = c.plugin->copy, o.script = c.plugin->script, o.file = c.plugin->file, o.path = c.plugin->path;
    o.index = c.index_in_plugin, o.seed = options.seed;
    if (options.paced) o.hang_ns = c.hang_ns;
    child_ = std::make_unique<Isolated>(*info, o);
    wait_for_child(child_->pid());
    functions_ = &Isolated::functions();
    instance_ = child_.get();
    return;
  }
  functions_ = &c.library->functions(c.index_in_plugin);
  {
    const Inside inside(c.name, "constructor");
    instance_ = functions_->create(options.seed, &problem);
  }
  if (!instance_) throw Error(c.where.text() + ": " + c.name + ": cannot be created: " + problem.text);
  if (c.run == RunMode::async) {
    const std::int64_t period = c.period_ns > 0 ? c.period_ns : tick_ns_;
    const auto depth = static_cast<std::size_t>(c.latency_ns / period) + 4;  // steps on their way, and room for retune and activate
    async_ = std::make_unique<Async>(c.name, *functions_, instance_, *info, depth);
    late_due_ns.reserve(depth);
  }
  if (c.run == RunMode::driver) samples_ = std::make_unique<Driver>(c.name, *functions_, instance_, *info);
}

Unit::~Unit() {
  async_.reset();
  samples_.reset();
  if (!instance_) return;
  if (active) deactivate();
  const Inside inside(component->name, "destructor");
  functions_->destroy(instance_);
}

void Unit::configure() {
  if (!instance_) return;  // the samples come from a log
  fill_values(values_, nullptr, true);
  problem.text[0] = '\0';
  const Inside inside(component->name, "configure");
  if (functions_->configure(instance_, values_.data(), &problem) == FULMAR_FAILED)
    throw Error(component->where.text() + ": " + component->name + ": " + (problem.text[0] ? problem.text : "refuses its parameters"));
}

std::unique_ptr<Tape> Unit::present_inputs(std::int64_t now_ns, std::uint64_t index) {
  if (prepare_inputs(now_ns) == Inputs::missing) return nullptr;
  auto now = std::make_unique<Tape>(*info, 1);
  now->record(tick(now_ns, index), inputs_);
  return now;
}

void Unit::keep_log_settings(const Unit& from) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const int k = from.info->output(slots[i].port->name);
    if (k < 0) continue;
    const Slot& was = from.slots[static_cast<std::size_t>(k)];
    slots[i].channel = was.channel, slots[i].log_period_ns = was.log_period_ns, slots[i].log_due_ns = was.log_due_ns;
    if (was.hash) slots[i].hash = std::make_unique<MessageHash>(*slots[i].port->type);
  }
  for (Reader& reader : readers)
    if (const int k = from.info->input(reader.port->name); k >= 0) reader.channel = from.readers[static_cast<std::size_t>(k)].channel;
  probe_channel = from.probe_channel, probe_period_ns = from.probe_period_ns, probe_due_ns = from.probe_due_ns;
}

void Unit::prepare_last_frame(const std::vector<std::vector<std::byte>>& failsafe) {
  if (!functions_->get_extension || failsafe.empty()) return;
  const auto encode = reinterpret_cast<fulmar_last_frame_function>(const_cast<void*>(functions_->get_extension(FULMAR_LAST_FRAME)));
  if (!encode) return;
  std::vector<fulmar_input> inputs(info->inputs.size());
  for (std::size_t i = 0; i < inputs.size() && i < failsafe.size(); ++i) {
    if (failsafe[i].empty()) continue;
    inputs[i].data = failsafe[i].data();
    inputs[i].count = 1;
    inputs[i].sequence = 1;
  }
  problem.text[0] = '\0';
  const fulmar_last_frame* const frame = encode(instance_, inputs.data(), &problem);
  if (!frame && problem.text[0]) throw Error(component->where.text() + ": " + component->name + ": " + problem.text);
  last_frame.store(frame, std::memory_order_release);
}

}  // namespace fulmar::core
