// SPDX-License-Identifier: BSD-3-Clause
// Real-time priority for the thread of the loop.
#pragma once
#include <sys/types.h>

namespace fulmar::core {

inline constexpr int usual_priority =
    80;  // of 1 to 99: above the interrupt threads of a real-time kernel, which have 50

/// Puts the calling thread under SCHED_FIFO, locks the memory of the process, and takes the pages of the
/// stack that a tick needs. Call before the flight is created: what it then takes from the heap is locked,
/// too. May be called again. Throws Error, with the ways to allow it, when that is not permitted.
///
/// Nothing inherits the priority: threads and processes that the calling thread creates afterwards are
/// ordinary ones. That is meant for the log, drivers and asynchronous components, which may take their time.
/// Two kinds need one of their own, since the loop waits for them: the child of an isolated component
/// (`wait_for_child`), and the thread with which a vehicle reads its device: the vehicle gives it the policy,
/// priority and CPU of the thread that calls its `read`.
void take_real_time(int priority);

/// The calling thread, the loop's, stays on the last CPU that it may use, since interrupts gather on the
/// first: a vehicle that reads its device in another thread can then run that one beside it, and to hand a
/// sample over costs no waking of a second CPU. For a flight on hardware. Undone by `leave_cpu_of_loop`.
void stay_on_one_cpu() noexcept;
/// For a thread that the loop's thread has created since, and for that thread itself when the flight is over:
/// any CPU again.
void leave_cpu_of_loop() noexcept;

/// Lets a child for whose answers the calling thread waits run one priority below that thread, so that an
/// ordinary program cannot delay the loop by way of the child, and a child that hangs does not keep the loop
/// from seeing it. What the child starts is ordinary again. It may run on any CPU. Does nothing when the
/// calling thread has no real-time priority; a child that may not have one stays as it is.
void wait_for_child(pid_t child) noexcept;

}  // namespace fulmar::core
