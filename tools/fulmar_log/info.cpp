// SPDX-License-Identifier: BSD-3-Clause
// See info.hpp.
#include "tools/fulmar_log/info.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "core/log/mcap_bytes.hpp"
#include "core/types/wire.hpp"
#include "tools/log_reading/cdr_values.hpp"
#include "tools/log_reading/log_file.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t sample_bytes = 128u << 10;  // of a topic, compressed together
constexpr std::size_t index_bytes = 16;           // of a message in its chunk's index
constexpr std::size_t max_events = 100'000;
constexpr std::array severities{"info", "warning", "error", "critical"};

/// Measures how well the messages of one topic compress.
struct Weight {
  LogInfo::Topic topic;
  std::vector<std::byte> open;
  std::uint64_t compressed = 0;

  void add(const McapFile::Message& m) {
    constexpr std::size_t head = mcap::record_head + mcap::message_head;
    const std::size_t before = open.size();
    open.resize(before + head + m.data.size());
    std::byte* at = open.data() + before + mcap::record_head;
    std::memcpy(at, &m.channel, 2);
    std::memcpy(at + 2, &m.sequence, 4);
    std::memcpy(at + 6, &m.log_ns, 8);
    std::memcpy(at + 14, &m.publish_ns, 8);
    if (!m.data.empty()) std::memcpy(open.data() + before + head, m.data.data(), m.data.size());
    topic.bytes += head + m.data.size();
    ++topic.messages;
    if (open.size() >= sample_bytes) press();
  }
  void press() {
    std::vector<std::byte> room(ZSTD_compressBound(open.size()));
    const std::size_t n = ZSTD_compress(room.data(), room.size(), open.data(), open.size(), -1);
    compressed += ZSTD_isError(n) ? open.size() : n;
    open.clear();
  }
};

struct Reading {
  McapStream stream;
  LogInfo info;
  std::map<std::string, Weight> weights;
  std::map<std::uint16_t, Weight*> channels;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max(), last_ns = 0;
  std::vector<std::pair<std::uint64_t, std::vector<std::byte>>> events;
  std::uint16_t event_channel = 0;

  explicit Reading(const std::filesystem::path& file) : stream(file) {
    info.bytes = std::filesystem::file_size(file);
  }

  Weight& weight(std::uint16_t channel) {
    const auto known = channels.find(channel);
    if (known != channels.end()) return *known->second;
    const McapFile::Channel& c = stream.log().channels.at(channel);
    Weight& made = weights[c.topic];
    const auto schema = stream.log().schemas.find(c.schema);
    made.topic.topic = c.topic;
    if (schema != stream.log().schemas.end()) made.topic.type = schema->second.name;
    channels[channel] = &made;
    return made;
  }

  void run() {
    while (const McapFile::Message* m = stream.next()) {
      Weight& w = weight(m->channel);
      const auto now = static_cast<std::int64_t>(m->log_ns);
      if (w.topic.messages == 0) w.topic.first_ns = w.topic.last_ns = now;
      w.topic.first_ns = std::min(w.topic.first_ns, now);
      w.topic.last_ns = std::max(w.topic.last_ns, now);
      w.add(*m);
      first_ns = std::min(first_ns, m->log_ns);
      last_ns = std::max(last_ns, m->log_ns);
      ++info.messages;
      if (w.topic.topic == core::Event::topic) {
        if (events.size() == max_events) events.pop_back();  // the last one has the verdict
        events.emplace_back(m->log_ns, std::vector<std::byte>(m->data.begin(), m->data.end()));
        event_channel = m->channel;
      }
    }
    finish();
  }

  void finish() {
    const McapFile& log = stream.log();
    const std::uint64_t epoch = log_epoch_ns(log, first_ns);
    if (info.messages > 0) {
      info.begin_ns = static_cast<std::int64_t>(first_ns - epoch);
      info.end_ns = static_cast<std::int64_t>(last_ns - epoch);
    }
    double all = 0, extras = 0;
    for (const McapFile::Attachment& a : log.attachments) extras += static_cast<double>(a.content.size());
    for (auto& [name, w] : weights) {
      w.press();
      all += static_cast<double>(w.compressed);
    }
    const double indexed = static_cast<double>(index_bytes * info.messages);
    const double rest = std::max(0.0, static_cast<double>(info.bytes) - extras - indexed);
    for (auto& [name, w] : weights) {
      w.topic.stored_bytes = rest * static_cast<double>(w.compressed) / std::max(1.0, all) +
                             static_cast<double>(index_bytes * w.topic.messages);
      w.topic.first_ns -= static_cast<std::int64_t>(epoch);
      w.topic.last_ns -= static_cast<std::int64_t>(epoch);
      info.topics.push_back(w.topic);
    }
    read_events(log, epoch);
    info.file = stream.take_log();
  }

  void begin_phase(const std::string& name, std::int64_t now_ns, const std::string& because) {
    if (!info.phases.empty()) info.phases.back().end_ns = now_ns;
    info.phases.push_back({name, now_ns, info.end_ns, because});
  }

  void read_events(const McapFile& log, std::uint64_t epoch) try {
    const HostTopic<core::Event> topic(log);
    if (!topic.same()) return read_other_events(log, epoch);
    for (const auto& [ns, bytes] : events) {
      const core::Event e = topic.read(bytes);
      const auto now_ns = static_cast<std::int64_t>(ns - epoch);
      const auto severity = static_cast<std::size_t>(e.severity);
      info.events.push_back({now_ns, kind_words(e.code), e.component.data(), e.words.data(),
                             severity < severities.size() ? severities[severity] : ""});
      if (e.code == Code::phase_entered) begin_phase(e.name.data(), now_ns, e.cause.data());
      if (e.code == Code::concluded && e.name[0] != '\0')
        info.verdict = {info.events.back().text, info.events.back().severity};
    }
  } catch (const Error&) {
    return;
  }

  /// Events of another version or program: `text` describes the event. In logs of Fulmar before event codes,
  /// a phase has its name after a keyword.
  void read_other_events(const McapFile& log, std::uint64_t epoch) {
    constexpr std::string_view phase_word = "phase ";
    const auto schema =
        events.empty() ? log.schemas.end() : log.schemas.find(log.channels.at(event_channel).schema);
    if (schema == log.schemas.end()) return;
    const TypePtr type = parse_ros_schema(schema->second.name, schema->second.text);
    for (const auto& [ns, bytes] : events) {
      LogInfo::Event e{static_cast<std::int64_t>(ns - epoch), "", "", "", ""};
      for (const auto& [name, text] : cdr_values(*type, bytes, 1000)) {
        if (name == "kind") e.kind = text;
        if (name == "component") e.component = text;
        if (name == "text" || name == "words") e.text = text;
      }
      if (e.kind == "phase" && e.text.starts_with(phase_word))
        begin_phase(e.text.substr(phase_word.size()), e.time_ns, "");
      info.events.push_back(std::move(e));
    }
  }
};

}  // namespace

std::string LogInfo::value(const std::string& metadata, const std::string& key) const {
  for (const McapFile::Metadata& m : file.metadata)
    for (const auto& [k, text] : m.pairs)
      if (m.name == metadata && k == key) return text;
  return "";
}

LogInfo read_info(const std::filesystem::path& log) {
  Reading reading(log);
  reading.run();
  return std::move(reading.info);
}

}  // namespace fulmar::core
