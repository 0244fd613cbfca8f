// SPDX-License-Identifier: BSD-3-Clause
#include "core/replay/logged.hpp"

#include <algorithm>

#include "core/run/published.hpp"
#include "core/types/text.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

std::string log_topic(const std::string& port) { return "/" + slashed(port); }

}  // namespace

bool has_topic(const McapFile& file, const std::string& topic) {
  return std::any_of(file.channels.begin(), file.channels.end(), [&](const auto& c) { return c.second.topic == topic; });
}

std::uint16_t channel_of(const McapFile& file, const std::string& topic, const Type& type) {
  const std::uint16_t channel = file.channel(topic);
  const auto schema = file.schemas.find(file.channels.at(channel).schema);
  if (schema == file.schemas.end() || schema->second.text != ros_definition(type))
    throw Error("the log's " + topic + " has other fields than " + type.name + " has here: it was written by another version");
  return channel;
}

std::string topic_in(const McapFile& file, const Graph& graph, const Component& component, std::size_t output) {
  const Port& port = component.info().outputs[output];
  const std::string role = log_topic(topic_name(graph, component, output)), own = log_topic(component.name + "." + port.name);
  if (role == own || !has_topic(file, own) || !has_topic(file, role)) return role;
  const auto schema = file.schemas.find(file.channels.at(file.channel(role)).schema);
  return schema != file.schemas.end() && schema->second.text == ros_definition(*port.type) ? role : own;
}

std::string gap_in(const McapFile& file, std::uint16_t channel) {
  std::uint64_t expected = 0, lost = 0;
  for (const McapFile::Message& m : file.messages) {
    if (m.channel != channel) continue;
    lost += static_cast<std::uint32_t>(m.sequence - static_cast<std::uint32_t>(expected));
    expected = std::uint64_t{m.sequence} + 1;
  }
  if (lost == 0) return "";
  return "the log has lost " + std::to_string(lost) + " samples of " + file.channels.at(channel).topic;
}

}  // namespace fulmar::core
