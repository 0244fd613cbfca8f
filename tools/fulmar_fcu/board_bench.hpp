// SPDX-License-Identifier: BSD-3-Clause
// One report of a board at rest: latency, rates, gaps and losses of the link, noise of each sensor.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/client.hpp"

namespace fulmar::fcu {

/// Running mean and standard deviation. Welford (1962).
class Spread {
 public:
  void add(double value) {
    ++count_;
    const double off = value - mean_;
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (value - mean_);
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }
  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  double deviation() const { return count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : 0; }
  double least() const { return least_; }
  double most() const { return most_; }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

/// One kind of message as it arrived.
struct Stream {
  std::string name;
  std::uint8_t id = 0;
  double last_s = -1;
  Spread interval_s;  ///< between two arrivals
};

/// One value of a sensor.
struct Channel {
  std::string name, unit;
  Spread value;
};

struct BoardReport {
  std::string port, version, at;  ///< `at`: UTC, empty when unknown
  double seconds = 0, bytes_per_s = 0;
  std::uint64_t frames = 0, missing = 0, bad = 0;
  std::vector<double> round_trips_s;  ///< sorted
  std::uint64_t unanswered = 0;
  std::uint64_t imu_lost = 0;  ///< by the clock of the samples
  double imu_gap_s = 0;        ///< the longest, by that clock
  std::vector<Stream> streams;
  std::vector<Channel> channels;
};

/// Measures for that time. The board must not move.
BoardReport measure_board(Client& client, double seconds, int questions = 100);
/// Quantile of sorted values; 0 for none.
double quantile(const std::vector<double>& sorted, double share);
nlohmann::json board_json(const BoardReport& report);
std::string board_markdown(const BoardReport& report);

}  // namespace fulmar::fcu
