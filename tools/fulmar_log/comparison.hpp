// SPDX-License-Identifier: BSD-3-Clause
// Comparison of two estimates: their difference, and with a truth or the fixes of a receiver in the log, the
// error of each and the consistency of its standard deviation. Both logs are read once, as streams.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fulmar/flight/navigation/consistency.hpp"
#include "tools/fulmar_log/states.hpp"

namespace fulmar::states {

struct Moments {
  double sum = 0, squares = 0, most = 0;
  std::uint64_t n = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++n;
    if (std::abs(x) > std::abs(most)) most = x;
  }
  double over_n(double x) const { return n > 0 ? x / static_cast<double>(n) : 0; }
  double mean() const { return over_n(sum); }
  double rms() const { return std::sqrt(over_n(squares)); }
};

/// Source of an estimate and of its reference.
struct Side {
  const StateLog* log = nullptr;
  std::string topic;
  std::string truth, fixes, check;  // topics of the same log, or ""; `truth` has priority over `fixes`
};

/// Errors of one estimate against the truth or the fixes, one row per quantity.
struct Errors {
  std::vector<Moments> all;
  std::vector<consistency::Channel> claimed;  // of the errors with a reported standard deviation
  consistency::Nees nees;
  std::uint64_t nees_n = 0;
  bool correlated = false;  // `nees` includes the correlations that the filter reports
  std::uint64_t pairs = 0;
};

struct Judged {
  std::uint64_t samples = 0;
  std::int64_t first_ns = 0, last_ns = 0;  // flight time of validity
  // samples with a value that is not finite; not later than the one before
  std::uint64_t not_finite = 0, not_new = 0;
  Errors errors;
};

struct Comparison {
  std::vector<Moments> difference;     // second minus first
  std::uint64_t pairs = 0, times = 0;  // times at which both have a value; times of the sparser one
  Judged first, second;
  std::optional<double> truths_apart_m;  // largest distance between the truths of two logs, if they differ
  bool equal = false;                    // the same samples in the compared quantities
};

/// Flight time of validity of states.
struct Span {
  std::int64_t from_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::max();
  bool holds(std::int64_t ns) const { return from_ns <= ns && ns <= to_ns; }
};

/// Throws core::Error.
Comparison compare(const Side& first, const Side& second, const Span& span = {});

/// An error of quantities()[quantity] in its unit, and its reported standard deviation; NaN: none.
using TakeError =
    std::function<void(std::int64_t valid_ns, std::size_t quantity, double error, double claim)>;

/// Compares one estimate with its truth or fixes; `take` gets each error. Throws core::Error.
Judged judge(const Side& side, const TakeError& take, const Span& span = {});

}  // namespace fulmar::states
