// SPDX-License-Identifier: BSD-3-Clause
// JSON messages of clients: subscriptions, parameters, client channels, the connection graph.
#include <algorithm>

#include "core/graph/yaml.hpp"
#include "links/live/hub_impl.hpp"
#include "links/live/messages.hpp"

namespace fulmar::core::live {
namespace {

using nlohmann::json;

constexpr std::size_t max_imports = 64;   // of one client
constexpr std::size_t max_sets = 10'000;  // of one message: its answer delays other clients

std::uint32_t id_of(const json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffu)
    throw Malformed("an id has to be a whole number of 32 bits");
  return value.get<std::uint32_t>();
}

const json& array_at(const json& message, const char* key) {
  const json& value = message.at(key);
  if (!value.is_array()) throw Malformed(std::string("'") + key + "' has to be a list");
  return value;
}

std::vector<std::string> names_at(const json& message) {
  return array_at(message, "parameterNames").get<std::vector<std::string>>();
}

std::optional<std::string> request_id(const json& message) {
  const auto id = message.find("id");
  if (id == message.end() || id->is_null()) return std::nullopt;
  return id->get<std::string>();
}

/// For a parameter without its component: the names that end with it, else all.
std::string names_with_component(const std::string& parameter, const std::vector<std::string>& known) {
  std::vector<std::string> same;
  for (const std::string& name : known)
    if (name.ends_with("." + parameter)) same.push_back(name);
  return choices_text(parameter, same.empty() ? known : same);
}

}  // namespace

const std::map<std::string, Hub::Op, std::less<>>& Hub::ops() {
  static const std::map<std::string, Op, std::less<>> map = {
      {"subscribe", &Hub::subscribe},
      {"unsubscribe", &Hub::unsubscribe},
      {"advertise", &Hub::client_advertise},
      {"unadvertise", &Hub::client_unadvertise},
      {"getParameters", &Hub::get_parameters},
      {"setParameters", &Hub::set_parameters},
      {"subscribeParameterUpdates", &Hub::subscribe_parameters},
      {"unsubscribeParameterUpdates", &Hub::unsubscribe_parameters},
      {"subscribeConnectionGraph", &Hub::subscribe_graph},
      {"unsubscribeConnectionGraph", &Hub::unsubscribe_graph}};
  return map;
}

void Hub::subscribe(Client& client, const json& message) {
  const bool paused = view().pace.paused;
  for (const json& entry : array_at(message, "subscriptions")) {
    const std::uint32_t id = id_of(entry.at("id")), channel_id = id_of(entry.at("channelId"));
    if (channel_id == 0 || channel_id > channels_.size()) {
      refuse(client, live_messages::channel_unknown(channel_id));
      continue;
    }
    const std::size_t index = channel_id - 1;
    Channel& channel = channels_[index];
    const bool has = std::any_of(channel.subscribers.begin(), channel.subscribers.end(),
                                 [&](const auto& l) { return l.first == &client; });
    if (has || client.subscriptions.contains(id)) {
      refuse(client, has ? live_messages::channel_already_subscribed(channel_id)
                         : live_messages::subscription_in_use(id));
      continue;
    }
    feed_.cursor->want(index, 0);
    catch_up();  // the ring may hold one sample of many; the client's stream must have no gap
    client.subscriptions[id] = index;
    channel.subscribers.emplace_back(&client, id);
    give_past(client, index, id, paused);
  }
}

void Hub::unsubscribe(Client& client, const json& message) {
  for (const json& entry : array_at(message, "subscriptionIds")) {
    const std::uint32_t id = id_of(entry);
    if (client.subscriptions.contains(id)) {
      stop_listening(client, id);
    } else {
      refuse(client, live_messages::subscription_unknown(id));
    }
  }
}

void Hub::client_advertise(Client& client, const json& message) {
  for (const json& channel : array_at(message, "channels")) {
    if (reported_enough(client)) return refuse(client, "");
    import_channel(client, channel);
  }
}

void Hub::import_channel(Client& client, const json& channel) {
  const std::uint32_t id = id_of(channel.at("id"));
  const auto topic = channel.at("topic").get<std::string>(),
             encoding = channel.at("encoding").get<std::string>();
  const std::string schema = channel.value("schemaName", "");
  if (encoding != "cdr" && encoding != "json")
    return refuse(client, located(topic, live_messages::encoding_unknown(encoding)));
  if (client.imports.contains(id)) return refuse(client, live_messages::channel_already_advertised(id));
  if (client.imports.size() >= max_imports)
    return refuse(client, live_messages::too_many_channels(max_imports));
  std::vector<std::string> topics;
  for (const ComponentView& c : view().components) {
    for (const PortView& p : c.inputs) {
      if (!p.imported || !p.type) continue;
      topics.push_back("/" + c.name + "/" + p.name);
      if (topics.back() != topic) continue;
      if (!schema.empty() && schema != ros_name(*p.type))
        return refuse(client, live_messages::topic_type_differs(topic, ros_name(*p.type), schema));
      client.imports.emplace(id, Import{c.name, p.name, topic, p.type, encoding == "json", Guard(*p.type)});
      return;
    }
  }
  refuse(client,
         [&] { return live_messages::topic_not_imported(topic, choices_text(topic, topics)).line(); });
}

