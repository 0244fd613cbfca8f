// SPDX-License-Identifier: BSD-3-Clause
// Output of frames from two threads without a lock: the loop writes at once. While the link's thread is
// writing, the loop leaves its frame to that thread.
#pragma once
#include <sched.h>

#include <atomic>

#include "frame.hpp"
#include "port.hpp"
#include "spsc_queue.hpp"

namespace fulmar::fcu {

class Outbox {
 public:
  /// Called by the thread of the loop. Never waits. Returns false when nothing is sent: no device, or a full
  /// one.
  bool send(const Frame& frame) noexcept {
    if (try_hold()) {
      drain();
      const bool sent = write(frame);
      release();
      return sent;
    }
    if (!left_.push(frame)) return false;
    // The holder of the port may have checked for frames just before this one.
    if (try_hold()) {
      drain();
      release();
    }
    return true;
  }

  /// Called by the thread of the link.
  bool send_own(const Frame& frame) noexcept {
    hold();
    drain();
    const bool sent = write(frame);
    release();
    drain_late();
    return sent;
  }

  /// Called by the thread of the link. After it returns, no thread writes to the old port.
  void attach(Port* port) noexcept {
    hold();
    for (Frame old; left_.pop(old);) continue;  // these frames are out of date
    port_ = port;
    release();
    drain_late();
  }

 private:
  // Both sides exchange the flag, so that the second one sees the frames that the first one left.
  bool try_hold() noexcept { return !held_.exchange(true, std::memory_order_acq_rel); }
  void release() noexcept { held_.exchange(false, std::memory_order_acq_rel); }
  void hold() noexcept {
    while (!try_hold()) sched_yield();  // the loop finishes one write
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
  Port* port_ = nullptr;       ///< accessed by the holder
  SpscQueue<Frame, 16> left_;  ///< pushed by the loop, popped by the holder
};

}  // namespace fulmar::fcu
