// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/flight_control.hpp"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/graph/params.hpp"
#include "core/graph/record.hpp"
#include "core/run/flight_impl.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t longest_value = 4096;         // of a parameter's text
constexpr auto nap = std::chrono::milliseconds(2);  // of the thread that answers; the loop never pays for waking it

Field text_field(const char* name, std::size_t offset, std::size_t size) {
  Field f;
  f.name = name, f.kind = FULMAR_TEXT, f.offset = static_cast<std::uint32_t>(offset), f.stride = static_cast<std::uint32_t>(size);
  return f;
}

TypePtr note_type(const char* name, std::size_t size, std::vector<Field> fields) {
  Type t;
  t.name = name, t.size = static_cast<std::uint32_t>(size), t.fields = std::move(fields);
  return std::make_shared<const Type>(t);
}

template <std::size_t N>
void put_text(std::array<char, N>& to, const std::string& text, const char* what) {
  if (text.size() >= N) throw Error(std::string(what) + " '" + text + "' is longer than " + std::to_string(N - 1) + " characters");
  std::copy(text.begin(), text.end(), to.begin());
}

Node parsed(const std::string& text, const std::string& name, Report& report) { return parse_yaml(make_source(text, name), report); }

}  // namespace

TypePtr parameter_note_type() {
  using N = ParameterNote;
  static const TypePtr type =
      note_type("ParameterSet", sizeof(N),
                {text_field("component", offsetof(N, component), sizeof(N::component)),
                 text_field("name", offsetof(N, name), sizeof(N::name)), text_field("text", offsetof(N, text), sizeof(N::text))});
  return type;
}

TypePtr command_note_type() {
  using N = CommandNote;
  static const TypePtr type = [] {
    Field kind;
    kind.name = "kind", kind.kind = FULMAR_ENUM, kind.stride = 1, kind.labels = {"phase", "swap", "reset"};
    return note_type("Command", sizeof(N),
                     {kind, text_field("component", offsetof(N, component), sizeof(N::component)),
                      text_field("text", offsetof(N, text), sizeof(N::text))});
  }();
  return type;
}

struct FlightControl::Command {
  enum class Kind : std::uint8_t { parameter, request, import, phase, swap, reset } kind = Kind::parameter;
  std::size_t component = 0, part = 0;  // parameter, input, or phase
  ParamValue value;
  std::vector<std::byte> message;
  std::string component_name, text;
  ParameterNote note;
  CommandNote command_note;
  Answer answer;
  std::array<char, 256> refusal{};
  std::shared_ptr<const PluginInfo> made_for;  // what it was checked against
  std::shared_ptr<const Directory> directory;  // after a swap
};

/// What there is to command; changes with a swap alone.
struct FlightControl::Directory {
  FlightView view;
  std::vector<std::shared_ptr<const PluginInfo>> plugins;  // keeps the infos alive
  std::vector<const ComponentInfo*> infos;
  std::vector<std::map<std::string, std::shared_ptr<const Guard>>> guards;  // per component: by request or imported input
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> overlaid;   // per phase: component and parameter
  std::vector<std::vector<int>> imports;                                    // per component and input: into the flight's imports, or -1

  explicit Directory(const Flight::Impl& flight);

  std::size_t component(const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < view.components.size(); ++i) {
      names.push_back(view.components[i].name);
      if (names.back() == name) return i;
    }
    throw Error("there is no component '" + name + "'." + choices_text(name, names));
  }
  /// An input that is a request, or imported.
  std::size_t input(std::size_t component, const std::string& port, bool imported) const {
    std::vector<std::string> names;
    const ComponentView& c = view.components[component];
    for (std::size_t i = 0; i < c.inputs.size(); ++i) {
      if (imported ? !c.inputs[i].imported : !c.inputs[i].request) continue;
      names.push_back(c.inputs[i].name);
      if (names.back() == port) return i;
    }
    throw Error("'" + c.name + "' takes no " + (imported ? "imported samples for" : "request") + " '" + port + "'." +
                choices_text(port, names));
  }
};