void Hub::client_unadvertise(Client& client, const json& message) {
  for (const json& entry : array_at(message, "channelIds")) {
    const std::uint32_t id = id_of(entry);
    if (client.imports.erase(id) == 0) refuse(client, live_messages::channel_not_advertised(id));
  }
}

void Hub::refuse_parameter(Client& client, const std::string& name, const std::vector<std::string>& known) {
  refuse(client,
         [&] { return live_messages::parameter_path_unknown(name, choices_text(name, known)).line(); });
}

void Hub::get_parameters(Client& client, const json& message) {
  const std::optional<std::string> id = request_id(message);
  std::vector<std::string> names = names_at(message);
  const FlightView now = view();
  const std::vector<std::string> known = parameter_names(now);
  if (names.empty()) names = known;
  std::set<std::string> done;  // a repeated name is answered once
  json values = json::array();
  for (const std::string& name : names) {
    if (!done.insert(name).second) continue;
    if (const ParameterView* p = find_parameter(now, name))
      values.push_back(parameter_json(name, *p));
    else
      refuse_parameter(client, name, known);
  }
  json reply = {{"op", "parameterValues"}, {"parameters", values}};
  if (id) reply["id"] = *id;
  send_json(client, reply);
}

void Hub::set_parameters(Client& client, const json& message) {
  const json& list = array_at(message, "parameters");
  if (list.size() > max_sets) return refuse(client, live_messages::too_many_parameters(max_sets));
  auto pending = std::make_shared<Pending>();
  pending->client = client.id;
  pending->id = request_id(message);
  std::set<std::string> names;
  for (const json& parameter : list) {
    const auto name = parameter.at("name").get<std::string>();  // a missing name throws before any is set
    if (names.insert(name).second) pending->names.push_back(name);
  }
  // one more for this function, so that no answer is the last before all requests are made
  pending->open = list.size() + 1;
  client.unanswered += list.size();
  for (const json& parameter : list) set_one(client, pending, parameter);
  if (--pending->open == 0) parameters_.replies.push_back(pending);
}

void Hub::set_one(Client& asker, const std::shared_ptr<Pending>& pending, const json& parameter) {
  const auto name = parameter.at("name").get<std::string>();
  const auto done = [this, pending, name](const std::string& refusal) {
    Client* client = find(pending->client);
    if (client != nullptr) {
      --client->unanswered;
      if (!refusal.empty()) status(*client, 2, name + ": " + refusal);
    }
    if (--pending->open == 0) parameters_.replies.push_back(pending);
  };
  try {
    if (reported_enough(asker)) throw Error("");
    const auto value = parameter.find("value");
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos)
      throw Error(live_messages::parameter_name_invalid(names_with_component(name, parameter_names(view()))));
    if (value == parameter.end() || value->is_null()) throw Error(live_messages::parameter_not_removable());
    const std::string text = mission_text(*value, parameters_.texts.contains(name));
    control_.set_parameter(name.substr(0, dot), name.substr(dot + 1), text,
                           [mailbox = mailbox_, done](const std::string& refusal) {
                             mailbox->put([done, refusal] { done(refusal); });
                           });
  } catch (const Error& e) {
    complain(asker, [&] { return name + ": " + e.what(); });
    done("");
  }
}

void Hub::subscribe_parameters(Client& client, const json& message) {
  const std::vector<std::string> names = names_at(message), known = parameter_names(view());
  if (names.empty()) {
    client.watched.insert(known.begin(), known.end());
    return;
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse_parameter(client, name, known);
    else
      client.watched.insert(name);
  }
}

void Hub::unsubscribe_parameters(Client& client, const json& message) {
  const std::vector<std::string> names = names_at(message);
  if (names.empty()) client.watched.clear();
  for (const std::string& name : names) client.watched.erase(name);
}

void Hub::subscribe_graph(Client& client, const json&) {
  client.graph = true;
  send_json(client, connection_graph(view(), tap_, services_));
}

void Hub::unsubscribe_graph(Client& client, const json&) {
  if (!client.graph) refuse(client, live_messages::graph_not_subscribed());
  client.graph = false;
}

}  // namespace fulmar::core::live
