// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/control.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/graph/params.hpp"
#include "core/run/control_impl.hpp"
#include "core/run/flight_impl.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_value = 4096;  // length of a parameter's text
constexpr auto nap =
    std::chrono::milliseconds(2);  // sleep of the answering thread; the loop never has the cost of a wake-up

}  // namespace

struct FlightControl::Waiting {
  Command command;
  std::optional<PaceOrder> pace;  // in place of a command
  Answer answer;
  std::array<char, 256> refusal{};             // reason of a component, written in its step
  std::string fault;                           // fault found by the host, complete
  std::shared_ptr<const Directory> directory;  // after a swap
};

FlightControl::FlightControl(Flight::Impl& flight)
    : flight_(flight),
      seen_(flight.wiring.units.size()),
      directory_(std::make_shared<const Directory>(flight)) {
  if (!flight.state.on_hardware()) seen_.speed.store(flight.state.options.speed);
  for (const auto& unit : flight.wiring.units) base_.push_back(unit->base);
  waiting_.of_import.resize(flight.wiring.imports.size());
  thread_ = quiet_thread("fulmar-control", [this] { run(); });
}

FlightControl::~FlightControl() { end(); }

// ---- the loop

void FlightControl::note(int phase, std::int64_t now_ns, bool armed) noexcept {
  seen_.phase.store(phase, std::memory_order_relaxed);
  seen_.now_ns.store(now_ns, std::memory_order_relaxed);
  seen_.armed.store(armed, std::memory_order_relaxed);
}

void FlightControl::note_unit(std::size_t component, const Unit& unit) noexcept {
  constexpr auto relaxed = std::memory_order_relaxed;
  Seen::Component& seen = seen_.components[component];
  seen.active.store(unit.active, relaxed);
  seen.stopped.store(unit.stopped, relaxed);
  seen.steps.store(unit.stats.steps, relaxed);
  seen.step_us.store(unit.stats.time.mean_us(), relaxed);
  seen.step_max_us.store(unit.stats.time.max_us(), relaxed);
}

void FlightControl::done(Waiting& waiting) noexcept {
  queues_.out.push(&waiting);
}  // the queue has room for all pending commands

bool FlightControl::apply() noexcept {
  std::size_t applied = 0, left = 0;
  held_.grounded = false;
  for (std::size_t i = 0; i < held_.count; ++i)
    if (applied < max_per_tick && take(*held_.list[i]))
      ++applied;
    else
      held_.list[left++] = held_.list[i];
  held_.count = left;
  for (; applied < max_per_tick; ++applied) {
    Waiting* const waiting = queues_.in.pop();
    if (!waiting) break;
    const bool paces = waiting->pace.has_value();
    if (!take(*waiting)) held_.list[held_.count++] = waiting;
    if (paces) break;  // later commands are executed later
  }
  for (std::size_t n = 0; n < max_per_tick; ++n) {
    Waiting* const sample = queues_.samples.pop();
    if (!sample) break;
    take(*sample);
  }
  return !held_.grounded;
}

bool FlightControl::take(Waiting& w) noexcept {
  try {
    return w.pace ? apply_pace(w) : apply(w);
  } catch (const std::exception& fault) {
    try {
      w.fault = fault.what();
    } catch (...) {  // out of memory
    }
    return refuse(w, fault.what());
  }
}

bool FlightControl::refuse(Waiting& w, const char* why) noexcept {
  const int length = std::snprintf(w.refusal.data(), w.refusal.size(), "%s", why);
  if (length >= static_cast<int>(w.refusal.size())) end_in_dots(w.refusal.data(), w.refusal.size());
  done(w);
  return true;
}

/// Returns false when it must wait. A request waits until there is room for it, and is answered by its
/// component.
bool FlightControl::apply(Waiting& w) {
  Command& c = w.command;
  if (c.made_for && c.made_for != flight_.wiring.units[c.at]->component->plugin)
    return refuse(w, run_messages::component_was_swapped.c_str());
  if (c.kind == CommandKind::swap || c.kind == CommandKind::reset) held_.grounded = true;
  Reply reply;
  if (c.kind == CommandKind::request) reply = [this, &w](const char* refusal) { refuse(w, refusal); };
  const Flight::Impl::Taken taken = flight_.take(c, std::move(reply));
  if (taken == Flight::Impl::Taken::full) return false;
  if (taken == Flight::Impl::Taken::idle) {
    std::array<char, 96> refusal;
    run_messages::component_not_active.write(refusal.data(), refusal.size(), c.component);
    return refuse(w, refusal.data());
  }
  if (c.kind == CommandKind::request) return true;
  if (c.kind == CommandKind::swap) w.directory = std::make_shared<const Directory>(flight_);
  done(w);
  return true;
}

// ---- the loop's clock

