// SPDX-License-Identifier: BSD-3-Clause
// What `fulmar aero tune` has found.
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
  std::vector<std::string> faults;  ///< a sentence each; with one of them the code is not 0
  std::vector<Gain> gains, shipped_gains;
  Judged computed;
  std::optional<Judged> shipped;    ///< with the gains that the file has
  std::optional<TuneFlight> flown;  ///< with --verify
};
/// Prints all but the faults, and writes the file when it is asked for and nothing is at fault.
TuneOutcome tune_outcome(const FlightOptions& options, const TuneOptions& tune_options);

}  // namespace fulmar::aero
