// SPDX-License-Identifier: BSD-3-Clause
// See topics.hpp.
#include "tools/fulmar_report/topics.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_report/messages.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::report {
namespace {

using core::McapFile;

constexpr double slow_hz = 2;
constexpr std::uint32_t largest_message = 1u << 20;  // a damaged log may contain any size

enum class Form { columns, slow, whole };
struct Wanted {
  const char* type;
  Form form;
  std::vector<std::string> fields;
};

/// The fields that web/src uses.
const std::vector<Wanted>& all_wanted() {
  static const std::vector<Wanted> list{
      {"fulmar_msgs/msg/VehicleState",
       Form::columns,
       {"position_m.north",
        "position_m.east",
        "height_m",
        "roll_rad",
        "pitch_rad",
        "yaw_rad",
        "course_rad",
        "ground_speed_mps",
        "airspeed_mps",
        "climb_rate_mps",
        "wind_mps.north",
        "wind_mps.east",
        "position_std_m.north",
        "position_std_m.east",
        "attitude_valid",
        "velocity_valid",
        "position_valid",
        "height_valid",
        "airspeed_valid",
        "wind_valid"}},
      {"fulmar_msgs/msg/GuidanceCommand", Form::columns, {"course_rad", "height_m", "airspeed_mps"}},
      {"fulmar_msgs/msg/AttitudeCommand", Form::columns, {"roll_rad", "pitch_rad", "throttle_frac"}},
      {"fulmar_msgs/msg/Actuators",
       Form::columns,
       {"throttle_frac", "aileron_rad", "elevator_rad", "rudder_rad"}},
      {"fulmar_msgs/msg/Plan", Form::whole, {}},
      {"fulmar_msgs/msg/Path", Form::slow, {}},
      {"fulmar_msgs/msg/Progress", Form::slow, {}},
      {"fulmar_msgs/msg/VehicleStatus", Form::slow, {}},
      {"fulmar_msgs/msg/NavigationHealth", Form::slow, {}},
      {"fulmar_msgs/msg/SafetyState", Form::slow, {}},
      {"fulmar_msgs/msg/GroundState", Form::slow, {}},
      {"fulmar_msgs/msg/ContactTruth", Form::slow, {}},
      {"fulmar_msgs/msg/Gnss", Form::slow, {}},
      {"fulmar_msgs/msg/Rc", Form::slow, {}}};
  return list;
}

/// State of one topic while the log is read.
struct Reading {
  ShownTopic shown;
  double gap_ns = 0;
  std::uint64_t kept_ns = 0;
  core::TypePtr type;
  std::vector<core::FieldRef> places;
  std::optional<core::FieldRef> lateral;  // GuidanceCommand: 0 is a course
  std::vector<std::byte> message;

  /// Fields that are missing in the log's definition, as in older logs, are left out.
  void find_fields(const std::vector<std::string>& fields) {
    type = core::parse_ros_definition(shown.type, shown.schema);
    if (type->size > largest_message) throw core::Error(report_messages::messages_too_large(shown.type));
    message.resize(type->size);
    const auto place = [&](const std::string& field) -> std::optional<core::FieldRef> {
      try {
        return core::resolve_field(*type, field);
      } catch (const core::Error&) {
        return std::nullopt;
      }
    };
    for (const std::string& field : fields) {
      const std::optional<core::FieldRef> at = place(field);
      if (!at || at->field->kind == FULMAR_TEXT || at->field->kind == FULMAR_STRUCT) continue;
      shown.fields.push_back(field);
      places.push_back(*at);
    }
    if (shown.type.ends_with("/GuidanceCommand")) lateral = place("lateral");
    shown.columns.values.resize(places.size());
  }

