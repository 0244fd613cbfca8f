// SPDX-License-Identifier: BSD-3-Clause
// Binary messages of clients: samples for imported inputs, and calls of services.
#include "core/graph/record.hpp"
#include "core/graph/yaml.hpp"
#include "core/types/cdr_bytes.hpp"
#include "links/live/hub_impl.hpp"
#include "links/live/messages.hpp"

namespace fulmar::core::live {
namespace {

using nlohmann::json;

constexpr std::size_t data_head = 1 + 4, call_head = 1 + 4 + 4 + 4;
constexpr char op_answer = 3;

/// XCDR1 of {bool accepted, string reason, ...}, or of {string text}.
std::string cdr_answer(std::optional<bool> accepted, std::initializer_list<std::string_view> texts) {
  CdrOut out;
  if (accepted) out.flag(*accepted);
  for (const std::string_view text : texts) out.text(text);
  const std::vector<std::byte> bytes = out.take();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// XCDR1 of `count` strings.
std::vector<std::string> cdr_texts(std::string_view bytes, std::size_t count) try {
  CdrReader in(std::as_bytes(std::span(bytes)));
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.emplace_back(in.ended_text());
  return texts;
} catch (const Error& e) {
  throw Error(live_messages::request_invalid(e.what()));
}

std::vector<std::byte> from_cdr(const Type& type, std::string_view payload) {
  std::vector<std::byte> message(type.size);
  cdr_decode(type, reinterpret_cast<const std::byte*>(payload.data()), payload.size(), message.data());
  return message;
}

/// JSON is YAML: names, units and faults are those of a mission file. Omitted fields are zero. `name` is the
/// payload's name in faults.
std::vector<std::byte> from_json(const Type& type, const std::string& name, std::string_view payload) {
  std::vector<std::byte> message(type.size);
  Report report;
  const Node node = parse_yaml(make_source(std::string(payload), name), report);
  if (report.empty()) fill_record(type, node, message.data(), "", report);
  report.throw_if_any();
  return message;
}

void check(const Guard& guard, const std::vector<std::byte>& message) {
  if (!guard.check(message.data())) throw Error(guard.explain(message.data()));
}

/// The arguments of a service of the host.
std::vector<std::string> arguments(const Service& service, bool as_json, std::string_view payload) {
  if (!as_json)
    return service.arguments.empty() ? std::vector<std::string>()
                                     : cdr_texts(payload, service.arguments.size());
  const json object = payload.empty() ? json::object() : json::parse(payload, nullptr, false);
  std::vector<std::string> texts;
  for (const std::string& name : service.arguments) {
    const auto value = object.is_object() ? object.find(name) : object.end();
    if (value == object.end() || !value->is_string()) throw Error(live_messages::request_text_missing(name));
    texts.push_back(value->get<std::string>());
  }
  return texts;
}

/// Accepts only an object that is not nested too deep for the parser.
void check_json(std::string_view payload) {
  if (json_too_deep(payload)) throw Error(live_messages::request_too_deep());
  if (!payload.empty() && !json::parse(payload, nullptr, false).is_object())
    throw Error(live_messages::request_not_object());
}

}  // namespace

void Hub::client_data(Client& client, std::string_view message) {
  const std::uint32_t id = read_u32(message, 1);
  const auto at = client.imports.find(id);
  if (at == client.imports.end()) throw Error(live_messages::channel_not_advertised(id));
  const Import& import = at->second;
  const std::string_view payload = message.substr(data_head);
  try {
    if (import.as_json) check_json(payload);
    std::vector<std::byte> sample = import.as_json ? from_json(*import.type, import.type->name, payload)
                                                   : from_cdr(*import.type, payload);
    check(import.guard, sample);
    if (!control_.publish(import.component, import.port, std::move(sample))) ++counters_.lost;
  } catch (const Error& e) {
    throw Error(located(import.topic, e.diagnostic));
  }
}

void Hub::service_request(Client& client, std::string_view message) {
  const std::uint32_t service_id = read_u32(message, 1), call_id = read_u32(message, 5),
                      size = read_u32(message, 9);
  if (message.size() - call_head < size)
    throw Malformed("a service call ends within the name of its encoding");
  const std::string encoding(message.substr(call_head, size));
  const auto fail = [&](const std::string& why) {
    ++counters_.refused;
    send_json(
        client,
        {{"op", "serviceCallFailure"}, {"serviceId", service_id}, {"callId", call_id}, {"message", why}});
  };
  if (service_id == 0 || service_id > services_.size())
    return fail(live_messages::service_unknown(service_id));
  if (encoding != "cdr" && encoding != "json") return fail(live_messages::encoding_unknown(encoding));
  try {
    call(client, services_[service_id - 1], service_id, call_id, encoding == "json",
         message.substr(call_head + size));
  } catch (const Malformed& e) {
    fail(e.what());
  }
}

void Hub::call(Client& client, const Service& service, std::uint32_t service_id, std::uint32_t call_id,
               bool as_json, std::string_view payload) {
  const auto reply = [this, id = client.id, service_id, call_id, as_json](const std::string& body) {
    Client* caller = find(id);
    if (caller == nullptr) return;
    const std::string_view encoding = as_json ? "json" : "cdr";
    std::string bytes(1, op_answer);
    for (const std::uint32_t n : {service_id, call_id, static_cast<std::uint32_t>(encoding.size())})
      bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
    Message message;
    message.binary = true;
    message.body = std::make_shared<const std::string>(bytes.append(encoding) + body);
    caller->peer->send(std::move(message));
  };
  if (service.what == Service::What::view) {
    const std::string text = dumped(view_json(view(), begun_, tap_));
    return reply(as_json ? text : cdr_answer(std::nullopt, {text}));
  }
  const auto done = [this, reply, as_json, what = service.what, id = client.id](const std::string& refusal) {
    if (Client* caller = find(id)) --caller->unanswered;
    if (what == Service::What::save && !as_json) return reply(cdr_answer(refusal.empty(), {refusal, "", ""}));
    if (what == Service::What::record && !as_json) return reply(cdr_answer(refusal.empty(), {refusal, ""}));
    reply(as_json ? dumped({{"accepted", refusal.empty()}, {"reason", refusal}})
                  : cdr_answer(refusal.empty(), {refusal}));
  };
  const Control::Answer answer = [mailbox = mailbox_, done](const std::string& refusal) {
    mailbox->put([done, refusal] { done(refusal); });
  };
  ++client.unanswered;
  try {
    if (as_json) check_json(payload);
    if (service.what == Service::What::save)
      return call_save(client, arguments(service, as_json, payload), reply, as_json);
    if (service.what == Service::What::request) return call_request(service, as_json, payload, answer);
    if (service.what == Service::What::record)
      return call_record(client, arguments(service, as_json, payload), reply, as_json);
    call_host(service, arguments(service, as_json, payload), answer);
  } catch (const Error& e) {
    done(e.what());
  }
}

void Hub::call_request(const Service& service, bool as_json, std::string_view payload,
                       Control::Answer answer) {
  std::vector<std::byte> message;
  if (as_json) {  // the control checks its values
    const std::string name = service.component + "." + service.port;
    message = from_json(*service.type, name, payload.empty() ? "{}" : payload);
  } else {
    message = from_cdr(*service.type, payload);
    check(Guard(*service.type), message);
  }
  control_.request(service.component, service.port, std::move(message), std::move(answer));
}

void Hub::call_save(Client& client, const std::vector<std::string>& texts,
                    std::function<void(const std::string&)> reply, bool as_json) {
  saving_.begin(
      view(), texts[0], texts[1],
      [this, mailbox = mailbox_, id = client.id, reply = std::move(reply), as_json](const SaveAnswer& a) {
        const std::string text =
            as_json
                ? dumped(
                      {{"accepted", a.accepted}, {"reason", a.reason}, {"lines", a.lines}, {"mark", a.mark}})
                : cdr_answer(a.accepted, {a.reason, a.lines, a.mark});
        mailbox->put([this, id, reply, text] {
          if (Client* caller = find(id)) --caller->unanswered;
          reply(text);
        });
      });
}

void Hub::call_record(Client& client, const std::vector<std::string>& texts,
                      const std::function<void(const std::string&)>& reply, bool as_json) {
  const json record = record_json(view(), texts[0], texts[1]);
  --client.unanswered;
  reply(as_json ? dumped({{"accepted", true}, {"reason", ""}, {"record", record}})
                : cdr_answer(true, {"", dumped(record)}));
}

void Hub::call_host(const Service& service, const std::vector<std::string>& texts, Control::Answer answer) {
  switch (service.what) {
    case Service::What::set_parameter:
      return control_.set_parameter(texts[0], texts[1], texts[2], std::move(answer));
    case Service::What::phase: return control_.enter_phase(texts[0], std::move(answer));
    case Service::What::swap: return control_.swap(texts[0], texts[1], std::move(answer));
    case Service::What::reset_guards: return control_.reset_guards(std::move(answer));
    case Service::What::pause: return control_.pace({PaceOrder::What::pause}, std::move(answer));
    case Service::What::resume: return control_.pace({PaceOrder::What::resume}, std::move(answer));
    case Service::What::step: return control_.pace(step_order(texts[0]), std::move(answer));
    case Service::What::speed: return control_.pace(speed_order(texts[0]), std::move(answer));
    case Service::What::restart: return control_.pace(restart_order(texts[0]), std::move(answer));
    case Service::What::request:
    case Service::What::save:
    case Service::What::record:
    case Service::What::view: break;
  }
}

}  // namespace fulmar::core::live