/// The flight continues at full speed.
void FlightControl::go_on() noexcept {
  end_steps();
  clock_.paused = false;
  flight_.stopwatch.go_on();
}

/// Reports the number of flown ticks to the client that requested them.
void FlightControl::end_steps() noexcept {
  if (!clock_.stepper) return;
  Waiting& w = *std::exchange(clock_.stepper, nullptr);
  const std::uint64_t asked = w.pace->ticks, left = std::exchange(clock_.left, 0);
  std::array<char, 80> words;
  std::snprintf(words.data(), words.size(), "ended after %llu of %llu ticks",
                static_cast<unsigned long long>(asked - left), static_cast<unsigned long long>(asked));
  refuse(w, words.data());
}

void FlightControl::ticked() noexcept {
  if (clock_.left == 0 || --clock_.left > 0) return;
  done(*std::exchange(clock_.stepper, nullptr));
}

bool FlightControl::apply_pace(Waiting& w) {
  using What = PaceOrder::What;
  held_.grounded = true;  // the report allocates
  const PaceOrder& order = *w.pace;
  switch (order.what) {
    case What::pause:
      if (stands()) return refuse(w, run_messages::flight_already_paused.c_str());
      end_steps();
      clock_.paused = true;
      break;
    case What::resume:
      if (!clock_.paused) return refuse(w, run_messages::flight_not_paused.c_str());
      go_on();
      break;
    case What::step:
      if (!clock_.paused) return refuse(w, run_messages::step_without_pause.c_str());
      if (clock_.stepper) return refuse(w, run_messages::steps_in_progress.c_str());
      clock_.left = order.ticks;
      clock_.stepper = &w;
      return true;
    case What::restart:
      end_steps();
      flight_.state.restart = Restart{order.seed};
      flight_.end.end_by(Ending::Cue::abandoned);
      done(w);
      return true;
    case What::speed:
      flight_.state.options.speed = order.speed;
      flight_.recorder.wait_for_log(order.speed == 0);
      go_on();
  }
  seen_.paused.store(clock_.paused, std::memory_order_relaxed);
  seen_.speed.store(flight_.state.options.speed, std::memory_order_relaxed);
  flight_.report_pace(order);
  done(w);
  return true;
}

// ---- any other thread

std::shared_ptr<const FlightControl::Directory> FlightControl::directory() const {
  const std::lock_guard lock(mutex_);
  return directory_;
}

void FlightControl::send(Command command, Answer answer) {
  directory()->commands->prepare(command);
  auto waiting = std::make_unique<Waiting>();
  waiting->command = std::move(command);
  waiting->answer = std::move(answer);
  enqueue(std::move(waiting));
}

void FlightControl::enqueue(std::unique_ptr<Waiting> waiting) {
  Waiting* const w = waiting.get();
  const std::lock_guard lock(mutex_);
  if (over_.load()) throw Error(run_messages::flight_ended());
  if (const std::size_t commands = waiting_.all.size() - waiting_.samples;
      commands >= max_waiting || !queues_.in.push(w))
    throw Error(run_messages::too_many_commands(commands));
  waiting_.all.emplace(w, std::move(waiting));
}

void FlightControl::end() {
  std::map<Waiting*, std::unique_ptr<Waiting>> left;
  {
    const std::lock_guard lock(mutex_);
    if (over_.exchange(true)) return;
  }
  stop_.store(true);
  thread_.join();
  answer_done();
  {
    const std::lock_guard lock(mutex_);
    left = std::move(waiting_.all);
    waiting_.all.clear();
  }
  for (const auto& [pointer, waiting] : left)
    if (waiting->answer) waiting->answer(run_messages::flight_ended.c_str());
}

void FlightControl::run() noexcept {
  while (!stop_.load()) {
    answer_done();
    std::this_thread::sleep_for(nap);
  }
}

void FlightControl::answer_done() {
  while (Waiting* const w = queues_.out.pop()) {
    const Command& c = w->command;
    std::unique_ptr<Waiting> waiting;
    decltype(changed_) changed;
    const bool accepted = w->refusal[0] == '\0';
    {
      const std::lock_guard lock(mutex_);
      const auto at = waiting_.all.find(w);
      waiting = std::move(at->second);
      waiting_.all.erase(at);
      if (c.kind == CommandKind::import) {
        --waiting_.samples;
        --waiting_.of_import[c.part];
        if (!accepted) lost_samples_.fetch_add(1, std::memory_order_relaxed);
      }
      if (accepted && !w->pace && c.kind == CommandKind::parameter) {
        base_[c.at][c.part] = value_of(c.note, directory_->commands->info(c.at).params[c.part]);
        changed = changed_;
      }
      if (w->directory) {
        directory_ = w->directory;
        for (std::size_t i = 0; i < base_.size(); ++i) {
          base_[i].clear();
          for (const ParameterView& p : directory_->view.components[i].params) base_[i].push_back(p.base);
        }
      }
    }
    if (w->answer) w->answer(w->fault.empty() ? std::string(w->refusal.data()) : w->fault);
    for (const auto& report : changed) report(c.component, c.name);
  }
}

