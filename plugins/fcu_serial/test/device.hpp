// SPDX-License-Identifier: BSD-3-Clause
// Possible devices on a serial port, in real time: a flight controller, a satellite receiver, noise, silence.
#pragma once
#include <time.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "plugins/fcu_serial/test/peer/firmware.hpp"
#include "pty.hpp"

namespace fulmar::fcu::testing {

/// Time since shortly before the first call: the clock of a new controller starts at 0, and the time since
/// the boot of the computer must not be simulated.
inline std::int64_t wall_us() {
  const auto now_us = [] {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return std::int64_t{t.tv_sec} * 1000000 + t.tv_nsec / 1000;
  };
  static const std::int64_t begun_us = now_us() - 1;
  return now_us() - begun_us;
}

/// Calls `work` repeatedly in a separate thread until it is destroyed.
class Device {
 public:
  explicit Device(std::function<void(Pty&)> work)
      : thread_([this, work = std::move(work)] {
          while (!over_) {
            // The thread that holds a mutex usually gets it again at once, so waiting threads must be let in.
            while (waiting_ > 0) std::this_thread::yield();
            const std::lock_guard lock(mutex_);
            work(pty_);
          }
        }) {}
  ~Device() {
    over_ = true;
    thread_.join();
  }
  std::string name() const { return pty_.name(); }
  /// Between two calls of `work`.
  void change(const std::function<void(Pty&)>& change) {
    ++waiting_;
    const std::lock_guard lock(mutex_);
    --waiting_;
    change(pty_);
  }

 private:
  Pty pty_;
  std::mutex mutex_;
  std::atomic<bool> over_{false};
  std::atomic<int> waiting_{0};
  std::thread thread_;
};

inline void pause_us(long us) {
  const timespec t{us / 1000000, us % 1000000 * 1000};
  nanosleep(&t, nullptr);
}

/// One pass of a controller: reads the input and sends the frames that are due.
inline void serve(peer::Firmware& fcu, Pty& pty) {
  std::array<std::uint8_t, 1024> room{};
  if (pty.master() >= 0)
    if (const std::size_t n = pty.read(room, 0)) fcu.receive({room.data(), n}, wall_us());
  fcu.run(wall_us());
  const auto out = fcu.take();
  if (pty.master() >= 0 && !out.empty()) pty.write(out);
  pause_us(200);
}

}  // namespace fulmar::fcu::testing
