// SPDX-License-Identifier: BSD-3-Clause
#include "links/dds/topics.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.hpp"
#include "core/types/text.hpp"
#include "links/dds/messages.hpp"

namespace fulmar::core::dds {
namespace {

// Bounds on stored samples and on samples per poll: a flood costs its sender samples and does not delay the
// flight.
constexpr int import_depth = 64;
constexpr std::size_t samples_per_wake = 16;

// A reader that joins late gets the last sample of a port that need not publish in every step ("latched" in
// ROS). The writer has room for several samples, so that a quick series also reaches slow readers. An older
// sample has reached them and is dropped for the new one.
constexpr std::int64_t delivered_ns = 1'000'000'000;

}  // namespace

// ---- remote endpoints

void Others::expect(const std::string& topic, const std::string& type, bool we_write, bool best_effort) {
  const std::lock_guard lock(mutex_);
  topics_.try_emplace(topic, Topic{type, we_write, best_effort});
}

void Others::found(const std::string& topic, const std::string& type, bool writer, bool best_effort) {
  const std::lock_guard lock(mutex_);
  const auto at = topics_.find(topic);
  if (at == topics_.end() || at->second.we_write == writer) return;
  Topic& t = at->second;
  if (t.type != type) {
    if (!std::exchange(t.reported_type, true))
      say_(dds_messages::peer_type_differs(writer ? "writes" : "reads", topic, type, t.type), Tone::warning);
  } else if (writer && best_effort) {
    t.best_effort_writer = true;
  } else if (!writer && !best_effort && t.best_effort) {
    if (!std::exchange(t.reported_effort, true))
      say_(dds_messages::peer_reliability_differs(topic), Tone::warning);
  }
}

bool Others::has_best_effort_writer(const std::string& topic) const {
  const std::lock_guard lock(mutex_);
  const auto at = topics_.find(topic);
  return at != topics_.end() && at->second.best_effort_writer;
}

/// As in ROS 2, a name that begins with '/' is absolute and stays unchanged.
static Endpoint endpoint_of(const std::string& topic, const Type& type, const DdsOptions& options) {
  Endpoint endpoint;
  endpoint.topic = dds_topic("rt", topic.starts_with('/') ? "" : options.name_space, topic);
  endpoint.type = dds_type(ros_name(type));
  endpoint.max_bytes = CdrEncoder(type).max_size();
  endpoint.type_hash = ros_type_hash(type);
  return endpoint;
}

// ---- exports

Exports::Exports(Tap& tap, const DdsOptions& options, Others& others)
    : cursor_(tap), of_channel_(tap.channels().size()) {
  std::vector<std::int64_t> wanted(tap.channels().size(), -1);
  std::vector<std::string> names;
  for (const TapChannel& c : tap.channels()) names.push_back(c.topic);
  for (const DdsOptions::Export& e : options.exports) {
    const auto at = std::find(names.begin(), names.end(), "/" + slashed(e.port));
    if (at == names.end())
      throw Error(located(
          e.where, dds_messages::exported_port_unknown(e.port, choices_text("/" + slashed(e.port), names))));
    const auto channel = static_cast<std::size_t>(at - names.begin());
    const Type& type = *tap.channels()[channel].type;
    Topic topic;
    topic.encoder = std::make_unique<CdrEncoder>(type);
    topic.period_ns = e.period_ns;
    topic.endpoint = endpoint_of(e.topic, type, options);
    topic.endpoint.best_effort = e.best_effort;
    topic.endpoint.transient_local = tap.channels()[channel].may_stay_silent && !e.best_effort;
    others.expect(topic.endpoint.topic, topic.endpoint.type, true, e.best_effort);
    wanted[channel] = wanted[channel] < 0 ? e.period_ns : std::min(wanted[channel], e.period_ns);
    of_channel_[channel].push_back(topics_.size());
    bytes_.resize(std::max(bytes_.size(), topic.encoder->max_size()));
    topics_.push_back(std::move(topic));
  }
  for (std::size_t c = 0; c < wanted.size(); ++c)
    if (wanted[c] >= 0) cursor_.want(c, wanted[c]);
}

void Exports::open(Participant& participant) {
  for (Topic& topic : topics_) topic.writer = participant.writer(topic.endpoint);
}

void Exports::pump() {
  while (const Tap::Sample* sample = cursor_.next()) {
    for (const std::size_t i : of_channel_[sample->channel]) send(topics_[i], *sample);
  }
  lost_.store(cursor_.lost(), std::memory_order_relaxed);
}

/// The ring holds the samples of all sinks, at any rate.
void Exports::send(Topic& topic, const Tap::Sample& sample) {
  if (topic.period_ns > 0 && !topic.due.take(sample.now_ns, topic.period_ns)) return;
  const bool read = topic.writer->readers() > 0;
  if (!read && !topic.endpoint.transient_local) return;
  if (topic.endpoint.transient_local &&
      sample.now_ns - std::exchange(topic.last_ns, sample.now_ns) > delivered_ns)
    topic.writer->forget();
  const std::size_t size = topic.encoder->encode(sample.data(), bytes_.data());
  const bool written = topic.writer->write({bytes_.data(), size});
  if (read) (written ? sent_ : lost_).fetch_add(1, std::memory_order_relaxed);
}

std::vector<Guid> Exports::writers() const {
  std::vector<Guid> list;
  for (const Topic& topic : topics_) list.push_back(topic.writer->guid());
  return list;
}

// ---- imports

Imports::Imports(const DdsHost& host, const FlightView& view, const DdsOptions& options, Others& others)
    : host_(host), others_(others) {
  for (const DdsOptions::Import& i : options.imports) {
    const ComponentView& component = view.components.at(static_cast<std::size_t>(i.component));
    const PortView& port = component.inputs.at(static_cast<std::size_t>(i.input));
    Topic topic;
    topic.component = component.name;
    topic.port = port.name;
    topic.type = port.type;
    topic.guard = std::make_unique<Guard>(*port.type);
    topic.endpoint = endpoint_of(i.topic, *port.type, options);
    topic.endpoint.depth = import_depth;
    topic.stats.port = component.name + "." + port.name;
    topic.stats.topic = topic.endpoint.topic.substr(2);
    others.expect(topic.endpoint.topic, topic.endpoint.type, false, false);
    topics_.push_back(std::move(topic));
  }
}

void Imports::open(Participant& participant, Waker& waker) {
  for (Topic& topic : topics_) topic.reader = participant.reader(topic.endpoint, waker);
}

bool Imports::pump(Participant& participant, Waker& waker) {
  bool all = true;
  for (Topic& topic : topics_) {
    std::size_t taken = topic.reader->take(samples_per_wake, [&](const Reader::Sample& s) { use(topic, s); });
    if (!topic.loose && others_.has_best_effort_writer(topic.endpoint.topic)) {
      Endpoint loose = topic.endpoint;
      loose.best_effort = true;
      topic.loose = participant.reader(loose, waker);
    }
    // A best-effort reader also matches the reliable writers, whose samples the other reader takes.
    if (topic.loose)
      taken = std::max(taken, topic.loose->take(samples_per_wake, [&](const Reader::Sample& s) {
        if (!topic.reader->hears(s.from.guid)) use(topic, s);
      }));
    all = all && taken < samples_per_wake;
    const std::lock_guard lock(mutex_);
    topic.stats.lost = topic.crowded + topic.reader->lost() + (topic.loose ? topic.loose->lost() : 0);
  }
  return all;
}

void Imports::use(Topic& topic, const Reader::Sample& sample) {
  std::vector<std::byte> message(topic.type->size);
  std::string why;
  bool taken = false;
  try {
    cdr_decode(*topic.type, sample.bytes.data(), sample.bytes.size(), message.data());
    if (topic.guard->check(message.data()))
      taken = host_.control.publish(topic.component, topic.port, std::move(message));
    else
      why = topic.guard->explain(message.data());
  } catch (const Error& fault) {
    why = fault.what();
  }
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const double latency_s =
      static_cast<double>(std::chrono::nanoseconds(now).count() - sample.written_ns) * 1e-9;
  if (!why.empty() && !std::exchange(topic.reported, true))
    host_.say(dds_messages::sample_refused(topic.stats.topic, topic.stats.port, why), Tone::warning);
  const std::lock_guard lock(mutex_);
  DdsStats::Import& stats = topic.stats;
  if (!why.empty() || !taken) {
    ++(why.empty() ? topic.crowded : stats.refused);
    return;
  }
  ++stats.received;
  topic.latency_sum_s += latency_s;
  stats.latency_mean_s = topic.latency_sum_s / static_cast<double>(stats.received);
  stats.latency_max_s = stats.received == 1 ? latency_s : std::max(stats.latency_max_s, latency_s);
}

std::vector<DdsStats::Import> Imports::stats() const {
  const std::lock_guard lock(mutex_);
  std::vector<DdsStats::Import> list;
  for (const Topic& topic : topics_) list.push_back(topic.stats);
  return list;
}

std::vector<Guid> Imports::readers() const {
  std::vector<Guid> list;
  for (const Topic& topic : topics_) list.push_back(topic.reader->guid());
  return list;
}

}  // namespace fulmar::core::dds
