// SPDX-License-Identifier: BSD-3-Clause
#include "core/replay/replay_difference.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "core/replay/playback.hpp"
#include "core/types/ros_parse.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

using Message = McapFile::Message;

/// Per topic, up to a time; the ticks are looked at one by one elsewhere.
std::map<std::string, std::vector<const Message*>> by_topic(const McapFile& file, std::uint64_t last_ns) {
  std::map<std::uint16_t, std::vector<const Message*>> channels;
  for (const Message& m : file.messages)
    if (m.log_ns <= last_ns) channels[m.channel].push_back(&m);
  std::map<std::string, std::vector<const Message*>> topics;
  for (auto& [channel, list] : channels)
    if (const std::string& topic = file.channels.at(channel).topic; topic != "/fulmar/ticks") topics[topic] = std::move(list);
  return topics;
}

std::uint64_t differing_bytes(std::span<const std::byte> a, std::span<const std::byte> b) {
  const std::size_t both = std::min(a.size(), b.size());
  std::uint64_t n = std::max(a.size(), b.size()) - both;
  for (std::size_t i = 0; i < both; ++i) n += a[i] != b[i];
  return n;
}

bool same(const Message& a, const Message& b) {
  return a.log_ns == b.log_ns && a.publish_ns == b.publish_ns && a.data.size() == b.data.size() &&
         std::memcmp(a.data.data(), b.data.data(), a.data.size()) == 0;
}

/// Every number and text of a message, by its dotted name.
nlohmann::json values(const McapFile& file, const Message& m) {
  const McapFile::Schema& schema = file.schemas.at(file.channels.at(m.channel).schema);
  const TypePtr type = parse_ros_definition(schema.name, schema.text);
  std::vector<std::byte> message(type->size);
  cdr_decode(*type, m.data.data(), m.data.size(), message.data());
  return to_json(*type, message.data(), false).flatten();
}

std::string field_name(std::string pointer) {
  if (!pointer.empty()) pointer.erase(0, 1);
  std::replace(pointer.begin(), pointer.end(), '/', '.');
  return pointer;
}

void name_field(const McapFile& was, const Message& a, const McapFile& is, const Message& b, Difference& d) try {
  const nlohmann::json before = values(was, a), now = values(is, b);
  for (const auto& [key, value] : before.items()) {
    if (now.contains(key) && now.at(key) == value) continue;
    d.field = field_name(key), d.was = value.dump(), d.is = now.contains(key) ? now.at(key).dump() : "none";
    return;
  }
  for (const auto& [key, value] : now.items())
    if (!before.contains(key)) {
      d.field = field_name(key), d.was = "none", d.is = value.dump();
      return;
    }
  if (a.publish_ns != b.publish_ns) d.field = "valid at", d.was = std::to_string(a.publish_ns), d.is = std::to_string(b.publish_ns);
} catch (const std::exception&) {
  d.field = "other fields";  // what cannot be decoded differs all the same
}

struct Comparison {
  const McapFile &was, &is;
  std::int64_t epoch_ns;
  ReplayResult& result;
  const Message *first_was = nullptr, *first_is = nullptr;
  std::string first_topic;
  std::uint64_t first_ns = ~std::uint64_t{0};

  /// `was` or `is` may be missing. Of two in one tick the one that stands first in the log counts.
  void differs(const std::string& topic, const Message* a, const Message* b) {
    ++result.differing_messages;
    result.differing_bytes += differing_bytes(a ? a->data : std::span<const std::byte>{}, b ? b->data : std::span<const std::byte>{});
    const std::uint64_t at = std::min(a ? a->log_ns : ~std::uint64_t{0}, b ? b->log_ns : ~std::uint64_t{0});
    const bool before = at < first_ns || (at == first_ns && a && first_was && a < first_was);
    if (before) first_ns = at, first_topic = topic, first_was = a, first_is = b;
  }

  void topic(const std::string& name, const std::vector<const Message*>& a, const std::vector<const Message*>& b) {
    std::size_t i = 0, k = 0;
    while (i < a.size() || k < b.size()) {
      const Message* const x = i < a.size() ? a[i] : nullptr;
      const Message* const y = k < b.size() ? b[k] : nullptr;
      if (x && y && x->log_ns == y->log_ns) {
        if (!same(*x, *y)) differs(name, x, y);
        ++i, ++k;
      } else if (x && (!y || x->log_ns < y->log_ns)) {
        differs(name, x, nullptr), ++i;
      } else {
        differs(name, nullptr, y), ++k;
      }
    }
    result.messages += a.size();
  }

  void finish() {
    if (result.differing_messages == 0) return;
    Difference d{first_topic, "", first_was ? "a sample" : "none", first_is ? "a sample" : "none",
                 static_cast<std::int64_t>(first_ns) - epoch_ns};
    if (first_was && first_is) name_field(was, *first_was, is, *first_is, d);
    result.first = d;
  }
};

}  // namespace

void find_differences(const McapFile& was, const TickList& was_ticks, const McapFile& is, const TickList& is_ticks, std::int64_t epoch_ns,
                      ReplayResult& result) {
  const std::size_t both = std::min(was_ticks.hash.size(), is_ticks.hash.size());
  for (std::size_t i = 0; i < both && !result.first_tick; ++i)
    if (was_ticks.hash[i] != is_ticks.hash[i] || was_ticks.time_ns[i] != is_ticks.time_ns[i])
      result.first_tick = i, result.first_tick_ns = was_ticks.time_ns[i];
  const auto last_ns = static_cast<std::uint64_t>(was_ticks.time_ns.back() + epoch_ns);
  auto before = by_topic(was, last_ns), now = by_topic(is, last_ns);
  for (const auto& [topic, list] : now) before.try_emplace(topic);
  Comparison comparison{was, is, epoch_ns, result, nullptr, nullptr, {}};
  for (const auto& [topic, list] : before) comparison.topic(topic, list, now[topic]);
  comparison.finish();
}

}  // namespace fulmar::core
