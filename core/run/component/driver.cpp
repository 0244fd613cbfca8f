// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/component/driver.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "core/run/component/process_state.hpp"
#include "core/run/component/realtime.hpp"
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
constexpr int patience_ms = 2000;  // for the present step of a driver at the end of the flight

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
    for (;;) ::syscall(SYS_exit_group, 1);  // _Exit would count as an exit by a plugin
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

}  // namespace fulmar::core
