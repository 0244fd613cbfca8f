// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "fulmar/message.hpp"

namespace fulmar::score {

/// Running mean of squares. Unlike a growing sum it loses no digits in a long flight.
struct MeanSquare {
  double mean = 0;
  double count = 0;
  void add(double error) { mean += (error * error - mean) / ++count; }
  double rms() const { return std::sqrt(mean); }
  double rms_if_any() const { return count > 0 ? rms() : unknown_std; }
};

}  // namespace fulmar::score
