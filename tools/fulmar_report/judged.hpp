// SPDX-License-Identifier: BSD-3-Clause
// Estimates in a report: errors, reported standard deviations, innovations; and tick intervals.
#pragma once
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_log/comparison.hpp"
#include "tools/fulmar_report/columns.hpp"

namespace fulmar::report {

/// An error curve. Columns: the value and its reported standard deviation (NaN without one).
struct JudgedSeries {
  std::string words, unit;  ///< "roll", "deg"
  Columns columns;
  states::Moments all;           ///< of the values
  consistency::Channel claimed;  ///< values with a reported standard deviation
  bool has_claim() const { return claimed.n > 0; }
};

struct JudgedEstimate {
  std::string topic, reference;  ///< "/nav/state"; "/vehicle/truth", or a receiver's topic
  bool truth = false;            ///< `reference` is the truth
  states::Judged judged;
  std::vector<JudgedSeries> series;  ///< of the compared quantities
};

/// The estimates of the log, each against the truth, or without it against the fixes of a receiver, as in
/// `fulmar log compare`. Estimates without a reference, and a truth in place of an estimate (error always
/// zero), are left out. Throws core::Error.
std::vector<JudgedEstimate> judged_estimates(const states::StateLog& log);

/// Innovations in expected standard deviations, each once: of fixes by axis (FilterCheck) if recorded, else
/// the largest axis; of magnetometer, barometer, pitot (NavigationHealth).
std::vector<JudgedSeries> innovations(const states::StateLog& log);

/// {n, mean_ms, p99_ms, max_ms} of the tick interval; null without recorded ticks.
nlohmann::json tick_times(const std::filesystem::path& log);

/// `most`: limit of the rows of each curve, which are those with the largest values.
nlohmann::json judged_json(const JudgedEstimate& estimate, std::size_t most);
nlohmann::json judged_json(const JudgedSeries& series, std::size_t most);

}  // namespace fulmar::report
