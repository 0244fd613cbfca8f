// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/unit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/run/allocation.hpp"

namespace fulmar::core {

void Reader::push(const std::byte* message, std::int64_t valid_at_ns, const CopyPlan& plan) noexcept {
  if (count == port->capacity) {
    ++lost;
    return;
  }
  plan.run(message, items.data() + std::size_t{count} * port->type->size);
  stamps[count] = valid_at_ns;
  answers[count] = {};
  replies[count] = nullptr;
  ++count;
}

/// Tells whoever asked what came of a request.
void Unit::answer(std::size_t input, Reply& reply, const fulmar_answer& a) noexcept {
  const char* const why = a.verdict == FULMAR_ACCEPTED ? "" : a.verdict == FULMAR_REFUSED ? a.reason : "was not answered";
  if (*why && refusals.size() < refusals.capacity()) {
    refusals.emplace_back().input = static_cast<std::uint32_t>(input);
    std::snprintf(refusals.back().reason.data(), refusals.back().reason.size(), "%s", why);
  }
  if (reply) reply(why);
  reply = nullptr;
}

void Reader::latch() noexcept {
  const Slot* s = source();
  const std::uint64_t now = slot ? slot->sequence : role ? role->sequence : 0;
  if (!s || now == copied) return;
  plans[role ? static_cast<std::size_t>(s->filler) : 0].run(s->published.data(), copy.data());
  copied = now;
  copied_valid_ns = s->valid_at_ns;
}

void Unit::fill_values(std::vector<fulmar_value>& values, const std::vector<Overlay>* overlay, bool with_data) noexcept {
  auto put = [&](std::size_t i, const ParamValue& v) {
    fulmar_value& to = values[i];
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
  fill_values(values_, overlay, false);
  problem.text[0] = '\0';
  if (!instance_ || !functions_->retune) return true;
  if (async_) {
    Async::Job* const j = job(Async::Job::Call::retune, 0);
    if (!j) return fail("has too many calls on their way"), false;
    j->values = values_;
    async_->submit();
    return true;
  }
  if (started_) return fail("is a driver: its parameters are fixed in flight"), false;
  const Inside inside(component->name, "retune");
  return functions_->retune(instance_, values_.data(), &problem) != FULMAR_FAILED;
}

bool Unit::ready() const noexcept {
  for (const Reader& r : readers)
    if (!r.port->optional && r.port->kind == FULMAR_IN_VALUE && r.sequence() == 0) return false;
  return true;
}

Unit::Inputs Unit::prepare_inputs(std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < readers.size(); ++i) {
    Reader& r = readers[i];
    fulmar_input& in = inputs_[i];
    in.flags = 0;
    if (r.port->kind != FULMAR_IN_VALUE) {
      in.data = r.items.data();
      in.stamps_ns = r.stamps.data();
      in.answers = r.answers.data();
      in.count = r.count;
      in.lost = r.lost;
      continue;
    }
    const Slot* s = r.source();
    in.sequence = r.sequence();
    if (!s || in.sequence == 0) {
      in = {};
      if (!r.port->optional) return Inputs::missing;
      continue;
    }
    const CopyPlan& plan = r.plans[r.role ? static_cast<std::size_t>(s->filler) : 0];
    in.data = s->published.data();
    in.valid_at_ns = s->valid_at_ns;
    if (r.delayed) {
      in.data = r.copy.data();
      in.valid_at_ns = r.copied_valid_ns;
    } else if (!plan.whole) {
      if (r.copied != in.sequence) plan.run(s->published.data(), r.copy.data());
      r.copied = in.sequence;
      in.data = r.copy.data();
    }
    in.age_ns = now_ns - in.valid_at_ns;
    in.count = 1;
    if (in.sequence != r.seen) in.flags |= FULMAR_FRESH;
    if (r.max_age_ns > 0 && in.age_ns > r.max_age_ns) {
      in.flags |= FULMAR_STALE;
      if (r.guarded) {
        std::snprintf(problem.text, sizeof problem.text, "input '%s' is %.3f s old, the limit is %.3f s", r.port->name.c_str(),
                      1e-9 * static_cast<double>(in.age_ns), 1e-9 * static_cast<double>(r.max_age_ns));
        return Inputs::stale;
      }
    }
  }
  return Inputs::good;
}

void Unit::prepare_outputs(std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < slots.size(); ++i) outputs_[i] = {slots[i].staging.data(), slots[i].stamps.data(), now_ns, 0, 0};
}

