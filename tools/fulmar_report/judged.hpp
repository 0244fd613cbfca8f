// SPDX-License-Identifier: BSD-3-Clause
// What a report says of estimates: their errors, the deviations they claim, what the sensors showed of it;
// and when the ticks came.
#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_log/comparison.hpp"
#include "tools/fulmar_report/columns.hpp"

namespace fulmar::report {

/// A curve that is judged. Columns: the value, and where it is claimed its deviation (NaN where not).
struct JudgedSeries {
  std::string words, unit;  ///< "roll", "deg"
  Columns columns;
  states::Moments all;           ///< of the values
  consistency::Channel claimed;  ///< of those for which there was a claim
  bool has_claim() const { return claimed.n > 0; }
};

struct JudgedEstimate {
  std::string topic, reference;  ///< "/nav/state"; "/vehicle/truth", or a receiver's topic
  bool truth = false;            ///< `reference` is the truth
  states::Judged judged;
  std::vector<JudgedSeries> series;  ///< of those quantities that were ever compared
};

/// The estimates of the log, each against the truth that there is, else against a receiver's fixes, as
/// `fulmar log compare` does. One that has neither is left out, as is a truth that stands for an estimate
/// (an error of zero throughout). Throws core::Error.
std::vector<JudgedEstimate> judged_estimates(const states::StateLog& log);

/// Innovations in expected deviations, each once: of fixes by axis (FilterCheck) where they are recorded,
/// else the largest of the axes; of magnetometer, barometer, pitot tube (NavigationHealth).
std::vector<JudgedSeries> innovations(const states::StateLog& log);

/// {n, mean_ms, p99_ms, max_ms} of the time from one tick to the next; null when nobody recorded ticks.
nlohmann::json tick_times(const std::filesystem::path& log);

/// `most`: so many rows of each curve, those with the largest values.
nlohmann::json judged_json(const JudgedEstimate& estimate, std::size_t most);
nlohmann::json judged_json(const JudgedSeries& series, std::size_t most);

}  // namespace fulmar::report
