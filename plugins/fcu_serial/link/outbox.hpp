// SPDX-License-Identifier: BSD-3-Clause
// The way out, for two threads without a lock: the loop writes at once, or, while the link's thread is
// writing, leaves its frame for that one.
#pragma once
#include <sched.h>

#include <atomic>

#include "frame.hpp"
#include "port.hpp"
#include "spsc_queue.hpp"

namespace fulmar::fcu {

class Outbox {
 public:
  /// The loop's thread. Never waits. False when nothing goes out: no device, or one that takes no more.
  bool send(const Frame& frame) noexcept {
    if (try_hold()) {
      drain();
      const bool sent = write(frame);
      release();
      return sent;
    }
    if (!left_.push(frame)) return false;
    // Who holds the port may have looked for frames just before this one.
    if (try_hold()) {
      drain();
      release();
    }
    return true;
  }

  /// The link's thread.
  bool send_own(const Frame& frame) noexcept {
    hold();
    drain();
    const bool sent = write(frame);
    release();
    drain_late();
    return sent;
  }

  /// The link's thread. When it returns, nobody writes to the port before any more.
  void attach(Port* port) noexcept {
    hold();
    for (Frame old; left_.pop(old);) continue;  // meant for a moment that is over
    port_ = port;
    release();
    drain_late();
  }

 private:
  // Both sides exchange, so that whichever comes second sees what the first has left.
  bool try_hold() noexcept { return !held_.exchange(true, std::memory_order_acq_rel); }
  void release() noexcept { held_.exchange(false, std::memory_order_acq_rel); }
  void hold() noexcept {
    while (!try_hold()) sched_yield();  // the loop is within one write
  }
  bool write(const Frame& frame) noexcept { return port_ != nullptr && port_->write(frame.view()); }
  void drain() noexcept {
    for (Frame frame; left_.pop(frame);) write(frame);
  }
  void drain_late() noexcept {
    while (!left_.empty() && try_hold()) {
      drain();
      release();
    }
  }

  std::atomic<bool> held_{false};
  Port* port_ = nullptr;       ///< of who holds
  SpscQueue<Frame, 16> left_;  ///< by the loop; taken by who holds
};

}  // namespace fulmar::fcu
