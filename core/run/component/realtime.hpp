// SPDX-License-Identifier: BSD-3-Clause
// Real-time priority for the thread of the loop.
#pragma once
#include <sys/types.h>

namespace fulmar::core {

inline constexpr int usual_priority =
    80;  // of 1 to 99: above the interrupt threads of a real-time kernel, which have 50

/// Puts the calling thread under SCHED_FIFO, locks the memory of the process, and takes the pages of the
/// stack that a tick needs. Call before the flight is created: then its heap is locked, too. May be called
/// again. Throws Error, with the ways to allow it, when that is not permitted.
///
/// Nothing inherits the priority: threads and processes that the calling thread creates afterwards have
/// ordinary scheduling. That suits the log, drivers and asynchronous components. Two kinds need a priority,
/// because the loop waits for them. One is the child of an isolated component (`wait_for_child`). The other
/// is the thread with which a vehicle reads its device: the vehicle gives it the policy, priority and CPU of
/// the thread that calls its `read`.
void take_real_time(int priority);

/// Binds the calling thread, the loop's, to the last CPU that it may use, because interrupts gather on the
/// first. A vehicle that reads its device in another thread can then bind that thread to the same CPU: a
/// sample does not have to wake a second CPU. For a flight on hardware. Undone by `leave_cpu_of_loop`.
void stay_on_one_cpu() noexcept;
/// Allows any CPU again: for a thread that the loop's thread has created since, and for the loop's thread
/// after the flight.
void leave_cpu_of_loop() noexcept;

/// Lets a child for whose answers the calling thread waits run one priority below that thread. Then an
/// ordinary program cannot delay the loop through the child, and a hanging child does not keep the loop from
/// detecting it. Threads and processes that the child starts have ordinary scheduling again. The child may
/// run on any CPU. Does nothing when the calling thread has no real-time priority; a child without permission
/// stays as it is.
void wait_for_child(pid_t child) noexcept;

}  // namespace fulmar::core
