// SPDX-License-Identifier: BSD-3-Clause
// See diff.hpp.
#include "tools/fulmar_log/diff.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "tools/fulmar_log/export_table.hpp"
#include "core/log/reader.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t most_compared_columns = 100'000;
using MessageBytes = std::vector<std::byte>;

struct Stored {
  MessageBytes data;
  std::uint64_t valid_ns;  // as the log has it: its publish time
  bool operator==(const Stored&) const = default;
};

/// One of the two logs: the messages of one log time after the other.
struct Side {
  McapStream stream;
  const McapFile::Message* ahead;
  std::map<std::string, std::vector<Stored>> now;  // by topic, of the present log time
  std::vector<std::string> order;                  // of the topics there, as they stand in the file
  std::map<std::string, std::uint16_t> channels;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();

  explicit Side(const std::filesystem::path& file) : stream(file), ahead(stream.next()) {
    if (ahead != nullptr) first_ns = ahead->log_ns;
  }
  std::uint64_t next_ns() const { return ahead != nullptr ? ahead->log_ns : std::numeric_limits<std::uint64_t>::max(); }
  void take(std::uint64_t ns) {
    for (auto& [topic, list] : now) list.clear();
    order.clear();
    for (; ahead != nullptr && ahead->log_ns == ns; ahead = stream.next()) {
      const std::string& topic = stream.log().channels.at(ahead->channel).topic;
      channels.try_emplace(topic, ahead->channel);
      if (now[topic].empty()) order.push_back(topic);
      now[topic].push_back({MessageBytes(ahead->data.begin(), ahead->data.end()), ahead->publish_ns});
    }
  }
  std::int64_t flight_ns(std::uint64_t ns) const { return static_cast<std::int64_t>(ns - log_epoch_ns(stream.log(), first_ns)); }
};

struct Value {
  std::string name, text;
};

/// The message field by field; empty when it cannot be decoded.
std::vector<Value> values(const Side& side, const std::string& topic, const MessageBytes& message) {
  try {
    const McapFile& log = side.stream.log();
    const McapFile::Channel& channel = log.channels.at(side.channels.at(topic));
    const auto schema = log.schemas.find(channel.schema);
    if (schema == log.schemas.end() || schema->second.encoding != "ros2msg" || channel.encoding != "cdr") return {};
    RosField root = parse_ros2msg(schema->second.name, schema->second.text);
    measure(root, message);
    const std::vector<Column> columns = lay_out(root, most_compared_columns);
    std::vector<Cell> row;
    decode(root, message, row);
    std::vector<Value> list;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string_view label = cell_label(*columns[i].field, row[i]);
      list.push_back({columns[i].name, label.empty() ? cell_text(row[i]) : std::string(label)});
    }
    return list;
  } catch (const Error&) {
    return {};
  }
}

/// The first field that is not the same, or else a byte; of samples that hold the same, when they are valid.
LogDiff::First first_field(const Side& a, const Side& b, const std::string& topic, const Stored& in_a, const Stored& in_b) {
  const MessageBytes &left = in_a.data, &right = in_b.data;
  if (left == right) return {topic, "valid at", 0, std::to_string(in_a.valid_ns), std::to_string(in_b.valid_ns)};
  const std::vector<Value> x = values(a, topic, left), y = values(b, topic, right);
  for (std::size_t i = 0; i < std::max(x.size(), y.size()); ++i) {
    const bool in_x = i < x.size(), in_y = i < y.size();
    if (in_x && in_y && x[i].name == y[i].name && x[i].text == y[i].text) continue;
    const bool same_name = !in_x || !in_y || x[i].name == y[i].name;
    LogDiff::First f;
    f.topic = topic;
    f.field = in_x ? x[i].name : y[i].name;
    f.a = in_x ? x[i].text : "absent";
    f.b = !in_y ? "absent" : same_name ? y[i].text : y[i].name + " " + y[i].text;
    return f;
  }
  const auto [p, q] = std::mismatch(left.begin(), left.end(), right.begin(), right.end());
  const std::string at = "byte " + std::to_string(p - left.begin());
  const auto text = [](MessageBytes::const_iterator byte, MessageBytes::const_iterator end) {
    return byte == end ? std::string("absent") : std::to_string(static_cast<int>(*byte));
  };
  LogDiff::First f;
  f.topic = topic, f.field = at, f.a = text(p, left.end()), f.b = text(q, right.end());
  return f;
}

struct Comparison {
  Side a, b;
  LogDiff diff;

  Comparison(const std::filesystem::path& file_a, const std::filesystem::path& file_b) : a(file_a), b(file_b) {}

