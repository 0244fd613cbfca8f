// SPDX-License-Identifier: BSD-3-Clause
// Request ports as services, parameter events, and the node. Source of the graph's topic: rmw_dds_common.
#include "links/dds/services.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "core/log/events.hpp"
#include "core/types/ros_service.hpp"
#include "core/types/wire.hpp"
#include "links/dds/messages.hpp"

namespace fulmar::core::dds {
namespace {

constexpr int max_unanswered = 64;  // of one service: further requests are rejected at once

Bytes response(const CdrEncoder& encoder, const std::string& refusal) {
  ServiceResponse r;
  r.accepted = refusal.empty();
  std::strncpy(r.reason, refusal.c_str(), sizeof r.reason - 1);
  if (refusal.size() >= sizeof r.reason) end_in_dots(r.reason, sizeof r.reason);
  Bytes bytes;
  encoder.encode(reinterpret_cast<const std::byte*>(&r), bytes);
  return bytes;
}

/// One request port.
struct Requests {
  Control& control;
  std::string component, port;
  TypePtr type;
  Guard guard;
  std::shared_ptr<const CdrEncoder> encoder;  // of the response
  std::shared_ptr<std::atomic<int>> unanswered = std::make_shared<std::atomic<int>>(0);

  void operator()(std::span<const std::byte> bytes, const Server::Reply& reply) const {
    std::vector<std::byte> message(type->size);
    cdr_decode(*type, bytes.data(), bytes.size(), message.data());
    auto answer = [reply, encoder = encoder](const std::string& refusal) {
      reply(response(*encoder, refusal));
    };
    if (!guard.check(message.data())) return answer(guard.explain(message.data()));
    if (unanswered->load() >= max_unanswered) return answer(dds_messages::too_many_requests(max_unanswered));
    ++*unanswered;
    try {
      control.request(component, port, std::move(message),
                      [answer, count = unanswered](const std::string& refusal) {
                        --*count;
                        answer(refusal);
                      });
    } catch (const Error& fault) {
      --*unanswered;
      answer(fault.what());
    }
  }
};

std::string node_space(const DdsOptions& options) {
  return dds_topic("", options.name_space, "").empty() ? "/" : dds_topic("", options.name_space, "");
}

}  // namespace

void add_request_services(Servers& servers, Participant& participant, const DdsOptions& options,
                          Control& control, const FlightView& view, const std::shared_ptr<Waker>& waker) {
  for (const ComponentView& component : view.components) {
    for (const PortView& port : component.inputs) {
      if (!port.request) continue;
      const TypePtr in = srv_request(*port.type), out = srv_response(*port.type);
      const Server::Names names{component.name + "/" + port.name, ros_name(*in), ros_name(*out)};
      Requests handle{control,   component.name,    port.name,
                      port.type, Guard(*port.type), std::make_shared<const CdrEncoder>(*out)};
      servers.push_back(
          std::make_unique<Server>(participant, options.name_space, names, waker, std::move(handle)));
    }
  }
}

// ---- events

ParameterEvents::ParameterEvents(Participant& participant, const DdsOptions& options, Control& control,
                                 const std::shared_ptr<Waker>& waker)
    : control_(control),
      node_(dds_topic("", options.name_space, node_name)),
      changed_(std::make_shared<Inbox<std::string>>([waker] { waker->wake(); })) {
  Endpoint e;
  e.topic = "rt/parameter_events";  // one topic for all nodes
  e.type = "rcl_interfaces::msg::dds_::ParameterEvent_";
  e.depth = 1000;  // as in rclcpp
  writer_ = participant.writer(e);
  control.on_parameter(
      [inbox = std::weak_ptr(changed_)](const std::string& component, const std::string& parameter) {
        if (const auto changed = inbox.lock()) changed->put(component + "." + parameter);
      });
}

void ParameterEvents::pump() {
  const std::vector<std::string> changed = changed_->take();
  if (changed.empty() || writer_->readers() == 0) return;
  const FlightView view = control_.view();
  std::vector<std::string> list;
  for (const std::string& name : parameter_names(view))
    if (std::find(changed.begin(), changed.end(), name) != changed.end()) list.push_back(name);
  constexpr std::int64_t second = 1'000'000'000;
  const std::int64_t now = std::max<std::int64_t>(0, view.epoch_ns + view.now_ns);
  CdrOut out;
  out.number(static_cast<std::int32_t>(now / second));
  out.number(static_cast<std::uint32_t>(now % second));
  out.text(node_);
  out.count(0);  // new
  out.count(list.size());
  for (const std::string& name : list) {
    out.text(name);
    rcl_value(*find_parameter(view, name)).write(out);
  }
  out.count(0);  // deleted
  writer_->write(out.take());
}

// ---- node

std::unique_ptr<Writer> node_info(Participant& participant, const DdsOptions& options,
                                  const std::vector<Guid>& readers, const std::vector<Guid>& writers) {
  Endpoint e;
  e.topic = "ros_discovery_info";
  e.type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
  e.depth = 1;
  e.transient_local = true;
  e.max_bytes = 256 + 24 * (readers.size() + writers.size());
  std::unique_ptr<Writer> writer = participant.writer(e);
  CdrOut out;
  const std::size_t padding = options.humble ? 8 : 0;  // a gid has 24 bytes in Humble, 16 since Iron
  auto gid = [&](const Guid& guid) {
    for (const std::uint8_t b : guid) out.number(b);
    for (std::size_t i = 0; i < padding; ++i) out.number(std::uint8_t{0});
  };
  gid(participant.guid());
  out.count(1);
  out.text(node_space(options));
  out.text(node_name);
  for (const auto* list : {&readers, &writers}) {
    out.count(list->size());
    for (const Guid& guid : *list) gid(guid);
  }
  writer->write(out.take());
  return writer;
}

}  // namespace fulmar::core::dds