FlightView FlightControl::view() const {
  const std::lock_guard lock(mutex_);
  FlightView v = directory_->view;
  const auto phase = static_cast<std::size_t>(seen_.phase.load(std::memory_order_relaxed));
  v.phase.now = v.phase.all.at(phase);
  v.now_ns = seen_.now_ns.load(std::memory_order_relaxed);
  v.armed = seen_.armed.load(std::memory_order_relaxed);
  v.over = over_.load();
  v.pace.paused = seen_.paused.load(std::memory_order_relaxed);
  v.pace.speed = seen_.speed.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < v.components.size(); ++i) {
    ComponentView& c = v.components[i];
    const Seen::Component& seen = seen_.components[i];
    c.active = seen.active;
    c.stopped = seen.stopped;
    c.steps = seen.steps;
    c.step_us = seen.step_us;
    c.step_max_us = seen.step_max_us;
    for (std::size_t k = 0; k < c.params.size(); ++k) c.params[k].base = base_[i][k];
  }
  for (const auto& [component, param] : directory_->overlaid[phase])
    v.components[component].params[param].overlaid = true;
  return v;
}

void FlightControl::set_parameter(const std::string& component, const std::string& param,
                                  const std::string& text, Answer answer) {
  Command command = command_of(CommandKind::parameter, component, param);
  std::shared_ptr<const CommandTable> commands;
  std::size_t at = 0, part = 0;
  {
    const std::lock_guard lock(mutex_);
    commands = directory_->commands;
    at = commands->component(component);
    part = commands->param(at, param);
    command.value = base_[at][part];
  }
  if (text.size() > max_value)
    throw Error(run_messages::value_too_long(component, param, text.size(), max_value));
  const ParamInfo& info = commands->info(at).params[part];
  check_live(component, info);
  Report report;
  FileStore files(report);
  const Node node = parse_yaml(make_source(text, component + "." + param), report);
  read_param(info, node, param, command.value, files, report);
  report.throw_if_any();
  send(std::move(command), std::move(answer));
}

void FlightControl::request(const std::string& component, const std::string& port,
                            std::vector<std::byte> message, Answer answer) {
  Command command = command_of(CommandKind::request, component, port);
  command.message = std::move(message);
  send(std::move(command), std::move(answer));
}

bool FlightControl::publish(const std::string& component, const std::string& port,
                            std::vector<std::byte> message) {
  auto waiting = std::make_unique<Waiting>();
  Command& c = waiting->command = command_of(CommandKind::import, component, port);
  c.message = std::move(message);
  directory()->commands->prepare(c);
  Waiting* const w = waiting.get();
  const std::lock_guard lock(mutex_);
  // A limit per import: a flood of one does not block the others.
  if (over_.load() || waiting_.of_import[c.part] >= max_of_import || !queues_.samples.push(w)) {
    lost_samples_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  ++waiting_.samples;
  ++waiting_.of_import[c.part];
  waiting_.all.emplace(w, std::move(waiting));
  return true;
}

void FlightControl::enter_phase(const std::string& phase, Answer answer) {
  send(command_of(CommandKind::phase, "", phase), std::move(answer));
}

void FlightControl::swap(const std::string& component, const std::string& file, Answer answer) {
  send(command_of(CommandKind::swap, component, file), std::move(answer));
}

void FlightControl::reset_guards(Answer answer) { send(command_of(CommandKind::reset), std::move(answer)); }

void FlightControl::pace(const PaceOrder& order, Answer answer) {
  using What = PaceOrder::What;
  const bool stops = order.what == What::pause || order.what == What::resume;
  if (flight_.state.on_hardware())
    throw Error(run_messages::hardware_pace_fixed(stops                      ? "an aircraft cannot be paused"
                                                  : order.what == What::step ? "an aircraft cannot be stepped"
                                                  : order.what == What::restart
                                                      ? "an aircraft cannot be put back to where it began"
                                                      : "its time has no speed but that of the clock"));
  if (order.what == What::restart && !flight_.state.options.no_restart.empty())
    throw Error(run_messages::restart_not_possible(flight_.state.options.no_restart));
  auto waiting = std::make_unique<Waiting>();
  waiting->pace = order;
  waiting->answer = std::move(answer);
  enqueue(std::move(waiting));
}

void FlightControl::on_parameter(std::function<void(const std::string&, const std::string&)> changed) {
  const std::lock_guard lock(mutex_);
  changed_.push_back(std::move(changed));
}

}  // namespace fulmar::core