bool Unit::outputs_good() noexcept {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Slot& s = slots[i];
    const fulmar_output& out = outputs_[i];
    if (s.port->kind == FULMAR_OUT_PROBE) {
      double value = 0;
      std::memcpy(&value, s.staging.data(), sizeof value);
      if (out.count == 0 || std::isfinite(value)) continue;
      std::snprintf(problem.text, sizeof problem.text, "probe '%s' is not finite", s.port->name.c_str());
      return false;
    }
    const std::uint32_t count = s.port->kind == FULMAR_OUT_VALUE ? 1 : out.count;
    if (count > s.port->capacity) {
      std::snprintf(problem.text, sizeof problem.text, "output '%s' holds %u items, there is room for %u", s.port->name.c_str(), count,
                    s.port->capacity);
      return false;
    }
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::byte* message = s.staging.data() + std::size_t{k} * s.size;
      if (s.guard->check(message)) continue;
      const int n = std::snprintf(problem.text, sizeof problem.text, "output '%s': ", s.port->name.c_str());
      s.guard->explain_to(message, problem.text + n, sizeof problem.text - static_cast<std::size_t>(n));
      return false;
    }
  }
  return true;
}

void Unit::consume() noexcept {
  for (std::size_t i = 0; i < readers.size(); ++i) {
    Reader& r = readers[i];
    if (r.port->kind == FULMAR_IN_VALUE) {
      r.seen = inputs_[i].sequence;
      continue;
    }
    for (std::uint32_t k = 0; k < r.count; ++k)
      if (r.port->kind == FULMAR_IN_REQUEST) answer(i, r.replies[k], r.answers[k]);
    r.count = r.lost = 0;
  }
}

fulmar_tick Unit::tick(std::int64_t now_ns, std::uint64_t index) const noexcept {
  const std::int64_t nominal = component->period_ns > 0 ? component->period_ns : tick_ns_;
  const bool first = last_step_ns_ == std::numeric_limits<std::int64_t>::min();
  return {now_ns, first ? nominal : now_ns - last_step_ns_, index};
}

void Unit::stepped(std::int64_t now_ns) noexcept {
  last_step_ns_ = now_ns;
  if (component->period_ns == 0) return;
  // Integer due times: no drift. After a gap the schedule starts anew instead of catching up.
  due_ns_ = due_ns_ + component->period_ns > now_ns ? due_ns_ + component->period_ns : now_ns + component->period_ns;
}

void Unit::fail(const char* text) noexcept { std::snprintf(problem.text, sizeof problem.text, "%s", text); }

Verdict Unit::step(std::int64_t now_ns, std::uint64_t index) noexcept {
  if (!due(now_ns)) return {Verdict::Kind::not_due};
  if (due_ns_ == std::numeric_limits<std::int64_t>::min()) due_ns_ = now_ns;
  if (const Inputs inputs = prepare_inputs(now_ns); inputs != Inputs::good)
    return {inputs == Inputs::stale ? Verdict::Kind::bad : Verdict::Kind::waiting};
  const fulmar_tick t = tick(now_ns, index);
  if (tape) tape->record(t, inputs_);
  if (async_) return submit(now_ns, t);
  prepare_outputs(now_ns);
  problem.text[0] = '\0';
  const HeapUse heap = thread_heap();
  std::uint32_t status = FULMAR_OK;
  {
    const Inside inside(component->name, "step");
    status = functions_->step(instance_, &t, inputs_.data(), outputs_.data(), &problem);
  }
  if (const HeapUse now = thread_heap(); now.calls != heap.calls || now.bytes != heap.bytes) {
    stats.allocations += now.calls - heap.calls;
    heap_growth_ += now.bytes - heap.bytes;
  }
  if (child_) stats.allocations = child_->allocations(), heap_growth_ = child_->heap_growth();
  stepped(now_ns);
  ++stats.steps;
  consume();
  if (status >= FULMAR_FAILED) {
    if (!problem.text[0]) fail("says that it failed");
    return {Verdict::Kind::bad};
  }
  if (!outputs_good() || !heap_good()) return {Verdict::Kind::bad};
  if (status == FULMAR_DEGRADED) ++stats.degraded;
  return {Verdict::Kind::stepped};
}

bool Unit::heap_good() noexcept {
  if (heap_growth_ <= static_cast<std::int64_t>(component->memory_bytes)) return true;
  std::snprintf(problem.text, sizeof problem.text, "its heap has grown by %.0f MB in flight; %.0f MB are allowed",
                1e-6 * static_cast<double>(heap_growth_), 1e-6 * static_cast<double>(component->memory_bytes));
  return false;
}

Verdict Unit::read(std::int64_t& now_ns, std::uint64_t index) noexcept {
  prepare_outputs(FULMAR_ON_ARRIVAL);
  fulmar_tick t{now_ns, tick_ns_, index};
  problem.text[0] = '\0';
  const std::uint64_t allocations = thread_allocations();
  std::uint32_t status = FULMAR_OK;
  {
    const Inside inside(component->name, "read");
    status = functions_->read(instance_, &t, outputs_.data(), &problem);
  }
  stats.allocations += thread_allocations() - allocations;
  ++stats.steps;
  if (status >= FULMAR_FAILED) {
    if (!problem.text[0]) fail("says that it failed");
    return {Verdict::Kind::bad};
  }
  if (index > 0 && t.now_ns <= now_ns) {
    std::snprintf(problem.text, sizeof problem.text, "time went from %lld to %lld ns", static_cast<long long>(now_ns),
                  static_cast<long long>(t.now_ns));
    return {Verdict::Kind::bad};
  }
  for (fulmar_output& out : outputs_)
    if (out.valid_at_ns == FULMAR_ON_ARRIVAL) out.valid_at_ns = t.now_ns;  // read has not dated it, and now the time is known
  now_ns = t.now_ns;
  last_step_ns_ = now_ns;
  if (!outputs_good()) return {Verdict::Kind::bad};
  if (status == FULMAR_DEGRADED) ++stats.degraded;
  return {Verdict::Kind::stepped};
}

