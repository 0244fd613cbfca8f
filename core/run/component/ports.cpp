// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/ports.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>

#include "core/run/messages.hpp"

namespace fulmar::core {

void Reader::push(const std::byte* message, std::int64_t valid_at_ns, const CopyPlan& plan) noexcept {
  Pending& p = pending;
  if (p.count == port->capacity) {
    ++p.lost;
    return;
  }
  plan.run(message, p.items.data() + std::size_t{p.count} * port->type->size);
  p.stamps[p.count] = valid_at_ns;
  p.answers[p.count] = {};
  p.replies[p.count] = nullptr;
  ++p.count;
}

void Reader::push(const std::byte* message, std::int64_t valid_at_ns) noexcept {
  CopyPlan whole;
  whole.size = port->type->size;
  push(message, valid_at_ns, whole);
}

void Reader::latch() noexcept {
  const Slot* s = source();
  const std::uint64_t now = published();
  if (!s || now == copied) return;
  plans[role ? static_cast<std::size_t>(s->filler) : 0].run(s->published.data(), copy.data());
  copied = now;
  copied_valid_ns = s->valid_at_ns;
}

// ---- inputs

Intake::Intake(const Component& component)
    : readers(component.info().inputs.size()), views(component.info().inputs.size()) {
  for (std::size_t i = 0; i < readers.size(); ++i) {
    Reader& r = readers[i];
    r.port = &component.info().inputs[i];
    r.wire = &component.wires[i];
    if (r.port->kind == FULMAR_IN_VALUE) continue;
    r.pending.items.resize(std::size_t{r.port->capacity} * r.port->type->size);
    r.pending.stamps.resize(r.port->capacity);
    r.pending.answers.resize(r.port->capacity);
    r.pending.replies.resize(r.port->capacity);
    if (r.port->kind == FULMAR_IN_REQUEST) refusals.reserve(32);
  }
}

namespace {

bool lacks_sample(const Reader& r) noexcept {
  return !r.port->optional && r.port->kind == FULMAR_IN_VALUE && r.sequence() == 0;
}

/// Age of a sample whose writer was stopped: above every limit.
constexpr std::int64_t lost_ns = std::numeric_limits<std::int64_t>::max();

bool writer_lost(const Reader& r) noexcept {
  const Publisher* const writer = r.writer();
  return writer && writer->stopped;
}

/// Age for the limit of a wire. For an output that need not publish in every step it counts from the last
/// step of its writer.
std::int64_t judged_age_ns(const Reader& r, std::int64_t now_ns, std::int64_t age_ns) noexcept {
  const Slot& s = *r.source();
  if (!r.wire->by_steps || s.port->kind != FULMAR_OUT_EVENT || !s.owner || writer_lost(r)) return age_ns;
  return now_ns - s.owner->completed_ns;
}

/// The view of a value that has a sample.
void view_sample(Reader& r, std::int64_t now_ns, fulmar_input& in) noexcept {
  const Slot* const s = r.source();
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
  in.age_ns = writer_lost(r) ? lost_ns : now_ns - in.valid_at_ns;
  in.count = 1;
  if (in.sequence != r.seen) in.flags |= FULMAR_FRESH;
  const std::int64_t limit_ns = r.wire->max_age_ns > 0 ? r.wire->max_age_ns : lost_ns - 1;
  if (judged_age_ns(r, now_ns, in.age_ns) > limit_ns) in.flags |= FULMAR_STALE;
}

void report_stale(const Reader& r, std::int64_t now_ns, const fulmar_input& in,
                  fulmar_error& problem) noexcept {
  const char* const input = r.port->name.c_str();
  if (writer_lost(r))
    return put_problem(problem, run_messages::input_of_stopped, input, r.writer()->component->name);
  put_problem(problem, run_messages::input_too_old, input,
              Fixed{1e-9 * static_cast<double>(judged_age_ns(r, now_ns, in.age_ns)), 3},
              Fixed{1e-9 * static_cast<double>(r.wire->max_age_ns), 3});
}

}  // namespace

namespace {

/// It has no sample, and will not get one.
bool waits_in_vain(const Reader& r) noexcept { return lacks_sample(r) && r.wire->guarded && writer_lost(r); }

}  // namespace

bool Intake::in_vain(fulmar_error& problem) const noexcept {
  for (const Reader& r : readers)
    if (waits_in_vain(r)) {
      report_stale(r, 0, {}, problem);
      return true;
    }
  return false;
}

bool Intake::too_old(std::size_t input, std::int64_t now_ns, fulmar_error& problem) const noexcept {
  const Reader& r = readers[input];
  if (r.port->kind != FULMAR_IN_VALUE || r.wire->max_age_ns <= 0 || !r.source() || r.sequence() == 0)
    return false;
  fulmar_input seen{};
  seen.age_ns = writer_lost(r) ? lost_ns : now_ns - (r.delayed ? r.copied_valid_ns : r.source()->valid_at_ns);
  if (judged_age_ns(r, now_ns, seen.age_ns) <= r.wire->max_age_ns) return false;
  report_stale(r, now_ns, seen, problem);
  return true;
}

bool Intake::all_younger_than(std::int64_t limit_ns, std::int64_t now_ns) const noexcept {
  bool any = false;  // a component that reads queues alone may wait for them
  for (const Reader& r : readers) {
    if (r.port->optional || r.port->kind != FULMAR_IN_VALUE) continue;
    if (lacks_sample(r) || writer_lost(r) || !r.source() || now_ns - r.source()->valid_at_ns > limit_ns)
      return false;
    any = true;
  }
  return any;
}

bool Intake::ready() const noexcept {
  for (const Reader& r : readers)
    if (lacks_sample(r)) return false;
  return true;
}

void Intake::report_missing(fulmar_error& problem) const noexcept {
  for (const Reader& r : readers)
    if (lacks_sample(r)) put_problem(problem, run_messages::input_empty, r.port->name);
}

Intake::State Intake::prepare(std::int64_t now_ns, fulmar_error& problem) noexcept {
  for (std::size_t i = 0, count = readers.size(); i < count; ++i) {
    Reader& r = readers[i];
    fulmar_input& in = views[i];
    in.flags = 0;
    if (r.port->kind != FULMAR_IN_VALUE) {
      in.data = r.pending.items.data();
      in.stamps_ns = r.pending.stamps.data();
      in.answers = r.pending.answers.data();
      in.count = r.pending.count;
      in.lost = r.pending.lost;
      continue;
    }
    in.sequence = r.sequence();
    if (!r.source() || in.sequence == 0) {
      in = {};
      if (r.port->optional) continue;
      if (!waits_in_vain(r)) return State::missing;
      report_stale(r, now_ns, in, problem);
      return State::stale;
    }
    view_sample(r, now_ns, in);
    if (!r.wire->guarded || (in.flags & FULMAR_STALE) == 0) continue;
    report_stale(r, now_ns, in, problem);
    return State::stale;
  }
  return State::good;
}

void Intake::consume() noexcept {
  for (std::size_t i = 0, count = readers.size(); i < count; ++i) {
    Reader& r = readers[i];
    if (r.port->kind == FULMAR_IN_VALUE) {
      r.seen = views[i].sequence;
      continue;
    }
    for (std::uint32_t k = 0; k < r.pending.count; ++k)
      if (r.port->kind == FULMAR_IN_REQUEST) answer(i, r.pending.replies[k], r.pending.answers[k]);
    r.pending.count = r.pending.lost = 0;
  }
}

/// Passes the answer of a request to its sender.
void Intake::answer(std::size_t input, Reply& reply, const fulmar_answer& a) noexcept {
  const char* const why = a.verdict == FULMAR_ACCEPTED  ? ""
                          : a.verdict == FULMAR_REFUSED ? a.reason
                                                        : "was not answered";
  if (*why && refusals.size() < refusals.capacity()) {
    refusals.emplace_back().input = static_cast<std::uint32_t>(input);
    std::snprintf(refusals.back().reason.data(), refusals.back().reason.size(), "%s", why);
  }
  if (reply) reply(why);
  reply = nullptr;
}

void Intake::forget_queues() noexcept {
  for (Reader& r : readers)
    if (r.port->kind == FULMAR_IN_QUEUE) r.pending.count = r.pending.lost = 0;
}

void Intake::refuse_requests(const char* why) noexcept {
  for (Reader& r : readers) {
    if (r.port->kind != FULMAR_IN_REQUEST) continue;
    for (std::uint32_t k = 0; k < r.pending.count; ++k) {
      if (r.pending.replies[k]) r.pending.replies[k](why);
      r.pending.replies[k] = nullptr;
    }
    r.pending.count = r.pending.lost = 0;
  }
}

// ---- outputs

Outlets::Outlets(const Component& component, Publisher& owner)
    : slots(component.info().outputs.size()),
      views(component.info().outputs.size()),
      blank_(component.info().outputs.size()),
      values_(component.info().outputs.size()) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Slot& s = slots[i];
    s.port = &component.info().outputs[i];
    s.owner = &owner;
    s.size = s.port->type ? s.port->type->size : sizeof(double);
    s.staging.resize(std::size_t{s.size} * s.port->capacity);
    s.published.resize(s.size);
    s.stamps.resize(s.port->capacity);
    if (s.port->type)
      s.guard = std::make_unique<Guard>(*s.port->type);
    else
      probes.outputs.push_back(static_cast<std::uint32_t>(i));
    blank_[i].data = s.staging.data();
    blank_[i].stamps_ns = s.stamps.data();
    values_[i] = s.port->kind == FULMAR_OUT_VALUE;
  }
  probes.values.resize(probes.outputs.size());
}

