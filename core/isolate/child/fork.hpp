// SPDX-License-Identifier: BSD-3-Clause
// Forks of the child: a copy of it would answer the host as well.
#pragma once

namespace fulmar::core {

/// The fork that was refused to the component in this thread, as in "vfork"; nullptr: none.
extern constinit thread_local const char* refused_fork;
/// Forks are refused now: the component flies in this thread.
extern constinit thread_local bool refuses_forks;

}  // namespace fulmar::core
