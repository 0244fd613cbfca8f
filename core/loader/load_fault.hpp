// SPDX-License-Identifier: BSD-3-Clause
// Sentences made of what the system's loader says (glibc's wording, dlerror(3)).
#pragma once
#include <string>

namespace fulmar::core {

/// "my_law.so needs libfoo.so.1, which is not there".
std::string load_fault(const std::string& name, const char* dlerror_text);
std::string no_entry_fault(const std::string& name);

}  // namespace fulmar::core
