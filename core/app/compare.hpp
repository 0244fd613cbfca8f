// SPDX-License-Identifier: BSD-3-Clause
// Compares the results of two flights.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/app/messages.hpp"

namespace fulmar::core {

/// Figures that exist in both results. The results have the form of result_json.
struct FigureChanges {
  struct Change {
    std::string name;  // "tracking_rmse.north_m"
    nlohmann::json before, after;
  };
  std::vector<Change> changed;
  int equal = 0;
};
FigureChanges figure_changes(const nlohmann::json& before, const nlohmann::json& after);

/// Heading and column names of the comparison.
struct Sides {
  const char* heading = app_messages::flights_compared.c_str();
  const char* before = "before";
  const char* after = "now";
};

/// Table of the figures that both results have and that differ: before, after, change.
std::string comparison(const FigureChanges& changes, const Sides& sides = {});
std::string comparison(const nlohmann::json& before, const nlohmann::json& after);

}  // namespace fulmar::core
