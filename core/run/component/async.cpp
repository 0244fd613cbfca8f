// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/async.hpp"

#include <cstring>

#include "core/clock.hpp"
#include "core/run/component/process_state.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t other_calls = 4;  // pending retune and activate, in addition to the steps

void prepare(Async::Job& job, const ComponentInfo& info) {
  const std::size_t in = info.inputs.size(), out = info.outputs.size();
  job.in = {std::vector<fulmar_input>(in), std::vector<std::vector<std::byte>>(in),
            std::vector<std::vector<std::int64_t>>(in), std::vector<std::vector<fulmar_answer>>(in),
            std::vector<std::vector<Reply>>(in)};
  for (std::size_t i = 0; i < in; ++i) {
    const Port& port = info.inputs[i];
    job.in.data[i].resize(std::size_t{port.capacity} * port.type->size);
    if (port.kind == FULMAR_IN_VALUE) continue;
    job.in.stamps[i].resize(port.capacity);
    job.in.answers[i].resize(port.capacity);
    job.in.replies[i].resize(port.capacity);
  }
  job.out = OutputRoom(info);
  job.last.views.resize(out);
  job.last.data = job.out.data;
  job.values.resize(info.params.size());
}

}  // namespace

OutputRoom::OutputRoom(const ComponentInfo& info) : views(info.outputs.size()) {
  for (const Port& port : info.outputs) {
    data.emplace_back(std::size_t{port.capacity} * (port.type ? port.type->size : sizeof(double)));
    stamps.emplace_back(port.capacity);
  }
}

void OutputRoom::prepare(std::int64_t now_ns) noexcept {
  for (std::size_t i = 0; i < views.size(); ++i) views[i] = {data[i].data(), stamps[i].data(), now_ns, 0, 0};
}

Async::Async(const std::string& name, const fulmar_component& functions, void* instance,
             const ComponentInfo& info, std::size_t depth)
    : name_(name), functions_(functions), instance_(instance), jobs_(depth + other_calls), max_steps_(depth) {
  for (Job& job : jobs_) prepare(job, info);
  thread_ = quiet_thread("fulmar-async", [this] { run(); });
}

Async::~Async() {
  submitted_.fetch_or(ending, std::memory_order_release);
  submitted_.notify_one();
  thread_.join();
}

Async::Job* Async::room(Job::Call call) noexcept {
  if (call == Job::Call::step && steps_ >= max_steps_) return nullptr;
  const std::uint64_t n = submitted_.load(std::memory_order_relaxed);
  return n - taken_ < jobs_.size() ? &at(n) : nullptr;
}

void Async::submit() noexcept {
  Job& job = at(submitted_.load(std::memory_order_relaxed));
  job.dropped = job.missed = false;
  steps_ += job.call == Job::Call::step;
  submitted_.fetch_add(1, std::memory_order_release);
  submitted_.notify_one();
}

void Async::release() noexcept {
  steps_ -= at(taken_).call == Job::Call::step;
  ++taken_;
}

Async::Job* Async::oldest() noexcept {
  return submitted_.load(std::memory_order_relaxed) > taken_ ? &at(taken_) : nullptr;
}

void Async::wait() const noexcept {
  for (std::uint64_t n = finished_.load(std::memory_order_acquire); n <= taken_;
       n = finished_.load(std::memory_order_acquire))
    finished_.wait(n, std::memory_order_acquire);
}

void Async::drop() noexcept {
  for (std::uint64_t n = taken_; n < submitted_.load(std::memory_order_relaxed); ++n) at(n).dropped = true;
}

void Async::copy_inputs(const std::vector<fulmar_input>& from, const ComponentInfo& info, Job& job) noexcept {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Port& port = info.inputs[i];
    fulmar_input& to = job.in.views[i];
    to = from[i];
    if (from[i].count > 0 && from[i].data)
      std::memcpy(job.in.data[i].data(), from[i].data, std::size_t{from[i].count} * port.type->size);
    to.data = from[i].data ? job.in.data[i].data() : nullptr;
    if (port.kind == FULMAR_IN_VALUE) continue;
    for (std::uint32_t k = 0; k < from[i].count; ++k) {
      job.in.stamps[i][k] = from[i].stamps_ns[k];
      job.in.answers[i][k] = {};
    }
    to.stamps_ns = job.in.stamps[i].data();
    to.answers = job.in.answers[i].data();
  }
}

void Async::work(Job& job) noexcept {
  const HeapUse heap = thread_heap();
  const std::int64_t begin = monotonic_ns();
  job.error.text[0] = '\0';
  static constexpr const char* calls[] = {"step", "retune", "activate"};
  const InFlight inside(name_, calls[static_cast<std::size_t>(job.call)], Thread::own);
  switch (job.call) {
    case Job::Call::step:
      job.out.prepare(job.tick.now_ns);
      job.status =
          functions_.step(instance_, &job.tick, job.in.views.data(), job.out.views.data(), &job.error);
      break;
    case Job::Call::retune: job.status = functions_.retune(instance_, job.values.data(), &job.error); break;
    case Job::Call::activate:
      job.status =
          functions_.activate(instance_, &job.tick, job.in.views.data(), job.last.views.data(), &job.error);
      break;
  }
  job.status = judge(job.status, job.error);
  job.took_ns = monotonic_ns() - begin;
  job.heap_growth = thread_heap().bytes - heap.bytes;
}

void Async::run() noexcept {
  for (std::uint64_t n = 0;; ++n) {
    std::uint64_t there = submitted_.load(std::memory_order_acquire);
    while ((there & ~ending) <= n && (there & ending) == 0) {
      submitted_.wait(there, std::memory_order_acquire);
      there = submitted_.load(std::memory_order_acquire);
    }
    if ((there & ending) != 0) return;
    work(at(n));
    finished_.store(n + 1, std::memory_order_release);
    finished_.notify_one();
  }
}

}  // namespace fulmar::core
