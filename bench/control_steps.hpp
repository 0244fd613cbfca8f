// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

/// A step of a law alone: no guard, no port, no clock.
struct LawStep {
  std::string name;
  std::function<void()> thousand;  ///< steps, one after another
};

/// Laws of the shipped controllers, the Anaconda in a climbing turn; `dt` 2.5 ms.
std::vector<LawStep> law_steps();
