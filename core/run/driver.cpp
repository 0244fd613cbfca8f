// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/driver.hpp"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/error.hpp"
#include "core/run/realtime.hpp"
#include "core/tap/reader.hpp"
#include "core/tap/wire.hpp"

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

Driver::Driver(const fulmar_component& functions, void* instance, const ComponentInfo& info)
    : functions_(functions), instance_(instance), info_(info), ring_(ring_bytes, largest(info)) {
  for (const Port& port : info.outputs) {
    data_.emplace_back(std::size_t{port.capacity} * (port.type ? port.type->size : sizeof(double)));
    stamps_.emplace_back(port.capacity);
  }
  outputs_.resize(info.outputs.size());
}

Driver::~Driver() {
  stop_.store(true, std::memory_order_release);
  if (!thread_.joinable()) return;
  for (int i = 0; i < patience_ms && !ended_.load(std::memory_order_acquire); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!ended_.load(std::memory_order_acquire)) {
    std::fprintf(stderr, "fulmar: the driver %s does not return from its step; the host ends without it\n", info_.name.c_str());
    std::_Exit(1);
  }
  thread_.join();
}

void Driver::start() {
  sigset_t all, before;  // signals are for the main thread
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_setname_np(thread_.native_handle(), "fulmar-driver");
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

bool Driver::step() noexcept {
  const fulmar_tick tick{now_ns_.load(std::memory_order_relaxed), 0, steps_++};
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = {data_[i].data(), stamps_[i].data(), tick.now_ns, 0, 0};
  error_.text[0] = '\0';
  if (functions_.step(instance_, &tick, nullptr, outputs_.data(), &error_) >= FULMAR_FAILED) return false;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Port& port = info_.outputs[i];
    const std::size_t size = port.type ? port.type->size : sizeof(double);
    std::uint64_t lost = outputs_[i].lost;
    for (std::uint32_t k = 0; k < std::min(outputs_[i].count, port.capacity); ++k) {
      const Ring::Record record{0, static_cast<std::uint32_t>(i), 0, 0, port.type ? stamps_[i][k] : FULMAR_ON_ARRIVAL};
      if (!ring_.push(record, data_[i].data() + k * size, size)) ++lost;
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
  sample = {record->channel, record->valid_ns == FULMAR_ON_ARRIVAL ? now_ns : record->valid_ns, record->data()};
  return true;
}

RecordedSamples::RecordedSamples(const std::filesystem::path& log, const ComponentInfo& info, const std::vector<std::string>& topics,
                                 std::int64_t epoch_ns) {
  const McapFile file = read_mcap(log);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].empty()) continue;
    const std::uint16_t channel = file.channel(topics[i]);
    const Type& type = *info.outputs[i].type;
    if (file.schemas.at(file.channels.at(channel).schema).text != ros_definition(type))
      throw Error(log.string() + ": " + topics[i] + " has other fields than " + info.name + "." + info.outputs[i].name);
    for (const McapFile::Message& m : file.messages) {
      if (m.channel != channel) continue;
      Stored s{static_cast<std::int64_t>(m.log_ns) - epoch_ns, static_cast<std::int64_t>(m.publish_ns) - epoch_ns,
               static_cast<std::uint32_t>(i), std::vector<std::byte>(type.size)};
      cdr_decode(type, m.data.data(), m.data.size(), s.data.data());
      samples_.push_back(std::move(s));
    }
  }
  std::stable_sort(samples_.begin(), samples_.end(), [](const Stored& a, const Stored& b) { return a.log_ns < b.log_ns; });
}

bool RecordedSamples::next(std::int64_t now_ns, Sample& sample) noexcept {
  if (at_ == samples_.size() || samples_[at_].log_ns > now_ns) return false;
  const Stored& s = samples_[at_++];
  sample = {s.output, s.valid_at_ns, s.data.data()};
  return true;
}

}  // namespace fulmar::core
