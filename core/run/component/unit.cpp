// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/unit.hpp"

#include "core/graph/places.hpp"
#include "core/run/component/last_frame.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

// ---- before and between flights

Unit::Unit(const Component& c, UnitOptions options)
    : Publisher{&c, &c.info(), c.roles.empty()},
      in(c),
      out(c, *this),
      base(c.params),
      arguments_{std::vector<fulmar_input>(info->outputs.size()),
                 std::vector<fulmar_value>(info->params.size())},
      schedule_{options.tick_ns, Schedule::never, {}} {
  stats.name = c.name;
  if (options.tape_steps > 0) tape = std::make_unique<Tape>(*info, options.tape_steps);
  runner_ = make_runner(options);
}

std::unique_ptr<Runner> Unit::make_runner(UnitOptions& options) {
  const Component& c = *component;
  if (options.runner) return std::move(options.runner);
  if (options.samples) return std::make_unique<RecordedRunner>(std::move(options.samples), stats);
  const std::int64_t period_ns = c.period_ns > 0 ? c.period_ns : schedule_.tick_ns;
  switch (c.run) {
    case RunMode::process:
      return std::make_unique<Child>(c, options.seed, options.hang_ns, std::move(options.deaths));
    case RunMode::async:
      return std::make_unique<AsyncRunner>(c, options.seed, period_ns, options.wait_for_async,
                                           std::move(options.late), stats);
    case RunMode::driver: return std::make_unique<DriverRunner>(c, options.seed, stats);
    case RunMode::tick: break;
  }
  return std::make_unique<Direct>(c, options.seed);
}

Unit::~Unit() {
  runner_->rest();
  if (active) deactivate();
}

void Unit::configure() {
  fill_values(nullptr, true);
  problem.text[0] = '\0';
  if (runner_->configure(arguments_.values.data(), problem) != FULMAR_FAILED) return;
  const Diagnostic why = problem.text[0] ? Diagnostic(problem.text) : run_messages::parameters_refused();
  throw Error(
      located(place_in(*component, why.text).value_or(component->where), located(component->name, why)));
}

std::unique_ptr<Tape> Unit::present_inputs(std::int64_t now_ns, std::uint64_t index) {
  if (in.prepare(now_ns, problem) == Intake::State::missing) return nullptr;
  auto now = std::make_unique<Tape>(*info, 1);
  now->record(tick(now_ns, index), in.views);
  return now;
}

void Unit::keep_log_settings(const Unit& from) {
  for (Slot& slot : out.slots) {
    const int k = from.info->output(slot.port->name);
    if (k < 0) continue;
    const Slot& was = nth(from.out.slots, k);
    slot.log = was.log;
    if (was.hash) slot.hash = std::make_unique<MessageHash>(*slot.port->type);
  }
  for (Reader& reader : in.readers)
    if (const int k = from.info->input(reader.port->name); k >= 0)
      reader.channel = nth(from.in.readers, k).channel;
  out.probes.log = from.out.probes.log;
}

void Unit::prepare_last_frame(const std::vector<std::vector<std::byte>>& failsafe) {
  if (failsafe.empty()) return;
  std::vector<fulmar_input> inputs(info->inputs.size());
  for (std::size_t i = 0; i < inputs.size() && i < failsafe.size(); ++i) {
    if (failsafe[i].empty()) continue;
    inputs[i].data = failsafe[i].data();
    inputs[i].count = 1;
    inputs[i].sequence = 1;
  }
  problem.text[0] = '\0';
  const fulmar_last_frame* const frame = runner_->last_frame(inputs.data(), problem);
  if (!frame && problem.text[0])
    throw Error(located(component->where, located(component->name, Diagnostic(problem.text))));
  if (frame) last_frame.store(frame, std::memory_order_release);
}

bool Unit::rehearse(const Tape& from) noexcept {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Tape::Step step = from.step(i);
    in.views = step.inputs;
    problem.text[0] = '\0';
    if (i == 0 && !runner_->activate(step.tick, in.views, arguments_.last, problem)) return false;
    out.prepare(step.tick.now_ns);
    if (!has_stepped(runner_->step(step.tick, in, out, problem))) return false;
    if (!out.good(step.tick.now_ns, problem)) return false;
  }
  return true;
}

// ---- in a tick

void Unit::fill_values(const std::vector<Overlay>* overlay, bool with_data) noexcept {
  const auto put = [&](std::size_t i, const ParamValue& v) {
    fulmar_value& to = arguments_.values[i];
    for (int k = 0; k < 3; ++k) to.number[k] = v.number[k];
    to.integer = v.integer;
    to.text = v.text.c_str();
    to.data = with_data && !v.data.empty() ? v.data.data() : nullptr;
    to.size = v.data.size();
  };
  for (std::size_t i = 0; i < base.size(); ++i) put(i, base[i]);
  if (overlay)
    for (const Overlay& o : *overlay) put(static_cast<std::size_t>(o.param), o.value);
}

bool Unit::retune(const std::vector<Overlay>* overlay) noexcept {
  fill_values(overlay, false);
  problem.text[0] = '\0';
  return runner_->retune(arguments_.values, problem);
}

inline fulmar_tick Unit::tick(std::int64_t now_ns, std::uint64_t index) const noexcept {
  const std::int64_t nominal = component->period_ns > 0 ? component->period_ns : schedule_.tick_ns;
  return {now_ns, schedule_.last_step_ns == Schedule::never ? nominal : now_ns - schedule_.last_step_ns,
          index};
}

