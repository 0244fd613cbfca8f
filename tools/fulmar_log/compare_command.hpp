// SPDX-License-Identifier: BSD-3-Clause
// `fulmar log compare`: two estimates side by side.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/fulmar_log/comparison.hpp"

namespace fulmar::states {

struct CompareArguments {
  std::string log;
  std::vector<std::string> rest;       // another log, if it is a file; then names of states
  std::string truth, fixes, names;     // topics; "before,now"; "" for the default
  std::optional<double> from_s, to_s;  // of flight time
  bool changed = false;                // leaves out equal topics
  bool json = false;
};

/// Default estimate and its reference: the truth of the log, else fixes.
Side usual_side(const StateLog& log, const std::string& topic);

/// Returns 0: compared, or with `changed` without a difference; 1: no common times. Throws core::Error.
int compare_command(const CompareArguments& words);

}  // namespace fulmar::states
