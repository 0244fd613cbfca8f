// SPDX-License-Identifier: BSD-3-Clause
// Loads a plugin in a child process first, so that a crash, a hang or an exit does not affect the host.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

/// A script as a child opens it: its private copy, and its original path.
struct ProbedScript {
  std::filesystem::path copy, file;
};

/// Fault of the plugin at `copy`, in a sentence that begins with `name`. "" when a child has loaded, read and
/// unloaded it. With a script, `copy` is the plugin that hosts its language, and the script is the file under
/// test. The time limit is 5 s of CPU time, or FULMAR_PROBE_SECONDS, and four times that on the wall clock.
/// Throws Error when the program fulmar-probe is missing.
std::string probe(const std::filesystem::path& copy, const std::string& name,
                  const ProbedScript& script = {});

/// Whether a plugin stays mapped in the process after it is closed; its replacement would then run the old
/// code. Tested in a child.
bool stays_mapped(const std::filesystem::path& copy);

}  // namespace fulmar::core
