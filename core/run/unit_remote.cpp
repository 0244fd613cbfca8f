// SPDX-License-Identifier: BSD-3-Clause
// A unit whose work is done in another thread: asynchronous steps, samples of drivers.
#include <algorithm>
#include <cstring>
#include <utility>

#include "core/run/unit.hpp"

namespace fulmar::core {

/// A free job. In simulation there is always one in the end: results are waited for.
Async::Job* Unit::job(Async::Job::Call call, std::int64_t due_ns) noexcept {
  Async::Job* j = async_->room();
  if (!j) return nullptr;
  j->call = call;
  j->due_ns = due_ns;
  j->held_until_ns = due_ns;
  return j;
}

Verdict Unit::submit(std::int64_t now_ns, const fulmar_tick& t) noexcept {
  Async::Job* const j = job(Async::Job::Call::step, now_ns + component->latency_ns);
  stepped(now_ns);
  if (!j) {  // hardware: the thread is far behind
    ++stats.misses;
    return {Verdict::Kind::waiting};
  }
  if (const auto late = late_.find(j->due_ns); late != late_.end()) j->held_until_ns = late->second;
  j->tick = t;
  Async::copy_inputs(inputs_, *info, *j);
  for (std::size_t i = 0; i < readers.size(); ++i) {
    Reader& r = readers[i];
    if (r.port->kind == FULMAR_IN_VALUE) {
      r.seen = inputs_[i].sequence;
      continue;
    }
    for (std::uint32_t k = 0; k < r.count; ++k) j->replies[i][k] = std::move(r.replies[k]), r.replies[k] = nullptr;
    r.count = r.lost = 0;
  }
  async_->submit();
  return {Verdict::Kind::submitted};
}

Verdict Unit::collect(std::int64_t now_ns) noexcept { return async_ ? collect_async(now_ns) : collect_samples(now_ns); }

std::optional<std::int64_t> Unit::overdue_ns(std::int64_t now_ns) noexcept {
  const Async::Job* const j = async_ ? async_->oldest() : nullptr;
  return j && j->due_ns <= now_ns ? std::optional(j->due_ns) : std::nullopt;
}

Verdict Unit::collect_async(std::int64_t now_ns) noexcept {
  // at the first call of a tick: when the one before was
  const std::int64_t before_ns = now_ns == collected_ns_ ? before_ns_ : std::exchange(collected_ns_, now_ns);
  before_ns_ = before_ns;
  for (Async::Job* j = async_->oldest(); j && j->held_until_ns <= now_ns; j = async_->oldest()) {
    if (!async_->done()) {
      if (!wait_for_async_) {
        if (!j->missed) ++stats.misses;
        j->missed = true;
        break;
      }
      const Inside inside(component->name, "step");
      async_->wait();
    }
    const bool step = j->call == Async::Job::Call::step;
    if (step && j->due_ns <= before_ns && late_due_ns.size() < late_due_ns.capacity()) late_due_ns.push_back(j->due_ns);
    heap_growth_ += j->heap_growth;
    for (std::size_t i = 0; step && i < j->replies.size(); ++i)
      for (std::uint32_t k = 0; k < (info->inputs[i].kind == FULMAR_IN_REQUEST ? j->inputs[i].count : 0); ++k)
        answer(i, j->replies[i][k], j->answers[i][k]);
    if (step) ++stats.steps, stats.time.add(j->took_ns);
    const bool wanted = !j->dropped && (step || j->status >= FULMAR_FAILED);
    const std::uint32_t status = j->status;
    if (wanted) {
      problem = j->error;
      for (std::size_t i = 0; step && i < slots.size(); ++i) {
        const fulmar_output& out = j->outputs[i];
        Slot& s = slots[i];
        std::memcpy(s.staging.data(), j->output_data[i].data(), j->output_data[i].size());
        std::copy(j->output_stamps[i].begin(), j->output_stamps[i].end(), s.stamps.begin());
        outputs_[i] = {s.staging.data(), s.stamps.data(), out.valid_at_ns, out.count, out.lost};
      }
    }
    async_->release();
    if (!wanted) continue;
    if (status >= FULMAR_FAILED) {
      if (!problem.text[0]) fail("says that it failed");
      return {Verdict::Kind::bad};
    }
    if (!outputs_good() || !heap_good()) return {Verdict::Kind::bad};
    if (status == FULMAR_DEGRADED) ++stats.degraded;
    return {Verdict::Kind::stepped};
  }
  return {Verdict::Kind::not_due};
}

/// Samples that have arrived, as many as one publication holds.
Verdict Unit::collect_samples(std::int64_t now_ns) noexcept {
  if (!started_) {
    started_ = true;
    if (auto* driver = dynamic_cast<Driver*>(samples_.get())) driver->start();
  }
  prepare_outputs(now_ns);
  SampleSource::Sample sample;
  bool any = false;
  while (samples_->next(now_ns, sample)) {
    Slot& s = slots[sample.output];
    fulmar_output& out = outputs_[sample.output];
    std::memcpy(s.staging.data() + std::size_t{out.count} * s.size, sample.data, s.size);
    s.stamps[out.count++] = sample.valid_at_ns;
    samples_->release();
    any = true;
    if (out.count >= s.port->capacity || sample.ends) break;  // the rest in the same tick, by the next call
  }
  stats.misses = samples_->lost();
  if (any) {
    ++stats.steps;
    return {outputs_good() ? Verdict::Kind::stepped : Verdict::Kind::bad};
  }
  if (samples_->fault()[0] == '\0') return {Verdict::Kind::not_due};
  fail(samples_->fault());
  return {Verdict::Kind::bad};
}

}  // namespace fulmar::core
