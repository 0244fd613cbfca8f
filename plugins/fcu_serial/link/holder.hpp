// SPDX-License-Identifier: BSD-3-Clause
// Programs that have a device open, for the message about a device in use. Source: proc(5).
#pragma once
#include <sys/stat.h>

#include <string>

namespace fulmar::fcu {

/// Program that has locked this file, "minicom (pid 123)"; empty when /proc does not show it.
std::string lock_holder(const struct stat& file);

/// The same of another program that has this character device open, locked or not; empty when /proc shows
/// none.
std::string other_user(const struct stat& device);

}  // namespace fulmar::fcu
