// SPDX-License-Identifier: BSD-3-Clause
// Two estimates side by side: how they differ, and where the log has a truth or the fixes of a receiver, how
// far each is off and whether it knows. Both logs are read once, in streams.
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

/// Where an estimate stands, and with what it is judged.
struct Side {
  const StateLog* log = nullptr;
  std::string topic;
  std::string truth, fixes, check;  // topics of the same log, or ""; `truth` before `fixes`
};

/// Of one estimate against the truth or the fixes. A row per quantity, as everywhere.
struct Errors {
  std::vector<Moments> all;
  std::vector<consistency::Channel> claimed;  // of those errors for which there was a claim
  consistency::Nees nees;
  std::uint64_t nees_n = 0;
  bool correlated = false;  // in `nees` the correlations that the filter tells
  std::uint64_t pairs = 0;
};

struct Judged {
  std::uint64_t samples = 0;
  std::int64_t first_ns = 0, last_ns = 0;     // flight time of validity
  std::uint64_t not_finite = 0, not_new = 0;  // samples with what is no number; not later than the one before
  Errors errors;
};

struct Comparison {
  std::vector<Moments> difference;     // second minus first
  std::uint64_t pairs = 0, times = 0;  // times at which both were there, of those of the sparser one
  Judged first, second;
  std::optional<double> truths_apart_m;  // at most; of two logs whose truths are not the same
  bool equal = false;                    // the same samples, as far as they are compared
};

/// Flight time of validity, of states.
struct Span {
  std::int64_t from_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::max();
  bool holds(std::int64_t ns) const { return from_ns <= ns && ns <= to_ns; }
};

/// Throws core::Error.
Comparison compare(const Side& first, const Side& second, const Span& span = {});

/// An error of quantities()[quantity], in its unit, and the deviation that is claimed for it; NaN: none is.
using TakeError =
    std::function<void(std::int64_t valid_ns, std::size_t quantity, double error, double claim)>;

/// One estimate against its truth or fixes; `take` gets each error. Throws core::Error.
Judged judge(const Side& side, const TakeError& take, const Span& span = {});

}  // namespace fulmar::states