Verdict Unit::write(std::int64_t now_ns, std::uint64_t index, Ending::Steering steering,
                    const std::vector<std::vector<std::byte>>& failsafe) noexcept {
  if (prepare_inputs(now_ns) != Inputs::good && steering == Ending::Steering::commands)
    return {Verdict::Kind::waiting};
  for (std::size_t i = 0; i < readers.size(); ++i) {
    if (readers[i].port->kind != FULMAR_IN_VALUE) continue;
    if (steering == Ending::Steering::nothing)
      inputs_[i] = {};
    else if (steering == Ending::Steering::failsafe && !failsafe[i].empty()) {
      inputs_[i].data = failsafe[i].data();
      inputs_[i].valid_at_ns = now_ns;
      inputs_[i].age_ns = 0;
      inputs_[i].count = 1;
      inputs_[i].flags = FULMAR_FRESH;
      ++inputs_[i].sequence;
    }
  }
  const fulmar_tick t{now_ns, tick_ns_, index};
  problem.text[0] = '\0';
  const std::uint64_t allocations = thread_allocations();
  std::uint32_t status = FULMAR_OK;
  {
    const Inside inside(component->name, "write");
    status = functions_->write(instance_, &t, inputs_.data(), &problem);
  }
  stats.allocations += thread_allocations() - allocations;
  consume();
  if (status >= FULMAR_FAILED) {
    if (!problem.text[0]) fail("says that it failed");
    return {Verdict::Kind::bad};
  }
  return {Verdict::Kind::stepped};
}

void Unit::tell_missing() noexcept {
  for (const Reader& r : readers)
    if (!r.port->optional && r.port->kind == FULMAR_IN_VALUE && r.sequence() == 0)
      std::snprintf(problem.text, sizeof problem.text, "input '%s' has no sample", r.port->name.c_str());
}

bool Unit::activate(std::int64_t now_ns, std::uint64_t index, const std::vector<const Slot*>& last) noexcept {
  const Inputs inputs = prepare_inputs(now_ns);
  if (inputs == Inputs::missing) tell_missing();
  if (inputs != Inputs::good) return false;
  fresh_start = false;
  last_step_ns_ = std::numeric_limits<std::int64_t>::min();  // dt of the first step is the nominal period, not the absence
  if (async_) async_->drop();
  if (!instance_ || !functions_->activate) return true;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    last_[i] = {};
    const Slot* s = i < last.size() ? last[i] : nullptr;
    if (!s || s->sequence == 0) continue;
    last_[i].data = s->published.data();
    last_[i].valid_at_ns = s->valid_at_ns;
    last_[i].age_ns = now_ns - s->valid_at_ns;
    last_[i].sequence = s->sequence;
    last_[i].count = 1;
  }
  const fulmar_tick t = tick(now_ns, index);
  problem.text[0] = '\0';
  if (async_) {  // whether it takes over is known when its first result is due
    Async::Job* const j = job(Async::Job::Call::activate, now_ns);
    if (!j) return fail("has too many calls on their way"), false;
    j->tick = t;
    Async::copy_inputs(inputs_, *info, *j);
    for (std::size_t i = 0; i < last_.size(); ++i) {
      j->last[i] = last_[i];
      if (!last_[i].data) continue;
      std::memcpy(j->last_data[i].data(), last_[i].data, slots[i].size);
      j->last[i].data = j->last_data[i].data();
    }
    async_->submit();
    return true;
  }
  const Inside inside(component->name, "activate");
  if (functions_->activate(instance_, &t, inputs_.data(), last_.data(), &problem) < FULMAR_FAILED) return true;
  if (!problem.text[0]) fail("refuses to take over");
  return false;
}

void Unit::forget_queues() noexcept {
  for (Reader& r : readers)
    if (r.port->kind == FULMAR_IN_QUEUE) r.count = r.lost = 0;
}

void Unit::refuse_requests(const char* why) noexcept {
  for (Reader& r : readers) {
    if (r.port->kind != FULMAR_IN_REQUEST) continue;
    for (std::uint32_t k = 0; k < r.count; ++k) {
      if (r.replies[k]) r.replies[k](why);
      r.replies[k] = nullptr;
    }
    r.count = r.lost = 0;
  }
}

void Unit::deactivate() noexcept {
  if (async_) async_->drop();
  if (async_ || started_ || !instance_) return;  // another thread is in it
  const Inside inside(component->name, "deactivate");
  if (functions_->deactivate) functions_->deactivate(instance_);
}

}  // namespace fulmar::core
