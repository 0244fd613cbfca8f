// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/recorded_vehicle.hpp"

#include <cstring>

#include "core/types/named.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_replay/logged.hpp"
#include "tools/fulmar_replay/messages.hpp"

namespace fulmar::core {

VehicleTrack::VehicleTrack(const Survey& survey, const Graph& graph)
    : log_(survey.log), epoch_ns_(graph.epoch_ns), vehicle_(nth(graph.components, graph.vehicle)) {
  const std::vector<Port>& ports = vehicle_.info().outputs;
  for (std::uint32_t i = 0; i < ports.size(); ++i) {
    const Port& port = ports[i];
    if (!port.type) {
      probes_.push_back(i);
      continue;
    }
    const std::string topic = topic_in(log_, graph, vehicle_, i);
    // without a sample in the whole flight
    const bool silent = port.kind != FULMAR_OUT_VALUE && !has_topic(log_, topic);
    if (!silent) outputs_[channel_of(log_, topic, *port.type)] = i;
  }
  if (!probes_.empty()) outputs_[log_.channel("/" + vehicle_.name + "/probes")] = all_probes;
}

void VehicleTrack::take(std::uint32_t output, const McapFile::Message& m) {
  if (output == all_probes && m.data.size() != 4 + 8 * probes_.size())
    throw Error(replay_messages::probes_mismatch(
        vehicle_.name, m.data.size() < 4 ? 0 : (m.data.size() - 4) / 8, probes_.size(), vehicle_.use));
  waiting_.push_back({flight_ns(m.log_ns, epoch_ns_), flight_ns(m.publish_ns, epoch_ns_), m.channel, output,
                      std::vector<std::byte>(m.data.begin(), m.data.end())});
}

void VehicleTrack::begin_tick(std::int64_t now_ns) {
  if (!waiting_.empty() && waiting_.front().log_ns < now_ns)
    throw Error(replay_messages::samples_between_ticks(log_.channels.at(waiting_.front().channel).topic));
  now_ns_ = now_ns;
}

void VehicleTrack::read(fulmar_tick& tick, std::vector<fulmar_output>& out) {
  if (!now_ns_) throw Error(last_words_);
  tick.now_ns = *now_ns_;
  for (; !waiting_.empty() && waiting_.front().log_ns == *now_ns_; waiting_.pop_front())
    put(waiting_.front(), out);
  now_ns_.reset();
}

void VehicleTrack::put(const Sample& sample, std::vector<fulmar_output>& out) const {
  if (sample.output == all_probes) {  // in one message of doubles
    for (std::size_t k = 0; k < probes_.size(); ++k) {
      std::memcpy(out[probes_[k]].data, sample.data.data() + 4 + 8 * k, 8);
      out[probes_[k]].count = 1;
    }
    return;
  }
  const Port& port = vehicle_.info().outputs[sample.output];
  fulmar_output& to = out[sample.output];
  const bool queue = port.kind == FULMAR_OUT_QUEUE;
  if (queue && to.count == port.capacity) throw Error(replay_messages::too_many_samples(port.name));
  const std::size_t at = queue ? std::size_t{to.count} * port.type->size : 0;
  cdr_decode(*port.type, sample.data.data(), sample.data.size(), static_cast<std::byte*>(to.data) + at);
  if (queue) {
    to.stamps_ns[to.count++] = sample.valid_at_ns;
  } else {
    to.valid_at_ns = sample.valid_at_ns;
    to.count = 1;
  }
}

std::uint32_t RecordedVehicle::read(fulmar_tick& tick, Outlets& out, fulmar_error& problem) noexcept try {
  track_->read(tick, out.views);
  return FULMAR_OK;
} catch (const std::exception& fault) {
  put_problem(problem, fault.what());
  return FULMAR_FAILED;
}

}  // namespace fulmar::core
