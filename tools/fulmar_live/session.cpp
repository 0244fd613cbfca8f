// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/session.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/types/text.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::uint8_t message_data = 1, service_request = 2, service_response = 3;  // opcodes

template <class T>
T read_le(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}
void append_u32(std::string& bytes, std::uint32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Removes control characters from texts of the flight, which are shown on a terminal.
json tamed(const std::string& text) {
  json value = json_too_deep(text) ? json(json::value_t::discarded) : json::parse(text, nullptr, false);
  const std::function<void(json&)> tame = [&](json& part) {
    if (part.is_string()) part = for_terminal(part.get<std::string>());
    if (part.is_object()) {
      json object = json::object();
      for (auto& [key, inner] : part.items()) tame(object[for_terminal(key)] = std::move(inner));
      part = std::move(object);
    }
    if (part.is_array())
      for (json& inner : part) tame(inner);
  };
  if (!value.is_discarded()) tame(value);
  return value;
}

std::string text_of(const json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : "";
}
std::uint32_t number_of(const json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number_unsigned() ? it->get<std::uint32_t>() : 0;
}
const json& list_of(const json& object, const char* key) {
  static const json none = json::array();
  const auto it = object.find(key);
  return it != object.end() && it->is_array() ? *it : none;
}

}  // namespace

Session::Session(const LiveAddress& target, Milliseconds patience)
    : client_(target, patience), at_(target.text()), patience_(patience) {}
Session::~Session() = default;

// ---- properties of the flight

void Session::handle_text(const std::string& text) {
  const json message = tamed(text);
  if (!message.is_object()) return;
  const std::string op = text_of(message, "op");
  if (op == "serverInfo") {
    id_ = text_of(message, "sessionId");
  } else if (op == "advertise") {
    for (const json& c : list_of(message, "channels"))
      channels_[text_of(c, "topic")] = {number_of(c, "id"), text_of(c, "topic"), text_of(c, "schemaName"),
                                        text_of(c, "schema"), text_of(c, "encoding")};
    advertised_ = true;
  } else if (op == "advertiseServices") {
    for (const json& s : list_of(message, "services")) services_[text_of(s, "name")] = number_of(s, "id");
    services_known_ = true;
  } else if (op == "serviceCallFailure" && number_of(message, "callId") == calls_) {
    failure_ = text_of(message, "message");
    answer_ = std::make_unique<json>();
  }
}

void Session::handle_binary(const std::string& bytes) {
  constexpr std::size_t data_header = 1 + 4 + 8, answer_header = 1 + 4 + 4 + 4;
  if (bytes.empty()) return;
  const auto op = static_cast<std::uint8_t>(bytes[0]);
  if (op == message_data && bytes.size() >= data_header) {
    const auto subscription = subscriptions_.find(read_le<std::uint32_t>(bytes, 1));
    if (subscription == subscriptions_.end()) return;
    const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
    samples_.push_back({subscription->second,
                        static_cast<std::int64_t>(read_le<std::uint64_t>(bytes, 5)),
                        {first + data_header, first + bytes.size()}});
  } else if (op == service_response && bytes.size() >= answer_header &&
             read_le<std::uint32_t>(bytes, 5) == calls_) {
    const std::size_t encoding = read_le<std::uint32_t>(bytes, 9);
    if (encoding > bytes.size() - answer_header) return;
    answer_ = std::make_unique<json>(tamed(bytes.substr(answer_header + encoding)));
    if (answer_->is_discarded()) {
      *answer_ = json(nullptr);
      failure_ = "the answer is no JSON";
    }
  }
}

bool Session::pump(Milliseconds limit) {
  const std::optional<Client::Message> message = client_.receive(limit);
  if (!message) return false;
  heard_ = Clock::now();
  message->binary ? handle_binary(message->data) : handle_text(message->data);
  return true;
}

template <class Ready>
void Session::pump_until(const Ready& ready, const char* what) {
  const auto end = Clock::now() + patience_;
  while (!ready()) {
    const auto left = std::chrono::duration_cast<Milliseconds>(end - Clock::now());
    if (left.count() <= 0) throw NoAnswer("the flight on " + at_ + " does not answer: no " + what + " came");
    pump(left);
  }
}

// ---- channels and samples

const std::map<std::string, Session::Channel>& Session::channels() {
  pump_until([this] { return advertised_; }, "list of topics");
  return channels_;
}

TypePtr Session::type(const std::string& topic) {
  const auto known = types_.find(topic);
  if (known != types_.end()) return known->second;
  const Channel& channel = channels().at(topic);
  if (channel.encoding != "cdr") throw Error(remote_messages::encoding_unsupported(topic, channel.encoding));
  return types_[topic] = parse_ros_definition(channel.schema_name, channel.schema);
}

void Session::subscribe(const std::string& topic) {
  const std::uint32_t channel = channels().at(topic).id;
  for (const auto& [id, name] : subscriptions_)
    if (name == topic) return;
  const auto id = static_cast<std::uint32_t>(subscriptions_.size() + 1);
  subscriptions_[id] = topic;
  client_.send(json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}.dump());
}

std::optional<Session::Sample> Session::next(Milliseconds limit) {
  const auto end = Clock::now() + limit;
  while (taken_ == samples_.size()) {
    samples_.clear();
    taken_ = 0;
    const auto left = std::chrono::duration_cast<Milliseconds>(end - Clock::now());
    if (!pump(std::max(left, Milliseconds(0))) && left.count() <= 0) return std::nullopt;
  }
  return std::move(samples_[taken_++]);
}

// ---- services

std::uint32_t Session::service_id(const std::string& name) {
  pump_until([this] { return services_known_; }, "list of services");
  const auto found = services_.find(name);
  if (found != services_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [service, id] : services_) names.push_back(service);
  throw Error(remote_messages::service_unknown(at_, name, choices_text(name, names)));
}

json Session::call(const std::string& service, const json& request) {
  const std::uint32_t id = service_id(service);
  static const std::string encoding = "json";
  std::string bytes(1, static_cast<char>(service_request));
  append_u32(bytes, id);
  append_u32(bytes, ++calls_);
  append_u32(bytes, static_cast<std::uint32_t>(encoding.size()));
  bytes += encoding + request.dump();
  answer_.reset();
  failure_.clear();
  client_.send_binary(bytes);
  pump_until([this] { return answer_ != nullptr; }, "answer");
  if (!failure_.empty()) throw Error(failure_);
  return *std::move(answer_);
}

Session::Verdict Session::order(const std::string& service, const json& request) {
  const json answer = call(service, request);
  const auto accepted = answer.is_object() ? answer.find("accepted") : answer.end();
  if (!answer.is_object() || accepted == answer.end() || !accepted->is_boolean())
    throw Error(remote_messages::verdict_missing(at_));
  return {accepted->get<bool>(), text_of(answer, "reason")};
}

json Session::view() {
  json answer = call("/fulmar/view", json::object());
  if (!answer.is_object()) throw Error(remote_messages::view_missing(at_));
  return answer;
}

const std::string& Session::id() {
  pump_until([this] { return !id_.empty(); }, "greeting");
  return id_;
}

std::int64_t Session::epoch_ns() { return view().value("epoch_ns", std::int64_t{0}); }

}  // namespace fulmar::core
