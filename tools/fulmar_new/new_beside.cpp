// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_beside.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/types/named.hpp"
#include "tools/fulmar_new/messages.hpp"

namespace fulmar::core {
namespace {

constexpr double usual_rate_hz = 100;

struct Asked {
  std::string name, what;  // "state", "nav.state"
  bool queue = false, optional = false;
};

bool is_word(const std::string& text) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && !(text[0] >= '0' && text[0] <= '9') && std::all_of(text.begin(), text.end(), good);
}

Asked read_asked(const std::string& option, const std::string& text, const std::string& example) {
  const Error fault(new_messages::port_form_invalid(option, text, example));
  const std::size_t at = text.find('=');
  if (at == std::string::npos) throw fault;
  Asked asked{text.substr(0, at), text.substr(at + 1)};
  if ((asked.queue = asked.what.ends_with("[]"))) asked.what.resize(asked.what.size() - 2);
  if ((asked.optional = asked.name.ends_with('?'))) asked.name.pop_back();
  if (!is_word(asked.name) || (asked.queue && asked.optional)) throw fault;
  return asked;
}

PortName port_name(const std::string& text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return {};
  return {text.substr(0, dot), text.substr(dot + 1)};
}

/// Every port that can be the source of a wire and carries a message.
std::vector<std::string> sources(const Graph& graph) {
  std::vector<std::string> names;
  for (const Role& role : graph.roles)
    for (const RolePort& port : role.outputs) names.push_back(role.name + "." + port.name);
  for (const Component& component : graph.components)
    for (const Port& port : component.info().outputs)
      if (port.type) names.push_back(component.name + "." + port.name);
  return names;
}

/// The type as the mission's plugins define it; else a type by its name alone: the SDK's, or a new one.
TypePtr type_named(const Graph& graph, const std::string& name) {
  for (const Component& component : graph.components)
    for (const auto* ports : {&component.info().inputs, &component.info().outputs})
      for (const Port& port : *ports)
        if (port.type && port.type->name == name) return port.type;
  auto type = std::make_shared<Type>();
  type->name = name;
  type->fields = {{.name = "value_ratio", .kind = FULMAR_F64}, {.name = "valid", .kind = FULMAR_BOOL}};
  return type;
}

/// Type of a role's output that no component writes in this run, from the message that the mission names.
TypePtr promised_type(const MissionView& mission, const PortName& from) {
  const RoleText* role = mission.text.role(from.owner);
  const RoleOutText* port = role ? find_named(role->out, from.port) : nullptr;
  return port ? type_named(mission.graph, port->type) : nullptr;
}

ContractInput input_of(const MissionView& mission, const Asked& asked) {
  ContractInput input{asked.name, port_name(asked.what), nullptr, FULMAR_IN_VALUE, asked.optional};
  const Sent sent = sent_by(mission.graph, input.from);
  if (!sent.known || sent.kind == FULMAR_OUT_PROBE)
    throw Error(new_messages::output_unknown(asked.name, asked.what, mission.file.filename().string(),
                                             choices_text(asked.what, sources(mission.graph))));
  // without a type it is the output of a role: components have untyped outputs as probes alone
  input.type = sent.type ? sent.type : promised_type(mission, input.from);
  // A value input would see only the last item of a queue.
  if (asked.queue || sent.kind == FULMAR_OUT_QUEUE) input.kind = FULMAR_IN_QUEUE;
  return input;
}

ContractOutput output_of(const MissionView& mission, const Asked& asked) {
  if (!is_word(asked.what) || !(asked.what[0] >= 'A' && asked.what[0] <= 'Z') || asked.optional)
    throw Error(new_messages::output_form_invalid(asked.name, asked.what));
  ContractOutput output;
  output.name = asked.name;
  output.type = type_named(mission.graph, asked.what);
  output.type_name = asked.what;
  output.kind = asked.queue ? FULMAR_OUT_QUEUE : FULMAR_OUT_EVENT;
  output.capacity = asked.queue ? 16 : 1;
  return output;
}

template <class List>
void check_new(const List& list, const std::string& name) {
  if (find_named(list, name)) throw Error(new_messages::port_duplicate(name));
}

/// The rest of the template's line with this begin; "" for none.
std::string line_of(const std::string& source, const std::string& key) {
  const std::size_t at = source.find("// " + key + ": ");
  if (at == std::string::npos) return "";
  const std::size_t from = at + key.size() + 5;
  return source.substr(from, source.find('\n', from) - from);
}

/// "state vehicle.truth nav.state, progress manage.progress"
std::vector<std::vector<std::string>> lists_of(const std::string& line) {
  std::vector<std::vector<std::string>> lists;
  std::istringstream parts(line);
  for (std::string part; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    lists.emplace_back();
    for (std::string word; words >> word;) lists.back().push_back(word);
  }
  return lists;
}

bool open_input(const MissionView& mission, const PortName& port) {
  const ComponentText* text = mission.text.component(port.owner);
  if (!text || find_named(text->in, port.port)) return false;
  for (const Component& component : mission.graph.components)
    if (component.name == port.owner) return component.info().input(port.port) >= 0;
  return false;
}

}  // namespace

