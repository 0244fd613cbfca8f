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
  std::vector<std::string> rest;       // another log, if it is a file; then the names of states
  std::string truth, fixes, names;     // topics; "before,now"; "" where nothing is said
  std::optional<double> from_s, to_s;  // of flight time
  bool changed = false;                // nothing of what is equal
  bool json = false;
};

/// An estimate and what it is judged with unless somebody says otherwise: the log's truth, else fixes.
Side usual_side(const StateLog& log, const std::string& topic);

/// 0: compared, or with `changed` nothing was to be; 1: at no time were both there. Throws core::Error.
int compare_command(const CompareArguments& words);

}  // namespace fulmar::states
