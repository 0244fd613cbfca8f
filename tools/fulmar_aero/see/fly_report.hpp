// SPDX-License-Identifier: BSD-3-Clause
// The results of `fulmar aero fly` as a page.
#pragma once
#include <optional>
#include <string>

#include "tools/fulmar_aero/findings.hpp"
#include "tools/fulmar_aero/tune_outcome.hpp"

namespace fulmar::aero {

/// Results of the completed steps.
struct FlyRecord {
  const AirframeFile* file = nullptr;
  const Findings* findings = nullptr;
  double altitude_m = 0;
  std::optional<TuneOutcome> tuned;
  std::string verdict;  ///< "flown", or the step that failed
};
std::string fly_report_html(const FlyRecord& record);

}  // namespace fulmar::aero
