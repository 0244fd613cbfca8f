// SPDX-License-Identifier: BSD-3-Clause
// Who else has a device open: for the sentence that says why it cannot be had. Source: proc(5).
#pragma once
#include <sys/stat.h>

#include <string>

namespace fulmar::fcu {

/// "minicom (pid 123)" of the program that has locked this file; empty when /proc does not tell.
std::string lock_holder(const struct stat& file);

/// The same of another program that has this character device open, locked or not; empty when there is none
/// or /proc does not tell.
std::string other_user(const struct stat& device);

}  // namespace fulmar::fcu
