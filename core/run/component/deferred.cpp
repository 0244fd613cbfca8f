// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/deferred.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/run/component/running_code.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {
namespace {

/// Largest number of pending steps.
std::size_t depth_of(const Component& c, std::int64_t period_ns) {
  return static_cast<std::size_t>(c.latency_ns / period_ns) + 4;
}

}  // namespace

AsyncRunner::AsyncRunner(const Component& component, std::uint64_t seed, std::int64_t period_ns, bool wait,
                         LateResults late, ComponentStats& stats)
    : Direct(component, seed, Results::later),
      component_(component),
      stats_(stats),
      wait_(wait),
      late_(std::move(late)) {
  const std::size_t depth = depth_of(component, period_ns);
  async_ = std::make_unique<Async>(component.name, functions_, instance_, component.info(), depth);
  late_due_ns.reserve(depth);
}

/// A free job. In simulation there is always one, because results are waited for.
Async::Job* AsyncRunner::job(Async::Job::Call call, std::int64_t due_ns) noexcept {
  Async::Job* const j = async_->room(call);
  if (!j) return nullptr;
  j->call = call;
  j->due_ns = due_ns;
  j->held_until_ns = due_ns;
  return j;
}

bool AsyncRunner::retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept {
  if (!functions_.retune) return true;
  Async::Job* const j = job(Async::Job::Call::retune, 0);
  if (!j) {
    put_problem(problem, run_messages::too_many_calls);
    return false;
  }
  j->values = values;
  async_->submit();
  return true;
}

bool AsyncRunner::activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                           const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept {
  async_->drop();
  if (!functions_.activate) return true;
  Async::Job* const j = job(Async::Job::Call::activate, tick.now_ns);
  if (!j) {
    put_problem(problem, run_messages::too_many_calls);
    return false;
  }
  j->tick = tick;
  Async::copy_inputs(inputs, component_.info(), *j);
  for (std::size_t i = 0; i < last.size(); ++i) {
    j->last.views[i] = last[i];
    if (!last[i].data) continue;
    const Port& port = component_.info().outputs[i];
    std::memcpy(j->last.data[i].data(), last[i].data, port.type ? port.type->size : sizeof(double));
    j->last.views[i].data = j->last.data[i].data();
  }
  async_->submit();
  return true;
}

void AsyncRunner::deactivate() noexcept {
  if (async_) return async_->drop();  // another thread is using the instance
  Direct::deactivate();
}

StepResult AsyncRunner::step(const fulmar_tick& tick, Intake& in, Outlets&, fulmar_error&) noexcept {
  Async::Job* const j = job(Async::Job::Call::step, tick.now_ns + component_.latency_ns);
  if (!j) {  // hardware: the thread is too far behind
    ++stats_.misses;
    return StepResult::waiting;
  }
  const auto late = std::lower_bound(late_.begin(), late_.end(), j->due_ns,
                                     [](const auto& l, std::int64_t due_ns) { return l.first < due_ns; });
  if (late != late_.end() && late->first == j->due_ns) j->held_until_ns = late->second;
  j->tick = tick;
  Async::copy_inputs(in.views, component_.info(), *j);
  for (std::size_t i = 0; i < in.readers.size(); ++i) {
    Reader& r = in.readers[i];
    if (r.port->kind == FULMAR_IN_VALUE) {
      r.seen = in.views[i].sequence;
      continue;
    }
    for (std::uint32_t k = 0; k < r.pending.count; ++k)
      j->in.replies[i][k] = std::exchange(r.pending.replies[k], nullptr);
    r.pending.count = r.pending.lost = 0;
  }
  async_->submit();
  return StepResult::submitted;
}

std::optional<std::int64_t> AsyncRunner::overdue_ns(std::int64_t now_ns) noexcept {
  const Async::Job* const j = async_->oldest();
  return j && j->due_ns <= now_ns ? std::optional(j->due_ns) : std::nullopt;
}

/// Whether the oldest call has returned, if necessary after a wait.
bool AsyncRunner::arrived(Async::Job& j) noexcept {
  if (async_->done()) return true;
  if (!wait_) {
    if (!j.missed) ++stats_.misses;
    j.missed = true;
    return false;
  }
  const Inside inside(name_, "step");
  async_->wait();
  return true;
}

