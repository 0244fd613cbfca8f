// SPDX-License-Identifier: BSD-3-Clause
// Options that name a mission and override parts of it, for every subcommand that loads one.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// "a=b" -> {a, b}. Throws CLI::ValidationError with the option and the form of its value, "ROLE=COMPONENT".
std::vector<std::pair<std::string, std::string>> pairs(const std::vector<std::string>& words,
                                                       const char* option, const char* form);

/// Option that may be given several times, with one value each time.
void add_pairs(CLI::App* command, const char* option, std::vector<std::string>& words, const char* type,
               const char* help);

/// Validator of an option that names a file. An empty value, as of a shell variable that is not set, is
/// rejected and does not mean the default.
CLI::Validator a_file(const std::string& otherwise);

struct MissionOptions {
  std::string mission, io, arm;
  std::uint64_t seed = 0;
  std::vector<std::string> roles, set, with, record;

  void add(CLI::App* command);
  /// Throws CLI::ValidationError.
  Overrides overrides(const CLI::App* command) const;
};

}  // namespace fulmar::core