  void run() {
    while (a.ahead != nullptr || b.ahead != nullptr) {
      const std::uint64_t ns = std::min(a.next_ns(), b.next_ns());
      a.take(ns);
      b.take(ns);
      for (const std::string& topic : a.order) compare(topic, ns);
      for (const std::string& topic : b.order)
        if (a.now[topic].empty()) compare(topic, ns);
    }
    diff.fault_a = a.stream.log().fault;
    diff.fault_b = b.stream.log().fault;
    for (auto it = diff.topics.begin(); it != diff.topics.end();) {
      const bool in_a = a.channels.contains(it->first), in_b = b.channels.contains(it->first);
      if (!in_b) diff.only_a.push_back(it->first);
      if (!in_a) diff.only_b.push_back(it->first);
      it = in_a && in_b ? std::next(it) : diff.topics.erase(it);
    }
    diff.first = first_pair;
    for (const auto& [topic, first] : first_absent) {  // a topic that is only in one is told by that
      if (diff.topics.contains(topic) && (!diff.first || first.time_ns < diff.first->time_ns)) diff.first = first;
    }
  }

  void compare(const std::string& topic, std::uint64_t ns) {
    const std::vector<Stored>&left = a.now[topic], &right = b.now[topic];
    LogDiff::Topic& counts = diff.topics[topic];
    const std::size_t both = std::min(left.size(), right.size());
    for (std::size_t i = 0; i < both; ++i) {
      if (left[i] == right[i]) {
        ++counts.equal;
        continue;
      }
      ++counts.different;
      if (topic == Ticks::topic) note_tick(left[i].data, right[i].data);
      if (first_pair && first_pair->topic != Ticks::topic) continue;
      if (first_pair && (topic == Ticks::topic || a.flight_ns(ns) > first_pair->time_ns)) continue;
      first_pair = first_field(a, b, topic, left[i], right[i]);
      first_pair->time_ns = a.flight_ns(ns);
    }
    counts.only_a += left.size() - both;
    counts.only_b += right.size() - both;
    if (left.size() == right.size()) return;
    const auto word = [&](std::size_t n) { return n > both ? "a message" : "absent"; };
    first_absent.try_emplace(topic, LogDiff::First{topic, "", a.flight_ns(ns), word(left.size()), word(right.size())});
  }

  void note_tick(const MessageBytes& left, const MessageBytes& right) try {
    const HostTopic<Ticks> in_a(a.stream.log()), in_b(b.stream.log());
    if (diff.first_tick || !in_a.same() || !in_b.same()) return;
    const Ticks x = in_a.read(left), y = in_b.read(right);
    std::int64_t time_ns = x.time_ns;
    for (std::uint32_t i = 0; i < std::min(x.hashes, y.hashes); ++i) {
      if (i > 0) time_ns += x.period_ns[i];
      if (x.hash[i] == y.hash[i]) continue;
      diff.first_tick = {x.first + i, time_ns};
      return;
    }
  } catch (const Error&) {  // no message of the host's: the bytes differ, and that is all
  }

  std::optional<LogDiff::First> first_pair;
  std::map<std::string, LogDiff::First> first_absent;  // by topic
};

using Named = std::map<std::string, std::string>;

Named metadata_of(const McapFile& log) {
  Named all;
  for (const McapFile::Metadata& m : log.metadata)
    for (const auto& [key, value] : m.pairs) all[m.name + ": " + key] = value;
  return all;
}

Named attachments_of(const McapFile& log) {
  Named all;
  for (const McapFile::Attachment& a : log.attachments) all[a.name] = a.content;
  return all;
}

std::size_t line_of_difference(const std::string& a, const std::string& b) {
  const auto [p, q] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return 1 + static_cast<std::size_t>(std::count(a.begin(), p, '\n'));
}

template <class Sentence>
std::vector<std::string> differences(const Named& a, const Named& b, Sentence sentence) {
  std::vector<std::string> list;
  for (const auto& [name, value] : a) {
    const auto other = b.find(name);
    if (other == b.end()) list.push_back(name + " is only in the first");
    if (other != b.end() && other->second != value) list.push_back(sentence(name, value, other->second));
  }
  for (const auto& [name, value] : b)
    if (!a.contains(name)) list.push_back(name + " is only in the second");
  return list;
}

}  // namespace

bool LogDiff::messages_equal() const {
  const bool same = std::all_of(topics.begin(), topics.end(),
                                [](const auto& t) { return t.second.different == 0 && t.second.only_a == 0 && t.second.only_b == 0; });
  return same && only_a.empty() && only_b.empty() && fault_a.empty() == fault_b.empty();
}

LogDiff diff_logs(const std::filesystem::path& file_a, const std::filesystem::path& file_b) {
  Comparison comparison(file_a, file_b);
  comparison.run();
  LogDiff diff = std::move(comparison.diff);
  const McapFile &a = comparison.a.stream.log(), &b = comparison.b.stream.log();
  diff.metadata = differences(metadata_of(a), metadata_of(b), [](const std::string& name, const std::string& x, const std::string& y) {
    return name + " is " + x + " and " + y;
  });
  diff.attachments =
      differences(attachments_of(a), attachments_of(b), [](const std::string& name, const std::string& x, const std::string& y) {
        return name + " differs from line " + std::to_string(line_of_difference(x, y)) + " on";
      });
  return diff;
}

}  // namespace fulmar::core
