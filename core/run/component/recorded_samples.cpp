// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/recorded_samples.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <span>

#include "core/error.hpp"
#include "core/run/messages.hpp"
#include "core/types/named.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_waiting_bytes = 32u << 20;  // of a driver whose samples are not collected

/// Plugin that published the samples of a component, "nmea_gnss.so 1.2.0".
std::string writer_of(const McapFile& log, const std::string& component) {
  std::string file, version;
  if (const McapFile::Metadata* const plugins = find_named(log.metadata, "plugins"))
    for (const auto& [key, value] : plugins->pairs) {
      if (key == component + ".file") file = std::filesystem::path(value).filename().string();
      if (key == component + ".version") version = value;
    }
  return file.empty() ? run_messages::plugin_unnamed().line() : file + " " + version;
}

}  // namespace

SampleTrack::SampleTrack(const McapFile& log, const std::string& component, const ComponentInfo& info,
                         const std::vector<std::string>& topics, const std::string& probes,
                         std::int64_t epoch_ns)
    : name_(component), epoch_ns_(epoch_ns) {
  for (const Port& port : info.outputs) types_.push_back(port.type);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].empty()) continue;
    const std::uint16_t channel = log.channel(topics[i]);
    if (log.schemas.at(log.channels.at(channel).schema).text != ros_definition(*types_[i]))
      throw Error(run_messages::topic_fields_differ(topics[i], name_, info.outputs[i].name, types_[i]->name,
                                                    writer_of(log, name_)));
    outputs_[channel] = static_cast<std::uint32_t>(i);
  }
  if (!probes.empty()) outputs_[log.channel(probes)] = all_probes;
}

void SampleTrack::take(const McapFile::Message& m) {
  const auto at = outputs_.find(m.channel);
  if (at == outputs_.end()) return;
  if (at->second == all_probes)
    add_probes(m);
  else
    add(at->second, m);
}

void SampleTrack::store(Stored sample) {
  if (waiting_bytes_ > max_waiting_bytes) {
    ++lost_;
    return;
  }
  waiting_bytes_ += sample.data.size() + sizeof sample;
  waiting_.push_back(std::move(sample));
}

/// Samples of one publication are in the order of the outputs.
void SampleTrack::add(std::uint32_t output, const McapFile::Message& m) {
  const Type& type = *types_[output];
  Stored s{static_cast<std::int64_t>(m.log_ns) - epoch_ns_,
           static_cast<std::int64_t>(m.publish_ns) - epoch_ns_, output, std::vector<std::byte>(type.size),
           false};
  cdr_decode(type, m.data.data(), m.data.size(), s.data.data());
  if (!waiting_.empty() && output < waiting_.back().output) waiting_.back().ends = true;
  store(std::move(s));
}

/// Probes are stored at the end of each publication, all in one message of doubles; one publication changes
/// at most one of them.
void SampleTrack::add_probes(const McapFile::Message& m) {
  const std::int64_t log_ns = static_cast<std::int64_t>(m.log_ns) - epoch_ns_;
  const std::span<const std::byte> values = m.data.subspan(std::min<std::size_t>(4, m.data.size()));
  probes_.resize(values.size());
  const bool alone = waiting_.empty() || waiting_.back().ends || waiting_.back().log_ns != log_ns;
  std::uint32_t changed = 0, first = 0;
  std::size_t k = 0, changed_at = 0;
  bool any = false;
  for (std::uint32_t i = 0; i < types_.size(); ++i) {
    if (types_[i]) continue;
    if (8 * k + 8 > values.size()) throw Error(run_messages::recorded_probes_differ(name_));
    if (k == 0) first = i;
    if (std::memcmp(values.data() + 8 * k, probes_.data() + 8 * k, 8) != 0) {
      changed = i;
      changed_at = k;
      any = true;
    }
    ++k;
  }
  if (any || alone) {
    const std::byte* const value = values.data() + 8 * changed_at;
    store({log_ns, log_ns, any ? changed : first, std::vector<std::byte>(value, value + 8), false});
  }
  if (!waiting_.empty()) waiting_.back().ends = true;
  std::copy(values.begin(), values.end(), probes_.begin());
}

bool SampleTrack::next(std::int64_t now_ns, SampleSource::Sample& sample) noexcept {
  if (waiting_.empty() || waiting_.front().log_ns > now_ns) return false;
  given_ = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= given_.data.size() + sizeof given_;
  sample = {given_.output, given_.valid_at_ns, given_.data.data(), given_.ends};
  return true;
}

// ---- a log with a single reader

RecordedSamples::RecordedSamples(const std::filesystem::path& log, const std::string& component,
                                 const ComponentInfo& info, const std::vector<std::string>& topics,
                                 const std::string& probes, std::int64_t epoch_ns)
    : epoch_ns_(epoch_ns) {
  McapStream whole(log);  // a topic may begin anywhere
  std::set<std::uint16_t> late;
  std::uint64_t latest_ns = 0;
  while (const McapFile::Message* const m = whole.next()) {
    if (m->log_ns < latest_ns) late.insert(m->channel);
    latest_ns = std::max(latest_ns, m->log_ns);
  }
  try {
    track_ = std::make_shared<SampleTrack>(whole.log(), component, info, topics, probes, epoch_ns);
  } catch (const Error& fault) {
    throw Error(located(log.string(), fault.diagnostic));
  }
  for (const auto& [channel, output] : track_->outputs())
    if (late.contains(channel))
      throw Error(run_messages::samples_unordered(log.string(), whole.log().channels.at(channel).topic));
  stream_ = std::make_unique<McapStream>(log);
}

RecordedSamples::RecordedSamples(std::shared_ptr<SampleTrack> track,
                                 std::vector<std::pair<std::int64_t, std::string>> faults)
    : track_(std::move(track)), faults_(std::move(faults)) {}

/// Reads up to the first message of a later tick: then the publication is complete.
void RecordedSamples::read_on(std::int64_t now_ns) noexcept try {
  while (stream_ && read_ns_ <= now_ns) {
    const McapFile::Message* const m = stream_->next();
    if (!m) {
      stream_.reset();
      return;
    }
    read_ns_ = static_cast<std::int64_t>(m->log_ns) - epoch_ns_;
    track_->take(*m);
  }
} catch (const std::exception& fault) {
  stream_.reset();
  unreadable_ = fault.what();
}

bool RecordedSamples::next(std::int64_t now_ns, Sample& sample) noexcept {
  now_ns_ = now_ns;
  read_on(now_ns);
  return track_->next(now_ns, sample);
}

const char* RecordedSamples::fault() const noexcept {
  const auto at = std::lower_bound(faults_.begin(), faults_.end(), now_ns_,
                                   [](const auto& f, std::int64_t ns) { return f.first < ns; });
  return at != faults_.end() && at->first == now_ns_ ? at->second.c_str() : unreadable_.c_str();
}

}  // namespace fulmar::core
