// SPDX-License-Identifier: BSD-3-Clause
#include "sim.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/app/report.hpp"
#include "core/graph/params.hpp"
#include "core/graph/record.hpp"
#include "core/run/command/command.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_module/messages.hpp"
#include "values.hpp"

namespace fulmar::module {
using namespace core;
namespace {

constexpr int ticks_between_signals = 400;  // interval of the check for Ctrl-C

/// Converts values to the text of a mission file: Python writes JSON, which is a subset of YAML.
Node as_yaml(const py::handle& value, const std::string& name, Report& report) {
  const py::module_ json = py::module_::import("json");
  const py::object plain =
      py::cpp_function([](const py::object& x) { return x.attr("tolist")(); });  // numpy's numbers and arrays
  const auto text = py::cast<std::string>(
      json.attr("dumps")(value, py::arg("default") = plain, py::arg("ensure_ascii") = false));
  return parse_yaml(make_source(text, name), report);
}

/// Valid names of its owner, or all owners when the owner is unknown.
std::string choices_of(const std::string& owner, const std::string& rest,
                       const std::vector<std::string>& names) {
  std::vector<std::string> own, owners;
  for (const std::string& name : names) {
    const std::string one = name.substr(0, name.find('.'));
    if (one == owner) own.push_back(name.substr(one.size() + 1));
    if (std::find(owners.begin(), owners.end(), one) == owners.end()) owners.push_back(one);
  }
  return own.empty() ? choices_text(owner, owners) : choices_text(rest, own);
}

std::pair<std::string, std::string> split(const std::string& name, const char* what) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == name.size())
    throw Error(module_messages::dotted_name_expected(name, what, what));
  return {name.substr(0, dot), name.substr(dot + 1)};
}

}  // namespace

Sim::Sim(const std::string& mission, const Overrides& overrides, const FlightOptions& options)
    : graph_(load_mission(mission, overrides)), options_(options), log_file_(options.log_file) {
  options_.log = !log_file_.empty();
  options_.say = [this](const std::string& text, bool) { events_.push_back(text); };
  flight();
}

Flight& Sim::flight() {
  if (!flight_) flight_ = std::make_unique<Flight>(graph_, options_);
  return *flight_;
}

void Sim::finish() { result_ = result_json(graph_, *flight_, flight_->finish()).dump(); }

bool Sim::step(std::int64_t n) {
  if (n < 0) throw Error(module_messages::step_negative(n));
  for (std::int64_t i = 0; i < n && !done(); ++i) {
    const py::gil_scoped_release others_may_run;
    begun_ = true;
    if (!flight().step()) finish();
  }
  return !done();
}

