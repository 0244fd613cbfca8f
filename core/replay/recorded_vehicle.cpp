// SPDX-License-Identifier: BSD-3-Clause
#include "core/replay/recorded_vehicle.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "core/replay/logged.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {

RecordedVehicle::RecordedVehicle(const McapFile& file, const Graph& graph,
                                 const std::vector<std::int64_t>& time_ns)
    : time_ns_(time_ns),
      epoch_ns_(graph.epoch_ns),
      info_(nth(graph.components, graph.vehicle).info()),
      samples_(time_ns.size()) {
  const Component& vehicle = nth(graph.components, graph.vehicle);
  std::map<std::uint16_t, std::uint32_t> outputs;  // channel -> output
  for (std::uint32_t i = 0; i < info_.outputs.size(); ++i) {
    const Port& port = info_.outputs[i];
    if (!port.type) {
      probes_.push_back(i);
      continue;
    }
    const std::string topic = topic_in(file, graph, vehicle, i);
    const bool silent = port.kind != FULMAR_OUT_VALUE && !has_topic(file, topic);  // in the whole flight
    if (!silent) outputs[channel_of(file, topic, *port.type)] = i;
  }
  if (!probes_.empty()) outputs[file.channel("/" + vehicle.name + "/probes")] = all_probes;
  for (const auto& [channel, output] : outputs)
    if (const std::string gap = gap_in(file, channel); !gap.empty()) gaps_.push_back(gap);
  std::size_t tick = 0;
  for (const McapFile::Message& m : file.messages) {
    const auto at = outputs.find(m.channel);
    if (at == outputs.end()) continue;
    const std::int64_t now = flight_ns(m.log_ns, epoch_ns_);
    while (tick < samples_.size() && time_ns_[tick] < now) ++tick;
    if (tick == samples_.size()) break;  // the log was cut off before it told of this tick
    if (time_ns_[tick] != now)
      throw Error("the log has samples of " + file.channels.at(m.channel).topic + " between two ticks");
    if (at->second == all_probes && m.data.size() != 4 + 8 * probes_.size())
      throw Error("the log has other probes of " + vehicle.name);
    index(m, at->second, tick);
  }
}

void RecordedVehicle::index(const McapFile::Message& message, std::uint32_t output, std::size_t tick) {
  if (output != all_probes) return samples_[tick].push_back({output, &message});
  for (const std::uint32_t probe : probes_) samples_[tick].push_back({probe, &message});
}

void RecordedVehicle::put(const Sample& sample, fulmar_output& out) const {
  const Port& port = info_.outputs[sample.output];
  const McapFile::Message& m = *sample.message;
  auto* const to = static_cast<std::byte*>(out.data);
  if (!port.type) {  // all probes in one message of doubles
    const auto k =
        static_cast<std::size_t>(std::find(probes_.begin(), probes_.end(), sample.output) - probes_.begin());
    std::memcpy(to, m.data.data() + 4 + 8 * k, 8);
    out.count = 1;
    return;
  }
  const std::int64_t valid_at_ns = flight_ns(m.publish_ns, epoch_ns_);
  if (port.kind != FULMAR_OUT_QUEUE) {
    cdr_decode(*port.type, m.data.data(), m.data.size(), to);
    out.valid_at_ns = valid_at_ns;
    out.count = 1;
    return;
  }
  if (out.count == port.capacity)
    throw Error("the log has more samples of " + port.name + " in a tick than there is room for");
  cdr_decode(*port.type, m.data.data(), m.data.size(), to + std::size_t{out.count} * port.type->size);
  out.stamps_ns[out.count++] = valid_at_ns;
}

std::uint32_t RecordedVehicle::read(fulmar_tick& tick, Outlets& out, fulmar_error& problem) noexcept {
  try {
    if (at_ == samples_.size()) throw Error(last_words_);
    tick.now_ns = time_ns_[at_];
    for (const Sample& sample : samples_[at_]) put(sample, out.views[sample.output]);
    ++at_;
    return FULMAR_OK;
  } catch (const std::exception& fault) {
    put_problem(problem, "%s", fault.what());
    return FULMAR_FAILED;
  }
}

}  // namespace fulmar::core