inline void Unit::stepped(std::int64_t now_ns) noexcept {
  schedule_.last_step_ns = now_ns;
  if (component->period_ns > 0) schedule_.due.done(now_ns, component->period_ns);
}

inline bool Unit::heap_good() noexcept {
  const std::int64_t growth = runner_->heap().bytes;
  if (growth <= static_cast<std::int64_t>(component->memory_bytes)) return true;
  put_problem(problem, run_messages::heap_too_large, Fixed{1e-6 * static_cast<double>(growth), 0},
              Fixed{1e-6 * static_cast<double>(component->memory_bytes), 0});
  return false;
}

/// Result of a step after the guards.
inline StepResult Unit::guarded(StepResult result, std::int64_t now_ns) noexcept {
  if (!has_stepped(result)) return result;
  if (!out.good(now_ns, problem) || !heap_good()) return StepResult::bad;
  if (result == StepResult::degraded) ++stats.degraded;
  return result;
}

StepResult Unit::step(std::int64_t now_ns, std::uint64_t index) noexcept {
  if (!due(now_ns)) return StepResult::not_due;
  schedule_.due.begin(now_ns);
  if (const Intake::State inputs = in.prepare(now_ns, problem); inputs != Intake::State::good)
    return inputs == Intake::State::stale ? StepResult::bad : StepResult::waiting;
  const fulmar_tick t = tick(now_ns, index);
  if (tape) tape->record(t, in.views);
  const bool here = !runner_->remote();
  if (here) out.prepare(now_ns);
  problem.text[0] = '\0';
  const StepResult result = runner_->step(t, in, out, problem);
  stepped(now_ns);
  if (!here) return result;
  stats.allocations = runner_->heap().calls;
  ++stats.steps;
  in.consume();
  return guarded(result, now_ns);
}

StepResult Unit::collect(std::int64_t now_ns) noexcept {
  return guarded(runner_->collect(now_ns, in, out, problem), now_ns);
}

StepResult Unit::read(std::int64_t& now_ns, std::uint64_t index) noexcept {
  out.prepare(FULMAR_ON_ARRIVAL);
  fulmar_tick t{now_ns, schedule_.tick_ns, index};
  problem.text[0] = '\0';
  const std::uint32_t status = runner_->read(t, out, problem);
  stats.allocations = runner_->heap().calls;
  ++stats.steps;
  if (status >= FULMAR_FAILED) {
    put_if_silent(problem, "says that it failed");
    return StepResult::bad;
  }
  if (index > 0 && t.now_ns <= now_ns) {
    put_problem(problem, run_messages::time_not_monotonic, now_ns, t.now_ns);
    return StepResult::bad;
  }
  now_ns = t.now_ns;
  schedule_.last_step_ns = now_ns;
  if (!out.good(now_ns, problem)) return StepResult::bad;
  if (status == FULMAR_DEGRADED) ++stats.degraded;
  return StepResult::stepped;
}

void Unit::steer(std::int64_t now_ns, Steering steering,
                 const std::vector<std::vector<std::byte>>& failsafe) noexcept {
  for (std::size_t i = 0; i < in.readers.size(); ++i) {
    if (in.readers[i].port->kind != FULMAR_IN_VALUE) continue;
    fulmar_input& view = in.views[i];
    if (steering == Steering::nothing)
      view = {};
    else if (steering == Steering::failsafe && !failsafe[i].empty()) {
      view.data = failsafe[i].data();
      view.valid_at_ns = now_ns;
      view.age_ns = 0;
      view.count = 1;
      view.flags = FULMAR_FRESH;
      ++view.sequence;
    }
  }
}

StepResult Unit::write(std::int64_t now_ns, std::uint64_t index, Steering steering,
                       const std::vector<std::vector<std::byte>>& failsafe) noexcept {
  if (in.prepare(now_ns, problem) != Intake::State::good && steering == Steering::commands)
    return StepResult::waiting;
  steer(now_ns, steering, failsafe);
  problem.text[0] = '\0';
  const std::uint32_t status = runner_->write({now_ns, schedule_.tick_ns, index}, in, problem);
  stats.allocations = runner_->heap().calls;
  in.consume();
  if (status < FULMAR_FAILED) return StepResult::stepped;
  put_if_silent(problem, "says that it failed");
  return StepResult::bad;
}

void Unit::fill_last(std::int64_t now_ns, const std::vector<const Slot*>& last) noexcept {
  for (std::size_t i = 0; i < arguments_.last.size(); ++i) {
    fulmar_input& view = arguments_.last[i];
    view = {};
    const Slot* const s = i < last.size() ? last[i] : nullptr;
    if (!s || s->sequence == 0) continue;
    view.data = s->published.data();
    view.valid_at_ns = s->valid_at_ns;
    view.age_ns = now_ns - s->valid_at_ns;
    view.sequence = s->sequence;
    view.count = 1;
  }
}

bool Unit::activate(std::int64_t now_ns, std::uint64_t index, const std::vector<const Slot*>& last) noexcept {
  const Intake::State inputs = in.prepare(now_ns, problem);
  if (inputs == Intake::State::missing) in.report_missing(problem);
  if (inputs != Intake::State::good) return false;
  fresh_start = false;
  schedule_.last_step_ns = Schedule::never;  // dt of the first step is the nominal period, not the pause
  fill_last(now_ns, last);
  problem.text[0] = '\0';
  return runner_->activate(tick(now_ns, index), in.views, arguments_.last, problem);
}

}  // namespace fulmar::core