py::object Sim::run(std::optional<double> until_s) {
  while (!done() && !(until_s && now_s() >= *until_s)) {
    {
      const py::gil_scoped_release others_may_run;
      begun_ = true;
      for (int i = 0; i < ticks_between_signals && !done() && !(until_s && now_s() >= *until_s); ++i)
        if (!flight().step()) finish();
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return result();
}

void Sim::reset(std::optional<std::uint64_t> seed) {
  if (begun_ && !log_file_.empty()) throw Error(module_messages::reset_with_log(log_file_));
  flight_.reset();
  result_.reset();
  events_.clear();
  begun_ = false;
  if (seed) graph_.seed = *seed;
  flight();
}

double Sim::now_s() const { return flight_ ? 1e-9 * static_cast<double>(flight_->now_ns()) : 0; }

std::string Sim::phase() const { return begun_ ? flight_->phase() : ""; }

py::object Sim::result() const {
  return done() ? py::module_::import("json").attr("loads")(*result_) : py::none();
}

// ---- ports

std::vector<std::string> Sim::ports() const {
  std::vector<std::string> names;
  for (const Role& role : graph_.roles)
    for (const RolePort& port : role.outputs) names.push_back(role.name + "." + port.name);
  for (const Component& c : graph_.components)
    for (const Port& port : c.info().outputs) names.push_back(c.name + "." + port.name);
  return names;
}

Source Sim::find_port(const std::string& owner, const std::string& port) const {
  for (std::size_t r = 0; r < graph_.roles.size(); ++r)
    for (std::size_t k = 0; graph_.roles[r].name == owner && k < graph_.roles[r].outputs.size(); ++k)
      if (graph_.roles[r].outputs[k].name == port)
        return {Source::Kind::role, static_cast<int>(r), static_cast<int>(k)};
  for (std::size_t i = 0; i < graph_.components.size(); ++i)
    if (const int k = graph_.components[i].info().output(port); graph_.components[i].name == owner && k >= 0)
      return {Source::Kind::component, static_cast<int>(i), k};
  throw py::key_error("there is no port '" + owner + "." + port + "'." + choices_of(owner, port, ports()));
}

TypePtr Sim::type_of(const Source& source) const {
  const auto i = static_cast<std::size_t>(source.index), k = static_cast<std::size_t>(source.output);
  return source.kind == Source::Kind::role ? graph_.roles[i].outputs[k].type
                                           : graph_.components[i].info().outputs[k].type;
}

py::object Sim::sample(const std::string& name) {
  const auto [owner, rest] = split(name, "port");
  const std::size_t dot = rest.find('.');
  const Source source = find_port(owner, rest.substr(0, dot));
  const TypePtr type = type_of(source);
  const std::byte* message = flight().sample(source);
  if (message == nullptr) return py::none();
  if (!type) return py::float_(number_at(FULMAR_F64, message));  // a probe
  if (dot == std::string::npos) return record_of(*type, message);
  const FieldRef field = resolve_field(*type, rest.substr(dot + 1));
  return field.present(message) ? value_of(*field.field, message + field.offset) : py::none();
}

// ---- parameters

std::vector<std::string> Sim::parameters() const {
  std::vector<std::string> names;
  for (const Component& c : graph_.components)
    for (const ParamInfo& p : c.info().params) names.push_back(c.name + "." + p.name);
  return names;
}

std::pair<std::size_t, std::size_t> Sim::find_parameter(const std::string& name) const {
  const auto [owner, param] = split(name, "parameter");
  for (std::size_t i = 0; i < graph_.components.size(); ++i)
    if (const int k = graph_.components[i].info().param(param); graph_.components[i].name == owner && k >= 0)
      return {i, static_cast<std::size_t>(k)};
  throw py::key_error("there is no parameter '" + name + "'." + choices_of(owner, param, parameters()));
}

py::object Sim::parameter(const std::string& name) const {
  const auto [i, k] = find_parameter(name);
  const ParamInfo& info = graph_.components[i].info().params[k];
  const ParamValue& value = graph_.components[i].params[k];
  switch (info.kind) {
    case FULMAR_NUMBER: return py::float_(value.number[0]);
    case FULMAR_FLAG: return py::bool_(value.integer != 0);
    case FULMAR_COUNT: return py::int_(value.integer);
    case FULMAR_CHOICE: return py::str(info.choices.at(static_cast<std::size_t>(value.integer)));
    case FULMAR_VECTOR: return py::make_tuple(value.number[0], value.number[1], value.number[2]);
    case FULMAR_RECORD: return record_of(*info.type, value.data.data());
    default: return py::str(value.text);
  }
}

/// Before the first tick any parameter may change; later only live ones.
void Sim::set_parameter(const std::string& name, const py::handle& value) {
  const auto [i, k] = find_parameter(name);
  const ParamInfo& info = graph_.components[i].info().params[k];
  ParamValue changed = graph_.components[i].params[k];
  Report report;
  FileStore files(report);
  read_param(info, as_yaml(value, name, report), name, changed, files, report);
  report.throw_if_any();
  if (begun_ && !done()) {
    Command command = command_of(CommandKind::parameter, graph_.components[i].name, info.name);
    command.value = changed;
    flight().apply(std::move(command));
  } else if (!begun_) {
    flight_.reset();  // the next flight is created with it
  }
  graph_.components[i].params[k] = changed;
}

// ---- requests

std::shared_ptr<Answer> Sim::request(const std::string& name, const py::handle& message) {
  if (done()) throw Error(located(name, module_messages::flight_over()));
  const auto [owner, port] = split(name, "request");
  const Port* asked = nullptr;
  std::vector<std::string> names;
  for (const Component& c : graph_.components)
    for (const Port& p : c.info().inputs) {
      if (p.kind != FULMAR_IN_REQUEST) continue;
      names.push_back(c.name + "." + p.name);
      if (names.back() == name) asked = &p;
    }
  if (asked == nullptr)
    throw py::key_error("there is no request '" + name + "'." + choices_text(name, names));
  Report report;
  Command command = command_of(CommandKind::request, owner, port);
  command.message.resize(asked->type->size);
  fill_record(*asked->type, as_yaml(message, name, report), command.message.data(), "", report);
  report.throw_if_any();
  const auto answer = std::make_shared<Answer>();
  flight().apply(std::move(command), [answer](const std::string& refusal) {
    answer->answered = true;
    answer->accepted = refusal.empty();
    answer->reason = refusal;
  });
  return answer;
}

}  // namespace fulmar::module