void Outlets::prepare(std::int64_t now_ns) noexcept {
  std::copy(blank_.begin(), blank_.end(), views.begin());
  for (fulmar_output& view : views) view.valid_at_ns = now_ns;
}

namespace {

bool probe_good(const Slot& s, const fulmar_output& out, fulmar_error& problem) noexcept {
  double value = 0;
  std::memcpy(&value, s.staging.data(), sizeof value);
  if (out.count == 0 || std::isfinite(value)) return true;
  put_problem(problem, run_messages::probe_not_finite, s.port->name);
  return false;
}

/// Largest time by which a sample may be ahead of its tick. A vehicle stamps samples on arrival, and after a
/// pause of the host they are earlier than their ticks. Other components pass on the stamps that they read.
constexpr std::uint64_t vehicle_ahead_ns = 60'000'000'000, max_ahead_ns = 1'000'000'000;
constexpr std::int64_t earliest_ns = -7'200'000'000'000;  // before any flight

/// Whether the time of validity belongs to this flight; a sample without one gets the present time. A sample
/// from the future would never become too old.
bool well_dated(std::int64_t& valid_at_ns, std::int64_t now_ns, std::uint64_t ahead_ns) noexcept {
  if (valid_at_ns == FULMAR_ON_ARRIVAL) valid_at_ns = now_ns;
  if (valid_at_ns <= now_ns) return valid_at_ns >= earliest_ns;
  return static_cast<std::uint64_t>(valid_at_ns) - static_cast<std::uint64_t>(now_ns) <= ahead_ns;
}

bool times_good(Slot& s, fulmar_output& out, std::int64_t now_ns, fulmar_error& problem) noexcept {
  const std::uint64_t ahead_ns = s.owner->info->vehicle ? vehicle_ahead_ns : max_ahead_ns;
  const bool queue = s.port->kind == FULMAR_OUT_QUEUE;
  const std::uint32_t count = queue ? out.count : 1;
  for (std::uint32_t k = 0; k < count; ++k) {
    std::int64_t& valid_at_ns = queue ? s.stamps[k] : out.valid_at_ns;
    if (well_dated(valid_at_ns, now_ns, ahead_ns)) continue;
    put_problem(problem, run_messages::output_date_wrong, s.port->name,
                Fixed{1e-9 * static_cast<double>(valid_at_ns), 3},
                Fixed{1e-9 * static_cast<double>(now_ns), 3});
    return false;
  }
  return true;
}

bool messages_good(Slot& s, const fulmar_output& out, fulmar_error& problem) noexcept {
  const std::uint32_t count = s.port->kind == FULMAR_OUT_VALUE ? 1 : out.count;
  if (count > s.port->capacity) {
    put_problem(problem, run_messages::output_too_long, s.port->name, count, s.port->capacity);
    return false;
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::byte* message = s.staging.data() + std::size_t{k} * s.size;
    if (s.guard->check(message)) continue;
    const int n = std::snprintf(problem.text, sizeof problem.text, "output '%s': ", s.port->name.c_str());
    s.guard->explain_to(message, problem.text + n, sizeof problem.text - static_cast<std::size_t>(n));
    return false;
  }
  return true;
}

}  // namespace

bool Outlets::good(std::int64_t now_ns, fulmar_error& problem) noexcept {
  for (std::size_t i = 0, count = slots.size(); i < count; ++i) {
    if (!written(i)) continue;
    const bool probe = slots[i].port->kind == FULMAR_OUT_PROBE;
    if (!(probe ? probe_good(slots[i], views[i], problem)
                : messages_good(slots[i], views[i], problem) &&
                      times_good(slots[i], views[i], now_ns, problem)))
      return false;
  }
  return true;
}

}  // namespace fulmar::core
