// SPDX-License-Identifier: BSD-3-Clause
// Results of `fulmar aero tune`.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/app/program.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/tune_flight.hpp"
#include "tools/fulmar_aero/tune_words.hpp"

namespace fulmar::aero {

struct TuneOutcome {
  int code = core::ExitCode::done;
  std::vector<std::string> faults;  ///< a sentence each; with a fault the exit code is not 0
  std::vector<Gain> gains, shipped_gains;
  Judged computed;
  std::optional<Judged> shipped;    ///< with the gains of the file
  std::optional<TuneFlight> flown;  ///< with --verify
};
/// Prints all but the faults, and writes the file if requested and without faults.
TuneOutcome tune_outcome(const FlightOptions& options, const TuneOptions& tune_options);

}  // namespace fulmar::aero
