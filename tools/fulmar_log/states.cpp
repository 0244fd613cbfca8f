// SPDX-License-Identifier: BSD-3-Clause
// See states.hpp.
#include "tools/fulmar_log/states.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/log_reading/log_file.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::states {
namespace {

using core::Error;
using core::Field;
using core::McapFile;
using core::Type;
using core::TypePtr;

constexpr std::uint32_t largest_message = 1u << 20;  // limit, as a damaged log may state any size

/// A state that a vehicle publishes is the truth: only a simulated vehicle has one.
bool is_truth(const std::string& topic) {
  return topic.starts_with("/vehicle/") || topic.ends_with("/truth");
}

/// "fulmar_msgs/msg/VehicleState" -> "VehicleState"; the whole name for messages of other packages.
std::string type_word(const McapFile& log, const McapFile::Channel& channel) {
  const auto schema = log.schemas.find(channel.schema);
  if (schema == log.schemas.end()) return log_tool_messages::message_type_missing().line();
  constexpr std::string_view ours = "fulmar_msgs/msg/";
  const std::string& name = schema->second.name;
  return name.starts_with(ours) ? name.substr(ours.size()) : name;
}

/// Type for a reader that accepts any subset of the fields.
TypePtr all_optional(const Type& type) {
  Type copy = type;
  copy.hash = 0;
  for (Field& field : copy.fields) field.appended = true;
  return std::make_shared<const Type>(std::move(copy));
}

}  // namespace

const StateLog::Topic* StateLog::find(const std::string& topic) const {
  const Topic* const found = core::find_named(estimates, topic);
  return found ? found : core::find_named(truths, topic);
}

std::vector<std::string> StateLog::states() const {
  std::vector<std::string> names = core::names_of(estimates);
  for (const Topic& topic : truths) names.push_back(topic.name);
  return names;
}

StateLog look_for_states(const std::filesystem::path& log) {
  core::McapStream stream(log);
  std::map<std::string, StateLog::Topic> topics;
  std::map<std::uint16_t, StateLog::Topic*> by_channel;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();
  while (const McapFile::Message* m = stream.next()) {
    StateLog::Topic*& topic = by_channel[m->channel];
    if (!topic) topic = &topics[stream.log().channels.at(m->channel).topic];
    if (topic->messages++ == 0) topic->first_ns = m->log_ns;
    topic->last_ns = std::max(topic->last_ns, m->log_ns);
    first_ns = std::min(first_ns, m->log_ns);
  }
  StateLog out;
  out.file = log;
  out.epoch_ns = core::log_epoch_ns(stream.log(), first_ns);
  out.fault = stream.log().fault;
  for (const auto& [id, channel] : stream.log().channels) {
    const auto found = topics.find(channel.topic);
    if (found == topics.end()) continue;
    found->second.name = channel.topic;
    out.types[channel.topic] = type_word(stream.log(), channel);
  }
  for (const auto& [name, topic] : topics) {
    const std::string& type = out.types[name];
    if (type == "VehicleState") (is_truth(name) ? out.truths : out.estimates).push_back(topic);
    if (type == "Gnss") out.fixes.push_back(topic);
    if (type == "FilterCheck") out.checks.push_back(topic);
  }
  return out;
}

NamedFields::NamedFields(const McapFile& log, std::uint16_t channel, const TypePtr& ours) {
  const McapFile::Channel& c = log.channels.at(channel);
  topic_ = c.topic;
  try {
    const auto schema = log.schemas.find(c.schema);
    if (c.encoding != "cdr" || schema == log.schemas.end() || schema->second.encoding != "ros2msg")
      throw Error(log_tool_messages::message_encoding_unsupported());
    theirs_ = core::parse_ros_definition(schema->second.name, schema->second.text);
    if (theirs_->size > largest_message) throw Error(log_tool_messages::messages_too_large(largest_message));
    plan_ = core::copy_plan(*theirs_, *all_optional(*ours));
  } catch (const Error& fault) {
    throw Error(located(topic_, fault.diagnostic));
  }
  plan_.gaps.clear();  // fields that the log lacks keep the caller's values
  room_.resize(theirs_->size);
}

void NamedFields::read(std::span<const std::byte> bytes, std::byte* message) const try {
  core::cdr_decode(*theirs_, bytes.data(), bytes.size(), room_.data());
  plan_.run(room_.data(), message);
} catch (const Error& fault) {
  throw Error(located(topic_, fault.diagnostic));
}

}  // namespace fulmar::states
