// SPDX-License-Identifier: BSD-3-Clause
// The parameter services of one ROS 2 node. Semantics as rclcpp and rclpy have them where ROS 2 says nothing.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/dds/services.hpp"
#include "core/graph/quantity.hpp"

namespace fulmar::core::dds {

RclValue rcl_value(const ParameterView& parameter) {
  const ParamInfo& info = parameter.info;
  const ParamValue& base = parameter.base;
  RclValue value;
  switch (info.kind) {
    case FULMAR_NUMBER: value.type = RclType::number, value.number = base.number[0]; break;
    case FULMAR_FLAG: value.type = RclType::boolean, value.boolean = base.integer != 0; break;
    case FULMAR_COUNT: value.type = RclType::integer, value.integer = base.integer; break;
    case FULMAR_VECTOR:
      value.type = RclType::numbers, value.numbers.assign(base.number, base.number + 3);
      break;
    case FULMAR_CHOICE: {
      const auto i = static_cast<std::size_t>(base.integer);
      value.type = RclType::text, value.text = i < info.choices.size() ? info.choices[i] : "";
      break;
    }
    default: value.type = RclType::text, value.text = base.text;
  }
  return value;
}

namespace {

/// The text that a mission file would have for it. Throws Error when the parameter has no such values.
std::string parameter_text(const ParamInfo& info, const RclValue& value) {
  const bool text_kind = info.kind == FULMAR_CHOICE || info.kind == FULMAR_STRING ||
                         info.kind == FULMAR_RECORD || info.kind == FULMAR_BLOB;
  switch (value.type) {
    case RclType::boolean: return value.boolean ? "true" : "false";
    case RclType::integer: return std::to_string(value.integer);
    case RclType::number:
      if (!std::isfinite(value.number)) throw Error("it is not a finite number");
      return number_text(value.number);
    case RclType::text:  // "20 deg" sets a number, too
      return text_kind
                 ? nlohmann::json(value.text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                 : value.text;
    case RclType::numbers:
    case RclType::integers: {
      std::string list;
      for (const double x : value.numbers) {
        if (!std::isfinite(x)) throw Error("it holds a number that is not finite");
        list += (list.empty() ? "" : ", ") + number_text(x);
      }
      for (const std::int64_t x : value.integers) list += (list.empty() ? "" : ", ") + std::to_string(x);
      return "[" + list + "]";
    }
    default:
      throw Error("a parameter is a number, a flag, a text or a list of numbers, and cannot be deleted");
  }
}

constexpr std::size_t most_at_once = 256;  // parameters in one call

/// All parameters by their ROS names, and a reader of them.
struct Known {
  FlightView view;
  std::map<std::string, std::pair<const ComponentView*, const ParameterView*>> by_name;

  explicit Known(const Control& control) : view(control.view()) {
    for (const ComponentView& c : view.components)
      for (const ParameterView& p : c.params) by_name.try_emplace(c.name + "." + p.info.name, &c, &p);
  }
  const ParameterView* find(const std::string& name) const {
    const auto at = by_name.find(name);
    return at == by_name.end() ? nullptr : at->second.second;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& [name, where] : by_name) list.push_back(name);
    return list;
  }
};

RclDescriptor descriptor(const std::string& name, const ParameterView* p) {
  RclDescriptor d;
  d.name = name;
  if (p == nullptr) return d;
  const ParamInfo& info = p->info;
  d.type = rcl_value(*p).type;
  d.description =
      info.doc + (info.unit.empty() ? "" : (info.doc.empty() ? "" : " ") + ("[" + info.unit + "]"));
  if (info.kind == FULMAR_CHOICE) d.constraints = "one of " + join(info.choices);
  if (p->overlaid)
    d.constraints += d.constraints.empty() ? "the present phase sets it" : "; the present phase sets it";
  d.read_only = !info.live;
  d.min = info.min;
  d.max = info.max;
  const bool ranged = std::isfinite(info.min) && std::isfinite(info.max);
  d.number_range = ranged && (info.kind == FULMAR_NUMBER || info.kind == FULMAR_VECTOR);
  d.integer_range = ranged && info.kind == FULMAR_COUNT;
  return d;
}

// ---- answers that only look

Bytes list_parameters(const Control& control, CdrIn in) {
  const std::vector<std::string> prefixes = in.texts();
  const auto depth = in.number<std::uint64_t>();  // 0: any
  std::vector<std::string> names;
  std::set<std::string> components;
  for (const std::string& name : Known(control).names()) {
    const std::string component = name.substr(0, name.find('.'));
    const bool asked =
        prefixes.empty() || std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& p) {
          return name == p || name.compare(0, p.size() + 1, p + ".") == 0;
        });
    if (!asked || (depth == 1 && prefixes.empty())) continue;
    names.push_back(name);
    components.insert(component);
  }
  CdrOut out;
  out.texts(names);
  out.texts({components.begin(), components.end()});
  return out.take();
}

