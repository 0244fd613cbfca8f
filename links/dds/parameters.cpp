// SPDX-License-Identifier: BSD-3-Clause
// The parameter services of one ROS 2 node. Where ROS 2 specifies nothing, the semantics are those of rclcpp
// and rclpy.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/graph/quantity.hpp"
#include "links/dds/messages.hpp"
#include "links/dds/services.hpp"

namespace fulmar::core::dds {

RclValue rcl_value(const ParameterView& parameter) {
  const ParamInfo& info = parameter.info;
  const ParamValue& base = parameter.base;
  RclValue value;
  switch (info.kind) {
    case FULMAR_NUMBER:
      value.type = RclType::number;
      value.number = base.number[0];
      break;
    case FULMAR_FLAG:
      value.type = RclType::boolean;
      value.boolean = base.integer != 0;
      break;
    case FULMAR_COUNT:
      value.type = RclType::integer;
      value.integer = base.integer;
      break;
    case FULMAR_VECTOR:
      value.type = RclType::numbers;
      value.numbers.assign(base.number, base.number + 3);
      break;
    case FULMAR_CHOICE: {
      const auto i = static_cast<std::size_t>(base.integer);
      value.type = RclType::text;
      value.text = i < info.choices.size() ? info.choices[i] : "";
      break;
    }
    default: value.type = RclType::text; value.text = base.text;
  }
  return value;
}

namespace {

/// The value in the form of a mission file. Throws Error when the parameter has no such values.
std::string parameter_text(const ParamInfo& info, const RclValue& value) {
  const bool text_kind = info.kind == FULMAR_CHOICE || info.kind == FULMAR_STRING ||
                         info.kind == FULMAR_RECORD || info.kind == FULMAR_BLOB;
  switch (value.type) {
    case RclType::boolean: return value.boolean ? "true" : "false";
    case RclType::integer: return std::to_string(value.integer);
    case RclType::number:
      if (!std::isfinite(value.number)) throw Error(dds_messages::number_not_finite());
      return number_text(value.number);
    case RclType::text:  // "20 deg" sets a number, too
      return text_kind
                 ? nlohmann::json(value.text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                 : value.text;
    case RclType::numbers:
    case RclType::integers: {
      std::string list;
      for (const double x : value.numbers) {
        if (!std::isfinite(x)) throw Error(dds_messages::element_not_finite());
        list += (list.empty() ? "" : ", ") + number_text(x);
      }
      for (const std::int64_t x : value.integers) list += (list.empty() ? "" : ", ") + std::to_string(x);
      return "[" + list + "]";
    }
    default: throw Error(dds_messages::parameter_type_invalid());
  }
}

constexpr std::size_t max_at_once = 256;  // parameters in one call

RclType type_of(const ParameterView* p) { return p ? rcl_value(*p).type : RclType::not_set; }

std::vector<std::string> sorted_names(const FlightView& view) {
  std::vector<std::string> names = parameter_names(view);
  std::sort(names.begin(), names.end());
  return names;
}

/// rcl_interfaces/msg/ParameterDescriptor
void write_descriptor(CdrOut& out, const std::string& name, const ParameterView* p) {
  const ParamInfo& info = p ? p->info : ParamInfo{};
  std::string description = info.doc, constraints;
  if (!info.unit.empty()) description += (info.doc.empty() ? "[" : " [") + info.unit + "]";
  if (info.kind == FULMAR_CHOICE) constraints = "one of " + join(info.choices);
  if (p && p->overlaid)
    constraints += constraints.empty() ? "the present phase sets it" : "; the present phase sets it";
  const bool ranged = p && std::isfinite(info.min) && std::isfinite(info.max);
  const bool number_range = ranged && (info.kind == FULMAR_NUMBER || info.kind == FULMAR_VECTOR);
  const bool integer_range = ranged && info.kind == FULMAR_COUNT;
  out.text(name);
  out.number(static_cast<std::uint8_t>(type_of(p)));
  out.text(description);
  out.text(constraints);
  out.flag(p && !info.live);  // read only
  out.flag(false);            // dynamic typing
  out.count(number_range ? 1 : 0);
  if (number_range) {
    out.number(info.min);
    out.number(info.max);
    out.number(0.0);  // step: any value
  }
  out.count(integer_range ? 1 : 0);
  if (integer_range) {
    constexpr double largest = 9.2e18;  // fits an int64
    out.number(static_cast<std::int64_t>(std::clamp(info.min, -largest, largest)));
    out.number(static_cast<std::int64_t>(std::clamp(info.max, -largest, largest)));
    out.number(std::uint64_t{1});
  }
}

// ---- read requests

Bytes list_parameters(const Control& control, CdrReader in) {
  const std::vector<std::string> prefixes = in.texts();
  const auto depth = in.number<std::uint64_t>();  // 0: any depth
  std::vector<std::string> names;
  std::set<std::string> components;
  for (const std::string& name : sorted_names(control.view())) {
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

/// Writes an answer for each requested name.
template <class Answer>
Bytes each_name(const Control& control, CdrReader& in, Answer answer) {
  const std::vector<std::string> names = in.texts();
  const FlightView view = control.view();
  CdrOut out;
  out.count(names.size());
  for (const std::string& name : names) answer(out, name, find_parameter(view, name));
  return out.take();
}

Bytes get_parameters(const Control& control, CdrReader in) {
  return each_name(control, in, [](CdrOut& out, const std::string&, const ParameterView* p) {
    (p ? rcl_value(*p) : RclValue{}).write(out);
  });
}

Bytes get_parameter_types(const Control& control, CdrReader in) {
  return each_name(control, in, [](CdrOut& out, const std::string&, const ParameterView* p) {
    out.number(static_cast<std::uint8_t>(type_of(p)));
  });
}

Bytes describe_parameters(const Control& control, CdrReader in) {
  return each_name(control, in, write_descriptor);
}

// ---- write requests

/// Collects the result of each parameter of one call; the last answer sends the reply.
struct Results {
  Server::Reply reply;
  bool one = false;  // a single result for all, without a list
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

void set_one(Control& control, const FlightView& view, const RclParameter& parameter,
             const std::function<void(const std::string&)>& answer) {
  const auto& [name, value] = parameter;
  try {
    const ParameterView* p = find_parameter(view, name);
    if (p == nullptr)
      throw Error(dds_messages::parameter_unknown(name, choices_text(name, sorted_names(view))));
    control.set_parameter(name.substr(0, name.find('.')), p->info.name, parameter_text(p->info, value),
                          answer);
  } catch (const Error& fault) {
    answer(fault.what());
  }
}

void set_parameters(Control& control, CdrReader in, const Server::Reply& reply, bool at_once) {
  const std::vector<RclParameter> list = read_parameters(in);
  auto results = std::make_shared<Results>();
  results->reply = reply;
  results->one = at_once;
  results->refusals.resize(at_once ? 1 : list.size());
  results->open = results->refusals.size();
  if (list.empty()) return results->open == 0 ? results->send() : results->set(0, "");
  // Each change takes effect between two ticks; two changes may take effect in different ticks.
  const bool several = at_once && list.size() > 1;
  if (several) return results->set(0, dds_messages::several_parameters());
  if (list.size() > max_at_once) throw Error(dds_messages::too_many_parameters(max_at_once));
  const FlightView view = control.view();
  for (std::size_t i = 0; i < list.size(); ++i)
    set_one(control, view, list[i], [results, i](const std::string& refusal) { results->set(i, refusal); });
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
  auto look = [&control](Bytes (*answer)(const Control&, CdrReader)) {
    return [&control, answer](std::span<const std::byte> request, const Server::Reply& reply) {
      reply(answer(control, CdrReader(request)));
    };
  };
  add("list_parameters", "ListParameters", look(list_parameters));
  add("get_parameters", "GetParameters", look(get_parameters));
  add("get_parameter_types", "GetParameterTypes", look(get_parameter_types));
  add("describe_parameters", "DescribeParameters", look(describe_parameters));
  auto set = [&control](bool at_once) {
    return [&control, at_once](std::span<const std::byte> request, const Server::Reply& reply) {
      set_parameters(control, CdrReader(request), reply, at_once);
    };
  };
  add("set_parameters", "SetParameters", set(false));
  add("set_parameters_atomically", "SetParametersAtomically", set(true));
}

}  // namespace fulmar::core::dds
