// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/logged.hpp"

#include <algorithm>

#include "core/run/state/published.hpp"
#include "core/types/text.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_replay/messages.hpp"

namespace fulmar::core {

bool has_topic(const McapFile& file, const std::string& topic) {
  return std::any_of(file.channels.begin(), file.channels.end(),
                     [&](const auto& c) { return c.second.topic == topic; });
}

std::uint16_t channel_of(const McapFile& file, const std::string& topic, const Type& type) {
  const std::uint16_t channel = file.channel(topic);
  const auto schema = file.schemas.find(file.channels.at(channel).schema);
  if (schema == file.schemas.end() || schema->second.text != ros_definition(type))
    throw Error(replay_messages::topic_type_mismatch(topic, type.name));
  return channel;
}

std::string topic_in(const McapFile& file, const Graph& graph, const Component& component,
                     std::size_t output) {
  const Port& port = component.info().outputs[output];
  const std::string role = "/" + slashed(topic_name(graph, component, output)),
                    own = "/" + slashed(component.name + "." + port.name);
  if (role == own || !has_topic(file, own) || !has_topic(file, role)) return role;
  const auto schema = file.schemas.find(file.channels.at(file.channel(role)).schema);
  return schema != file.schemas.end() && schema->second.text == ros_definition(*port.type) ? role : own;
}

std::string gap_in(const Survey& survey, std::uint16_t channel) {
  const auto lost = survey.lost.find(channel);
  if (lost == survey.lost.end()) return "";
  return replay_messages::samples_lost(lost->second, survey.log.channels.at(channel).topic).line();
}

void check_order(const Survey& survey, std::uint16_t channel) {
  if (survey.late.contains(channel))
    throw Error(replay_messages::topic_not_in_order(survey.log.channels.at(channel).topic));
}

}  // namespace fulmar::core