namespace {

std::string source_name(const Graph& graph, const Wire& wire) {
  if (wire.from.kind == Source::Kind::none) return "";
  const auto index = static_cast<std::size_t>(wire.from.index), output = static_cast<std::size_t>(wire.from.output);
  if (wire.from.kind == Source::Kind::role) return graph.roles[index].name + "." + graph.roles[index].outputs[output].name;
  const Component& c = graph.components[index];
  return c.name + "." + c.info().outputs[output].name;
}

ComponentView view_of(const Flight::Impl& flight, const Unit& unit) {
  static constexpr const char* modes[] = {"tick", "process", "async", "driver"};
  const Component& c = *unit.component;
  ComponentView v;
  v.name = c.name, v.use = c.use, v.doc = c.info().doc, v.run = modes[static_cast<std::size_t>(c.run)];
  if (c.role >= 0) v.role = flight.graph.roles[static_cast<std::size_t>(c.role)].name;
  for (std::size_t i = 0; i < c.info().params.size(); ++i) v.params.push_back({c.info().params[i], unit.base[i], false});
  for (std::size_t i = 0; i < unit.readers.size(); ++i) {
    const Reader& r = unit.readers[i];
    PortView port{r.port->name, r.port->type, source_name(flight.graph, c.wires[i])};
    port.request = r.port->kind == FULMAR_IN_REQUEST;
    port.imported = c.wires[i].import >= 0;
    port.channel = r.channel;
    v.inputs.push_back(std::move(port));
  }
  for (const Slot& s : unit.slots) {
    PortView port{s.port->name, s.port->type, ""};
    port.channel = static_cast<int>(s.port->type ? s.channel : unit.probe_channel);
    v.outputs.push_back(std::move(port));
  }
  return v;
}

}  // namespace

FlightControl::Directory::Directory(const Flight::Impl& flight) {
  if (!flight.graph.file.empty()) view.file = std::filesystem::absolute(flight.graph.file).string();
  view.mission = flight.graph.mission, view.io = flight.graph.io, view.epoch_ns = flight.graph.epoch_ns;
  for (const Phase& p : flight.graph.phases) {
    view.phases.push_back(p.name);
    overlaid.emplace_back();
    for (const Assignment& a : p.roles)
      for (const Overlay& o : a.set) overlaid.back().emplace_back(static_cast<std::size_t>(a.component), static_cast<std::size_t>(o.param));
  }
  for (const auto& unit : flight.units) {
    plugins.push_back(unit->component->plugin);
    infos.push_back(unit->info);
    view.components.push_back(view_of(flight, *unit));
    guards.emplace_back(), imports.emplace_back();
    for (const Wire& wire : unit->component->wires) imports.back().push_back(wire.import);
    for (const PortView& port : view.components.back().inputs)
      if (port.request || port.imported) guards.back()[port.name] = std::make_shared<const Guard>(*port.type);
  }
}