void AsyncRunner::note_step(Async::Job& j, std::int64_t before_ns, Intake& in) noexcept {
  if (j.due_ns <= before_ns && late_due_ns.size() < late_due_ns.capacity()) late_due_ns.push_back(j.due_ns);
  for (std::size_t i = 0; i < in.readers.size(); ++i)
    for (std::uint32_t k = 0; in.readers[i].port->kind == FULMAR_IN_REQUEST && k < j.in.views[i].count; ++k)
      in.answer(i, j.in.replies[i][k], j.in.answers[i][k]);
  ++stats_.steps;
  stats_.time.add(j.took_ns);
}

namespace {

void take_outputs(const Async::Job& j, Outlets& out) noexcept {
  for (std::size_t i = 0; i < out.slots.size(); ++i) {
    const fulmar_output& from = j.out.views[i];
    Slot& s = out.slots[i];
    std::memcpy(s.staging.data(), j.out.data[i].data(), j.out.data[i].size());
    std::copy(j.out.stamps[i].begin(), j.out.stamps[i].end(), s.stamps.begin());
    out.views[i] = {s.staging.data(), s.stamps.data(), from.valid_at_ns, from.count, from.lost};
  }
}

}  // namespace

StepResult AsyncRunner::collect(std::int64_t now_ns, Intake& in, Outlets& out,
                                fulmar_error& problem) noexcept {
  // the first call of a tick stores the time of the previous one
  if (now_ns != collected_ns_) before_ns_ = std::exchange(collected_ns_, now_ns);
  for (Async::Job* j = async_->oldest(); j && j->held_until_ns <= now_ns; j = async_->oldest()) {
    if (!arrived(*j)) break;
    const bool step = j->call == Async::Job::Call::step;
    heap_.bytes += j->heap_growth;
    if (step) note_step(*j, before_ns_, in);
    const bool wanted = !j->dropped && (step || j->status >= FULMAR_FAILED);
    const std::uint32_t status = j->status;
    if (wanted) problem = j->error;
    if (wanted && step) take_outputs(*j, out);
    async_->release();
    if (!wanted) continue;
    if (status < FULMAR_FAILED) return status == FULMAR_DEGRADED ? StepResult::degraded : StepResult::stepped;
    put_if_silent(problem, "says that it failed");
    return StepResult::bad;
  }
  return StepResult::not_due;
}

// ---- drivers

StepResult Arrivals::collect(std::int64_t now_ns, Outlets& out, fulmar_error& problem) noexcept {
  if (!std::exchange(started_, true)) source_->start();
  out.prepare(now_ns);
  SampleSource::Sample sample;
  bool any = false;
  while (source_->next(now_ns, sample)) {
    Slot& s = out.slots[sample.output];
    fulmar_output& to = out.views[sample.output];
    std::memcpy(s.staging.data() + std::size_t{to.count} * s.size, sample.data, s.size);
    s.stamps[to.count++] = sample.valid_at_ns;
    source_->release();
    any = true;
    if (to.count >= s.port->capacity || sample.ends) break;  // the next call takes the rest in the same tick
  }
  stats_.misses = source_->lost();
  if (any) {
    ++stats_.steps;
    return StepResult::stepped;
  }
  if (source_->fault()[0] == '\0') return StepResult::not_due;
  put_problem(problem, source_->fault());
  return StepResult::bad;
}

DriverRunner::DriverRunner(const Component& component, std::uint64_t seed, ComponentStats& stats)
    : Direct(component, seed, Results::unasked),
      arrivals_(std::make_unique<Driver>(component.name, functions_, instance_, component.info()), stats) {}

bool DriverRunner::retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept {
  if (!functions_.retune || !arrivals_.started()) return Direct::retune(values, problem);
  put_problem(problem, run_messages::driver_parameters_fixed);
  return false;
}

bool DriverRunner::activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                            const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept {
  return arrivals_.started() || Direct::activate(tick, inputs, last, problem);  // another thread is using the
                                                                                // instance
}

void DriverRunner::deactivate() noexcept {
  if (!arrivals_.started()) Direct::deactivate();
}

}  // namespace fulmar::core
