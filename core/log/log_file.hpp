// SPDX-License-Identifier: BSD-3-Clause
// A file that is named as a log.
#pragma once
#include <string>

namespace fulmar::core {

/// Throws Error that says why what is named is no log: there is none, a directory, empty.
void check_log_file(const std::string& file);

}  // namespace fulmar::core
