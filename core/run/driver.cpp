// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/driver.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <span>

#include "core/error.hpp"
#include "core/run/in_flight.hpp"
#include "core/run/realtime.hpp"
#include "core/types/wire.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core {
namespace {

std::size_t largest(const ComponentInfo& info) {
  std::size_t size = sizeof(double);
  for (const Port& port : info.outputs)
    if (port.type) size = std::max<std::size_t>(size, port.type->size);
  return size;
}

constexpr std::size_t ring_bytes = 256u << 10;
constexpr int patience_ms = 2000;  // for the step that a driver is in when the flight ends

}  // namespace

Driver::Driver(const std::string& name, const fulmar_component& functions, void* instance,
               const ComponentInfo& info)
    : name_(name),
      functions_(functions),
      instance_(instance),
      info_(info),
      out_(info),
      ring_(ring_bytes, largest(info)) {}

Driver::~Driver() {
  stop_.store(true, std::memory_order_release);
  if (!thread_.joinable()) return;
  for (int i = 0; i < patience_ms && !ended_.load(std::memory_order_acquire); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!ended_.load(std::memory_order_acquire)) {
    std::fprintf(stderr, "fulmar: the driver %s does not return from its step; the host ends without it\n",
                 info_.name.c_str());
    for (;;) ::syscall(SYS_exit_group, 1);  // _Exit is taken for a plugin's
  }
  thread_.join();
}

void Driver::start() {
  thread_ = quiet_thread("fulmar-driver", [this] { run(); });
}

bool Driver::step() noexcept {
  const fulmar_tick tick{now_ns_.load(std::memory_order_relaxed), 0, steps_++};
  out_.prepare(tick.now_ns);
  error_.text[0] = '\0';
  {
    const InFlight inside(name_, "step", Thread::own);
    const std::uint32_t status = functions_.step(instance_, &tick, nullptr, out_.views.data(), &error_);
    if (judge(status, error_) >= FULMAR_FAILED) return false;
  }
  for (std::size_t i = 0; i < out_.views.size(); ++i) {
    const Port& port = info_.outputs[i];
    const std::size_t size = port.type ? port.type->size : sizeof(double);
    std::uint64_t lost = out_.views[i].lost;
    for (std::uint32_t k = 0; k < std::min(out_.views[i].count, port.capacity); ++k) {
      const Ring::Record record{0, static_cast<std::uint32_t>(i), 0, 0,
                                port.type ? out_.stamps[i][k] : FULMAR_ON_ARRIVAL};
      if (!ring_.push(record, out_.data[i].data() + k * size, size)) ++lost;
    }
    if (lost > 0) lost_.fetch_add(lost, std::memory_order_relaxed);
  }
  return true;
}

void Driver::run() noexcept {
  leave_cpu_of_loop();
  while (!stop_.load(std::memory_order_acquire)) {
    if (step()) continue;
    if (error_.text[0] == '\0') std::snprintf(error_.text, sizeof error_.text, "says that it failed");
    failed_.store(true, std::memory_order_release);
    break;
  }
  ended_.store(true, std::memory_order_release);
}

bool Driver::next(std::int64_t now_ns, Sample& sample) noexcept {
  now_ns_.store(now_ns, std::memory_order_relaxed);
  const Ring::Record* record = ring_.next();
  if (!record) return false;
  sample = {record->channel, record->valid_ns == FULMAR_ON_ARRIVAL ? now_ns : record->valid_ns,
            record->data(), false};
  return true;
}

RecordedSamples::RecordedSamples(const std::filesystem::path& log, const ComponentInfo& info,
                                 const std::vector<std::string>& topics, std::int64_t epoch_ns)
    : RecordedSamples(read_mcap(log), info, topics, "", epoch_ns, {}) {}

RecordedSamples::RecordedSamples(const McapFile& file, const ComponentInfo& info,
                                 const std::vector<std::string>& topics, const std::string& probes,
                                 std::int64_t epoch_ns,
                                 std::vector<std::pair<std::int64_t, std::string>> faults)
    : faults_(std::move(faults)) {
  constexpr std::uint32_t all_probes = ~0u;
  std::map<std::uint16_t, std::uint32_t> outputs;  // channel -> output
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].empty()) continue;
    const std::uint16_t channel = file.channel(topics[i]);
    if (file.schemas.at(file.channels.at(channel).schema).text != ros_definition(*info.outputs[i].type))
      throw Error(topics[i] + " has other fields than " + info.name + "." + info.outputs[i].name);
    outputs[channel] = static_cast<std::uint32_t>(i);
  }
  if (!probes.empty()) outputs[file.channel(probes)] = all_probes;
  for (const McapFile::Message& m : file.messages) {
    const auto at = outputs.find(m.channel);
    if (at == outputs.end()) continue;
    if (at->second == all_probes)
      add_probes(info, m, epoch_ns);
    else
      add(info, at->second, m, epoch_ns);
  }
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const Stored& a, const Stored& b) { return a.log_ns < b.log_ns; });
}

/// What is published together is in the order of the outputs.
void RecordedSamples::add(const ComponentInfo& info, std::uint32_t output, const McapFile::Message& m,
                          std::int64_t epoch_ns) {
  Stored s{static_cast<std::int64_t>(m.log_ns) - epoch_ns, static_cast<std::int64_t>(m.publish_ns) - epoch_ns,
           output, std::vector<std::byte>(info.outputs[output].type->size)};
  cdr_decode(*info.outputs[output].type, m.data.data(), m.data.size(), s.data.data());
  if (!samples_.empty() && output < samples_.back().output) samples_.back().ends = true;
  samples_.push_back(std::move(s));
}

/// Probes are stored at the end of each publication, all in one message of doubles, and in a publication one
/// of them changes at most.
void RecordedSamples::add_probes(const ComponentInfo& info, const McapFile::Message& m,
                                 std::int64_t epoch_ns) {
  const std::int64_t log_ns = static_cast<std::int64_t>(m.log_ns) - epoch_ns;
  const std::span<const std::byte> values = m.data.subspan(std::min<std::size_t>(4, m.data.size()));
  probes_.resize(values.size());
  const bool alone = samples_.empty() || samples_.back().ends || samples_.back().log_ns != log_ns;
  std::uint32_t changed = 0, first = 0;
  std::size_t k = 0, changed_at = 0;
  bool any = false;
  for (std::uint32_t i = 0; i < info.outputs.size(); ++i) {
    if (info.outputs[i].type) continue;
    if (8 * k + 8 > values.size()) throw Error("the log has other probes of " + info.name);
    if (k == 0) first = i;
    if (std::memcmp(values.data() + 8 * k, probes_.data() + 8 * k, 8) != 0)
      changed = i, changed_at = k, any = true;
    ++k;
  }
  if (any || alone) {
    const std::byte* const value = values.data() + 8 * changed_at;
    samples_.push_back({log_ns, log_ns, any ? changed : first, std::vector<std::byte>(value, value + 8)});
  }
  samples_.back().ends = true;
  std::copy(values.begin(), values.end(), probes_.begin());
}

bool RecordedSamples::next(std::int64_t now_ns, Sample& sample) noexcept {
  now_ns_ = now_ns;
  if (at_ == samples_.size() || samples_[at_].log_ns > now_ns) return false;
  const Stored& s = samples_[at_++];
  sample = {s.output, s.valid_at_ns, s.data.data(), s.ends};
  return true;
}

const char* RecordedSamples::fault() const noexcept {
  for (const auto& [at_ns, text] : faults_)
    if (at_ns == now_ns_) return text.c_str();
  return "";
}

}  // namespace fulmar::core
