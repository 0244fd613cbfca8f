// SPDX-License-Identifier: BSD-3-Clause
// Two flights side by side.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/app/messages.hpp"

namespace fulmar::core {

/// The figures that two results both have. Results as result_json makes them.
struct FigureChanges {
  struct Change {
    std::string name;  // "tracking_rmse.north_m"
    nlohmann::json before, after;
  };
  std::vector<Change> changed;
  int equal = 0;
};
FigureChanges figure_changes(const nlohmann::json& before, const nlohmann::json& after);

/// How the two are called.
struct Sides {
  const char* heading = app_messages::flights_compared.c_str();
  const char* before = "before";
  const char* after = "now";
};

/// A table of the figures that both results have and that differ: before, after, change.
std::string comparison(const FigureChanges& changes, const Sides& sides = {});
std::string comparison(const nlohmann::json& before, const nlohmann::json& after);

}  // namespace fulmar::core
