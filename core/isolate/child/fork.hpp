// SPDX-License-Identifier: BSD-3-Clause
// Rejects forks of the child: a copy of the child would also answer the host.
#pragma once

namespace fulmar::core {

/// The fork that was rejected in this thread, as in "vfork"; nullptr: none.
extern constinit thread_local const char* refused_fork;
/// True while the component flies in this thread: forks are rejected.
extern constinit thread_local bool refuses_forks;

}  // namespace fulmar::core
