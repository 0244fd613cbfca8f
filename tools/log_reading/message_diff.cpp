// SPDX-License-Identifier: BSD-3-Clause
// See message_diff.hpp.
#include "tools/log_reading/message_diff.hpp"

#include <algorithm>
#include <cstring>
#include <deque>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "core/log/reader.hpp"
#include "core/types/wire.hpp"
#include "tools/log_reading/cdr_values.hpp"
#include "tools/log_reading/log_file.hpp"
#include "tools/log_reading/messages.hpp"
#include "tools/log_reading/ros_parse.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_compared_values = 100'000;
constexpr std::size_t max_at_once = 32u << 20;  // bytes of one log time
constexpr std::size_t max_waiting = 100'000;    // ticks without a partner in the other log
using MessageBytes = std::span<const std::byte>;

struct Stored {
  std::size_t begin, size;  // in the bytes of its log time
  std::uint64_t valid_ns;   // the publish time in the log
};

bool same_bytes(MessageBytes a, MessageBytes b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

struct LoggedSample {
  MessageBytes data;
  std::uint64_t valid_ns;
  bool operator==(const LoggedSample& other) const {
    return valid_ns == other.valid_ns && same_bytes(data, other.data);
  }
};

struct HashedTick {
  std::uint64_t index;
  std::int64_t time_ns;
  std::uint32_t hash;
};

/// One of the two logs: the messages of one log time after the other.
struct Side {
  McapStream stream;
  std::uint64_t last_ns;
  const McapFile::Message* ahead;
  std::vector<std::byte> bytes;                    // of the messages of the present log time
  std::map<std::string, std::vector<Stored>> now;  // these, by topic
  std::vector<std::string> order;                  // of these topics, in the order of the file
  std::map<std::string, std::uint16_t> channels;
  std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();

  std::deque<HashedTick> ticks;  // ticks that wait for those of the other log
  std::optional<HostTopic<Ticks>> tick_topic;

  Side(const std::filesystem::path& file, std::uint64_t last) : stream(file), last_ns(last), ahead(next()) {
    if (ahead != nullptr) first_ns = ahead->log_ns;
  }
  const McapFile::Message* next() {
    const McapFile::Message* m = stream.next();
    while (m != nullptr && m->log_ns > last_ns) m = stream.next();
    return m;
  }
  std::uint64_t next_ns() const {
    return ahead != nullptr ? ahead->log_ns : std::numeric_limits<std::uint64_t>::max();
  }
  void take(std::uint64_t ns) {
    for (auto& [topic, list] : now) list.clear();
    order.clear();
    bytes.clear();
    std::size_t taken = 0;
    for (; ahead != nullptr && ahead->log_ns == ns; ahead = next()) {
      const std::string& topic = stream.log().channels.at(ahead->channel).topic;
      channels.try_emplace(topic, ahead->channel);
      if ((taken += ahead->data.size() + sizeof(Stored)) > max_at_once)
        throw Error(reading_messages::messages_too_large(max_at_once >> 20,
                                                         Fixed{1e-9 * static_cast<double>(ns), 3}));
      if (now[topic].empty()) order.push_back(topic);
      now[topic].push_back({bytes.size(), ahead->data.size(), ahead->publish_ns});
      bytes.insert(bytes.end(), ahead->data.begin(), ahead->data.end());
      if (topic == Ticks::topic) take_ticks(ahead->data);
    }
  }
  void take_ticks(std::span<const std::byte> data) try {
    if (!tick_topic) tick_topic.emplace(stream.log());
    if (!tick_topic->same() || ticks.size() > max_waiting) return;
    const Ticks t = tick_topic->read(data);
    each_tick(t, [&](std::uint32_t i, std::int64_t time_ns) {
      ticks.push_back({t.first + i, time_ns, t.hash[i]});
    });
  } catch (const Error&) {  // the message of another program: only its bytes are compared
  }
  /// The i-th message of a topic, if it exists.
  std::optional<LoggedSample> sample(const std::vector<Stored>& of_topic, std::size_t i) const {
    if (i >= of_topic.size()) return std::nullopt;
    return LoggedSample{MessageBytes(bytes).subspan(of_topic[i].begin, of_topic[i].size),
                        of_topic[i].valid_ns};
  }
  std::int64_t flight_ns(std::uint64_t ns) const {
    return static_cast<std::int64_t>(ns - log_epoch_ns(stream.log(), first_ns));
  }
};

/// The message field by field; empty when it cannot be decoded.
std::vector<CdrValue> values(const Side& side, const std::string& topic, MessageBytes message) try {
  const McapFile& log = side.stream.log();
  const McapFile::Channel& channel = log.channels.at(side.channels.at(topic));
  const auto schema = log.schemas.find(channel.schema);
  const bool ours =
      channel.encoding == "cdr" && schema != log.schemas.end() && schema->second.encoding == "ros2msg";
  if (!ours) return {};
  return cdr_values(*parse_ros_schema(schema->second.name, schema->second.text), message,
                    max_compared_values);
} catch (const Error&) {
  return {};
}

/// The first different field, or else a byte; for samples with equal fields, their time of validity.
MessageDiff::First first_field(const Side& a, const Side& b, const std::string& topic,
                               const LoggedSample& in_a, const LoggedSample& in_b, std::int64_t time_ns) {
  const MessageBytes left = in_a.data, right = in_b.data;
  if (same_bytes(left, right))
    return {topic, "valid at", time_ns, std::to_string(in_a.valid_ns), std::to_string(in_b.valid_ns)};
  const std::vector<CdrValue> x = values(a, topic, left), y = values(b, topic, right);
  for (std::size_t i = 0; i < std::max(x.size(), y.size()); ++i) {
    const bool in_x = i < x.size(), in_y = i < y.size(), same_name = !in_x || !in_y || x[i].name == y[i].name;
    if (in_x && in_y && same_name && x[i].text == y[i].text) continue;
    const std::string text = !in_y ? "absent" : same_name ? y[i].text : y[i].name + " " + y[i].text;
    return {topic, in_x ? x[i].name : y[i].name, time_ns, in_x ? x[i].text : "absent", text};
  }
  const auto [p, q] = std::mismatch(left.begin(), left.end(), right.begin(), right.end());
  const auto text = [](MessageBytes::iterator byte, MessageBytes::iterator end) {
    return byte == end ? std::string("absent") : std::to_string(static_cast<int>(*byte));
  };
  return {topic, "byte " + std::to_string(p - left.begin()), time_ns, text(p, left.end()),
          text(q, right.end())};
}

std::uint64_t count_differing(MessageBytes a, MessageBytes b) {
  const std::size_t both = std::min(a.size(), b.size());
  std::uint64_t n = std::max(a.size(), b.size()) - both;
  for (std::size_t i = 0; i < both; ++i) n += a[i] != b[i];
  return n;
}

struct Comparison {
  Side a, b;
  bool whole_topics;
  MessageDiff diff{};

  void run() {
    while (a.ahead != nullptr || b.ahead != nullptr) {
      const std::uint64_t ns = std::min(a.next_ns(), b.next_ns());
      a.take(ns);
      b.take(ns);
      compare_ticks();
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
    for (const auto& [topic, first] : first_absent) {
      // a topic in only one log is reported as such
      if (!whole_topics && !diff.topics.contains(topic)) continue;
      if (precedes(first.time_ns, diff.first)) diff.first = first;
    }
  }

  static bool precedes(std::int64_t time_ns, const std::optional<MessageDiff::First>& other) {
    return !other || time_ns < other->time_ns;
  }

  void compare(const std::string& topic, std::uint64_t ns) {
    const std::vector<Stored>&left = a.now[topic], &right = b.now[topic];
    MessageDiff::Topic& counts = diff.topics[topic];
    const bool of_ticks = topic == Ticks::topic;
    const std::int64_t time_ns = a.flight_ns(ns);
    if (!of_ticks) diff.messages += left.size();
    for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
      const std::optional<LoggedSample> x = a.sample(left, i), y = b.sample(right, i);
      if (x && y && *x == *y) {
        ++counts.equal;
        continue;
      }
      ++(!x ? counts.only_b : !y ? counts.only_a : counts.different);
      if (of_ticks) continue;  // the hashes of ticks show a difference, but not its place
      ++diff.differing_messages;
      diff.differing_bytes += count_differing(x ? x->data : MessageBytes{}, y ? y->data : MessageBytes{});
      const auto word = [](const std::optional<LoggedSample>& there) {
        return there ? "a message" : "absent";
      };
      if (!x || !y)
        first_absent.try_emplace(topic, MessageDiff::First{topic, "", time_ns, word(x), word(y)});
      else if (precedes(time_ns, first_pair))
        first_pair = first_field(a, b, topic, *x, *y, time_ns);
    }
  }

  void compare_ticks() {
    while (!a.ticks.empty() && !b.ticks.empty()) {
      const HashedTick x = a.ticks.front(), y = b.ticks.front();
      if (x.index <= y.index) a.ticks.pop_front();
      if (y.index <= x.index) b.ticks.pop_front();
      if (diff.first_tick || x.index != y.index || (x.hash == y.hash && x.time_ns == y.time_ns)) continue;
      diff.first_tick = {x.index, x.time_ns};
    }
  }

  std::optional<MessageDiff::First> first_pair{};
  std::map<std::string, MessageDiff::First> first_absent{};  // by topic
};

}  // namespace

bool MessageDiff::messages_equal() const {
  const bool same = std::all_of(topics.begin(), topics.end(), [](const auto& t) {
    return t.second.different == 0 && t.second.only_a == 0 && t.second.only_b == 0;
  });
  return same && only_a.empty() && only_b.empty() && fault_a.empty() == fault_b.empty();
}

MessageDiff diff_messages(const std::filesystem::path& file_a, const std::filesystem::path& file_b,
                          const DiffOptions& options) {
  Comparison comparison{{file_a, options.last_ns}, {file_b, options.last_ns}, options.whole_topics};
  comparison.run();
  MessageDiff diff = std::move(comparison.diff);
  diff.log_a = comparison.a.stream.take_log();
  diff.log_b = comparison.b.stream.take_log();
  return diff;
}

}  // namespace fulmar::core
