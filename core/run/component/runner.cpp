// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/runner.hpp"

#include <utility>

#include "core/error.hpp"
#include "core/run/component/process_state.hpp"
#include "core/run/component/realtime.hpp"
#include "core/run/messages.hpp"

namespace fulmar::core {

void put_if_silent(fulmar_error& problem, const char* text) noexcept {
  if (problem.text[0] == '\0') put_problem(problem, text);
}

namespace {

void* create_instance(const Component& c, const fulmar_component& functions, std::uint64_t seed) {
  fulmar_error problem{};
  const Inside inside(c.name, "constructor");
  void* const instance = functions.create(seed, &problem);
  if (judge(FULMAR_OK, problem) != FULMAR_OK && instance) {
    functions.destroy(instance);
    throw Error(located(c.where, run_messages::constructor_failed(c.name, problem.text)));
  }
  if (!instance) throw Error(located(c.where, run_messages::component_not_created(c.name, problem.text)));
  return instance;
}

std::unique_ptr<Isolated> spawn(const Component& c, std::uint64_t seed, std::int64_t hang_ns) {
  IsolatedOptions o;
  o.name = c.name;
  o.copy = c.plugin->copy;
  o.script = c.plugin->script;
  o.file = c.plugin->file;
  o.path = c.plugin->path;
  o.index = c.index_in_plugin;
  o.seed = seed;
  o.hang_ns = hang_ns;
  auto child = std::make_unique<Isolated>(c.info(), o);
  wait_for_child(child->pid());
  return child;
}

}  // namespace

// ---- in the loop's thread

Direct::Direct(const Component& c, std::uint64_t seed, Results results)
    : Direct(c, c.library->functions(c.index_in_plugin),
             create_instance(c, c.library->functions(c.index_in_plugin), seed), results) {}

Direct::~Direct() {
  const Inside inside(name_, "destructor");
  functions_.destroy(instance_);
}

std::uint32_t Direct::configure(const fulmar_value* values, fulmar_error& problem) {
  const Inside inside(name_, "configure");
  return judge(functions_.configure(instance_, values, &problem), problem);
}

const fulmar_last_frame* Direct::last_frame(const fulmar_input* failsafe, fulmar_error& problem) {
  if (!functions_.get_extension) return nullptr;
  const auto encode = reinterpret_cast<fulmar_last_frame_function>(
      const_cast<void*>(functions_.get_extension(FULMAR_LAST_FRAME)));
  return encode ? encode(instance_, failsafe, &problem) : nullptr;
}

bool Direct::retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept {
  if (!functions_.retune) return true;
  const InFlight inside(name_, "retune");
  return judge(functions_.retune(instance_, values.data(), &problem), problem) != FULMAR_FAILED;
}

bool Direct::activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                      const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept {
  if (!functions_.activate) return true;
  const InFlight inside(name_, "activate");
  const std::uint32_t status = functions_.activate(instance_, &tick, inputs.data(), last.data(), &problem);
  if (judge(status, problem) < FULMAR_FAILED) return true;
  put_if_silent(problem, "refuses to take over");
  return false;
}

void Direct::deactivate() noexcept {
  const InFlight inside(name_, "deactivate");
  if (functions_.deactivate) functions_.deactivate(instance_);
  fulmar_error nobody_asks{};
  judge(FULMAR_OK, nobody_asks);
}

StepResult Direct::step(const fulmar_tick& tick, Intake& in, Outlets& out, fulmar_error& problem) noexcept {
  const HeapUse before = thread_heap();
  std::uint32_t status = FULMAR_OK;
  {
    const InFlight inside(name_, "step");
    status = judge(functions_.step(instance_, &tick, in.views.data(), out.views.data(), &problem), problem);
  }
  const HeapUse now = thread_heap();
  heap_.calls += now.calls - before.calls;
  heap_.bytes += now.bytes - before.bytes;
  if (status >= FULMAR_FAILED) {
    put_if_silent(problem, "says that it failed");
    return StepResult::bad;
  }
  return status == FULMAR_DEGRADED ? StepResult::degraded : StepResult::stepped;
}

std::uint32_t Direct::read(fulmar_tick& tick, Outlets& out, fulmar_error& problem) noexcept {
  const std::uint64_t before = thread_allocations();
  const InFlight inside(name_, "read");
  const std::uint32_t status = judge(functions_.read(instance_, &tick, out.views.data(), &problem), problem);
  heap_.calls += thread_allocations() - before;
  return status;
}

std::uint32_t Direct::write(const fulmar_tick& tick, const Intake& in, fulmar_error& problem) noexcept {
  const std::uint64_t before = thread_allocations();
  const InFlight inside(name_, "write");
  const std::uint32_t status = judge(functions_.write(instance_, &tick, in.views.data(), &problem), problem);
  heap_.calls += thread_allocations() - before;
  return status;
}

// ---- in a child

Child::Child(const Component& c, std::uint64_t seed, std::int64_t hang_ns, std::vector<Death> deaths)
    : Child(c, spawn(c, seed, hang_ns), std::move(deaths)) {}

Child::Child(const Component& c, std::unique_ptr<Isolated> child, std::vector<Death> deaths)
    : Direct(c, Isolated::functions(), child.get()), child_(std::move(child)), deaths_(std::move(deaths)) {}

/// The call then has the recorded result of the first flight.
void Child::die_again(const char* call, std::int64_t now_ns) noexcept {
  for (const Death& death : deaths_)
    if (death.at_ns == now_ns && death.call == call && child_->alive())
      child_->die(death.cause.c_str(), death.hung);
}

void Child::note(const char* call) noexcept {
  if (*died_in_ == '\0' && !child_->alive()) died_in_ = call;
}

bool Child::retune(const std::vector<fulmar_value>& values, fulmar_error& problem) noexcept {
  const bool good = Direct::retune(values, problem);
  note("retune");
  return good;
}

bool Child::activate(const fulmar_tick& tick, const std::vector<fulmar_input>& inputs,
                     const std::vector<fulmar_input>& last, fulmar_error& problem) noexcept {
  die_again("activate", tick.now_ns);
  const bool good = Direct::activate(tick, inputs, last, problem);
  note("activate");
  return good;
}

StepResult Child::step(const fulmar_tick& tick, Intake& in, Outlets& out, fulmar_error& problem) noexcept {
  die_again("step", tick.now_ns);
  const StepResult result = Direct::step(tick, in, out, problem);
  heap_ = {child_->allocations(), child_->heap_growth()};
  note("step");
  return result;
}

}  // namespace fulmar::core