Contract ports_contract(const MissionView& mission, const std::vector<std::string>& in,
                        const std::vector<std::string>& out) {
  Contract contract;
  contract.mission = mission.graph.mission;
  contract.rate_hz = usual_rate_hz;
  for (const std::string& text : in) {
    const Asked asked = read_asked("--in", text, "OWNER.PORT, as in state=nav.state");
    check_new(contract.inputs, asked.name);
    contract.inputs.push_back(input_of(mission, asked));
  }
  for (const std::string& text : out) {
    const Asked asked = read_asked("--out", text, "Message, as in range=Range");
    check_new(contract.outputs, asked.name);
    contract.outputs.push_back(output_of(mission, asked));
  }
  return contract;
}

Contract template_contract(const MissionView& mission, const std::string& name, const std::string& source,
                           const std::vector<std::string>& in) {
  std::vector<std::string> wires = in, outputs;
  std::vector<std::string> inputs;
  for (const auto& words : lists_of(line_of(source, "wired"))) {
    inputs.push_back(words.at(0));
    if (std::any_of(in.begin(), in.end(),
                    [&](const std::string& wire) { return wire.starts_with(words[0] + "="); }))
      continue;
    const auto there = std::find_if(words.begin() + 1, words.end(), [&](const std::string& from) {
      return sent_by(mission.graph, port_name(from)).type != nullptr;
    });
    if (there == words.end())
      throw Error(new_messages::template_source_missing(name, words.at(1), mission.file.filename().string(),
                                                        words[0]));
    wires.push_back(words[0] + "=" + *there);
  }
  for (const auto& words : lists_of(line_of(source, "says")))
    outputs.push_back(words.at(0) + "=" + words.at(1));
  Contract contract = ports_contract(mission, wires, outputs);
  for (const ContractInput& input : contract.inputs)
    if (std::find(inputs.begin(), inputs.end(), input.name) == inputs.end())
      throw Error(new_messages::template_input_unknown(input.name, name, choices_text(input.name, inputs)));
  if (const std::string rate = line_of(source, "rate"); !rate.empty()) contract.rate_hz = std::stod(rate);
  for (const auto& words : lists_of(line_of(source, "feeds")))
    if (const PortName to = port_name(words.at(1)); open_input(mission, to))
      contract.feeds.push_back({words.at(0), to});
  return contract;
}

std::string without_template_lines(std::string source) {
  for (const char* key :
       {"// ports in: ", "// ports out: ", "// wired: ", "// says: ", "// rate: ", "// feeds: "})
    for (std::size_t at = 0; (at = source.find(key)) != std::string::npos;)
      source.erase(at, source.find('\n', at) + 1 - at);
  return source;
}

}  // namespace fulmar::core
