// SPDX-License-Identifier: BSD-3-Clause
// The host's side of an isolated component: copies in, rings, waits while it checks the child's life, copies
// out.
#include "core/isolate/isolated.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>

#include "core/error.hpp"
#include "core/isolate/messages.hpp"
#include "core/loader/home.hpp"

namespace fulmar::core {
namespace {

// On a single CPU a busy wait would keep the other process from running.
std::int64_t useful_spin(std::int64_t wanted_ns) {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  if (::sched_getaffinity(0, sizeof cpus, &cpus) != 0) return 0;
  return CPU_COUNT(&cpus) > 1 ? std::max<std::int64_t>(wanted_ns, 0) : 0;
}

const ComponentInfo& isolatable(const ComponentInfo& info, const IsolatedOptions& options) {
  if (info.vehicle) throw Error(located(options.name, isolate_messages::vehicle_not_isolated()));
  if (info.name.size() >= sizeof ControlBlock::set_up.component)
    throw Error(located(options.name, isolate_messages::component_name_too_long()));
  return info;
}

std::vector<std::string> words(const IsolatedOptions& options) {
  const std::string& path = options.path.empty() ? options.file : options.path;
  return {options.name,
          options.copy,
          options.script,
          std::filesystem::absolute(path).string(),
          options.file,
          std::to_string(options.index),
          std::to_string(options.seed)};
}

// The host's own program, or the path in FULMAR_CHILD when a test or a tool in another folder runs.
std::string child_program() {
  const std::string program = own_program("fulmar-child", "FULMAR_CHILD").string();
  if (program.empty()) throw Error(isolate_messages::child_program_missing());
  return program;
}

// A component's standard output goes to the host's standard error, apart from the host's output.
ChildFiles child_files(const SharedMemory& memory) {
  const int error = ::fcntl(STDERR_FILENO, F_GETFD) < 0 ? -1 : STDERR_FILENO;
  return {-1, error, error, memory.descriptor(), false};
}

void report(fulmar_error* error, const char* text) noexcept {
  if (error) std::snprintf(error->text, sizeof error->text, "%s", text);
}

SharedInput head_of(const fulmar_input& from) noexcept {
  return {from.valid_at_ns,
          from.age_ns,
          from.sequence,
          from.count,
          from.lost,
          from.flags,
          from.data ? has_data : has_nothing};
}

const char* signal_words(int signal, bool stack_overflow) noexcept {
  switch (signal) {
    case SIGSEGV:
      return stack_overflow ? isolate_messages::stack_overflowed.c_str()
                            : isolate_messages::segmentation_fault.c_str();
    case SIGBUS: return isolate_messages::bus_error.c_str();
    case SIGFPE: return isolate_messages::arithmetic_error.c_str();
    case SIGILL: return isolate_messages::illegal_instruction.c_str();
    case SIGABRT: return isolate_messages::aborted.c_str();
    default: return nullptr;
  }
}

}  // namespace

// ---- set-up

Isolated::Isolated(const ComponentInfo& info, const IsolatedOptions& options)
    : info_(isolatable(info, options)),
      options_(options),
      layout_(info_),
      memory_(layout_.size),
      copied_(info_.inputs.size()),
      process_((prepare(), child_program()), words(options), child_files(memory_)) {
  if (wait(options_.setup_ns) && control().status < FULMAR_FAILED) return;
  refuse_setup();
}

// The child answers call 1, its own set-up, without a request.
void Isolated::prepare() {
  options_.spin_ns = useful_spin(options_.spin_ns);
  ControlBlock& c = *new (memory_.data()) ControlBlock{};
  c.request = number_;
  c.call = Call::create;
  c.set_up.version = shared_version;
  c.set_up.spin_ns = options_.spin_ns;
  c.set_up.host_pid = ::getpid();
  c.set_up.signature = layout_.signature;
  c.set_up.layout_size = layout_.size;
  std::memcpy(c.set_up.component, info_.name.c_str(), info_.name.size() + 1);
}

void Isolated::refuse_setup() {
  const bool loaded = control().stage.load() != Stage::loaded;
  if (!alive_)
    throw Error(located(options_.name, isolate_messages::child_stopped(options_.file, death_,
                                                                       loaded ? "created" : "loaded")));
  fulmar_error error = control().error;
  error.text[sizeof error.text - 1] = '\0';
  const Diagnostic why =
      control().has_error ? Diagnostic(error.text) : isolate_messages::constructor_failed();
  throw Error(located(options_.name, loaded ? isolate_messages::not_created(why) : why));
}

Isolated::~Isolated() { end(); }

std::string Isolated::end() {
  if (finished_) return "";
  finished_ = true;
  constexpr std::chrono::seconds second{1};
  const bool died_before = !alive_;
  if (alive_) call(Call::quit, std::min(options_.setup_ns, std::int64_t{2'000'000'000}), nullptr);
  std::string problem;
  if (!alive_ && !died_before)
    problem =
        located(options_.name, isolate_messages::child_stopped(options_.file, death_, "destroyed")).line();
  const bool dumps = !alive_ && control().signal.load() != 0 && std::getenv("FULMAR_CORE") != nullptr;
  if (!process_.wait(dumps ? 10 * second : second)) process_.kill();
  alive_ = false;
  if (!death_[0]) isolate_messages::child_gone.write(death_, sizeof death_);
  return problem;
}

// ---- copies in and out

// Skips a sample that the child already has: a plan of a thousand items is copied once.
void Isolated::put_input(const Place& place, SharedInput& to, const fulmar_input& from,
                         Sample& copied) noexcept {
  to = head_of(from);
  if (!from.data) return;
  std::byte* data = at<std::byte>(place.data);
  if (place.kind == FULMAR_IN_VALUE) {
    const bool held = copied.data == from.data && copied.sequence == from.sequence &&
                      copied.valid_at_ns == from.valid_at_ns;
    if (held && from.sequence != 0 && (from.flags & FULMAR_FRESH) == 0) return;
    copied = {from.data, from.sequence, from.valid_at_ns};
    std::memcpy(data, from.data, place.message);
    return;
  }
  const std::size_t count = std::min(from.count, place.capacity);
  std::memcpy(data, from.data, count * place.message);
  if (from.stamps_ns) {
    to.has |= has_stamps;
    std::memcpy(at<std::byte>(place.stamps), from.stamps_ns, count * sizeof(std::int64_t));
  }
  if (place.kind != FULMAR_IN_REQUEST || !from.answers) return;
  to.has |= has_answers;
  std::memcpy(at<std::byte>(place.answers), from.answers, count * sizeof(fulmar_answer));
}

void Isolated::put_tick_inputs(const fulmar_tick* tick, const fulmar_input* inputs) noexcept {
  control().tick = *tick;
  SharedInput* heads = at<SharedInput>(layout_.inputs_at);
  for (std::size_t i = 0; i < layout_.inputs.size(); ++i)
    put_input(layout_.inputs[i], heads[i], inputs[i], copied_[i]);
}

void Isolated::take_answers(const fulmar_input* inputs) noexcept {
  for (std::size_t i = 0; i < layout_.inputs.size(); ++i) {
    const Place& place = layout_.inputs[i];
    if (place.kind != FULMAR_IN_REQUEST || !inputs[i].answers) continue;
    const std::size_t count = std::min(inputs[i].count, place.capacity);
    std::memcpy(inputs[i].answers, at<std::byte>(place.answers), count * sizeof(fulmar_answer));
    for (std::size_t k = 0; k < count; ++k)
      inputs[i].answers[k].reason[sizeof inputs[i].answers[k].reason - 1] = '\0';
  }
}

void Isolated::put_outputs(const fulmar_output* outputs) noexcept {
  SharedOutput* heads = at<SharedOutput>(layout_.outputs_at);
  for (std::size_t i = 0; i < layout_.outputs.size(); ++i)
    heads[i] = {outputs[i].valid_at_ns, outputs[i].count, outputs[i].lost};
}

void Isolated::take_outputs(fulmar_output* outputs) noexcept {
  const SharedOutput* heads = at<SharedOutput>(layout_.outputs_at);
  for (std::size_t i = 0; i < layout_.outputs.size(); ++i) {
    const Place& place = layout_.outputs[i];
    const SharedOutput head = heads[i];
    outputs[i].valid_at_ns = head.valid_at_ns;
    outputs[i].count = head.count;
    outputs[i].lost = head.lost;
    const std::size_t count = place.kind == FULMAR_OUT_VALUE ? 1 : std::min(head.count, place.capacity);
    if (count == 0) continue;
    std::memcpy(outputs[i].data, at<std::byte>(place.data), count * place.message);
    if (place.kind == FULMAR_OUT_QUEUE)
      std::memcpy(outputs[i].stamps_ns, at<std::byte>(place.stamps), count * sizeof(std::int64_t));
  }
}

void Isolated::put_last(const fulmar_input* last) noexcept {
  SharedInput* heads = at<SharedInput>(layout_.last_at);
  for (std::size_t i = 0; i < layout_.last.size(); ++i) {
    heads[i] = head_of(last[i]);
    if (last[i].data) std::memcpy(at<std::byte>(layout_.last[i].data), last[i].data, layout_.last[i].message);
  }
}

std::uint32_t Isolated::configure(const fulmar_value* values, fulmar_error* error) {
  const auto aligned = [](std::size_t n) { return (n + cache_line - 1) / cache_line * cache_line; };
  const std::size_t count = info_.params.size();
  SharedValue* heads = at<SharedValue>(layout_.values_at);
  std::size_t size = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const fulmar_value& v = values[i];
    heads[i] = {{v.number[0], v.number[1], v.number[2]}, v.integer, v.size, size, 0,
                v.data ? has_data : has_nothing,         0};
    size += aligned(std::strlen(v.text ? v.text : "") + 1);
    heads[i].data_at = size;
    if (v.data) size += aligned(v.size);
  }
  const Mapping window = memory_.window(layout_.size, size);
  for (std::size_t i = 0; i < count; ++i) {
    const char* text = values[i].text ? values[i].text : "";
    std::memcpy(window.get() + heads[i].text_at, text, std::strlen(text) + 1);
    if (values[i].data && values[i].size > 0)
      std::memcpy(window.get() + heads[i].data_at, values[i].data, values[i].size);
  }
  control().set_up.values_size = size;
  return call(Call::configure, options_.setup_ns, error);
}

std::uint32_t Isolated::retune(const fulmar_value* values, fulmar_error* error) noexcept {
  if (!info_.retunes) return FULMAR_OK;
  SharedValue* heads = at<SharedValue>(layout_.values_at);
  for (std::size_t i = 0; i < layout_.texts.size(); ++i) {
    const fulmar_value& v = values[i];
    heads[i] = {{v.number[0], v.number[1], v.number[2]}, v.integer, v.size, 0, 0, 0, 0};
    const TextPlace& place = layout_.texts[i];
    if (place.capacity == 0) continue;
    const std::size_t length = std::strlen(v.text ? v.text : "");
    if (length >= place.capacity) {
      report(error, isolate_messages::text_too_long.c_str());
      return FULMAR_FAILED;
    }
    std::memcpy(at<std::byte>(place.at), v.text ? v.text : "", length + 1);
  }
  return call(Call::retune, options_.hang_ns, error);
}

std::uint32_t Isolated::activate(const fulmar_tick* tick, const fulmar_input* inputs,
                                 const fulmar_input* last, fulmar_error* error) noexcept {
  if (!info_.activates) return FULMAR_OK;
  if (!alive_) return dead(error);
  put_tick_inputs(tick, inputs);
  put_last(last);
  const std::uint32_t status = call(Call::activate, options_.hang_ns, error);
  if (alive_) take_answers(inputs);
  return status;
}

std::uint32_t Isolated::step(const fulmar_tick* tick, const fulmar_input* inputs, fulmar_output* outputs,
                             fulmar_error* error) noexcept {
  if (!alive_) return dead(error);
  put_tick_inputs(tick, inputs);
  put_outputs(outputs);
  const std::uint32_t status = call(Call::step, options_.hang_ns, error);
  if (!alive_) return status;
  take_answers(inputs);
  take_outputs(outputs);
  return status;
}

// ---- the hand-shake

std::uint32_t Isolated::call(Call what, std::int64_t limit_ns, fulmar_error* error) noexcept {
  if (!alive_) return dead(error);
  ControlBlock& c = control();
  c.call = what;
  c.request.store(++number_);  // sequentially consistent, before the read of child_sleeps, as in the child
  if (c.child_sleeps.load() != 0) futex_wake(c.request);
  if (!wait(limit_ns)) return dead(error);
  if (error && c.has_error != 0) {
    std::memcpy(error->text, c.error.text, sizeof error->text);
    error->text[sizeof error->text - 1] = '\0';
  }
  return c.status;
}

// The child's crash handler wakes the host. The host detects an exit or a kill by polling between sleeps.
bool Isolated::wait(std::int64_t limit_ns) noexcept {
  constexpr std::int64_t first_nap_ns = 200'000, max_nap_ns = 1'000'000;
  ControlBlock& c = control();
  if (spin_until(std::min(options_.spin_ns, limit_ns), [&] { return answered(); })) return true;
  const std::int64_t end = monotonic_ns() + limit_ns;
  for (std::int64_t nap_ns = first_nap_ns;; nap_ns = std::min(2 * nap_ns, max_nap_ns)) {
    c.host_sleeps.store(1);
    const std::uint32_t seen = c.answer.load();
    if (seen != number_) futex_wait(c.answer, seen, nap_ns);
    c.host_sleeps.store(0, std::memory_order_relaxed);
    // before the read of the answer: a child may answer just before its end
    const bool ended = has_ended();
    if (answered()) return true;
    if (ended) {
      note_death();
      return false;
    }
    if (monotonic_ns() < end) continue;
    hung_ = true;
    char limit_ms[32];
    std::snprintf(limit_ms, sizeof limit_ms, "%.6g", 1e-6 * static_cast<double>(limit_ns));
    isolate_messages::child_hung.write(death_, sizeof death_, limit_ms);
    alive_ = false;
    process_.kill();
    return false;
  }
}

bool Isolated::check() noexcept {
  if (alive_ && has_ended()) note_death();
  return alive_;
}

void Isolated::die(const char* death, bool hung) noexcept {
  process_.kill();
  alive_ = false;
  hung_ = hung;
  std::snprintf(death_, sizeof death_, "%s", death);
}

bool Isolated::has_ended() noexcept { return control().signal.load() != 0 || process_.ended(); }

// Call it only after the child has ended: a crashing child writes its signal last.
void Isolated::note_death() noexcept {
  int signal = static_cast<int>(control().signal.load());
  if (signal == 0) signal = process_.signal();
  const bool overflow = control().stack_overflow.load() != 0;
  alive_ = false;
  if (const char* known = signal_words(signal, overflow))
    std::snprintf(death_, sizeof death_, "%s", known);
  else if (signal != 0)
    isolate_messages::child_killed.write(death_, sizeof death_, signal);
  else
    isolate_messages::child_exited.write(death_, sizeof death_, process_.exit_code());
}

std::uint32_t Isolated::dead(fulmar_error* error) noexcept {
  report(error, death_);
  return FULMAR_FAILED;
}

// ---- calls of a component

const fulmar_component& Isolated::functions() {
  static const fulmar_component table = [] {
    fulmar_component t{};
    t.name = t.doc = "";
    t.destroy = [](void*) {};
    t.configure = [](void* instance, const fulmar_value* values, fulmar_error* error) -> std::uint32_t {
      try {
        return self(instance).configure(values, error);
      } catch (const std::exception& fault) {
        report(error, fault.what());
        return FULMAR_FAILED;
      }
    };
    t.retune = [](void* instance, const fulmar_value* values, fulmar_error* error) -> std::uint32_t {
      return self(instance).retune(values, error);
    };
    t.activate = [](void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                    const fulmar_input* last,
                    fulmar_error* error) { return self(instance).activate(tick, inputs, last, error); };
    t.deactivate = [](void* instance) {
      self(instance).call(Call::deactivate, self(instance).options_.hang_ns, nullptr);
    };
    t.step = [](void* instance, const fulmar_tick* tick, const fulmar_input* inputs, fulmar_output* outputs,
                fulmar_error* error) { return self(instance).step(tick, inputs, outputs, error); };
    return t;
  }();
  return table;
}

}  // namespace fulmar::core