/// Writes an answer for each name that was asked for.
template <class Answer>
Bytes each_name(const Control& control, CdrIn& in, Answer answer) {
  const std::vector<std::string> names = in.texts();
  const Known known(control);
  CdrOut out;
  out.count(names.size());
  for (const std::string& name : names) answer(out, name, known.find(name));
  return out.take();
}

Bytes get_parameters(const Control& control, CdrIn in) {
  return each_name(control, in, [](CdrOut& out, const std::string&, const ParameterView* p) {
    (p ? rcl_value(*p) : RclValue{}).write(out);
  });
}

Bytes get_parameter_types(const Control& control, CdrIn in) {
  return each_name(control, in, [](CdrOut& out, const std::string&, const ParameterView* p) {
    out.number(static_cast<std::uint8_t>((p ? rcl_value(*p) : RclValue{}).type));
  });
}

Bytes describe_parameters(const Control& control, CdrIn in) {
  return each_name(control, in, [](CdrOut& out, const std::string& name, const ParameterView* p) {
    descriptor(name, p).write(out);
  });
}

// ---- answers that change something

/// Collects what becomes of each parameter of one call; the last answer sends the reply.
struct Results {
  Server::Reply reply;
  bool one = false;  // one result for all, without a list
  std::mutex mutex;
  std::vector<std::string> refusals;
  std::size_t open = 0;

  void set(std::size_t i, const std::string& refusal) {
    const std::lock_guard lock(mutex);
    refusals[i] = refusal;
    if (--open == 0) send();
  }
  void send() {
    CdrOut out;
    if (!one) out.count(refusals.size());
    for (const std::string& refusal : refusals) {
      out.flag(refusal.empty());
      out.text(refusal);
    }
    reply(out.take());
  }
};

void set_one(Control& control, const Known& known, const RclParameter& parameter,
             const std::function<void(const std::string&)>& answer) {
  try {
    const auto at = known.by_name.find(parameter.name);
    if (at == known.by_name.end())
      throw Error("there is no parameter '" + parameter.name + "'." +
                  choices_text(parameter.name, known.names()));
    const auto& [component, p] = at->second;
    control.set_parameter(component->name, p->info.name, parameter_text(p->info, parameter.value), answer);
  } catch (const Error& fault) {
    answer(fault.what());
  }
}

void set_parameters(Control& control, CdrIn in, const Server::Reply& reply, bool at_once) {
  const std::vector<RclParameter> list = RclParameter::read_list(in);
  auto results = std::make_shared<Results>();
  results->reply = reply;
  results->one = at_once;
  results->refusals.resize(at_once ? 1 : list.size());
  results->open = results->refusals.size();
  if (list.empty()) return results->open == 0 ? results->send() : results->set(0, "");
  // Each change takes effect between two ticks, and two need not share the pair.
  const bool several = at_once && list.size() > 1;
  if (several)
    return results->set(
        0, "several parameters cannot be set in one instant; set_parameters sets them one after the other");
  if (list.size() > most_at_once)
    throw Error("more than " + std::to_string(most_at_once) + " parameters in one call");
  const Known known(control);
  for (std::size_t i = 0; i < list.size(); ++i)
    set_one(control, known, list[i], [results, i](const std::string& refusal) { results->set(i, refusal); });
}

}  // namespace

void add_parameter_services(Servers& servers, Participant& participant, const DdsOptions& options,
                            Control& control, const std::shared_ptr<Waker>& waker) {
  auto add = [&](const std::string& service, const std::string& type, Server::Handle handle) {
    const std::string name = "rcl_interfaces/srv/" + type;
    const Server::Names names{std::string(node_name) + "/" + service, name + "_Request", name + "_Response"};
    servers.push_back(
        std::make_unique<Server>(participant, options.name_space, names, waker, std::move(handle)));
  };
  auto look = [&control](Bytes (*answer)(const Control&, CdrIn)) {
    return [&control, answer](std::span<const std::byte> request, const Server::Reply& reply) {
      reply(answer(control, CdrIn(request)));
    };
  };
  add("list_parameters", "ListParameters", look(list_parameters));
  add("get_parameters", "GetParameters", look(get_parameters));
  add("get_parameter_types", "GetParameterTypes", look(get_parameter_types));
  add("describe_parameters", "DescribeParameters", look(describe_parameters));
  auto set = [&control](bool at_once) {
    return [&control, at_once](std::span<const std::byte> request, const Server::Reply& reply) {
      set_parameters(control, CdrIn(request), reply, at_once);
    };
  };
  add("set_parameters", "SetParameters", set(false));
  add("set_parameters_atomically", "SetParametersAtomically", set(true));
}

}  // namespace fulmar::core::dds
