// SPDX-License-Identifier: BSD-3-Clause
// Loads a plugin in a child process first: what crashes, hangs or changes the process does it there.
#pragma once
#include <filesystem>
#include <string>

namespace fulmar::core {

/// A script, as a child opens it: its private copy, and where its author keeps it.
struct ProbedScript {
  std::filesystem::path copy, file;
};

/// What is wrong with the plugin at `copy`, in a sentence that begins with `name`. "" when a child has
/// loaded, read and unloaded it. With a script, `copy` is the plugin that hosts its language, and the script
/// is what is tried. The time limit is 5 s of the CPU, or FULMAR_PROBE_SECONDS, and four times that by the
/// clock on the wall. Throws Error when the program fulmar-probe is missing.
std::string probe(const std::filesystem::path& copy, const std::string& name,
                  const ProbedScript& script = {});

/// Whether a plugin that can be loaded stays in the process after it is closed: what takes its place would
/// run its code. Tried in a child.
bool stays_mapped(const std::filesystem::path& copy);

}  // namespace fulmar::core