  void take(const McapFile::Message& m, std::uint64_t epoch_ns) {
    ++shown.count;
    const bool first = shown.columns.t.empty();
    if (!first && static_cast<double>(m.log_ns) < static_cast<double>(kept_ns) + gap_ns) return;
    if (!places.empty()) {
      core::cdr_decode(*type, m.data.data(), m.data.size(), message.data());
      for (std::size_t i = 0; i < places.size(); ++i)
        shown.columns.values[i].push_back(static_cast<float>(value(i)));
    } else {
      shown.messages.emplace_back(reinterpret_cast<const char*>(m.data.data()), m.data.size());
    }
    kept_ns = m.log_ns;
    shown.columns.t.push_back(tenths_of_ms(static_cast<std::int64_t>(m.log_ns - epoch_ns)));
  }
  double value(std::size_t i) const {
    const bool no_course = shown.fields[i] == "course_rad" && lateral &&
                           core::number_at(*lateral->field, message.data() + lateral->offset) != 0;
    if (no_course) return std::numeric_limits<double>::quiet_NaN();
    return core::number_at(*places[i].field, message.data() + places[i].offset);
  }
};

/// nullptr: topic not used.
std::unique_ptr<Reading> begin(const McapFile& log, std::uint16_t channel, double rate_hz) {
  const McapFile::Channel& c = log.channels.at(channel);
  const auto schema = log.schemas.find(c.schema);
  if (c.encoding != "cdr" || schema == log.schemas.end() || schema->second.encoding != "ros2msg")
    return nullptr;
  const std::string& type = schema->second.name;
  const auto& list = all_wanted();
  const auto found = std::find_if(list.begin(), list.end(), [&](const Wanted& w) { return type == w.type; });
  const bool event = c.topic == core::Event::topic;
  if (found == list.end() && !event) return nullptr;
  auto reading = std::make_unique<Reading>();
  reading->shown.topic = c.topic;
  reading->shown.type = type;
  reading->shown.schema = schema->second.text;
  reading->shown.whole = event || found->form == Form::whole;
  if (reading->shown.whole) return reading;
  const bool slow = found->form == Form::slow;
  reading->gap_ns = 0.99e9 / (slow ? std::min(slow_hz, rate_hz) : rate_hz);
  if (slow) return reading;
  reading->find_fields(found->fields);
  if (reading->places.empty()) return nullptr;
  return reading;
}

}  // namespace

std::vector<ShownTopic> shown_topics(const std::filesystem::path& log, std::uint64_t epoch_ns, double rate_hz,
                                     const std::vector<std::string>& without) {
  core::McapStream stream(log);
  std::map<std::uint16_t, std::unique_ptr<Reading>> by_channel;
  while (const McapFile::Message* m = stream.next()) {
    auto at = by_channel.find(m->channel);
    try {
      if (at == by_channel.end()) {
        at = by_channel.emplace(m->channel, nullptr).first;
        const std::string& topic = stream.log().channels.at(m->channel).topic;
        if (std::find(without.begin(), without.end(), topic) == without.end())
          at->second = begin(stream.log(), m->channel, rate_hz);
      }
      if (at->second) at->second->take(*m, epoch_ns);
    } catch (const core::Error&) {
      at->second = nullptr;  // damaged or of another definition
    }
  }
  std::vector<ShownTopic> all;
  for (auto& [channel, reading] : by_channel)
    if (reading) all.push_back(std::move(reading->shown));
  return all;
}

nlohmann::json topic_json(const ShownTopic& topic, std::size_t every_nth) {
  const std::size_t n = topic.whole ? 1 : every_nth;
  const Columns kept = n > 1 ? every(topic.columns, n) : topic.columns;
  nlohmann::json out{{"topic", topic.topic}, {"type", topic.type},    {"schema", topic.schema},
                     {"count", topic.count}, {"rows", kept.t.size()}, {"fields", topic.fields}};
  if (!topic.fields.empty()) {
    out["data"] = packed(kept);
    return out;
  }
  std::vector<std::string> messages;
  for (std::size_t i = 0; i < topic.messages.size(); i += n) messages.push_back(topic.messages[i]);
  out["data"] = packed(messages);
  out["t"] = packed(kept);
  return out;
}

}  // namespace fulmar::report