FlightControl::FlightControl(Flight::Impl& flight)
    : flight_(flight),
      states_(std::make_unique<std::atomic<std::uint8_t>[]>(flight.units.size())),
      directory_(std::make_shared<const Directory>(flight)) {
  for (const auto& unit : flight.units) base_.push_back(unit->base);
  waiting_of_.resize(flight.imports.size());
  sigset_t all, before;  // signals are for the main thread
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_setname_np(thread_.native_handle(), "fulmar-control");
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

FlightControl::~FlightControl() { end(); }

// ---- the loop ---------------------------------------------------------------------------------------------------------------------

void FlightControl::note(int phase, std::int64_t now_ns, bool armed) noexcept {
  phase_.store(phase, std::memory_order_relaxed);
  now_ns_.store(now_ns, std::memory_order_relaxed);
  armed_.store(armed, std::memory_order_relaxed);
}

void FlightControl::note_stopped(std::size_t component, bool active, bool stopped) noexcept {
  states_[component].store(static_cast<std::uint8_t>((active ? 1 : 0) | (stopped ? 2 : 0)), std::memory_order_relaxed);
}

void FlightControl::done(Command& command) noexcept { out_.push(&command); }  // has room for all that can wait

bool FlightControl::apply() noexcept {
  std::size_t applied = 0, left = 0;
  grounded_ = false;
  for (std::size_t i = 0; i < held_count_; ++i)
    if (applied < most_per_tick && take(*held_[i]))
      ++applied;
    else
      held_[left++] = held_[i];
  held_count_ = left;
  for (; applied < most_per_tick; ++applied) {
    Command* const command = in_.pop();
    if (!command) break;
    if (!take(*command)) held_[held_count_++] = command;
  }
  for (std::size_t n = 0; n < most_per_tick; ++n) {
    Command* const sample = samples_.pop();
    if (!sample) break;
    take(*sample);
  }
  return !grounded_;
}

bool FlightControl::take(Command& c) noexcept {
  try {
    return apply(c);
  } catch (const std::exception& fault) {
    return refuse(c, fault.what());
  }
}

bool FlightControl::refuse(Command& c, const char* why) noexcept {
  std::snprintf(c.refusal.data(), c.refusal.size(), "%s", why);
  done(c);
  return true;
}

/// A request has its turn when there is room for it.
bool FlightControl::apply_request(Command& c) {
  const Reply reply = [this, &c](const char* refusal) { refuse(c, refusal); };
  switch (flight_.apply_request(c.component, c.part, c.message.data(), reply)) {
    case Flight::Impl::Taken::yes:  // answered by its component
      return true;
    case Flight::Impl::Taken::idle:
      return refuse(c, "does not fly now");
    case Flight::Impl::Taken::full:
      break;
  }
  return false;
}

/// False: not now.
bool FlightControl::apply(Command& c) {
  if (c.made_for && c.made_for != flight_.units[c.component]->component->plugin)
    return refuse(c, "its component was swapped meanwhile; ask again");
  switch (c.kind) {
    case Command::Kind::parameter:
      flight_.apply_parameter(c.component, c.part, c.value, c.note);
      break;
    case Command::Kind::request:
      return apply_request(c);
    case Command::Kind::import:
      flight_.apply_import(c.part, c.message.data());
      break;
    case Command::Kind::phase:
      flight_.apply_phase(static_cast<int>(c.part), c.command_note);
      break;
    case Command::Kind::swap:
      grounded_ = true;
      flight_.owner->swap(c.component_name, c.text);
      c.directory = std::make_shared<const Directory>(flight_);
      break;
    case Command::Kind::reset:
      grounded_ = true;
      flight_.owner->reset_guards();
      break;
  }
  done(c);
  return true;
}

// ---- any other thread -------------------------------------------------------------------------------------------------------------

void FlightControl::send(std::unique_ptr<Command> command) {
  Command* const c = command.get();
  const std::lock_guard lock(mutex_);
  if (over_.load()) throw Error("the flight has ended");
  if (const std::size_t commands = waiting_.size() - waiting_samples_; commands >= most_waiting || !in_.push(c))
    throw Error(std::to_string(commands) + " commands are waiting for the flight; there is no room for more");
  waiting_.emplace(c, std::move(command));
}

void FlightControl::end() {
  std::map<Command*, std::unique_ptr<Command>> left;
  {
    const std::lock_guard lock(mutex_);
    if (over_.exchange(true)) return;
  }
  stop_.store(true);
  thread_.join();
  answer_done();
  {
    const std::lock_guard lock(mutex_);
    left = std::move(waiting_);
    waiting_.clear();
  }
  for (const auto& [pointer, command] : left)
    if (command->answer) command->answer("the flight has ended");
}

void FlightControl::run() noexcept {
  while (!stop_.load()) {
    answer_done();
    std::this_thread::sleep_for(nap);
  }
}

void FlightControl::answer_done() {
  while (Command* const c = out_.pop()) {
    std::unique_ptr<Command> command;
    decltype(changed_) changed;
    const bool accepted = c->refusal[0] == '\0';
    {
      const std::lock_guard lock(mutex_);
      const auto at = waiting_.find(c);
      command = std::move(at->second);
      waiting_.erase(at);
      if (c->kind == Command::Kind::import) {
        --waiting_samples_, --waiting_of_[c->part];
        if (!accepted) lost_samples_.fetch_add(1, std::memory_order_relaxed);
      }
      if (accepted && c->kind == Command::Kind::parameter) {
        const ComponentInfo& info = *directory_->infos[c->component];
        Report none;
        FileStore files(none);
        read_param(info.params[c->part], parsed(c->note.text.data(), "", none), "", base_[c->component][c->part], files, none);
        changed = changed_;
      }
      if (c->directory) {
        directory_ = c->directory;
        for (std::size_t i = 0; i < base_.size(); ++i) {
          base_[i].clear();
          for (const ParameterView& p : directory_->view.components[i].params) base_[i].push_back(p.base);
        }
      }
    }
    if (c->answer) c->answer(c->refusal.data());
    for (const auto& tell : changed) tell(c->note.component.data(), c->note.name.data());
  }
}

FlightView FlightControl::view() const {
  const std::lock_guard lock(mutex_);
  FlightView v = directory_->view;
  const auto phase = static_cast<std::size_t>(phase_.load(std::memory_order_relaxed));
  v.phase = v.phases.at(phase);
  v.now_ns = now_ns_.load(std::memory_order_relaxed);
  v.armed = armed_.load(std::memory_order_relaxed);
  v.over = over_.load();
  for (std::size_t i = 0; i < v.components.size(); ++i) {
    const std::uint8_t state = states_[i].load(std::memory_order_relaxed);
    v.components[i].active = state & 1, v.components[i].stopped = state & 2;
    for (std::size_t k = 0; k < v.components[i].params.size(); ++k) v.components[i].params[k].base = base_[i][k];
  }
  for (const auto& [component, param] : directory_->overlaid[phase]) v.components[component].params[param].overlaid = true;
  return v;
}

void FlightControl::set_parameter(const std::string& component, const std::string& param, const std::string& text, Answer answer) {
  auto command = std::make_unique<Command>();
  std::shared_ptr<const Directory> directory;
  {
    const std::lock_guard lock(mutex_);
    directory = directory_;
    command->component = directory->component(component);
    command->made_for = directory->plugins[command->component];
    const int index = directory->infos[command->component]->param(param);
    if (index >= 0)
      command->part = static_cast<std::size_t>(index), command->value = base_[command->component][command->part];
    else {
      std::vector<std::string> names;
      for (const ParamInfo& p : directory->infos[command->component]->params) names.push_back(p.name);
      throw Error("'" + component + "' has no parameter '" + param + "'." + choices_text(param, names));
    }
  }
  if (text.size() > longest_value)
    throw Error(component + "." + param + ": a value of " + std::to_string(text.size()) + " characters; " + std::to_string(longest_value) +
                " are allowed");
  const ParamInfo& info = directory->infos[command->component]->params[command->part];
  if (!info.live) throw Error(component + "." + param + " is a set-up parameter: it cannot change in flight");
  Report report;
  FileStore files(report);
  read_param(info, parsed(text, component + "." + param, report), param, command->value, files, report);
  report.throw_if_any();
  put_text(command->note.component, component, "the name");
  put_text(command->note.name, param, "the name");
  put_text(command->note.text, value_text(info, command->value), "the value");
  command->answer = std::move(answer);
  send(std::move(command));
}

void FlightControl::request(const std::string& component, const std::string& port, const std::string& text, Answer answer) {
  TypePtr type;
  {
    const std::lock_guard lock(mutex_);
    const std::size_t at = directory_->component(component);
    type = directory_->view.components[at].inputs[directory_->input(at, port, false)].type;
  }
  std::vector<std::byte> message(type->size);
  Report report;
  const Node node = parsed(text.empty() ? "{}" : text, component + "." + port, report);
  if (!node.is(Node::Kind::missing)) fill_record(*type, node, message.data(), "", report);
  report.throw_if_any();
  request(component, port, std::move(message), std::move(answer));
}

void FlightControl::request(const std::string& component, const std::string& port, std::vector<std::byte> message, Answer answer) {
  auto command = std::make_unique<Command>();
  command->kind = Command::Kind::request;
  std::shared_ptr<const Guard> guard;
  {
    const std::lock_guard lock(mutex_);
    command->component = directory_->component(component);
    command->made_for = directory_->plugins[command->component];
    command->part = directory_->input(command->component, port, false);
    const TypePtr& type = directory_->view.components[command->component].inputs[command->part].type;
    if (message.size() != type->size)
      throw Error(component + "." + port + ": " + std::to_string(message.size()) + " bytes are no " + type->name);
    guard = directory_->guards[command->component].at(port);
  }
  if (!guard->check(message.data())) throw Error(component + "." + port + ": " + guard->explain(message.data()));
  command->message = std::move(message);
  command->answer = std::move(answer);
  send(std::move(command));
}

bool FlightControl::publish(const std::string& component, const std::string& port, std::vector<std::byte> message) {
  auto command = std::make_unique<Command>();
  command->kind = Command::Kind::import;
  const std::lock_guard lock(mutex_);
  command->component = directory_->component(component);
  command->made_for = directory_->plugins[command->component];
  const std::size_t input = directory_->input(command->component, port, true);
  const TypePtr& type = directory_->view.components[command->component].inputs[input].type;
  const Guard& guard = *directory_->guards[command->component].at(port);
  if (message.size() != type->size)
    throw Error(component + "." + port + ": " + std::to_string(message.size()) + " bytes are no " + type->name);
  if (!guard.check(message.data())) throw Error(component + "." + port + ": " + guard.explain(message.data()));
  command->part = static_cast<std::size_t>(directory_->imports[command->component][input]);
  command->message = std::move(message);
  Command* const c = command.get();
  // So many of each: a flood of one import takes no other's place.
  if (over_.load() || waiting_of_[c->part] >= most_of_import || !samples_.push(c)) {
    lost_samples_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  ++waiting_samples_, ++waiting_of_[c->part];
  waiting_.emplace(c, std::move(command));
  return true;
}

void FlightControl::enter_phase(const std::string& phase, Answer answer) {
  auto command = std::make_unique<Command>();
  command->kind = Command::Kind::phase;
  {
    const std::lock_guard lock(mutex_);
    const std::vector<std::string>& names = directory_->view.phases;
    const auto at = std::find(names.begin(), names.end(), phase);
    if (at == names.end()) throw Error("there is no phase '" + phase + "'." + choices_text(phase, names));
    command->part = static_cast<std::size_t>(at - names.begin());
  }
  put_text(command->command_note.text, phase, "the phase");
  command->answer = std::move(answer);
  send(std::move(command));
}

void FlightControl::swap(const std::string& component, const std::string& file, Answer answer) {
  auto command = std::make_unique<Command>();
  command->kind = Command::Kind::swap;
  {
    const std::lock_guard lock(mutex_);
    command->component = directory_->component(component);
  }
  command->component_name = component, command->text = file;
  command->answer = std::move(answer);
  send(std::move(command));
}

void FlightControl::reset_guards(Answer answer) {
  auto command = std::make_unique<Command>();
  command->kind = Command::Kind::reset;
  command->answer = std::move(answer);
  send(std::move(command));
}

void FlightControl::on_parameter(std::function<void(const std::string&, const std::string&)> changed) {
  const std::lock_guard lock(mutex_);
  changed_.push_back(std::move(changed));
}

}  // namespace fulmar::core
